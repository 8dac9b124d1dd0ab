//! How large a pixel is, and how large it looks: a bank card held against the screen, and the distance.
//!
//! A card of the size ID-1 of ISO/IEC 7810 covers `w` physical pixels of an outline, so
//!
//! ```text
//! px per mm      = w / 85.6
//! px per degree  = 2 d tan(0.5 deg) px per mm           d: viewing distance in mm
//! arc minutes    = 60 texel / px per degree
//! ```
//!
//! Pixels are taken to be square. The angle is that of the degree around the middle of the screen.

/// Width and height of a card ID-1 in millimetres (ISO/IEC 7810).
const CARD_MM: [f64; 2] = [85.6, 53.98];

/// Widths of the outline in physical pixels: displays from 1.4 to 28 px per mm, a projection to a telephone.
const CARD_WIDTH_PX: std::ops::RangeInclusive<u32> = 120..=2400;

/// Viewing distances in cm: nearer nobody can focus, farther no shadow of a texel is seen.
const DISTANCE_CM: std::ops::RangeInclusive<f64> = 20.0..=500.0;

/// What systems assume of a display that does not tell: 96 pixels an inch, at a scale factor of 1.
const USUAL_PX_PER_MM: f64 = 96.0 / 25.4;

/// What is entered of the display's geometry.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Calibration {
    /// Viewing distance in cm as it was typed; empty where it was not measured.
    pub(crate) distance_cm: String,
    /// Width of the outline in physical pixels; `None` before it was changed.
    card_width_px: Option<u32>,
    /// Whether somebody said that the outline is as large as the card.
    pub(crate) matched: bool,
    /// Pixels per degree that were measured by other means and given on the command line.
    given_px_per_degree: Option<f64>,
}

impl Calibration {
    /// Nothing is measured yet but what the command line gives.
    pub(crate) fn new(given_px_per_degree: Option<f64>) -> Self {
        Self { given_px_per_degree, ..Self::default() }
    }

    /// Width of the outline in whole physical pixels; at first that of a usual display at this scale factor.
    pub(crate) fn card_width_px(&self, scale_factor: f64) -> u32 {
        self.card_width_px.unwrap_or_else(|| (CARD_MM[0] * USUAL_PX_PER_MM * scale_factor).round() as u32)
    }

    /// Width and height of the outline in whole physical pixels.
    pub(crate) fn card_px(&self, scale_factor: f64) -> [u32; 2] {
        let width = self.card_width_px(scale_factor);
        [width, (f64::from(width) * CARD_MM[1] / CARD_MM[0]).round() as u32]
    }

    /// Makes the outline wider by this many physical pixels, at most `most_px` wide; whether it matches the
    /// card has to be said again.
    pub(crate) fn widen(&mut self, by_px: i32, scale_factor: f64, most_px: u32) {
        let most = most_px.clamp(*CARD_WIDTH_PX.start(), *CARD_WIDTH_PX.end());
        let width = self.card_width_px(scale_factor).saturating_add_signed(by_px);
        self.card_width_px = Some(width.clamp(*CARD_WIDTH_PX.start(), most));
        self.matched = false;
    }

    /// The outline is as large as the card, as it is drawn at this scale factor, or that is not known.
    pub(crate) fn set_matched(&mut self, matched: bool, scale_factor: f64) {
        self.card_width_px = Some(self.card_width_px(scale_factor));
        self.matched = matched;
    }

    /// Takes the outline as large as the card, unless nobody has changed it: a key that leads through the page is
    /// no measurement.
    pub(crate) fn confirm(&mut self) {
        self.matched |= self.card_width_px.is_some();
    }

    /// Physical pixels per millimetre, where the outline was matched.
    pub(crate) fn px_per_mm(&self) -> Option<f64> {
        self.card_width_px.filter(|_| self.matched).map(|width| f64::from(width) / CARD_MM[0])
    }

    /// The viewing distance in millimetres, `None` where none was typed; the error holds what is no distance.
    pub(crate) fn distance_mm(&self) -> Result<Option<f64>, String> {
        let typed = self.distance_cm.trim();
        if typed.is_empty() {
            return Ok(None);
        }
        // A comma is how half of Europe writes it.
        match typed.replace(',', ".").parse::<f64>() {
            Ok(cm) if DISTANCE_CM.contains(&cm) => Ok(Some(10.0 * cm)),
            _ => Err(typed.to_owned()),
        }
    }

