//! What the JSON files say about a map, a device and a run.

use std::process::Command;

use serde::{Deserialize, Serialize};

use crate::device::Gpu;
use crate::setup::Setup;
use scumble::{BlockCounts, View};

/// One shadow map of a plan.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MapRecord {
    /// Number of the light.
    pub light: u32,
    /// Number of the slice of the view, 0 the nearest.
    #[serde(default)]
    pub slice: u32,
    /// View depth at which the slice ends, metres; null for the last.
    #[serde(default)]
    pub depth_end_world: Option<f64>,
    /// Whether it is the coarse map under slices that follow what was seen.
    #[serde(default)]
    pub net: bool,
    /// Texels across and down of the texture it was allocated in.
    pub size: [u32; 2],
    /// The part of it in use: x, y, width, height in texels.
    pub viewport: [u32; 4],
    /// Extent of the light's box at the reference plane, metres.
    pub extent_world: [f64; 2],
    /// Radius of the demand in texels of this map.
    pub c_effective: f64,
    /// Smallest radius whose texels this map hides, metres at the reference plane.
    pub radius_min_world: f64,
    /// Whether the demand asks for more than the cap.
    pub capped: bool,
    /// Whether it is small because nothing on screen is in its shadow.
    #[serde(default)]
    pub resting: bool,
    /// Blocks of pixels that read it, by what they pay; null where every pixel pays the filter.
    #[serde(default)]
    pub blocks: Option<BlocksRecord>,
}

/// Blocks of pixels of the last measured frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BlocksRecord {
    /// Lit at every corner: one lookup a pixel that says so.
    pub lit: u32,
    /// Dark at every corner: likewise.
    pub umbra: u32,
    /// The filter at every pixel.
    pub mixed: u32,
}

impl From<BlockCounts> for BlocksRecord {
    fn from(BlockCounts { lit, umbra, mixed }: BlockCounts) -> Self {
        Self { lit, umbra, mixed }
    }
}

impl MapRecord {
    /// The longer side of a texel, metres at the reference plane.
    pub fn texel_world(&self) -> f64 {
        let side = |axis: usize| self.extent_world[axis] / f64::from(self.viewport[axis + 2].max(1));
        side(0).max(side(1))
    }

    /// A map in a texture of `cap` texels a side, and what was counted of it.
    pub fn of(view: &View, cap: u32, blocks: Option<BlockCounts>) -> Self {
        let ([x, y], [width, height]) = (view.origin_texels, view.size_texels);
        Self {
            light: view.light,
            slice: view.slice,
            depth_end_world: Some(view.depth_end).filter(|end| end.is_finite()),
            net: view.is_net,
            size: [cap, cap],
            viewport: [x, y, width, height],
            extent_world: view.fit.extent_world.to_array(),
            c_effective: view.size.c_effective,
            radius_min_world: view.size.radius_min_world,
            capped: view.size.capped,
            resting: view.is_resting,
            blocks: blocks.map(BlocksRecord::from),
        }
    }
}

/// Where a run took place.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MachineRecord {
    /// Name of the adapter.
    pub device: String,
    /// Driver with its version.
    pub driver: String,
    /// Graphics interface.
    pub backend: String,
    /// Version of this program.
    pub version: String,
    /// Commit of the source tree, where git knows one.
    pub git_commit: Option<String>,
}

impl MachineRecord {
    /// Of an open device.
    pub fn of(gpu: &Gpu) -> Self {
        Self {
            device: gpu.info.name.clone(),
            driver: format!("{} {}", gpu.info.driver, gpu.info.driver_info).trim().to_owned(),
            backend: gpu.info.backend.to_string(),
            version: env!("CARGO_PKG_VERSION").into(),
            git_commit: git_commit(),
        }
    }
}

fn git_commit() -> Option<String> {
    let output = Command::new("git")
        .args(["-C", env!("CARGO_MANIFEST_DIR"), "describe", "--always", "--dirty", "--abbrev=12"])
        .output()
        .ok()
        .filter(|output| output.status.success())?;
    Some(String::from_utf8(output.stdout).ok()?.trim().to_owned())
}

/// The relation that sizes were chosen by.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RatioRecord {
    /// Texels per filter radius.
    pub value: f64,
    /// Its 95 % interval.
    pub ci95: [f64; 2],
    /// `published`, or the file it was read from.
    pub source: String,
}

impl RatioRecord {
    /// Of a setup.
    pub fn of(setup: &Setup) -> Self {
        Self { value: setup.relation.ratio(), ci95: setup.relation.ci95(), source: setup.relation_source.clone() }
    }
}
