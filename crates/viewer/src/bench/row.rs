//! One line of the benchmark: a scene, a method, a size, and everything that was measured of it.

use std::collections::BTreeMap;
use std::fmt;
use std::path::Path;

use anyhow::Result;
use scumble::Statistic;
use scumble_reference::Differences;
use serde::{Deserialize, Serialize};

use crate::bench::comparison::Comparison;
use crate::bench::pictures::Files;
use crate::record::MapRecord;
use crate::size::Size;
use crate::stage::Stage;
use crate::statistics::Spread;
use crate::timer::Times;
use crate::variant::{Case, Variant};

/// Bytes of a texel: the maps are 32-bit depth.
const TEXEL_BYTES: u64 = 4;
/// Bytes of a block of moments, in two textures.
const BLOCK_BYTES: u64 = 16;
/// Passes that make the moments of a map.
const MOMENT_PASSES: usize = 3;

/// Medians and quartiles in milliseconds by part of the shadow (`depth`, `demand`, `evaluation`), of their `total`, and of
/// the `drawing` of the picture, which is the scene's; empty on a device without timestamps.
pub type Spreads = BTreeMap<String, Spread>;

/// What a row is about: scene, method and size as the command line spells them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Key {
    /// Name of the scene.
    pub scene: String,
    /// `none`, `pcf`, `pcss` or `vsm`.
    pub method: String,
    /// Times the filter radius (pcf, vsm) or light size (pcss) of the run.
    pub softness: f64,
    /// As the command line spells it.
    pub size: String,
}

impl Key {
    /// Of a case in a scene.
    pub fn of(scene: &str, case: &Case) -> Self {
        Self {
            scene: scene.into(),
            method: case.method.name().into(),
            softness: case.softness,
            size: case.size.to_string(),
        }
    }

    /// Whether they differ in nothing but the size.
    pub fn is_beside(&self, other: &Self) -> bool {
        Self { size: String::new(), ..self.clone() } == Self { size: String::new(), ..other.clone() }
    }

    /// The size, unless the record was written by hand.
    pub fn size(&self) -> Option<Size> {
        self.size.parse().ok()
    }

    /// Whether the size is chosen by the relation.
    pub fn is_adaptive(&self) -> bool {
        matches!(self.size(), Some(Size::Adaptive(_)))
    }

    /// The share of the penumbra that may show texels, where the size is chosen by one.
    pub fn share(&self) -> Option<f64> {
        match self.size()? {
            Size::Adaptive(Statistic::Quantile(share)) => Some(share),
            _ => None,
        }
    }

    /// The filter, and the share where there is one: `pcss`, `pcss x4 @0.01`.
    pub fn filter_and_share(&self) -> String {
        match self.share() {
            Some(share) => format!("{} @{share}", self.filter()),
            None => self.filter(),
        }
    }

    /// Whether the size is fixed and the filter runs at every pixel.
    pub fn is_fixed(&self) -> bool {
        matches!(self.size(), Some(Size::Fixed(_)))
    }

    /// The filter with its softness, where that is not the run's own: `pcss`, `pcss x4`.
    pub fn filter(&self) -> String {
        if self.softness == 1.0 { self.method.clone() } else { format!("{} x{}", self.method, self.softness) }
    }
}

impl fmt::Display for Key {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{} {} {}", self.scene, self.filter(), self.size)
    }
}

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

    /// The middle half of every part.
    pub fn spreads(&self) -> Spreads {
        let parts = self.parts.iter().map(|(&part, list)| (part, list));
        let all = parts.chain([("total", &self.total)]);
        all.filter_map(|(part, list)| Some((part.to_owned(), Spread::of(list)?))).collect()
    }
}

/// A line of bench.csv and an entry of bench.json.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Scene, method, size.
    #[serde(flatten)]
    pub key: Key,
    /// Triangles of the scene.
    pub triangles: usize,
    /// Texels of all maps together.
    pub texels: u64,
    /// What was allocated and used for each light and slice of its view.
    pub maps: Vec<MapRecord>,
    /// Bytes of the texels in use, and of their moments.
    pub bytes_used: u64,
    /// Bytes of the whole textures.
    pub bytes_allocated: u64,
    /// Depth, moment, demand and evaluation passes of one frame.
    pub passes: u32,
    /// Objects of the device that frames created after the size had come to rest.
    pub allocations: u64,
    /// Map lookups of one pixel at most.
    pub taps_per_pixel: u32,
    /// Maps of the light and its slices that nothing on screen needs.
    #[serde(default)]
    pub maps_skipped: u32,
    /// Times on the device.
    pub times_ms: Spreads,
    /// Errors against the truth of the kernel.
    pub comparison: Comparison,
    /// Paths inside the results folder: `picture`, `error_map`, `truth`.
    pub pictures: BTreeMap<String, String>,
}

