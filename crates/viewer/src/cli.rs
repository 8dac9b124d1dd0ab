//! The command line. Every number is checked here, so that the commands start with what makes sense.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use scumble::AtCap;
use scumble_reference::LightTruth;

use crate::size::{SIDE_MAX, SIDE_MIN, Size};
use crate::truth::LIGHT_SAMPLES;

const EXAMPLES: &str = "\
Examples:
  scumble-viewer shot --scene stairwell --method pcss --size adaptive --out stairs.png
      one picture with the smallest shadow map that hides its texels, and stairs.json beside it
  scumble-viewer shot --scene path/to/model.glb --method pcf --size 2048 --radius 0.05 --out model.png
      a scene of your own under a fixed map of 2048 x 2048 texels
  scumble-viewer bench --scenes stairwell --methods pcf,pcss --sizes 512,2048,adaptive --out results
      times, texels and errors against ground truth: results/report.html, bench.csv, bench.json and pictures
  scumble-viewer truth --scene stairwell --method pcss --out truth.png
      the same filter over an alias-free shadow, by rays on the processor: truth.png, .npy and .json
  scumble-viewer truth --scene stairwell --truth light --samples 256 --out light.png
      the light itself, by 256 rays a pixel, with its standard error in light.se.npy

`scumble-viewer scenes` lists the catalogue. Lengths are metres. In the repository, \
`cargo run --release -p scumble-viewer --` stands for `scumble-viewer`.";

/// Pictures and benchmarks of adaptive shadow maps on real scenes.
#[derive(Debug, Parser)]
#[command(name = "scumble-viewer", version, about, after_help = EXAMPLES)]
pub struct Cli {
    /// What to do; nothing prints this help.
    #[command(subcommand)]
    pub command: Option<Command>,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// One picture, and a JSON file of the same name beside it with texels, times and demand
    Shot(Shot),
    /// Compare sizes: times, texels, bytes, taps and error against ground truth
    Bench(Bench),
    /// Make report.html of a former bench anew
    Report {
        /// The folder with bench.json and the pictures
        #[arg(value_name = "DIR")]
        folder: PathBuf,
    },
    /// Ground truth by rays on the processor: the filter over an alias-free shadow, or the light itself
    Truth(Truth),
    /// List the scenes of the catalogue
    Scenes,
}

/// Options of `shot`.
#[derive(Debug, Args)]
pub struct Shot {
    /// What is drawn
    #[command(flatten)]
    pub view: View,
    /// How shadows are filtered
    #[arg(long, value_enum, default_value_t = Method::Pcss)]
    pub method: Method,
    /// Texels of the shadow map: `adaptive`, N for N x N, or NxM; with `@0.01` or `+blocks`, see bench
    #[arg(long, default_value = "adaptive", value_name = "adaptive|N[xM]")]
    pub size: Size,
    /// Samples per pixel along x and along y
    #[arg(long, default_value_t = 2, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=4))]
    pub samples: u32,
    /// The picture, a .png file
    #[arg(long, value_name = "PNG")]
    pub out: PathBuf,
}

