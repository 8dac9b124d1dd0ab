//! The light of each of a display's 256 levels.
//!
//! Light is relative to the display's range: 0 is its black, 1 its brightest. What a display emits at
//! level 0 lies over the whole picture and is no part of the shadow.
//!
//! sRGB is the function of IEC 61966-2-1. A measured table is interpolated by the monotone piecewise
//! cubic of Fritsch and Carlson (1980) with the slopes of Fritsch and Butland (1984): at a row
//! between secants `d0` and `d1` over `h0` and `h1` levels the weighted harmonic mean
//! `(w0 + w1) / (w0 / d0 + w1 / d1)`, `w0 = 2 h1 + h0`, `w1 = h1 + 2 h0`; at the ends that
//! of the parabola through three rows, at least 0. It passes through every row and is strictly increasing
//! between rows that are. Two rows alone describe a display whose light is proportional to its code.

use crate::Error;

/// Light of each of the 256 levels, strictly increasing from 0 to 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Transfer {
    light: [f64; 256],
}

impl Transfer {
    /// The sRGB transfer function.
    pub fn srgb() -> Self {
        Self { light: std::array::from_fn(|level| linear_from_srgb(level as f64 / 255.0)) }
    }

    /// Light proportional to the code value.
    pub(crate) fn proportional() -> Self {
        Self { light: std::array::from_fn(|level| level as f64 / 255.0) }
    }

    /// A measured table: rows of a level and its luminance in candela per square metre.
    ///
    /// Levels begin at 0 and end at 255; levels and luminances strictly increase.
    pub fn from_table(rows: &[(u8, f64)]) -> Result<Self, Error> {
        check_table(rows)?;
        let luminance = interpolate(rows);
        let (black, range) = (luminance[0], luminance[255] - luminance[0]);
        let light = luminance.map(|value| (value - black) / range);
        match (1..256).find(|&level| light[level] <= light[level - 1]) {
            None => Ok(Self { light }),
            Some(level) => Err(Error::Table(format!(
                "levels {} and {level} have the same light; allowed are luminances that differ by more than rounding",
                level - 1
            ))),
        }
    }

    /// Light of a level, 0 at level 0 to 1 at level 255.
    pub fn light(&self, level: u8) -> f64 {
        self.light[usize::from(level)]
    }
}

impl Default for Transfer {
    /// [`Transfer::srgb`].
    fn default() -> Self {
        Self::srgb()
    }
}

/// Light, 0 to 1, of an sRGB signal, 0 to 1.
fn linear_from_srgb(srgb: f64) -> f64 {
    if srgb <= 0.040_45 { srgb / 12.92 } else { libm::pow((srgb + 0.055) / 1.055, 2.4) }
}

/// Refuses a table that does not describe a display.
fn check_table(rows: &[(u8, f64)]) -> Result<(), Error> {
    let (first, last) = (rows.first().map(|row| row.0), rows.last().map(|row| row.0));
    if first != Some(0) || last != Some(255) {
        let found = match (first, last) {
            (Some(first), Some(last)) => format!("from level {first} to level {last}"),
            _ => "without rows".to_owned(),
        };
        return Err(Error::Table(format!("a table {found}; allowed is one from level 0 to level 255")));
    }
    if let Some(&(level, luminance)) = rows.iter().find(|row| !(row.1.is_finite() && row.1 >= 0.0)) {
        return Err(Error::Table(format!(
            "level {level} has {luminance} cd/m2; allowed is a finite luminance of at least 0"
        )));
    }
    match rows.windows(2).find(|pair| pair[0].0 >= pair[1].0 || pair[0].1 >= pair[1].1) {
        None => Ok(()),
        Some(pair) => Err(Error::Table(format!(
            "level {} with {} cd/m2 after level {} with {} cd/m2; allowed are levels and luminances that increase",
            pair[1].0, pair[1].1, pair[0].0, pair[0].1
        ))),
    }
}

/// Luminance of every level: the monotone cubic through the rows.
fn interpolate(rows: &[(u8, f64)]) -> [f64; 256] {
    let level: Vec<f64> = rows.iter().map(|row| f64::from(row.0)).collect();
    let slopes = monotone_slopes(&level, rows);
    std::array::from_fn(|at| {
        let at = at as f64;
        let left = level.partition_point(|&known| known <= at).clamp(1, rows.len() - 1) - 1;
        let width = level[left + 1] - level[left];
        let t = (at - level[left]) / width;
        // The cubic with these values and slopes at both ends (Hermite).
        let rise = rows[left + 1].1 - rows[left].1;
        let (from, to) = (width * slopes[left], width * slopes[left + 1]);
        rows[left].1 + t * (from + t * (3.0 * rise - 2.0 * from - to + t * (from + to - 2.0 * rise)))
    })
}

/// Slopes at the rows, in luminance per level.
fn monotone_slopes(level: &[f64], rows: &[(u8, f64)]) -> Vec<f64> {
    let widths: Vec<f64> = level.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let secants: Vec<f64> = rows.windows(2).zip(&widths).map(|(pair, width)| (pair[1].1 - pair[0].1) / width).collect();
    let last = secants.len() - 1;
    if last == 0 {
        return vec![secants[0]; 2];
    }
    let end = |near: usize, far: usize| {
        let (h0, h1) = (widths[near], widths[far]);
        (((2.0 * h0 + h1) * secants[near] - h0 * secants[far]) / (h0 + h1)).max(0.0)
    };
    let inner = (0..last).map(|left| {
        let (w0, w1) = (2.0 * widths[left + 1] + widths[left], widths[left + 1] + 2.0 * widths[left]);
        (w0 + w1) / (w0 / secants[left] + w1 / secants[left + 1])
    });
    std::iter::once(end(0, 1)).chain(inner).chain(std::iter::once(end(last, last - 1))).collect()
}
