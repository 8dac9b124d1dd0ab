//! One line of the benchmark: a scene, a method, a size, and everything that was measured of it.

use std::collections::BTreeMap;
use std::fmt;
use std::path::Path;

use anyhow::{Context, Result};
use serde::Serialize;

use crate::bench::comparison::Comparison;
use crate::bench::pictures::Files;
use crate::bench::relative;
use crate::record::MapRecord;
use crate::stage::Stage;
use crate::statistics::Spread;
use crate::variant::{Times, Variant};

/// The parts of a frame that belong to the shadow.
const PARTS: [&str; 3] = ["depth", "demand", "evaluation"];

/// Milliseconds of every frame, by part.
#[derive(Default)]
pub struct Timings {
    parts: BTreeMap<&'static str, Vec<f64>>,
    total: Vec<f64>,
}

impl Timings {
    /// Adds a frame; one without times adds nothing.
    pub fn add(&mut self, times: &Times) {
        if times.is_empty() {
            return;
        }
        for &(part, milliseconds) in times {
            self.parts.entry(part).or_default().push(milliseconds);
        }
        self.total.push(times.iter().map(|(_, milliseconds)| milliseconds).sum());
    }

    fn spreads(&self) -> BTreeMap<&'static str, Spread> {
        let parts = self.parts.iter().map(|(&part, list)| (part, list));
        let all = parts.chain([("total", &self.total)]);
        all.filter_map(|(part, list)| Some((part, Spread::of(list)?))).collect()
    }
}

/// A line of bench.csv and an entry of bench.json.
#[derive(Serialize)]
pub struct Row {
    scene: String,
    triangles: usize,
    method: &'static str,
    size: String,
    width: u32,
    height: u32,
    /// Of all maps together.
    texels: u64,
    maps: Vec<MapRecord>,
    /// Of the texels in use.
    bytes_used: u64,
    /// Of the whole texture.
    bytes_allocated: u64,
    /// Depth, demand and evaluation passes of one frame.
    passes: u32,
    /// Map lookups of one pixel at most.
    taps_per_pixel: u32,
    /// Medians and quartiles in milliseconds: depth, demand, evaluation and their total; empty without timestamps.
    times_ms: BTreeMap<&'static str, Spread>,
    comparison: Comparison,
    /// Paths inside the results folder.
    pictures: BTreeMap<&'static str, String>,
}

impl Row {
    /// Gathers a variant's numbers.
    pub fn new(
        stage: &Stage,
        variant: &Variant,
        size_px: [u32; 2],
        timings: &Timings,
        comparison: Comparison,
        files: Files,
        out: &Path,
    ) -> Result<Self> {
        let plan = variant.plan()?;
        let counters = variant.counters();
        let maps = MapRecord::of(plan, variant.cap());
        let pictures = files.into_iter().map(|(name, path)| (name, relative(&path, out))).collect();
        Ok(Self {
            scene: stage.setup.scene.name.clone(),
            triangles: stage.setup.scene.triangle_count(),
            method: variant.method.name(),
            size: variant.size.to_string(),
            width: size_px[0],
            height: size_px[1],
            texels: plan.texels(),
            passes: maps.len() as u32 + 1 + u32::from(variant.measures()),
            maps,
            bytes_used: plan.texels() * 4,
            bytes_allocated: counters.map_bytes,
            taps_per_pixel: counters.taps_per_pixel,
            times_ms: timings.spreads(),
            comparison,
            pictures,
        })
    }

    fn cells(&self) -> Vec<String> {
        let map = self.maps.first();
        let viewport = map.map_or([0; 4], |map| map.viewport);
        let number = |value: Option<f64>| value.map(|value| format!("{value:.6}")).unwrap_or_default();
        let mut cells = vec![
            self.scene.clone(),
            self.triangles.to_string(),
            self.method.into(),
            self.size.clone(),
            self.width.to_string(),
            self.height.to_string(),
            viewport[2].to_string(),
            viewport[3].to_string(),
            self.texels.to_string(),
            self.bytes_used.to_string(),
            self.bytes_allocated.to_string(),
            self.passes.to_string(),
            self.taps_per_pixel.to_string(),
            number(map.map(|map| map.c_effective)),
            map.is_some_and(|map| map.capped).to_string(),
        ];
        for part in PARTS.iter().chain(&["total"]) {
            let spread = self.times_ms.get(part);
            cells.extend([
                number(spread.map(|spread| spread.median)),
                number(spread.map(|spread| spread.lower_quartile)),
                number(spread.map(|spread| spread.upper_quartile)),
            ]);
        }
        for error in [&self.comparison.lit_facing, &self.comparison.penumbra] {
            cells.push(error.pixels.to_string());
            cells.extend([error.max, error.p99, error.rms, error.bias].map(|value| number(Some(value))));
        }
        cells.push(number(self.comparison.violation_share));
        cells
    }
}

fn header() -> Vec<String> {
    let fixed = [
        "scene",
        "triangles",
        "method",
        "size",
        "width_px",
        "height_px",
        "map_width",
        "map_height",
        "texels",
        "bytes_used",
        "bytes_allocated",
        "passes",
        "taps_per_pixel",
        "c_effective",
        "capped",
    ];
    let mut header: Vec<String> = fixed.map(str::to_owned).to_vec();
    for part in PARTS.iter().chain(&["total"]) {
        header.extend(["median", "q25", "q75"].map(|which| format!("{part}_ms_{which}")));
    }
    for mask in ["lit_facing", "penumbra"] {
        header.extend(["pixels", "max", "p99", "rms", "bias"].map(|which| format!("{mask}_{which}")));
    }
    header.push("violation_share".into());
    header
}

/// bench.csv.
pub fn table(rows: &[Row]) -> Result<String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(header())?;
    for row in rows {
        writer.write_record(row.cells())?;
    }
    String::from_utf8(writer.into_inner()?).context("the table is not UTF-8")
}

impl fmt::Display for Row {
    /// One line for a terminal.
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{:<12} {:<5} {:<10} {:>9} texels", self.scene, self.method, self.size, self.texels)?;
        if let Some(total) = self.times_ms.get("total") {
            write!(formatter, "  {:>7.1} ms", total.median)?;
        }
        let penumbra = &self.comparison.penumbra;
        write!(formatter, "  penumbra RMS {:.4} p99 {:.3} bias {:+.4}", penumbra.rms, penumbra.p99, penumbra.bias)?;
        formatter.write_str(if self.maps.iter().any(|map| map.capped) { "  capped" } else { "" })
    }
}
