//! The edge in a picture, found from its pixels alone, and how straight it is.
//!
//! 1. **Light.** Levels become light by the display's transfer, in units of the range between the
//!    darkest and the brightest pixel. The contour is where the light is half of it: a filtered shadow
//!    averages light, and for a line half the light is its middle in every encoding's symmetric filter.
//!    (Half of the code value is 0.21 of the light, a contour off the middle.)
//! 2. **Place.** In each column the lit pixels are counted; a straight line fitted to the light of the
//!    pixels around that place crosses one half at the contour's height, to a part of a pixel. The fit
//!    spans the pixels between [`BAND`] on either side of one half, at least two: there the profile
//!    of a filter is straight.
//! 3. **Noise.** One level of the display is `q` of the range near half the light. Dithering makes that an
//!    error of variance `q^2 / 6` on average (rounding: half of it), so a height has
//!    `sigma = q / (sqrt 6 gradient sqrt n)` from n pixels.
//! 4. **Tilt.** The direction at a column is that of the line fitted to the heights of the m columns on
//!    either side, `atan(sum k y_k / sum k^2)`; its standard error is
//!    `sigma sqrt(3 / (m (m + 1) (2 m + 1)))`, and m is the smallest that brings it to
//!    [`TILT_NOISE_RAD`]: 1 to 4 columns for radii of 5 to 120 pixels. Longer would flatten the steps.
//! 5. **Straightness.** A contour's largest tilt is measured from its median direction, which is that of
//!    a step's treads and of a stair's diagonal, whatever the picture's width. (From the least-squares
//!    line it would depend on the width: by 1.5 a / W for a step.)
//!
//! Edges steeper than 45 degrees all along are not its subject: each column must cross the contour once.
//! The grain of a filter with a random turn at each pixel is taken for roughness, as it looks.

use scumble_stimuli::Transfer;

/// Part of the range on either side of one half over which a column's light is fitted: the disc's
/// profile deviates there from a straight line by 0.0004 of the range.
const BAND: f64 = 0.1;

/// Standard error of a tilt that the display's levels may cause: a seventh of the internal noise of a person
/// with the published threshold. At 0.01 the waves of a stair of 5 pixels would already be flattened.
const TILT_NOISE_RAD: f64 = 0.015;

/// A contour as a height for each column.
#[derive(Clone, Debug, PartialEq)]
pub struct Contour {
    /// Column of the first height.
    pub first_column: usize,
    /// Heights of the contour in the middle of each column, pixels down from the picture's top.
    pub heights_px: Vec<f64>,
    /// Standard error of a height that dithering causes.
    pub height_noise_px: f64,
}

impl Contour {
    /// The contour at half the light of a picture whose levels stand row by row.
    ///
    /// `None` where the picture has no edge from side to side or top to bottom: one level alone, or no
    /// three neighbouring columns with light and shadow.
    pub fn of_picture(levels: &[u8], width_px: usize, transfer: &Transfer) -> Option<Self> {
        let (darkest, brightest) = (*levels.iter().min()?, *levels.iter().max()?);
        let (black, range) = (transfer.light(darkest), transfer.light(brightest) - transfer.light(darkest));
        let light: [f64; 256] = std::array::from_fn(|level| (transfer.light(level as u8) - black) / range);
        let columns = Columns { levels, width_px, height_px: levels.len() / width_px, light };
        let crossed: Vec<Option<usize>> = columns.places();
        let crossings = crossed.iter().flatten().count();
        let in_band = levels.iter().filter(|level| (light[usize::from(**level)] - 0.5).abs() <= BAND).count();
        let half_band_px = in_band as f64 / (2.0 * crossings as f64);
        let half_window_px = half_band_px.max(1.0);

        let heights: Vec<Option<f64>> = crossed
            .iter()
            .enumerate()
            .map(|(column, place)| columns.height(column, (*place)?, half_window_px))
            .collect();
        let (first_column, heights_px) = longest_run(&heights);
        if darkest == brightest || heights_px.len() < 3 {
            return None;
        }
        let middle = light.partition_point(|of_level| *of_level < 0.5);
        let level_step = 0.5 * (light[middle.min(254) + 1] - light[middle.max(1) - 1]);
        let gradient = BAND / half_band_px;
        let height_noise_px = level_step / (6f64.sqrt() * gradient * (2.0 * half_window_px).sqrt());
        Some(Self { first_column, heights_px, height_noise_px })
    }