/// Options of `bench`.
#[derive(Debug, Args)]
pub struct Bench {
    /// Scenes, names of the catalogue or files, separated by commas [default: the whole catalogue]
    #[arg(long, value_delimiter = ',', value_name = "S,S")]
    pub scenes: Vec<String>,
    /// Filters, separated by commas
    #[arg(long, value_enum, value_delimiter = ',', default_value = "pcf,pcss")]
    pub methods: Vec<Method>,
    /// How soft, separated by commas: times the radius of pcf and vsm and the size of the light for pcss
    #[arg(long, value_delimiter = ',', default_value = "1", value_name = "F,F", value_parser = positive)]
    pub softness: Vec<f64>,
    /// Sizes, separated by commas: `adaptive`, N or NxM. adaptive@0.01 lets 1 % of the pixels in penumbrae show texels, the
    /// narrowest; adaptive lets none. N+blocks is a fixed size with the pass of an adaptive one that
    /// tells where one lookup is enough, so that what it saves and what the size saves can be told apart
    #[arg(long, value_delimiter = ',', default_value = "2048,adaptive", value_name = "N,adaptive")]
    pub sizes: Vec<Size>,
    /// Timed frames of every variant; the variants take turns
    #[arg(long, default_value_t = 15, value_parser = clap::value_parser!(u32).range(3..=10_000))]
    pub frames: u32,
    /// Light, softness, relation and picture size
    #[command(flatten)]
    pub conditions: Conditions,
    /// The directory for report.html, bench.csv, bench.json and the pictures; made if missing. A run that was killed goes on
    /// when it is started again with the same options
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Rays of every pixel to the light, the truth of pcss and of hard shadows: one of 64, 128, 256, 512 and 1024
    /// [default: 256, with --quick 64]
    #[arg(long, value_name = "N")]
    pub light_samples: Option<u32>,
    /// Where finished truths are kept, so that a second run is quick; `truth --help` says more
    #[arg(long, value_name = "DIR")]
    pub cache: Option<PathBuf>,
    /// Half the width and height, one sample per pixel in the pictures, 64 rays to the light
    #[arg(long)]
    pub quick: bool,
    /// Measures on the way, too: adaptive maps while camera or light moves, and fixed ones beside them (2048 where --sizes has
    /// it, else the largest), by size, time, and what changes at fixed points. Paths, separated by commas
    #[arg(long, value_enum, value_delimiter = ',', value_name = "P,P")]
    pub paths: Vec<Motion>,
    /// Measures the choice of the ratio, too: error and violation of adaptive maps chosen by ratios from 0.5 to 10
    #[arg(long)]
    pub sweep_ratio: bool,
    /// The bench.json of a former run; prints what changed beyond noise: times whose quartile ranges do not overlap and
    /// whose medians differ by more than 5 %, texels, RMS errors in the penumbra that differ by more than 2 %
    #[arg(long, value_name = "OLD.json")]
    pub against: Option<PathBuf>,
}

impl Bench {
    /// Rays of every pixel to the light.
    pub fn light_samples(&self) -> u32 {
        let [fewest, ..] = LightTruth::SAMPLES;
        self.light_samples.unwrap_or(if self.quick { fewest } else { LIGHT_SAMPLES })
    }
}

/// Options of `truth`.
#[derive(Debug, Args)]
pub struct Truth {
    /// What is drawn
    #[command(flatten)]
    pub view: View,
    /// What the shadow is compared with
    #[arg(long, value_enum, default_value_t = TruthOf::Kernel)]
    pub truth: TruthOf,
    /// Which filter the kernel truth is of; the light has none
    #[arg(long, value_enum, default_value_t = Method::Pcss)]
    pub method: Method,
    /// Rays of every pixel: taps of the kernel, 1 to 1024 [default: the renderer's 25, of vsm 64], or points of the light, one of
    /// 64, 128, 256, 512 and 1024 [default: 256]
    #[arg(long, value_name = "N")]
    pub samples: Option<u32>,
    /// The picture, a .png file. Beside it: the visibility in the middle of every pixel as .npy (float32, height x
    /// width), for the light its standard error as .se.npy, and a .json file that says what they are
    #[arg(long, value_name = "PNG")]
    pub out: PathBuf,
    /// Where finished rows are kept, by everything that they depend on, so that a run that was killed goes on and a
    /// second one is quick; what is in it may be deleted at any time [default: scumble/truth in the system's folder for
    /// caches, ~/.cache on Linux]
    #[arg(long, value_name = "DIR")]
    pub cache: Option<PathBuf>,
}

/// What a shadow is compared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum TruthOf {
    /// The same filter over the exact hard shadow: what the texels do
    Kernel,
    /// The light itself, every point of it: what the filter does, too
    Light,
}

impl TruthOf {
    /// As the command line spells it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Kernel => "kernel",
            Self::Light => "light",
        }
    }
}

/// A scene under conditions.
#[derive(Debug, Args)]
pub struct View {
    /// A name of the catalogue or a .gltf, .glb or .obj file
    #[arg(long, value_name = "S")]
    pub scene: String,
    /// Another kind of light in the place of the scene's [default: the scene's]
    #[arg(long, value_enum, value_name = "KIND")]
    pub light: Option<LightKind>,
    /// Light, softness, relation and picture size
    #[command(flatten)]
    pub conditions: Conditions,
}

/// What a scene's lamp is changed to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum LightKind {
    /// A bulb as large as the lamp that shines to all sides; for scenes with a lamp
    Point,
}

