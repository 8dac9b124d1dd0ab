//! What does not enter a fit, by rules that stand in the protocol before anybody sits down.
//!
//! The record keeps everything, and the session runs on: only the analysis leaves out.

use serde::{Deserialize, Serialize};

use crate::error::{Error, require};

/// Limits of what enters a fit; each may be missing, and then excludes nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Exclusions {
    /// Answers that came faster are left out: nobody looked at the pictures and chose in that time.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub response_time_min_secs: Option<f64>,
    /// Answers that took longer are left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub response_time_max_secs: Option<f64>,
    /// People who missed a larger share of the catch trials are left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub catch_misses_max: Option<f64>,
    /// People who called a larger share of the lines artifacts are left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub false_alarms_max: Option<f64>,
}

impl Exclusions {
    /// Refuses limits outside their ranges; the error names the key.
    pub(crate) fn check(&self) -> Result<(), Error> {
        let is_time = |secs: f64| secs.is_finite() && secs >= 0.0;
        let shortest = self.response_time_min_secs.unwrap_or(0.0);
        let longest = self.response_time_max_secs.unwrap_or(f64::MAX);
        require(is_time(shortest), "exclusions.response_time_min_secs", shortest, "a finite number of at least 0")?;
        let is_longer = is_time(longest) && longest > shortest;
        let allowed = "a finite number above response_time_min_secs";
        require(is_longer, "exclusions.response_time_max_secs", longest, allowed)?;
        for (key, share) in [
            ("exclusions.catch_misses_max", self.catch_misses_max),
            ("exclusions.false_alarms_max", self.false_alarms_max),
        ] {
            let share = share.unwrap_or(0.0);
            require((0.0..=1.0).contains(&share), key, share, "0 to 1")?;
        }
        Ok(())
    }

    /// Why an answer that took this long does not enter a fit; `None` where it does.
    pub fn of_response_time(&self, secs: f64) -> Option<&'static str> {
        match secs {
            _ if self.response_time_min_secs.is_some_and(|shortest| secs < shortest) => Some("answered too fast"),
            _ if self.response_time_max_secs.is_some_and(|longest| secs > longest) => Some("answered too slowly"),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RULES: Exclusions = Exclusions {
        response_time_min_secs: Some(0.2),
        response_time_max_secs: Some(30.0),
        catch_misses_max: Some(0.5),
        false_alarms_max: None,
    };

    #[test]
    fn an_answer_at_a_limit_counts_and_one_beyond_it_does_not() {
        for (secs, expected) in
            [(0.2, None), (30.0, None), (0.19, Some("answered too fast")), (30.1, Some("answered too slowly"))]
        {
            assert_eq!(RULES.of_response_time(secs), expected, "{secs} s");
            assert_eq!(Exclusions::default().of_response_time(secs), None);
        }
    }

    #[test]
    fn limits_out_of_range_are_refused_by_their_key() {
        assert!(RULES.check().is_ok() && Exclusions::default().check().is_ok());
        let refused = [
            (Exclusions { response_time_min_secs: Some(f64::NAN), ..RULES }, "response_time_min_secs"),
            (Exclusions { response_time_max_secs: Some(0.1), ..RULES }, "response_time_max_secs"),
            (Exclusions { catch_misses_max: Some(1.5), ..RULES }, "catch_misses_max"),
            (Exclusions { false_alarms_max: Some(-0.1), ..RULES }, "false_alarms_max"),
        ];
        for (rules, key) in refused {
            assert!(rules.check().unwrap_err().to_string().contains(key), "{key}");
        }
    }
}
