//! The whole analysis: thresholds, every series, the worst of them, and the file for renderers.

use std::f64::consts::LN_10;

use scumble_core::{
    ConditionEstimate, Estimate, FormTests, GoodnessOfFit as FileFit, ModelParameters, NullTest, OtherEstimator,
    PopulationPoint as FilePoint, Relation, RelationFile, SCHEMA,
};
use scumble_psychophysics::{Protocol, Round};

use crate::{
    Error,
    effects::{Effect, effects},
    estimate::MeanOverPeople,
    goodness_of_fit::GoodnessOfFit,
    mixed_model::MixedParameters,
    people::Study,
    population::Population,
    prior_sensitivity::{UnderPrior, under_priors},
    series::{Series, kernel_name, pattern_name, round_of, series_name},
    thresholds::{ConditionThreshold, thresholds_of},
};

/// Name and version of this program, as `relation.json` carries it.
pub const SOFTWARE: &str = concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION"));

/// What a study says.
#[derive(Debug, Clone, PartialEq)]
pub struct Analysis {
    /// Every person's thresholds, in the order of people and conditions.
    pub thresholds: Vec<ConditionThreshold>,
    /// Every pattern, contrast and kernel that at least two people's answers bound.
    pub series: Vec<Series>,
    /// Whether the model fits, for each of `series`.
    pub goodness: Vec<GoodnessOfFit>,
    /// Index of the worst series: the largest ratio under the protocol's first kernel. It is the
    /// renderer's number, which holds for one kernel.
    pub worst: usize,
    /// The viewers of the worst series.
    pub population: Population,
    /// What pattern, contrast and round do.
    pub effects: Vec<Effect>,
    /// The worst series by the staircases' own estimates, under several priors.
    pub under_priors: Vec<UnderPrior>,
    /// What was left out and why, in sentences.
    pub exclusions: Vec<String>,
}

impl Analysis {
    /// Analyses a study.
    ///
    /// # Errors
    /// The reason why the data carry no fit: fewer than two people with thresholds in every pattern
    /// and contrast, no condition in which the experiment converged, or one texel size alone.
    pub fn of(study: &Study) -> Result<Self, Error> {
        let protocol = &study.protocol;
        check_converged(study)?;
        check_sizes(study)?;
        let (mut series, mut exclusions) = (Vec::new(), Vec::new());
        let mut refusal = None;
        for round in protocol.rounds() {
            match Series::of(round, &study.people, protocol) {
                Ok(found) => series.push(found),
                Err(reason) => {
                    exclusions.push(reason.to_string());
                    refusal = refusal.or(Some(reason));
                }
            }
        }
        let fitted =
            |round: Round| series.iter().find(|series| series.round == round).map(|s: &Series| s.fit.parameters());
        let thresholds: Vec<_> =
            study.people.iter().flat_map(|person| thresholds_of(person, protocol, fitted)).collect();
        exclusions.extend(left_out(&thresholds, protocol));
        let no_series = || Error::CannotFit("the protocol has no round".to_owned());
        let of_kernel = |index: &usize| Some(&series[*index].round.kernel) == protocol.conditions.kernels.first();
        let larger = |a: &usize, b: &usize| series[*a].log10_ratio.value.total_cmp(&series[*b].log10_ratio.value);
        let Some(worst) = (0..series.len()).filter(of_kernel).max_by(larger) else {
            return Err(refusal.unwrap_or_else(no_series));
        };

        let goodness = series
            .iter()
            .map(|series| GoodnessOfFit::of(series, &study.people, protocol))
            .collect::<Result<_, Error>>()?;
        let population = Population::of(&series[worst].fit)?;
        let effects = effects(&series, &study.people, protocol);
        let under_priors = under_priors(&series[worst], &study.people, protocol)?;
        Ok(Self { thresholds, series, goodness, worst, population, effects, under_priors, exclusions })
    }

    /// The series whose ratio a renderer uses.
    pub fn worst(&self) -> &Series {
        &self.series[self.worst]
    }

