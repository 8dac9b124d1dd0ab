//! Settings by what is wanted, and the ratio that hides texels from a share of viewers.
//!
//! Kreuzer's 3.47 is the median person's radius at which a line is found on 82 % of trials of two alternatives: that person
//! still sees the texel on 64 % of trials. Two steps lead from there to "hidden from a share p of viewers":
//! ```text
//! seen on 10 % of trials in place of 64 %:   x (ln 0.36 / ln 0.90)^(1/b) = x 1.91     [Weibull, slope b = 3.5]
//! a share p of viewers in place of half:     x 10^(s z(p))                            [log-normal, s = 0.1]
//! ```
//! A texel under a radius r is seen on a share `1 - exp(-(t / r)^b)` of trials, b = 3.5 (QUEST's slope, Watson and Pelli
//! 1983; the thesis analyses with it): 64 % at the threshold means `(t / r)^b = -ln 0.36`, 10 % means `-ln 0.90`; z is the
//! quantile of the standard normal distribution. The spread s between people is assumed; the thesis prints none. A study of one's own
//! replaces both: [`RelationFile::relation_for`](crate::RelationFile::relation_for).

use crate::error::{Error, check};
use crate::relation::Relation;
use crate::settings::Settings;

/// Share of trials on which the median person sees the texel at 3.47: 82 % correct of two alternatives, guesses taken out,
/// `(0.82 - 0.5) / 0.5`.
const SEEN_AT_THRESHOLD: f64 = 0.64;
/// Share of trials on which a texel that counts as hidden is still seen.
const SEEN_WHEN_HIDDEN: f64 = 0.1;
/// Slope of the psychometric function (Watson and Pelli 1983).
const SLOPE: f64 = 3.5;
/// Standard deviation between people, log10 of the threshold. Assumed.
const BETWEEN_PEOPLE_LOG10: f64 = 0.1;
/// Viewers whose eyes the cinematic preset satisfies.
const CINEMA_VIEWERS: f64 = 0.95;

impl Relation {
    /// The published relation for a share of viewers, who see the texel on a tenth of trials at most: 6.6 for half of them,
    /// 9.7 for 95 %. The interval is that of 3.47, scaled: what it does not hold is the uncertainty of slope and spread.
    ///
    /// # Errors
    /// A share that is not above 0 and below 1, or one so near to 1 that the ratio would be above 64.
    pub fn hidden_from(viewers: f64) -> Result<Self, Error> {
        check("the share of viewers", viewers, viewers > 0.0 && viewers < 1.0, "a share above 0 and below 1")?;
        let seen = ((1.0 - SEEN_AT_THRESHOLD).ln() / (1.0 - SEEN_WHEN_HIDDEN).ln()).powf(1.0 / SLOPE);
        let factor = seen * 10_f64.powf(BETWEEN_PEOPLE_LOG10 * normal_quantile(viewers));
        let published = Self::published();
        Self::new(
            published.ratio() * factor,
            published.standard_error() * factor,
            published.ci95().map(|end| end * factor),
        )
    }
}

/// z with `P(Z < z) = share` of a standard normal Z, to 1e-12; halved intervals, because it is asked for once.
fn normal_quantile(share: f64) -> f64 {
    let (mut low, mut high) = (-9.0, 9.0);
    while high - low > 1e-12 {
        let middle = 0.5 * (low + high);
        let below = 0.5 * libm::erfc(-middle * std::f64::consts::FRAC_1_SQRT_2);
        if below < share { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

impl Settings {
    /// Contact shadows before memory: maps of up to 8192 texels a side, 268 MB each, before narrow shadows are widened.
    #[must_use]
    pub fn sharp() -> Self {
        Self { cap: 8192, ..Self::default() }
    }

    /// The published ratio with maps of up to 2048 texels a side, 17 MB each: what renderers call high, as a bound.
    #[must_use]
    pub fn balanced() -> Self {
        Self { cap: 2048, ..Self::default() }
    }

    /// Texels that 95 % of viewers miss, in maps of up to 4096 texels a side, 67 MB each: for films and screenshots.
    #[must_use]
    pub fn cinematic() -> Self {
        // The share is a constant inside of the range.
        Self::hidden_from(CINEMA_VIEWERS).unwrap_or_default()
    }

    /// The default, with texels hidden from a share of viewers in place of the median person.
    ///
    /// # Errors
    /// As [`Relation::hidden_from`].
    pub fn hidden_from(viewers: f64) -> Result<Self, Error> {
        Ok(Self { relation: Relation::hidden_from(viewers)?, ..Self::default() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_of_the_viewers_miss_texels_at_6_6_and_most_at_9_7() {
        let ratio = |viewers| Relation::hidden_from(viewers).unwrap().ratio();
        assert!(
            (ratio(0.5) - 6.64).abs() < 0.01 && (ratio(0.95) - 9.70).abs() < 0.01,
            "{} {}",
            ratio(0.5),
            ratio(0.95)
        );
        assert!(ratio(0.01) < ratio(0.5) && ratio(0.95) < ratio(0.999));
    }

    #[test]
    fn the_quantile_is_that_of_the_tables() {
        for (share, z) in [(0.5, 0.0), (0.841_344_746, 1.0), (0.975, 1.959_964), (0.95, 1.644_854), (0.001, -3.090_232)]
        {
            assert!((normal_quantile(share) - z).abs() < 1e-6, "{share}");
        }
    }

    #[test]
    fn a_share_that_is_none_is_refused() {
        for viewers in [0.0, 1.0, -0.5, f64::NAN] {
            assert!(Settings::hidden_from(viewers).unwrap_err().to_string().contains("share of viewers"));
        }
    }

    #[test]
    fn every_preset_is_allowed() {
        for settings in [Settings::sharp(), Settings::balanced(), Settings::cinematic()] {
            assert!(settings.checked().is_ok());
        }
        assert!((Settings::cinematic().relation.ratio() - 9.70).abs() < 0.01);
    }
}
