//! How far the staircases' own estimates, which a study may be tempted to report, lean on their prior.
//!
//! A staircase's estimate is the mean of its posterior: prior times answers. Here the answers are the recorded ones and
//! the prior is changed, its centre and its width by a factor of two; per person the mean over staircases, over people the
//! mean of logarithms, as the published study took it. What moves with the prior was not measured. The fit itself uses
//! no prior of the threshold.

use scumble_psychophysics::Protocol;

use crate::{
    Error,
    people::{Person, Run, Track},
    series::{Series, round_of},
};

/// The ratio of one series by the staircases' own estimates under one prior.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnderPrior {
    /// Factor on the prior's centre, in texels.
    pub centre_factor: f64,
    /// Factor on the prior's standard deviation.
    pub sd_factor: f64,
    /// Mean of logarithms over people, as a ratio.
    pub ratio: f64,
}

/// Factors on centre and width: as it was, then each by two either way.
const CHANGES: [(f64, f64); 5] = [(1.0, 1.0), (0.5, 1.0), (2.0, 1.0), (1.0, 0.5), (1.0, 2.0)];

/// The staircases' own estimates under each prior.
///
/// # Errors
/// A prior that the table of thresholds cannot hold.
pub fn under_priors(series: &Series, people: &[Person], protocol: &Protocol) -> Result<Vec<UnderPrior>, Error> {
    CHANGES.into_iter().map(|change| under_prior(series, people, protocol, change)).collect()
}

fn under_prior(
    series: &Series,
    people: &[Person],
    protocol: &Protocol,
    (centre_factor, sd_factor): (f64, f64),
) -> Result<UnderPrior, Error> {
    let mut changed = protocol.clone();
    changed.staircase.prior_sd_log10 *= sd_factor;
    let log10_ratio = |run: &Run| -> Result<f64, Error> {
        let mut staircase = changed.staircase_at(run.prior_ratio * centre_factor)?;
        for &(intensity, response) in &run.responses {
            staircase.update(intensity, response)?;
        }
        Ok(-staircase.mean())
    };
    let mut means = Vec::new();
    for person in people {
        let is_here = |track: &&Track| round_of(&track.condition) == series.round;
        let runs = person.tracks.iter().filter(is_here).flat_map(|track| &track.runs);
        let answered = runs.filter(|run| !run.responses.is_empty());
        let own: Vec<f64> = answered.map(log10_ratio).collect::<Result<_, Error>>()?;
        if !own.is_empty() {
            means.push(own.iter().sum::<f64>() / own.len() as f64);
        }
    }
    let ratio = 10_f64.powf(means.iter().sum::<f64>() / means.len() as f64);
    Ok(UnderPrior { centre_factor, sd_factor, ratio })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Analysis, Simulation};
    use scumble_psychophysics::ObserverModel;

    #[test]
    fn the_prior_as_it_was_gives_the_staircases_estimates_and_a_shifted_one_moves_them_its_way() {
        let protocol = Protocol::two_alternative();
        let median = ObserverModel::default().with_ratio(6.0).unwrap();
        let simulation = Simulation { protocol, observers: 3, seed: 2, median, between_sd_log10: 0.1 };
        let analysis = Analysis::of(&simulation.study().unwrap()).unwrap();
        let [own, low, high, narrow, wide] = analysis.under_priors[..] else { panic!("five priors") };

        let worst = analysis.worst().round;
        let (mut sum, mut people) = (0.0, 0.0);
        for index in 0..3 {
            let (experiment, _) = simulation.run(index).unwrap();
            let here = experiment.tracks().iter().filter(|track| round_of(track.condition()) == worst);
            let means: Vec<f64> = here.map(|track| track.staircase().mean()).collect();
            sum -= means.iter().sum::<f64>() / means.len() as f64;
            people += 1.0;
        }
        assert!((own.ratio - 10_f64.powf(sum / people)).abs() < 1e-9);
        assert!(low.ratio < own.ratio && own.ratio < high.ratio);
        // The prior's centre, 3, is pulled to by the narrow prior more than by the wide one.
        assert!((narrow.ratio - 3.0).abs() < (wide.ratio - 3.0).abs());
    }
}