    /// `relation.json` of this analysis.
    ///
    /// # Errors
    /// The schema's own check refuses the result: a ratio above 64, for instance.
    pub fn relation_file(&self, study: &Study) -> Result<RelationFile, Error> {
        let worst = self.worst();
        let file = RelationFile {
            schema: SCHEMA.to_owned(),
            ratio: ratio_of(worst),
            population: self
                .population
                .curve
                .iter()
                .map(|point| FilePoint {
                    viewers: point.viewers,
                    detection: point.detection,
                    ratio: Estimate { value: point.ratio, standard_error: point.standard_error, ci95: point.ci95 },
                })
                .collect(),
            kernel: Some(kernel_name(worst.round.kernel).to_owned()),
            tests: worst.intercept_px.zip(worst.exponent).map(|(intercept, exponent)| FormTests {
                intercept: null_test(&intercept, 0.0),
                exponent: null_test(&exponent, 1.0),
            }),
            conditions: self
                .series
                .iter()
                .zip(&self.goodness)
                .map(|(series, fit)| ConditionEstimate {
                    pattern: pattern_name(series.round.pattern).to_owned(),
                    contrast: series.round.contrast,
                    kernel: Some(kernel_name(series.round.kernel).to_owned()),
                    ratio: ratio_of(series),
                    goodness_of_fit: Some(FileFit {
                        chi_square: fit.chi_square,
                        expected: fit.expected,
                        p_value: fit.p_value,
                        drift: fit.drift,
                        drift_p_value: fit.drift_p_value,
                        cohorts: fit.cohorts.into(),
                    }),
                })
                .collect(),
            model: Some(model_of(worst)),
            other_estimators: other_estimators(worst),
            protocol: Some(study.protocol.name.clone()),
            people: Some(study.people.len() as u64),
            trials: Some(study.trial_count() as u64),
            sessions: study.session_hashes(),
            software: Some(SOFTWARE.to_owned()),
        };
        // What a renderer could not read is not written.
        Relation::from_json(&file.to_json()?)?;
        Ok(file)
    }
}

fn ratio_of(series: &Series) -> Estimate {
    Estimate { value: series.ratio(), standard_error: series.ratio_standard_error(), ci95: series.ratio_ci95() }
}

fn model_of(series: &Series) -> ModelParameters {
    let MixedParameters { between_sd, slope, blind_share, .. } = series.fit.parameters();
    ModelParameters { between_sd_log10: between_sd, slope_per_log10: slope, blind_share }
}

/// The ratio as others would estimate it, where the study carries that.
fn other_estimators(series: &Series) -> Vec<OtherEstimator> {
    let mean_of_logarithms = series.log_mean.map(|mean| {
        let value = 10_f64.powf(mean.mean);
        Estimate {
            value,
            standard_error: value * LN_10 * mean.standard_error,
            ci95: mean.ci95.map(|limit| 10_f64.powf(limit)),
        }
    });
    let line = series.origin_line.and_then(|line| {
        let mean = line.over_people?;
        Some(Estimate { value: line.slope, standard_error: mean.standard_error, ci95: mean.ci95 })
    });
    let named = [("mean_of_logarithms", mean_of_logarithms), ("line_through_origin", line)];
    named
        .into_iter()
        .filter_map(|(name, ratio)| Some(OtherEstimator { name: name.to_owned(), ratio: ratio? }))
        .collect()
}

fn null_test(mean: &MeanOverPeople, null: f64) -> NullTest {
    let estimate = Estimate { value: mean.mean, standard_error: mean.standard_error, ci95: mean.ci95 };
    NullTest { estimate, null, p_value: mean.p_value(null) }
}

/// Refuses a study in which no staircase met the experiment's own rule.
fn check_converged(study: &Study) -> Result<(), Error> {
    let tracks = || study.people.iter().flat_map(|person| &person.tracks);
    if tracks().any(|track| track.converged() > 0) {
        return Ok(());
    }
    Err(Error::CannotFit(format!(
        "none of {} staircases converged in any of {} people",
        tracks().map(|track| track.runs.len()).sum::<usize>(),
        study.people.len()
    )))
}

/// Refuses answers at one texel size, which tell nothing of how the radius grows with the texel.
fn check_sizes(study: &Study) -> Result<(), Error> {
    let answered =
        study.people.iter().flat_map(|person| &person.tracks).filter(|track| track.responses().next().is_some());
    let mut sizes_px: Vec<f64> = answered.map(|track| track.condition.texel_px).collect();
    sizes_px.sort_by(f64::total_cmp);
    sizes_px.dedup();
    match sizes_px[..] {
        [only_px] => Err(Error::CannotFit(format!(
            "all answers are at a texel of {only_px} px; that the radius grows with the texel needs at least 2 sizes"
        ))),
        _ => Ok(()),
    }
}

/// A sentence for every condition without a threshold.
pub(crate) fn left_out(thresholds: &[ConditionThreshold], protocol: &Protocol) -> Vec<String> {
    thresholds
        .iter()
        .filter_map(|entry| {
            let reason = entry.threshold.err()?;
            let condition = &entry.condition;
            let series = series_name(round_of(condition), protocol);
            Some(format!("{}, {series}, {} px: {reason}", entry.person, condition.texel_px))
        })
        .collect()
}
