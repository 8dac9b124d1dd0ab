//! Whether the staircases of a protocol can find the answers expected, before anybody sits down.
//!
//! Expected in a condition: the cohort's median threshold and two standard deviations between people
//! to either side, 19 of 20 people. Every staircase must hold them:
//!
//! 1. the table of thresholds, less the distance from its ends that the convergence rule asks for;
//! 2. the radii that a picture can show, less that distance;
//! 3. the *reach* of the prior: `D = s sqrt(n k)`, log10 units to either side of its centre.
//!
//! Reach. A normal prior of standard deviation `s` speaks against a threshold at the distance `D` from its centre by
//! `D^2 / (2 s^2)` nats. The staircase shows what its posterior expects to be answered rightly with the
//! threshold probability `q`; a person far away answers there near an end of the psychometric function, with
//! the probability `p`, and each answer contradicts the expectation by `k` nats on average, the
//! divergence `p ln(p / q) + (1 - p) ln((1 - p) / (1 - q))` (Kullback & Leibler 1951). Half of the
//! `n = trials_max` trials may go into leaving the prior, so that the other half measures:
//! `D^2 / (2 s^2) <= n k / 2`. Towards larger radii `p` is the upper end of the function, towards smaller
//! ones the lower.
//!
//! With guesses of one half, slips of 1 %, a threshold at 82 % and 36 trials the reach is 2.5 prior SDs
//! towards larger radii and 3.1 towards smaller ones. At its edge (prior of 0.03 texels, SD 0.92, 200 simulated
//! people) 76 % of the staircases converge and the ratio has no bias; at two thirds of that SD 14 % do.

use scumble_psychophysics::{Condition, Protocol};

use crate::{
    Error,
    assumptions::Assumptions,
    series::{round_of, series_name},
};

/// Standard deviations between people to either side of the median that a study must be able to measure:
/// 95 % of them.
const PEOPLE_SDS: f64 = 2.0;

/// Refuses a protocol whose staircases cannot hold or reach the thresholds expected.
///
/// `expected` has each condition with the log10 of the median person's ratio at the threshold.
///
/// # Errors
/// The first limit that does not hold, in the condition farthest from a prior, with what is allowed: so
/// that what it allows is enough for the other conditions.
pub fn check_reach(protocol: &Protocol, expected: &[(Condition, f64)], between_sd_log10: f64) -> Result<(), Error> {
    let distance_log10 = |median_log10: f64| {
        let centres = protocol.staircase.prior_ratios.iter().map(|ratio| ratio.log10());
        centres.map(|centre| (median_log10 - centre).abs()).fold(0.0, f64::max)
    };
    let mut farthest_first = expected.to_vec();
    farthest_first.sort_by(|a, b| distance_log10(b.1).total_cmp(&distance_log10(a.1)));
    for (condition, median_log10) in &farthest_first {
        let spread = PEOPLE_SDS * between_sd_log10;
        let people = Span { low: median_log10 - spread, high: median_log10 + spread };
        let name = format!(
            "{}, texel {} px: thresholds of {people} are expected",
            series_name(round_of(condition), protocol),
            condition.texel_px
        );
        check_radii(protocol, condition, people, &name)?;
        for prior_ratio in &protocol.staircase.prior_ratios {
            check_table(protocol, prior_ratio.log10(), people, &name)?;
            check_prior(protocol, prior_ratio.log10(), people, &name)?;
        }
    }
    Ok(())
}

/// Ratios from `low` to `high`, as log10.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Span {
    low: f64,
    high: f64,
}

impl Span {
    fn holds(&self, inner: &Self) -> bool {
        self.low <= inner.low && inner.high <= self.high
    }

    /// Without `margin` at both ends.
    fn less(&self, margin: f64) -> Self {
        Self { low: self.low + margin, high: self.high - margin }
    }
}

impl std::fmt::Display for Span {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let texels = |log10: f64| {
            let ratio = 10_f64.powf(log10);
            // Three digits that count, from 0.0298 to 347.
            let decimals = (2.0 - log10.floor()).clamp(0.0, 12.0) as usize;
            format!("{ratio:.decimals$}")
        };
        write!(f, "{} to {} texels", texels(self.low), texels(self.high))
    }
}

fn check_radii(protocol: &Protocol, condition: &Condition, people: Span, name: &str) -> Result<(), Error> {
    let (smallest_px, largest_px) = protocol.radius_range_px(condition.texel_px);
    let ratio_log10 = |radius_px: f64| (radius_px / condition.texel_px).log10();
    let shown = Span { low: ratio_log10(smallest_px), high: ratio_log10(largest_px) };
    let margin = protocol.convergence.edge_distance_log10;
    if shown.less(margin).holds(&people) {
        return Ok(());
    }
    Err(Error::CannotPlan(format!(
        "{name}, and pictures of {} x {} px show {shown}, of which a staircase converges on {}; allowed are larger \
         pictures, smaller conditions.texels_px, another pictures.ratio_min, or a smaller \
         convergence.edge_distance_log10",
        protocol.pictures.width_px,
        protocol.pictures.height_px,
        shown.less(margin)
    )))
}

fn check_table(protocol: &Protocol, centre: f64, people: Span, name: &str) -> Result<(), Error> {
    let half = protocol.staircase.table_width_log10 / 2.0;
    let margin = protocol.convergence.edge_distance_log10;
    let table = Span { low: centre - half, high: centre + half };
    if table.less(margin).holds(&people) {
        return Ok(());
    }
    let needed = 2.0 * (margin + (people.high - centre).max(centre - people.low));
    Err(Error::CannotPlan(format!(
        "{name}, and the table about the prior of {:.3} texels holds {table}, of which a staircase converges on {}; \
         allowed is staircase.table_width_log10 of {} or more, or staircase.prior_ratios nearer to what is expected",
        10_f64.powf(centre),
        table.less(margin),
        rounded_up(needed),
    )))
}

