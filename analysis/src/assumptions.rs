//! What the fit takes as known of a person's psychometric function.
//!
//! `p(x) = g + (1 - g)(1 - e) F(x)`, `F` the share of artifacts that are seen by who looks.
//!
//! * Guess rate `g`: the person's own false alarm rate where lines alone were shown, the protocol's
//!   elsewhere. A person who calls every second line an artifact also calls every second unseen
//!   artifact one.
//! * Blind share `e` and slope: those that the mixed model of the series found in everyone's answers, with the
//!   protocol's as weak priors; the protocol's where there is no such model.
//! * The threshold lies where artifacts are detected in the share 0.64 of the trials, which is 82 % of two
//!   alternatives, whatever a protocol's staircases aim at: ratios of all protocols mean the same.

use scumble_psychophysics::Protocol;

use crate::{
    maximum_likelihood::{Model, Parameter},
    mixed_model::MixedParameters,
    people::Person,
};

/// Share of trials on which the artifact is detected at the threshold: 82 % correct of two alternatives,
/// Kreuzer 2017's threshold probability (4.2).
pub const DETECTION_AT_THRESHOLD: f64 = 2.0 * 0.82 - 1.0;

/// What the fit takes as known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Assumptions {
    /// Probability of a right answer to an artifact that is not seen.
    pub guess: f64,
    /// Share of trials answered blindly.
    pub blind_share: f64,
    /// Slope of the psychometric function, per decade.
    pub slope: f64,
}

impl Assumptions {
    /// The protocol's own.
    pub fn of_protocol(protocol: &Protocol) -> Self {
        let rules = &protocol.staircase;
        Self {
            guess: rules.guess_probability,
            blind_share: rules.central_lapse_probability(),
            slope: rules.central_slope_per_log10(),
        }
    }

    /// Those for a person: the guess rate is counted where it can be.
    pub fn of_person(person: &Person, protocol: &Protocol) -> Self {
        let known = Self::of_protocol(protocol);
        Self { guess: person.checks.false_alarm_rate().unwrap_or(known.guess), ..known }
    }

    /// With the slope and the blind share that a mixed model found in everyone's answers.
    pub fn with(self, fitted: &MixedParameters) -> Self {
        Self { slope: fitted.slope, blind_share: fitted.blind_share, ..self }
    }

    /// The psychometric function to fit: its location alone is free.
    pub fn model(&self) -> Model {
        Model {
            guess: self.guess,
            lapse: Parameter::Fixed(self.blind_share * (1.0 - self.guess)),
            slope: Parameter::Fixed(self.slope),
        }
    }

    /// Share of artifacts seen at the threshold by who looks.
    pub fn seen_at_threshold(&self) -> f64 {
        DETECTION_AT_THRESHOLD / (1.0 - self.blind_share)
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::checks::Checks;

    #[test]
    fn the_staircases_of_every_shipped_protocol_aim_at_the_threshold() {
        for name in ["published", "two-alternative", "yes-no"] {
            let rules = Protocol::named(name).unwrap().staircase;
            let detected = (rules.threshold_probability - rules.guess_probability) / (1.0 - rules.guess_probability);
            assert!((detected - DETECTION_AT_THRESHOLD).abs() < 1e-12, "{name}: {detected}");
        }
    }

    #[test]
    fn the_guess_rate_is_counted_where_lines_were_shown() {
        let protocol = Protocol::named("yes-no").unwrap();
        let person = |checks| Person { code: "p".to_owned(), tracks: Vec::new(), checks, excluded: BTreeMap::new() };
        let of = |checks| Assumptions::of_person(&person(checks), &protocol);
        assert_eq!(of(Checks::default()).guess, 0.2);
        let counted = of(Checks { lines: 99, false_alarms: 9, ..Checks::default() });
        assert!((counted.guess - 0.095).abs() < 1e-12);
    }
}
