//! The benchmark that the documentation quotes: every number and picture of its reports, by one command.

use crate::packages;
use crate::run;
use anyhow::Result;
use std::path::Path;

/// Sizes whose curve an adaptive one is set against, to the largest that WebGPU promises.
const SIZES: &str = "256,512,1024,2048,4096,8192,2048+blocks,adaptive";
/// A lamp over a body and its thin legs, as in the pictures of the thesis.
const HEADLINE_SCENE: &str = "recital";
/// Frames that the thesis averages.
const HEADLINE_FRAMES: &str = "10";

/// Runs both parts into `target/bench`; one that was killed goes on.
pub fn run(quick: bool) -> Result<()> {
    packages::provide(&[packages::COMPILER, packages::VULKAN])?;
    run::cargo(&["build", "--release", "--locked", "-p", "scumble-viewer"])?;
    let folder = run::target_directory().join("bench");
    let cache = run::truth_cache();

    println!("\n1/2  What accuracy each millisecond buys, on every scene");
    let trade = ["--methods", "none,pcf,pcss", "--sizes", SIZES, "--paths", "approach,creep,sweep", "--sweep-ratio"];
    bench(&trade, &folder.join("trade"), &cache, quick)?;

    println!("\n2/2  Kreuzer (2017), Fig. 5.4: two radii of PCF, two lights of PCSS, fixed and reduced maps, 25 taps");
    let headline = ["--scenes", HEADLINE_SCENE, "--softness", "1,4", "--frames", HEADLINE_FRAMES];
    bench(&headline, &folder.join("headline"), &cache, quick)
}

fn bench(options: &[&str], out: &Path, cache: &Path, quick: bool) -> Result<()> {
    let paths = [out.display().to_string(), cache.display().to_string()];
    let mut arguments = vec!["bench", "--out", &paths[0], "--cache", &paths[1]];
    arguments.extend(options);
    arguments.extend(quick.then_some("--quick"));
    run::program("scumble-viewer", &arguments)
}
