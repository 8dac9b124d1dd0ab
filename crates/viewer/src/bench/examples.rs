//! Small records for the tests of this command.

use std::collections::BTreeMap;

use scumble_reference::{Differences, ErrorParts};

use crate::bench::comparison::Comparison;
use crate::bench::record::{BenchRecord, OptionsRecord, SCHEMA};
use crate::bench::row::{Key, Row};
use crate::record::{MachineRecord, MapRecord, RatioRecord};
use crate::statistics::Spread;

/// A row of a total time, spread by one per cent to both sides, and an error in the penumbra.
pub fn row(scene: &str, method: &str, size: &str, total_ms: f64, error: f64) -> Row {
    let differences = Differences { pixels: 100, max: 4.0 * error, p99: 3.0 * error, rms: error, bias: 0.0 };
    let total = Spread { median: total_ms, lower_quartile: 0.99 * total_ms, upper_quartile: 1.01 * total_ms };
    Row {
        key: Key { scene: scene.into(), method: method.into(), softness: 1.0, size: size.into() },
        triangles: 12,
        texels: size.parse::<u64>().map_or(100_000, |side| side * side),
        maps: Vec::new(),
        bytes_used: 0,
        bytes_allocated: 0,
        passes: 2,
        allocations: 0,
        taps_per_pixel: 25,
        maps_skipped: 0,
        times_ms: BTreeMap::from([("total".into(), total)]),
        comparison: Comparison {
            lit_facing: differences,
            penumbra: differences,
            parts: ErrorParts { pixels: 100, rms: error, noise_rms: 0.6 * error, structure_rms: 0.8 * error },
            flip_mean: error,
            edges: None,
            light: None,
            violation_share: Some(0.0),
        },
        pictures: BTreeMap::new(),
    }
}

/// A map of a light across a metre, with so many texels in use.
pub fn map([width, height]: [u32; 2], capped: bool) -> MapRecord {
    MapRecord {
        light: 0,
        slice: 0,
        depth_end_world: None,
        net: false,
        size: [width, height],
        viewport: [0, 0, width, height],
        extent_world: [1.0, 1.0],
        c_effective: 3.47,
        radius_min_world: 0.01,
        capped,
        resting: false,
        blocks: None,
    }
}

/// Options of a run of two scenes.
pub fn options() -> OptionsRecord {
    OptionsRecord {
        scenes: vec!["yard".into(), "contact".into()],
        methods: vec!["pcf".into()],
        softness: vec![1.0],
        sizes: vec!["2048".into(), "adaptive".into()],
        frames: 15,
        width: 1280,
        height: 720,
        light_samples: 256,
        quick: false,
        paths: Vec::new(),
        sweep_ratio: false,
        cap: 1024,
        at_cap: scumble::AtCap::Widen,
        cascades: 1,
        light_size: None,
        radius: None,
    }
}

/// A record of these rows.
pub fn record(rows: Vec<Row>) -> BenchRecord {
    let machine = MachineRecord {
        device: "a device".into(),
        driver: "a driver".into(),
        backend: "vulkan".into(),
        version: "0.1.0".into(),
        git_commit: None,
    };
    let ratio = RatioRecord { value: 3.47, ci95: [3.0, 4.0], source: "published".into() };
    BenchRecord {
        schema: SCHEMA.into(),
        machine,
        ratio,
        options: options(),
        columns: Vec::new(),
        rows,
        demand: Vec::new(),
        walks: Vec::new(),
        sweep: Vec::new(),
    }
}