impl Row {
    /// Gathers a variant's numbers; `out` is the results folder.
    pub fn new(
        stage: &Stage,
        variant: &Variant,
        times_ms: Spreads,
        comparison: Comparison,
        files: Files,
        out: &Path,
    ) -> Result<Self> {
        let plan = variant.plan()?;
        let counters = variant.counters();
        let maps = variant.map_records()?;
        let moment_passes = if counters.moment_blocks > 0 { MOMENT_PASSES } else { 0 };
        let pictures = files.into_iter().map(|(name, path)| (name.to_owned(), relative(&path, out))).collect();
        Ok(Self {
            key: Key::of(&stage.setup.scene.name, &variant.case),
            triangles: stage.setup.scene.triangle_count(),
            texels: plan.texels(),
            passes: (maps.len() * (1 + moment_passes)) as u32 + 1 + u32::from(variant.measures()),
            maps,
            bytes_used: plan.texels() * TEXEL_BYTES + counters.moment_blocks * BLOCK_BYTES,
            bytes_allocated: counters.map_bytes,
            allocations: variant.allocations_since_rest(),
            taps_per_pixel: counters.taps_per_pixel,
            maps_skipped: counters.maps_skipped,
            times_ms,
            comparison,
            pictures,
        })
    }

    /// Radius of the demand in texels of the map that meets it least.
    pub fn c_effective(&self) -> Option<f64> {
        self.maps.iter().map(|map| map.c_effective).min_by(f64::total_cmp)
    }

    /// Whether the screen asks for more texels than a map has.
    pub fn is_capped(&self) -> bool {
        self.maps.iter().any(|map| map.capped)
    }

    /// Blocks of pixels that skip the filter and blocks that pay it, all maps together; `None` where all pay.
    pub fn blocks(&self) -> Option<[u32; 2]> {
        let blocks: Vec<_> = self.maps.iter().filter_map(|map| map.blocks).collect();
        let skip = blocks.iter().map(|blocks| blocks.lit + blocks.umbra).sum();
        (!blocks.is_empty()).then(|| [skip, blocks.iter().map(|blocks| blocks.mixed).sum()])
    }

    /// Sides of the maps: `677 x 440`, `512 x 512 + 300 x 280`.
    pub fn sizes_words(&self) -> String {
        let sides: Vec<String> =
            self.maps.iter().map(|map| format!("{} x {}", map.viewport[2], map.viewport[3])).collect();
        sides.join(" + ")
    }

    /// Median milliseconds of the whole shadow.
    pub fn total_ms(&self) -> Option<f64> {
        self.times_ms.get("total").map(|spread| spread.median)
    }

    /// Errors in the penumbra; `None` where the filter leaves none.
    pub fn penumbra(&self) -> Option<&Differences> {
        Some(&self.comparison.penumbra).filter(|penumbra| penumbra.pixels > 0)
    }

    /// RMS error in the penumbra.
    pub fn error(&self) -> Option<f64> {
        self.penumbra().map(|penumbra| penumbra.rms)
    }

    /// RMS error against the light itself, where it is seen in part; `None` where it nowhere is.
    pub fn light_error(&self) -> Option<f64> {
        let light = self.comparison.light.as_ref()?;
        (light.penumbra.pixels > 0).then_some(light.penumbra.rms)
    }
}

/// A path inside the results, as the records name it.
fn relative(path: &Path, out: &Path) -> String {
    path.strip_prefix(out).unwrap_or(path).to_string_lossy().replace('\\', "/")
}

impl fmt::Display for Row {
    /// One line for a terminal.
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Key { scene, size, .. } = &self.key;
        write!(formatter, "{scene:<12} {:<8} {size:<14} {:>9} texels", self.key.filter(), self.texels)?;
        if let Some(total) = self.total_ms() {
            write!(formatter, "  {total:>7.1} ms")?;
        }
        if let Some(penumbra) = self.penumbra() {
            write!(formatter, "  penumbra RMS {:.4} p99 {:.3} bias {:+.4}", penumbra.rms, penumbra.p99, penumbra.bias)?;
        }
        if let Some(error) = self.light_error() {
            write!(formatter, "  light {error:.4}")?;
        }
        formatter.write_str(if self.key.is_adaptive() && self.is_capped() { "  capped" } else { "" })
    }
}
