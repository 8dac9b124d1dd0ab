//! The exported datasets under the BIDS validator, where npm is there to fetch it.
//!
//! The legacy validator, 1.15.0, is plain JavaScript for Node 18 and newer, and the only one of the two official
//! validators on npm (the other one, 2 and newer, wants Deno). As a dependency it brings 900 packages of 700 MB along,
//! which the program in its package never loads: so the package alone is fetched and unpacked, and no script
//! of any package runs.

use crate::{packages, run};
use anyhow::{Result, ensure};

/// The package, as npm names it.
const PACKAGE: &str = "bids-validator@1.15.0";
/// Its file in the registry.
const ARCHIVE: &str = "bids-validator-1.15.0.tgz";
/// What the registry had on 2026-11-22, as `npm view bids-validator@1.15.0 dist.integrity` prints it.
const INTEGRITY: &str =
    "sha512-gZ0UUTLBt5L3nuhLia/VfvK5OaM0yoTBPJvGmC4slQ8yDzpanWZOHHBS+PAua0riQ7Cwa51HER/Fnd9v17MHUw==";
/// The program and what it loads, a tenth of the archive.
const PARTS: [&str; 3] = ["package/package.json", "package/bin", "package/dist/commonjs/cli.js"];
/// npm is a script, which Windows starts under its whole name alone.
const NPM: &str = if cfg!(windows) { "npm.cmd" } else { "npm" };

/// Runs the tests that the validator decides; says in one line why not, where it cannot be had.
pub fn test() -> Result<()> {
    if !packages::on_path(NPM) {
        println!("LEFT OUT: the exported datasets under the BIDS validator, since npm is not on the path.");
        return Ok(());
    }
    if let Err(reason) = provide() {
        println!("LEFT OUT: the exported datasets under the BIDS validator, which could not be fetched: {reason:#}");
        return Ok(());
    }
    run::cargo(&["test", "--locked", "-p", "scumble-analysis", "--test", "bids_validator", "--", "--ignored"])
}

/// Makes `tools/bids-validator` in the target folder, where the test looks for it.
fn provide() -> Result<()> {
    let tools = run::target_directory().join("tools");
    let folder = tools.join("bids-validator");
    if folder.exists() {
        return Ok(());
    }
    // A folder under its last name is whole.
    let partial = tools.join("bids-validator.partial");
    if partial.exists() {
        std::fs::remove_dir_all(&partial)?;
    }
    std::fs::create_dir_all(&partial)?;
    let place = run::text(&partial)?;
    println!("Fetching {PACKAGE} into {}", folder.display());
    let fetched = run::output(NPM, &["pack", PACKAGE, "--json", "--ignore-scripts", "--pack-destination", place])?;
    ensure!(fetched.contains(INTEGRITY), "{PACKAGE} is not what it was: npm says {fetched}; allowed is {INTEGRITY}");
    let archive = partial.join(ARCHIVE);
    run::output("tar", &[&["-xzf", run::text(&archive)?, "-C", place], &PARTS[..]].concat())?;
    std::fs::remove_file(archive)?;
    Ok(std::fs::rename(partial, folder)?)
}
