//! What the fit takes as known of a person's psychometric function.
//!
//! `p(x) = g + (1 - g)(1 - e) F(x)`, `F` the share of artifacts that are seen by who looks.
//!
//! * Guess rate `g`: the person's own false alarm rate where lines alone were shown, the protocol's
//!   elsewhere. A person who calls every second line an artifact also calls every second unseen
//!   artifact one.
//! * Blind share `e` and slope: the protocol's.
//! * The threshold lies where artifacts are detected in the share `d = (p - g) / (1 - g)` of trials
//!   that the protocol's own threshold probability `p` and guess rate stand for: 0.64 at 82 % of two
//!   alternatives. It does not move with a person's guess rate, so that tasks can be compared.

use scumble_psychophysics::Protocol;

use crate::{
    maximum_likelihood::{Model, Parameter},
    people::Person,
};

/// What the fit takes as known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Assumptions {
    /// Probability of a right answer to an artifact that is not seen.
    pub guess: f64,
    /// Share of trials answered blindly.
    pub blind_share: f64,
    /// Slope of the psychometric function, per decade.
    pub slope: f64,
    /// Share of trials on which the artifact is detected at the threshold.
    pub detection_at_threshold: f64,
}

impl Assumptions {
    /// The protocol's own.
    pub fn of_protocol(protocol: &Protocol) -> Self {
        let rules = &protocol.staircase;
        let guess = rules.guess_probability;
        Self {
            guess,
            blind_share: rules.central_lapse_probability(),
            slope: rules.central_slope_per_log10(),
            detection_at_threshold: (rules.threshold_probability - guess) / (1.0 - guess),
        }
    }

    /// Those for a person: the guess rate is counted where it can be.
    pub fn of_person(person: &Person, protocol: &Protocol) -> Self {
        let known = Self::of_protocol(protocol);
        Self { guess: person.checks.false_alarm_rate().unwrap_or(known.guess), ..known }
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
        self.detection_at_threshold / (1.0 - self.blind_share)
    }

    /// Share of right answers of two alternatives at the same detection: 0.82 for Kreuzer 2017's threshold.
    pub fn two_alternative_probability(&self) -> f64 {
        0.5 + 0.5 * self.detection_at_threshold
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checks::Checks;

    #[test]
    fn every_shipped_protocol_has_its_threshold_at_82_percent_of_two_alternatives() {
        for name in ["published", "two-alternative", "yes-no"] {
            let known = Assumptions::of_protocol(&Protocol::named(name).unwrap());
            assert!((known.two_alternative_probability() - 0.82).abs() < 1e-12, "{name}: {known:?}");
            assert!((known.seen_at_threshold() - 0.32 / 0.495).abs() < 1e-12, "{name}: {known:?}");
        }
    }

    #[test]
    fn the_guess_rate_is_counted_where_lines_were_shown() {
        let protocol = Protocol::named("yes-no").unwrap();
        let person = |checks| Person { code: "p".to_owned(), tracks: Vec::new(), checks };
        let of = |checks| Assumptions::of_person(&person(checks), &protocol);
        assert_eq!(of(Checks::default()).guess, 0.2);
        let counted = of(Checks { lines: 99, false_alarms: 9, ..Checks::default() });
        assert!((counted.guess - 0.095).abs() < 1e-12);
        assert_eq!(counted.detection_at_threshold, of(Checks::default()).detection_at_threshold);
    }
}
