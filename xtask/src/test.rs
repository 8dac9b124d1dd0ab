//! Every test, and the promises of the whole chain.

use crate::packages;
use crate::{bids, demo, python, run};
use anyhow::Result;

/// Installs what is missing, runs the tests of all crates, those that need the BIDS validator or pandas where
/// these can be had, then a quick demo whose numbers are checked.
pub fn run() -> Result<()> {
    packages::provide(&[packages::COMPILER, packages::VULKAN, packages::WINDOWS])?;
    run::cargo(&["test", "--workspace", "--locked"])?;
    bids::test()?;
    python::test()?;
    demo::run(true)?.check()?;
    println!("All tests passed, and the demo keeps its promises.");
    Ok(())
}
