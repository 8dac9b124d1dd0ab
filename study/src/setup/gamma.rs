//! A check of the display's tone curve without a photometer.
//!
//! A field of black and white rows emits half of white's light, whatever the tone curve. The level `L` of
//! a uniform grey that looks the same from afar gives the exponent of the curve:
//!
//! ```text
//! (L / 255)^gamma = 0.5        gamma = ln 0.5 / ln(L / 255)
//! ```
//!
//! The pictures of the study assume sRGB (IEC 61966-2-1), which reaches half of its light at level 188.

/// The level at which sRGB emits half of its light: 0.503, and 187 emits 0.497.
pub(crate) const SRGB_LEVEL: u8 = 188;

/// Levels that differ less from sRGB's are near it: they hold a display set to 2.2 (186) and one set to
/// 2.4 (191), and not one set to 2.0 (180).
const NEAR_LEVELS: u8 = 5;

/// Where the adjustment begins: away from what is expected, so that nobody leaves it there.
const FIRST_LEVEL: u8 = 140;

/// The grey as it is adjusted.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct GammaCheck {
    level: u8,
    /// Whether somebody said that both fields look alike.
    pub(crate) matched: bool,
}

impl Default for GammaCheck {
    fn default() -> Self {
        Self { level: FIRST_LEVEL, matched: false }
    }
}

impl GammaCheck {
    /// The grey on show, 1 to 254.
    pub(crate) fn level(&self) -> u8 {
        self.level
    }

    /// Makes the grey lighter by this many levels; whether it matches has to be said again.
    pub(crate) fn lighten(&mut self, by: i8) {
        self.level = self.level.saturating_add_signed(by).clamp(1, 254);
        self.matched = false;
    }

    /// Takes the grey as matched, unless nobody has changed it: a key that leads through the page is no measurement.
    pub(crate) fn confirm(&mut self) {
        self.matched |= self.level != FIRST_LEVEL;
    }

    /// The level that looked like half of white, where it was matched.
    pub(crate) fn matched_level(&self) -> Option<u8> {
        Some(self.level).filter(|_| self.matched)
    }
}

/// The exponent of a display's tone curve of which this level, 1 to 254, emits half of the light.
pub(crate) fn gamma(level: u8) -> f64 {
    0.5_f64.ln() / (f64::from(level) / 255.0).ln()
}

/// Whether a display that emits half of its light at this level is near enough to sRGB for the pictures.
pub(crate) fn is_near_srgb(level: u8) -> bool {
    level.abs_diff(SRGB_LEVEL) <= NEAR_LEVELS
}

#[cfg(test)]
mod tests {
    use scumble_stimuli::Transfer;

    use super::*;

    #[test]
    fn a_grey_that_nobody_changed_is_not_confirmed() {
        let mut check = GammaCheck::default();
        check.confirm();
        assert_eq!(check.matched_level(), None);
        check.lighten(46);
        check.confirm();
        assert_eq!(check.matched_level(), Some(186));
    }

    #[test]
    fn srgb_emits_half_of_its_light_at_level_188() {
        let half = |level| (Transfer::srgb().light(level) - 0.5).abs();
        assert!((0..=255).all(|level| half(level) >= half(SRGB_LEVEL)));
        assert!((gamma(SRGB_LEVEL) - 2.273_944).abs() < 1e-6, "{}", gamma(SRGB_LEVEL));
    }

    #[test]
    fn the_exponent_is_that_of_a_display_which_has_one() {
        for (exponent, level) in [(1.0, 128), (1.8, 174), (2.2, 186), (2.4, 191)] {
            assert_eq!((255.0 * 0.5_f64.powf(1.0 / exponent)).round(), f64::from(level));
            assert!((gamma(level) - exponent).abs() < 0.02, "{level}: {}", gamma(level));
        }
    }

    #[test]
    fn menus_of_2_2_and_2_4_are_near_srgb_and_those_of_1_8_2_0_and_2_6_are_not() {
        let level = |exponent: f64| (255.0 * 0.5_f64.powf(1.0 / exponent)).round() as u8;
        assert!([2.2, 2.4].into_iter().all(|exponent| is_near_srgb(level(exponent))));
        assert!([1.8, 2.0, 2.6].into_iter().all(|exponent| !is_near_srgb(level(exponent))));
    }

    #[test]
    fn the_grey_stays_between_black_and_white_and_a_step_takes_the_match_back() {
        let mut check = GammaCheck { matched: true, ..GammaCheck::default() };
        assert_eq!(check.matched_level(), Some(FIRST_LEVEL));
        check.lighten(1);
        assert_eq!((check.level(), check.matched_level()), (FIRST_LEVEL + 1, None));
        (0..9).for_each(|_| check.lighten(127));
        assert_eq!(check.level(), 254);
        (0..9).for_each(|_| check.lighten(-128));
        assert_eq!(check.level(), 1);
        assert!(gamma(1).is_finite() && gamma(254).is_finite());
    }
}