/// What shot, bench and truth share.
#[derive(Clone, Debug, Args)]
pub struct Conditions {
    /// Size of the light: half angle in degrees of a sun, radius in metres of a lamp [default: the scene's]
    #[arg(long, value_name = "W", value_parser = positive, allow_negative_numbers = true)]
    pub light_size: Option<f64>,
    /// Filter radius of pcf, half side of vsm, in metres at the shadow [default: the scene's]
    #[arg(long, value_name = "R", value_parser = positive, allow_negative_numbers = true)]
    pub radius: Option<f64>,
    /// relation.json of a study: texels per filter radius [default: the published 3.47]
    #[arg(long, value_name = "FILE")]
    pub relation: Option<PathBuf>,
    /// Most texels per side of an adaptive map. Where the screen asks for more, pcss widens its narrowest shadows to
    /// what the map hides; pcf and vsm keep their radius and show texels; the records say `capped`
    #[arg(long, default_value_t = 1024, value_name = "N", value_parser = clap::value_parser!(u32).range(i64::from(SIDE_MIN)..=i64::from(SIDE_MAX)))]
    pub cap: u32,
    /// What gives way under pcss where the screen asks for more texels than --cap: width, so that texels stay hidden, or
    /// smoothness, so that contact keeps its width
    #[arg(long, value_enum, default_value_t = Yielding::Width)]
    pub at_cap: Yielding,
    /// Maps of a sun, each for a slice of the view, with a size of its own; a lamp has one. --cap and fixed sizes are of each
    /// map
    #[arg(long, default_value_t = 1, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=4))]
    pub cascades: u32,
    /// Pixels across
    #[arg(long, default_value_t = 1280, value_parser = clap::value_parser!(u32).range(16..=8192))]
    pub width: u32,
    /// Pixels down
    #[arg(long, default_value_t = 720, value_parser = clap::value_parser!(u32).range(16..=8192))]
    pub height: u32,
    /// Where the scenes of the catalogue are [default: `assets` beside the program, else in the workspace]
    #[arg(long, value_name = "DIR")]
    pub assets: Option<PathBuf>,
}

/// How shadows are filtered.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Method {
    /// One comparison, hard edges
    None,
    /// Percentage-closer filtering with a fixed radius
    Pcf,
    /// Percentage-closer soft shadows: the radius grows with the distance of the blocker
    Pcss,
    /// A variance shadow map with a fixed radius: filtered once a frame, bleeds where occluders lie above each other
    Vsm,
}

impl Method {
    /// As the command line spells it.
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Pcf => "pcf",
            Self::Pcss => "pcss",
            Self::Vsm => "vsm",
        }
    }
}

/// What gives way where a map may not have the texels that the screen asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Yielding {
    /// Narrow soft shadows are widened until their texels hide
    Width,
    /// They keep their width and show texels
    Smoothness,
}

impl Yielding {
    /// As the drop-in has it.
    pub fn at_cap(self) -> AtCap {
        match self {
            Self::Width => AtCap::Widen,
            Self::Smoothness => AtCap::ShowTexels,
        }
    }
}

/// A path of camera or light, which every scene has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Motion {
    /// The camera goes a third of the way to what it looks at
    Approach,
    /// The camera turns to both sides in place
    Pan,
    /// The camera moves sideways by less than a texel a frame
    Creep,
    /// The light moves: a sun about the vertical, a lamp as a pendulum
    Sweep,
}

impl Motion {
    /// As the command line spells it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Approach => "approach",
            Self::Pan => "pan",
            Self::Creep => "creep",
            Self::Sweep => "sweep",
        }
    }
}

fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value > 0.0 && value.is_finite() => Ok(value),
        _ => Err("a finite number above 0 is allowed".into()),
    }
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn the_examples_name_scenes_of_the_catalogue() {
        let words: Vec<&str> = EXAMPLES.split_whitespace().collect();
        let scenes = words.windows(2).filter(|pair| pair[0].starts_with("--scene")).map(|pair| pair[1]);
        let named: Vec<&str> = scenes.filter(|scene| !scene.contains('/')).collect();
        assert!(named.len() >= 3);
        for name in named {
            assert!(scumble_scenes::catalogue().iter().any(|entry| entry.name == name), "{name}");
        }
    }
}
