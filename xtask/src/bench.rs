//! The benchmark that the documentation quotes: every number and picture of its reports, by one command.

use crate::packages;
use crate::run;
use anyhow::Result;
use std::path::Path;

/// Sizes whose curve an adaptive one is set against, to the largest that WebGPU promises.
const SIZES: &str = "256,512,1024,2048,4096,8192,2048+blocks,adaptive";
/// The analytic edge, contact under the sky, contact under a lamp.
const CHOICES_SCENES: &str = "wedge,yard,room";
/// Every statistic of the demand.
const CHOICES_SIZES: &str = "2048,adaptive,adaptive@0.001,adaptive@0.01,adaptive@0.05";
/// A lamp over a body and its thin legs, as in the pictures of the thesis.
const HEADLINE_SCENE: &str = "recital";
/// Frames that the thesis averages.
const HEADLINE_FRAMES: &str = "10";

/// Runs all parts into `target/bench`; one that was killed goes on.
pub fn run(quick: bool) -> Result<()> {
    packages::provide(&[packages::COMPILER, packages::VULKAN])?;
    run::cargo(&["build", "--release", "--locked", "-p", "scumble-viewer"])?;
    let folder = run::target_directory().join("bench");
    let cache = run::truth_cache();

    println!("\n1/3  What accuracy each millisecond buys, on every scene");
    bench(&["--methods", "none,pcf,pcss", "--sizes", SIZES], &folder.join("trade"), &cache, quick)?;

    println!("\n2/3  Which ratio, which statistic, and what moves on the way");
    let choices = ["--scenes", CHOICES_SCENES, "--methods", "pcf,pcss,vsm", "--sizes", CHOICES_SIZES];
    let moving = ["--paths", "approach,creep,sweep", "--sweep-ratio"];
    bench(&[&choices[..], &moving].concat(), &folder.join("choices"), &cache, quick)?;

    println!("\n3/3  Kreuzer (2017), Fig. 5.4: radii of PCF and lights of PCSS, fixed and reduced maps, 25 taps");
    let headline = ["--scenes", HEADLINE_SCENE, "--softness", "1,4,8", "--frames", HEADLINE_FRAMES];
    bench(&headline, &folder.join("headline"), &cache, quick)
}

fn bench(options: &[&str], out: &Path, cache: &Path, quick: bool) -> Result<()> {
    let mut arguments = vec!["bench", "--out", run::text(out)?, "--cache", run::text(cache)?];
    arguments.extend(options);
    arguments.extend(quick.then_some("--quick"));
    run::program("scumble-viewer", &arguments)
}