    /// Columns on either side over which a direction is fitted.
    pub fn half_length_columns(&self) -> usize {
        let error = |m: f64| self.height_noise_px * (3.0 / (m * (m + 1.0) * (2.0 * m + 1.0))).sqrt();
        let most = (self.heights_px.len() - 1) / 2;
        (1..most).find(|m| error(*m as f64) <= TILT_NOISE_RAD).unwrap_or(most)
    }

    /// Directions along the contour, radians, downwards to the right positive.
    pub fn directions_rad(&self) -> Vec<f64> {
        let m = self.half_length_columns();
        let squares = (m * (m + 1) * (2 * m + 1)) as f64 / 3.0;
        let slope = |window: &[f64]| {
            let product = |(index, height): (usize, &f64)| (index as f64 - m as f64) * height;
            window.iter().enumerate().map(product).sum::<f64>() / squares
        };
        self.heights_px.windows(2 * m + 1).map(|window| libm::atan(slope(window))).collect()
    }

    /// The largest angle between a direction and the median direction, radians.
    pub fn largest_tilt_rad(&self) -> f64 {
        let directions = self.directions_rad();
        let mut sorted = directions.clone();
        sorted.sort_by(f64::total_cmp);
        let median = 0.5 * (sorted[(sorted.len() - 1) / 2] + sorted[sorted.len() / 2]);
        directions.iter().fold(0.0, |largest: f64, direction| largest.max((direction - median).abs()))
    }
}

/// A picture, column by column.
struct Columns<'a> {
    levels: &'a [u8],
    width_px: usize,
    height_px: usize,
    /// Light of a level in units of the picture's range.
    light: [f64; 256],
}

impl Columns<'_> {
    fn light(&self, column: usize, row: usize) -> f64 {
        self.light[usize::from(self.levels[row * self.width_px + column])]
    }

    /// Number of rows above the contour in each column; `None` for one that is all light or all shadow.
    fn places(&self) -> Vec<Option<usize>> {
        let rows = 0..self.height_px;
        let lit = |row: usize| (0..self.width_px).filter(|column| self.light(*column, row) >= 0.5).count();
        let half = self.height_px / 2;
        let lit_above: usize = (0..half).map(lit).sum();
        let lit_below: usize = (self.height_px - half..self.height_px).map(lit).sum();
        let place = |column: usize| {
            let lit = rows.clone().filter(|row| self.light(column, *row) >= 0.5).count();
            let above = if lit_above > lit_below { lit } else { self.height_px - lit };
            (0 < above && above < self.height_px).then_some(above)
        };
        (0..self.width_px).map(place).collect()
    }

    /// Height at which the line fitted to the light around `place` is one half; `None` where the fit would
    /// leave the picture.
    fn height(&self, column: usize, place: usize, half_window_px: f64) -> Option<f64> {
        // Pixel centres lie at half units; `place` lies between two pixels.
        let reach = (half_window_px + 0.5).floor() as usize;
        let rows = place.checked_sub(reach)?..place + reach;
        if rows.end > self.height_px {
            return None;
        }
        let count = rows.len() as f64;
        let mean = rows.clone().map(|row| self.light(column, row)).sum::<f64>() / count;
        let product = |row: usize| (row as f64 + 0.5 - place as f64) * self.light(column, row);
        let squares = count * (count * count - 1.0) / 12.0;
        let gradient = rows.map(product).sum::<f64>() / squares;
        let offset = (0.5 - mean) / gradient;
        // Where grain leaves no gradient, the count of lit pixels is all there is.
        Some(place as f64 + if offset.abs() <= half_window_px { offset } else { 0.0 })
    }
}

/// The longest run of values, and where it begins.
fn longest_run(values: &[Option<f64>]) -> (usize, Vec<f64>) {
    let mut best = (0, 0);
    let mut begin = 0;
    for (index, value) in values.iter().chain([&None]).enumerate() {
        if value.is_none() {
            if index - begin > best.1 - best.0 {
                best = (begin, index);
            }
            begin = index + 1;
        }
    }
    (best.0, values[best.0..best.1].iter().flatten().copied().collect())
}
