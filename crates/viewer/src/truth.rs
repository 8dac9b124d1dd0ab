//! x
use anyhow::Result;
pub fn run(_: &crate::cli::Truth) -> Result<()> {
    Ok(())
}
