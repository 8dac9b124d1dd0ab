//! The fixed map that an adaptive one is set beside, and what the one is of the other.

use std::fmt;

use crate::bench::row::{Key, Row};
use crate::size::Size;

/// An adaptive row and the fixed one beside it.
#[derive(Clone, Copy)]
pub struct Pair<'a> {
    /// The fixed map.
    pub fixed: &'a Row,
    /// The adaptive one of the same scene and filter.
    pub adaptive: &'a Row,
}

/// The pairs of soft filters, in the order of the rows.
pub fn pairs(rows: &[Row]) -> Vec<Pair<'_>> {
    let adaptive = rows.iter().filter(|row| row.key.is_adaptive() && row.key.method != "none");
    adaptive.filter_map(|adaptive| Some(Pair { fixed: fixed_beside(rows, &adaptive.key)?, adaptive })).collect()
}

/// The fixed map of the same scene and filter that adaptive ones are set beside.
pub fn fixed_beside<'a>(rows: &'a [Row], key: &Key) -> Option<&'a Row> {
    let others = || rows.iter().filter(|other| other.key.is_beside(key));
    let sizes: Vec<Size> = others().filter_map(|other| other.key.size()).collect();
    let beside = Size::beside(&sizes)?;
    others().find(|other| other.key.size() == Some(beside))
}

impl Pair<'_> {
    /// Fixed texels over adaptive ones.
    pub fn fewer_texels(&self) -> f64 {
        self.fixed.texels as f64 / self.adaptive.texels.max(1) as f64
    }

    /// Adaptive over fixed time of the whole shadow.
    pub fn time_ratio(&self) -> Option<f64> {
        Some(self.adaptive.total_ms()? / self.fixed.total_ms()?)
    }

    /// Adaptive time over that of the fixed map of the same size that skips filters, too; `None` where none was run.
    pub fn time_ratio_of_size(&self, rows: &[Row]) -> Option<f64> {
        let Size::Fixed(sides) = self.fixed.key.size()? else { return None };
        let mut others = rows.iter().filter(|other| other.key.is_beside(&self.adaptive.key));
        let blocks = others.find(|other| other.key.size() == Some(Size::Blocks(sides)))?;
        Some(self.adaptive.total_ms()? / blocks.total_ms()?)
    }

    /// Adaptive over fixed error in the penumbra.
    pub fn error_ratio(&self) -> Option<f64> {
        let fixed = self.fixed.error().filter(|&error| error > 0.0)?;
        Some(self.adaptive.error()? / fixed)
    }

    /// Adaptive over fixed error against the light itself.
    pub fn light_error_ratio(&self) -> Option<f64> {
        let fixed = self.fixed.light_error().filter(|&error| error > 0.0)?;
        Some(self.adaptive.light_error()? / fixed)
    }

    /// Adaptive over fixed frames per second, with receivers and shading.
    pub fn frame_rate_ratio(&self) -> Option<f64> {
        let drawing = self.adaptive.times_ms.get("drawing")?.median;
        Some((self.fixed.total_ms()? + drawing) / (self.adaptive.total_ms()? + drawing))
    }
}

impl fmt::Display for Pair<'_> {
    /// One line for a terminal.
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (key, fixed) = (&self.adaptive.key, &self.fixed.key.size);
        write!(formatter, "{} {} {} against {fixed}: ", key.scene, key.filter(), key.size)?;
        write!(formatter, "{:.1} times fewer texels", self.fewer_texels())?;
        let ratios = [
            ("the time", self.time_ratio()),
            ("the frame rate", self.frame_rate_ratio()),
            ("the error", self.error_ratio()),
            ("the error against the light", self.light_error_ratio()),
        ];
        let known = ratios.iter().filter_map(|(what, ratio)| Some((what, (*ratio)?)));
        known.into_iter().try_for_each(|(what, ratio)| write!(formatter, ", x {ratio:.2} {what}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::examples::row;

    #[test]
    fn the_usual_size_is_beside_an_adaptive_one_else_the_largest() {
        let rows = ["1024", "4096", "adaptive", "2048"].map(|size| row("yard", "pcf", size, 1.0, 0.1));
        assert_eq!(pairs(&rows)[0].fixed.key.size, "2048");
        assert_eq!(pairs(&rows[..3])[0].fixed.key.size, "4096");
        assert!(pairs(&rows[2..3]).is_empty());
    }

    #[test]
    fn the_frame_rate_counts_what_no_map_changes() {
        let mut rows = [row("yard", "pcf", "2048", 30.0, 0.1), row("yard", "pcf", "adaptive", 10.0, 0.1)];
        for row in &mut rows {
            let drawing = crate::statistics::Spread { median: 10.0, lower_quartile: 10.0, upper_quartile: 10.0 };
            row.times_ms.insert("drawing".into(), drawing);
        }
        assert_eq!(pairs(&rows)[0].frame_rate_ratio(), Some(2.0));
    }
}
