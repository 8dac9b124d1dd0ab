//! 95 % intervals of a study's single thresholds, by the two methods of the command `threshold`.
//!
//! *Profile likelihood* (`profile_likelihood.rs`): where `ln L` has fallen by 1.92. *Parametric bootstrap*
//! (`parametric_bootstrap.rs`): the fitted function answers the same trials anew, every such record is fitted at the same slope
//! and lapses, and the interval holds the bias-corrected percentiles; with the few answers of one staircase an end is often
//! open, because too many of the records bound nothing. The trials stay where the staircase put them by the first answers;
//! how often both hold the truth all the same is in `docs/analysis.md`.

use rayon::prelude::*;
use scumble_psychophysics::Round;

use crate::{
    Error,
    assumptions::Assumptions,
    count_table::CORRECT_AT_THRESHOLD,
    maximum_likelihood::{Count, Maximum, Place, fit},
    mixed_model::MixedParameters,
    parametric_bootstrap::{Resampling, interval, refits},
    people::{Person, Study, Track},
    profile_likelihood::place_interval,
    series::round_of,
};

/// Records that are drawn for a threshold: 2.5 % are five, at a tenth of the time that the command `threshold` takes for its
/// 2000. A refit of 20 answers takes 0.05 ms.
const RESAMPLES: u32 = 199;

/// Most people whose thresholds are resampled: beyond, that would take longer than the fit.
pub(crate) const RESAMPLED_MOST: usize = 100;

/// Ends of a 95 % interval, log10 of the ratio; `None` where the answers bound none.
pub(crate) type Ends = [Option<f64>; 2];

/// The intervals of one threshold; open where there is no threshold.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct ThresholdIntervals {
    /// By profile likelihood.
    pub profile: Ends,
    /// By bootstrap; open for more than [`RESAMPLED_MOST`] people.
    pub bootstrap: Ends,
}

/// Those of every person's every threshold, in the order of [`thresholds_of`](crate::thresholds_of) person by person. `fitted` gives the mixed model of a round, where there is one.
///
/// # Errors
/// The search for an end failed.
pub(crate) fn threshold_intervals(
    study: &Study,
    fitted: impl Fn(Round) -> Option<MixedParameters> + Sync,
) -> Result<Vec<ThresholdIntervals>, Error> {
    let tracks: Vec<(&Person, &Track)> =
        study.people.iter().flat_map(|person| person.tracks.iter().map(move |track| (person, track))).collect();
    let is_resampled = study.people.len() <= RESAMPLED_MOST;
    let of = |(person, track): &(&Person, &Track)| {
        let known = Assumptions::of_person(person, &study.protocol);
        let known = fitted(round_of(&track.condition)).map_or(known, |fitted| known.with(&fitted));
        intervals(track, &known, is_resampled)
    };
    tracks.par_iter().map(of).collect()
}

fn intervals(track: &Track, known: &Assumptions, is_resampled: bool) -> Result<ThresholdIntervals, Error> {
    let none = ThresholdIntervals::default();
    let model = known.model();
    let count = |(x, correct)| Count { x, correct: f64::from(u8::from(correct)), total: 1.0 };
    let counts: Vec<Count> = track.responses().map(count).collect();
    let Ok(found) = fit(&counts, &model) else { return Ok(none) };
    let weibull = found.weibull;
    let Some(x) = weibull.x_at_detection(known.seen_at_threshold()) else { return Ok(none) };
    // The threshold lies a fixed distance from the location, and the ratio falls as the intensity grows.
    let log10_ratio = |location: f64| -(location + x - weibull.location);
    let ends = |[low, high]: Ends| [high.map(log10_ratio), low.map(log10_ratio)];

    let top = Maximum { weibull, ln_likelihood: -found.negative_log_likelihood };
    let about = (weibull.location, found.location_se);
    let profile = ends(place_interval(&counts, &model, &top, Place::Location, about)?);
    if !is_resampled {
        return Ok(ThresholdIntervals { profile, ..none });
    }
    let resampling = Resampling { resamples: RESAMPLES, ..Resampling::default() };
    let refits = refits(&counts, &model, &weibull, CORRECT_AT_THRESHOLD, &resampling, || ());
    let allowed: Vec<[f64; 2]> = refits.iter().map(|refit| refit.location).collect();
    Ok(ThresholdIntervals { profile, bootstrap: ends(interval(&allowed, weibull.location)?) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Simulation, thresholds_of};
    use scumble_psychophysics::{ObserverModel, Protocol};

    #[test]
    fn intervals_hold_their_threshold_are_about_four_standard_errors_wide_and_are_drawn_again() {
        let protocol = Protocol::two_alternative();
        let simulation =
            Simulation { protocol, observers: 3, seed: 5, median: ObserverModel::default(), between_sd_log10: 0.1 };
        let study = simulation.study().unwrap();
        let found = threshold_intervals(&study, |_| None).unwrap();
        assert_eq!(found, threshold_intervals(&study, |_| None).unwrap());
        let thresholds: Vec<_> =
            study.people.iter().flat_map(|person| thresholds_of(person, &study.protocol, |_| None)).collect();
        assert_eq!(found.len(), thresholds.len());
        let mut widths = Vec::new();
        for (intervals, entry) in found.iter().zip(&thresholds) {
            let Ok(threshold) = entry.threshold else { continue };
            let ThresholdIntervals { profile: [Some(low), Some(high)], bootstrap } = *intervals else {
                panic!("a threshold is bounded: {intervals:?}");
            };
            assert!(low < threshold.log10_ratio && threshold.log10_ratio < high, "{entry:?}: {low} {high}");
            assert!(bootstrap[0].is_none_or(|end| end <= threshold.log10_ratio));
            assert!(bootstrap[1].is_none_or(|end| end >= threshold.log10_ratio));
            widths.push((high - low) / threshold.standard_error_log10);
        }
        let mean = widths.iter().sum::<f64>() / widths.len() as f64;
        assert!(widths.len() > 24 && (3.5..5.0).contains(&mean), "{} widths, {mean}", widths.len());
        assert!(found.iter().any(|intervals| intervals.bootstrap.iter().all(Option::is_some)));
    }

    #[test]
    fn a_track_without_a_threshold_has_no_interval() {
        let protocol = Protocol::two_alternative();
        let known = Assumptions::of_protocol(&protocol);
        let simulation =
            Simulation { protocol, observers: 1, seed: 5, median: ObserverModel::default(), between_sd_log10: 0.1 };
        let mut track = simulation.study().unwrap().people.remove(0).tracks.remove(0);
        track.runs.iter_mut().flat_map(|run| &mut run.responses).for_each(|(_, correct)| *correct = true);
        assert_eq!(intervals(&track, &known, true).unwrap(), ThresholdIntervals::default());
    }
}