    /// Physical pixels per degree of visual angle: from the card and the distance, else as it was given.
    pub(crate) fn px_per_degree(&self) -> Option<f64> {
        let measured = self.px_per_mm().zip(self.distance_mm().ok().flatten());
        measured.map(|(px_per_mm, mm)| px_per_degree(px_per_mm, mm)).or(self.given_px_per_degree)
    }
}

/// Physical pixels per degree of visual angle around the middle of a screen.
fn px_per_degree(px_per_mm: f64, distance_mm: f64) -> f64 {
    2.0 * distance_mm * 0.5_f64.to_radians().tan() * px_per_mm
}

/// Arc minutes that a length on the screen takes of the field of view.
pub(crate) fn arcmin(length_px: f64, px_per_degree: f64) -> f64 {
    60.0 * length_px / px_per_degree
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_outline_that_nobody_changed_is_not_confirmed() {
        let mut calibration = Calibration::default();
        calibration.confirm();
        assert_eq!(calibration.px_per_mm(), None);
        calibration.widen(1, 1.0, 1000);
        calibration.confirm();
        assert!(calibration.px_per_mm().is_some());
    }

    fn calibrated(width_px: u32, distance_cm: &str) -> Calibration {
        let mut calibration = Calibration { distance_cm: distance_cm.into(), ..Calibration::default() };
        calibration.widen(width_px as i32 - calibration.card_width_px(1.0) as i32, 1.0, u32::MAX);
        calibration.set_matched(true, 1.0);
        calibration
    }

    #[test]
    fn a_card_of_428_pixels_is_5_pixels_a_millimetre_and_52_a_degree_at_60_cm() {
        let calibration = calibrated(428, "60");
        assert_eq!(calibration.px_per_mm(), Some(5.0));
        assert_eq!(calibration.distance_mm(), Ok(Some(600.0)));
        // 2 x 600 mm x 0.0087268677907 x 5 px/mm.
        let px_per_degree = calibration.px_per_degree().unwrap();
        assert!((px_per_degree - 52.361_206_744).abs() < 1e-8, "{px_per_degree}");
        assert!((arcmin(10.0, px_per_degree) - 11.458_864).abs() < 1e-5);
        assert_eq!(calibration.card_px(1.0), [428, 270]);
    }

    #[test]
    fn a_display_of_96_pixels_an_inch_needs_no_step_at_any_scale_factor() {
        for (scale_factor, width_px) in [(1.0, 324), (1.25, 404), (1.5, 485), (2.0, 647)] {
            let mut calibration = Calibration::default();
            assert_eq!(calibration.card_width_px(scale_factor), width_px);
            assert_eq!(calibration.px_per_mm(), None, "nobody has said that it matches");
            calibration.set_matched(true, scale_factor);
            assert_eq!(calibration.px_per_mm(), Some(f64::from(width_px) / 85.6));
        }
    }

    #[test]
    fn a_change_of_the_outline_takes_the_match_back() {
        let mut calibration = calibrated(428, "");
        calibration.widen(-1, 1.0, 1000);
        assert_eq!((calibration.card_width_px(1.0), calibration.px_per_mm()), (427, None));
        calibration.widen(i32::MAX, 1.0, 1000);
        assert_eq!(calibration.card_width_px(1.0), 1000);
        calibration.widen(i32::MIN, 1.0, 1000);
        assert_eq!(calibration.card_width_px(1.0), 120);
    }

    #[test]
    fn a_distance_may_have_a_comma_be_left_out_and_must_be_plausible() {
        let of = |typed: &str| Calibration { distance_cm: typed.into(), ..Calibration::default() }.distance_mm();
        assert_eq!(of("57.5"), Ok(Some(575.0)));
        assert_eq!(of(" 57,5 "), Ok(Some(575.0)));
        assert_eq!(of("  "), Ok(None));
        for typed in ["6", "600 mm", "-60", "nan", "1e9"] {
            assert_eq!(of(typed), Err(typed.to_owned()));
        }
    }

    #[test]
    fn without_card_or_distance_the_given_pixels_per_degree_stand() {
        let given = Calibration { given_px_per_degree: Some(40.0), ..Calibration::default() };
        assert_eq!(given.px_per_degree(), Some(40.0));
        let measured = Calibration { given_px_per_degree: Some(40.0), ..calibrated(428, "60") };
        assert!(measured.px_per_degree().unwrap() > 52.0);
        assert_eq!(calibrated(428, "").px_per_degree(), None);
    }
}
