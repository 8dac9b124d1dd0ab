//! What the answers to single pictures say: hits, false alarms, d' and the criterion.
//!
//! The signal is the artifact. A hit is an artifact called "not a line", a false alarm a line called "not
//! a line". With the rates `H = (hits + 1/2) / (artifacts + 1)` and `F` alike, corrected so that no count
//! gives an infinite z (the log-linear rule, Hautus 1995), and z the inverse of the standard normal
//! distribution,
//!
//! ```text
//! d'        = z(H) - z(F)              0: artifacts and lines are not told apart
//! criterion = -(z(H) + z(F)) / 2       0: no preference; above 0: rather "a line"
//! var d'    = H (1 - H) / (artifacts phi(z(H))^2) + F (1 - F) / (lines phi(z(F))^2)
//! var criterion = var d' / 4
//! ```
//!
//! The variances are those of Gourevitch & Galanter (1967), for large counts; at ten trials they are a
//! rough guide. Equal variances of both traces are assumed (Macmillan & Creelman 2005, 1 to 3 and 13).
//!
//! A staircase chooses the radii of the artifacts, so H, d' and the criterion of a session are those of
//! its mixture of radii: they tell how a person answers, and are no threshold.

use crate::event::{Answered, Event};
use crate::normal;
use crate::standing::standing;
use crate::trial::{Answer, Pictures, Role};

/// Half width of a 95 % interval in standard errors: Phi^-1(0.975).
const Z_95: f64 = 1.959_963_984_540_054;

/// Answers to single pictures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct YesNoCounts {
    /// Artifacts shown.
    pub artifacts: u32,
    /// Those called "not a line".
    pub hits: u32,
    /// Lines shown.
    pub lines: u32,
    /// Those called "not a line".
    pub false_alarms: u32,
}

/// What the counts say of a person.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct YesNoStatistics {
    /// Corrected rate of hits, above 0 to below 1.
    pub hit_rate: f64,
    /// Corrected rate of false alarms, above 0 to below 1.
    pub false_alarm_rate: f64,
    /// Distance between artifact and line in standard deviations of the trace.
    pub d_prime: f64,
    /// Its standard error.
    pub d_prime_standard_error: f64,
    /// Place of the criterion from the middle between line and artifact, in standard deviations.
    pub criterion: f64,
    /// Its standard error.
    pub criterion_standard_error: f64,
}

/// The single pictures of a session and its catch trials.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct YesNoReport {
    /// Staircases' and line trials of the whole session; no practice, no catch trials.
    pub overall: YesNoCounts,
    /// The same for each round, by number: the first is round 1.
    pub rounds: Vec<YesNoCounts>,
    /// Catch trials shown, of one or of two pictures.
    pub catch_shown: u32,
    /// Those answered rightly.
    pub catch_seen: u32,
}

impl YesNoCounts {
    /// Share of the artifacts called "not a line"; `None` without artifacts.
    pub fn hit_share(&self) -> Option<f64> {
        share(self.hits, self.artifacts)
    }

    /// Share of the lines called "not a line"; `None` without lines.
    pub fn false_alarm_share(&self) -> Option<f64> {
        share(self.false_alarms, self.lines)
    }

    /// Rates, d' and criterion; `None` where no artifact or no line was shown.
    pub fn statistics(&self) -> Option<YesNoStatistics> {
        if self.artifacts == 0 || self.lines == 0 {
            return None;
        }
        let corrected = |count: u32, shown: u32| (f64::from(count) + 0.5) / (f64::from(shown) + 1.0);
        let hit_rate = corrected(self.hits, self.artifacts);
        let false_alarm_rate = corrected(self.false_alarms, self.lines);
        let (z_hit, z_false_alarm) = (normal::quantile(hit_rate), normal::quantile(false_alarm_rate));
        let variance = |rate: f64, z: f64, shown: u32| {
            let density = normal::density(z);
            rate * (1.0 - rate) / (f64::from(shown) * density * density)
        };
        let variance_of_difference =
            variance(hit_rate, z_hit, self.artifacts) + variance(false_alarm_rate, z_false_alarm, self.lines);
        Some(YesNoStatistics {
            hit_rate,
            false_alarm_rate,
            d_prime: z_hit - z_false_alarm,
            d_prime_standard_error: variance_of_difference.sqrt(),
            criterion: -0.5 * (z_hit + z_false_alarm),
            criterion_standard_error: 0.5 * variance_of_difference.sqrt(),
        })
    }

    fn add(&mut self, is_line: bool, called_artifact: bool) {
        let (shown, called) = match is_line {
            true => (&mut self.lines, &mut self.false_alarms),
            false => (&mut self.artifacts, &mut self.hits),
        };
        *shown += 1;
        *called += u32::from(called_artifact);
    }
}

impl YesNoStatistics {
    /// 95 % interval of d', by its standard error.
    pub fn d_prime_interval95(&self) -> (f64, f64) {
        let half = Z_95 * self.d_prime_standard_error;
        (self.d_prime - half, self.d_prime + half)
    }

    /// 95 % interval of the criterion, by its standard error.
    pub fn criterion_interval95(&self) -> (f64, f64) {
        let half = Z_95 * self.criterion_standard_error;
        (self.criterion - half, self.criterion + half)
    }
}

impl YesNoReport {
    /// Counts the answers of a session's events that stand ([`standing`]). Answers to pairs count among the
    /// catch trials only.
    pub fn of(events: &[Event]) -> Self {
        let mut report = Self::default();
        for answered in standing(events) {
            match (answered.trial.role, answered.trial.pictures) {
                (Role::Catch, _) => {
                    report.catch_shown += 1;
                    report.catch_seen += u32::from(answered.correct);
                }
                (Role::Measure | Role::Line, Pictures::Single { .. }) => report.add(answered),
                _ => {}
            }
        }
        report
    }

    /// Share of the catch trials answered rightly; `None` without catch trials.
    pub fn catch_share(&self) -> Option<f64> {
        share(self.catch_seen, self.catch_shown)
    }

    fn add(&mut self, answered: &Answered) {
        let round = answered.trial.round as usize;
        if self.rounds.len() < round {
            self.rounds.resize(round, YesNoCounts::default());
        }
        let is_line = answered.trial.pictures.right_answer() == Answer::Yes;
        let called_artifact = answered.answer == Answer::No;
        // Main trials are of round 1 or later.
        if let Some(counts) = round.checked_sub(1).and_then(|index| self.rounds.get_mut(index)) {
            counts.add(is_line, called_artifact);
        }
        self.overall.add(is_line, called_artifact);
    }
}

fn share(count: u32, shown: u32) -> Option<f64> {
    (shown > 0).then(|| f64::from(count) / f64::from(shown))
}