fn check_prior(protocol: &Protocol, centre: f64, people: Span, name: &str) -> Result<(), Error> {
    let sd = protocol.staircase.prior_sd_log10;
    let trials = protocol.schedule.trials_max;
    let (below_sds, above_sds) = reach_sds(protocol);
    let reach = Span { low: centre - sd * below_sds, high: centre + sd * above_sds };
    if reach.holds(&people) {
        return Ok(());
    }
    let needed_sd = ((people.high - centre) / above_sds).max((centre - people.low) / below_sds);
    let nearest = Span { low: people.high - sd * above_sds, high: people.low + sd * below_sds };
    let or_prior = match nearest.low <= nearest.high {
        true => format!(", or staircase.prior_ratios of {nearest}"),
        false => String::new(),
    };
    Err(Error::CannotPlan(format!(
        "{name}, and the prior of {:.3} texels with an SD of {sd} log10 reaches {reach} when half of {trials} trials \
         go into leaving it; allowed is staircase.prior_sd_log10 of {} or more{or_prior}",
        10_f64.powf(centre),
        rounded_up(needed_sd),
    )))
}

/// How far a staircase gets from its prior towards smaller and larger radii, in prior SDs.
fn reach_sds(protocol: &Protocol) -> (f64, f64) {
    let known = Assumptions::of_protocol(protocol);
    let floor = known.guess.max(SURE);
    let ceiling = (1.0 - known.blind_share * (1.0 - known.guess)).min(1.0 - SURE);
    let expected = protocol.staircase.threshold_probability;
    let trials = f64::from(protocol.schedule.trials_max);
    ((trials * divergence(floor, expected)).sqrt(), (trials * divergence(ceiling, expected)).sqrt())
}

/// Keeps the divergence finite where nobody is assumed to guess or to slip.
const SURE: f64 = 1e-3;

/// Mean nats by which answers that are right with probability `p` contradict the probability `q`.
fn divergence(p: f64, q: f64) -> f64 {
    p * (p / q).ln() + (1.0 - p) * ((1.0 - p) / (1.0 - q)).ln()
}

/// The next hundredth.
fn rounded_up(value: f64) -> f64 {
    (value * 100.0).ceil() / 100.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn expected(protocol: &Protocol) -> Vec<(Condition, f64)> {
        protocol.all_conditions().into_iter().map(|condition| (condition, 3.47_f64.log10())).collect()
    }

    fn refusal(change: impl Fn(&mut Protocol)) -> String {
        let mut protocol = Protocol::two_alternative();
        change(&mut protocol);
        protocol.check().unwrap();
        let message = check_reach(&protocol, &expected(&protocol), 0.1).unwrap_err().to_string();
        assert!(message.contains("allowed is") || message.contains("allowed are"), "{message}");
        assert!(!message.contains('\n'), "{message}");
        message
    }

    #[test]
    fn every_shipped_protocol_can_measure_what_kreuzer_found() {
        for name in ["published", "two-alternative", "yes-no"] {
            let protocol = Protocol::named(name).unwrap();
            check_reach(&protocol, &expected(&protocol), 0.1).unwrap();
        }
    }

    #[test]
    fn the_published_prior_is_out_of_reach_in_both_readings() {
        // "3 % of the artifact size" as centre and as SD: of log10 units, and of the radius itself, where an
        // SD as large as the centre is 1 / ln 10 = 0.434 log10.
        // A prior as wide as ours reaches no further from there: of 240 simulated staircases 32 converged.
        for sd in [0.03, std::f64::consts::LOG10_E, 0.6] {
            let message = refusal(|protocol| {
                protocol.staircase.prior_ratios = vec![0.03];
                protocol.staircase.prior_sd_log10 = sd;
            });
            assert!(message.contains("the prior of 0.030 texels") && message.contains("2.19 to 5.50"), "{message}");
        }
    }

    #[test]
    fn what_the_refusal_allows_is_allowed() {
        let message = refusal(|protocol| protocol.staircase.prior_sd_log10 = 0.03);
        let (_, allowed) = message.split_once("prior_sd_log10 of ").unwrap();
        let sd: f64 = allowed.split(' ').next().unwrap().parse().unwrap();
        let mut protocol = Protocol::two_alternative();
        protocol.staircase.prior_sd_log10 = sd;
        check_reach(&protocol, &expected(&protocol), 0.1).unwrap();
        protocol.staircase.prior_sd_log10 = sd - 0.01;
        assert!(check_reach(&protocol, &expected(&protocol), 0.1).is_err());
    }

    #[test]
    fn a_table_that_does_not_hold_the_answer_is_refused() {
        let message = refusal(|protocol| {
            protocol.staircase.prior_ratios = vec![1.0];
            protocol.staircase.table_width_log10 = 1.5;
        });
        assert!(message.contains("table_width_log10 of 1.79 or more"), "{message}");
    }

    #[test]
    fn pictures_too_small_for_the_radius_are_refused() {
        let message = refusal(|protocol| protocol.pictures.height_px = 240);
        assert!(message.contains("texel 20 px") && message.contains("600 x 240 px"), "{message}");
    }

    #[test]
    fn the_divergence_has_its_known_values() {
        assert_eq!(divergence(0.5, 0.5), 0.0);
        // 0.995 ln(0.995 / 0.82) + 0.005 ln(0.005 / 0.18) and 0.5 ln(0.5 / 0.82) + 0.5 ln(0.5 / 0.18).
        assert!((divergence(0.995, 0.82) - 0.174554).abs() < 1e-6);
        assert!((divergence(0.5, 0.82) - 0.263478).abs() < 1e-6);
    }
}
