//! A pattern at a contrast under a kernel, over all people and texel sizes: both estimators of the ratio and the
//! tests of the relation's form.
//!
//! *Ours*: the median person's ratio of the [mixed model](MixedModel), from every answer of everyone at all texel
//! sizes, catch trials too.
//!
//! *Mean of logarithms*: per person one ratio, by maximum likelihood from the answers at all texel sizes
//! ([`joint_threshold`]), then the mean of its logarithm over people with Student's t interval
//! ([`MeanOverPeople`]). People weigh equally; those without a threshold are not in it.
//!
//! *Published* (Kreuzer 2017, Eq. 5.1): the line through the origin of the mean radii over the texel
//! sizes; arithmetic means, large texels weigh most. For log-normal people its target is the mean
//! of the ratios, which lies above the median (by 3 % at a between-person SD of 0.1 log10).
//!
//! *Form*: per person the exponent of `r = c a^g` and the intercept of `r = c a + b`, each tested over
//! people with Student's t. One slope per person keeps the sizes' different errors out of the test.

use scumble_psychophysics::{Condition, Protocol, Round};
use scumble_stimuli::{Kernel, Pattern};

use crate::{
    Error,
    assumptions::Assumptions,
    checks::Checks,
    estimate::{MeanOverPeople, SizePoint, exponent, intercept_px, line_through_origin},
    mixed_model::{Interval, MixedFit, MixedModel, MixedParameters, PersonAnswers, Quantity},
    people::{Person, Track},
    thresholds::{joint_threshold, thresholds_of},
};

/// One person's thresholds in a series.
#[derive(Debug, Clone, PartialEq)]
pub struct PersonInSeries {
    /// The person's code.
    pub person: String,
    /// log10 of the ratio at threshold, from the answers at all texel sizes.
    pub log10_ratio: f64,
    /// Variance of that number from the answers' likelihood, log10 units squared.
    pub measurement_variance: f64,
    /// Radius at threshold for each texel size.
    pub points: Vec<SizePoint>,
}

/// The published estimator with its precision.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OriginLine {
    /// Slope of the line through the origin of the mean radii: a ratio.
    pub slope: f64,
    /// Precision over people, where everyone has every texel size: then the slope of the means is
    /// the mean of the people's slopes.
    pub over_people: Option<MeanOverPeople>,
}

/// A pattern at a contrast under a kernel.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// The pattern, contrast and kernel.
    pub round: Round,
    /// `step, 100 % contrast`, and the kernel where the study has several.
    pub name: String,
    /// Texel sizes, pixels, ascending.
    pub texels_px: Vec<f64>,
    /// People with at least one threshold here.
    pub people: Vec<PersonInSeries>,
    /// The mixed model.
    pub fit: MixedFit,
    /// Our estimator, log10 of the median person's ratio at the threshold.
    pub log10_ratio: Interval,
    /// Mean of the people's own log10 ratios; `None` below two people with a threshold.
    pub log_mean: Option<MeanOverPeople>,
    /// The published estimator; `None` where no person has a threshold.
    pub origin_line: Option<OriginLine>,
    /// Exponent `g` over people; `None` where fewer than two people have two sizes.
    pub exponent: Option<MeanOverPeople>,
    /// Intercept over people, pixels.
    pub intercept_px: Option<MeanOverPeople>,
}

impl Series {
    /// The series of a round.
    ///
    /// # Errors
    /// Fewer than two people answered here, or their answers do not bound the ratio.
    pub fn of(round: Round, people: &[Person], protocol: &Protocol) -> Result<Self, Error> {
        let mut texels_px = protocol.conditions.texels_px.clone();
        texels_px.sort_by(f64::total_cmp);
        let name = series_name(round, protocol);
        let (fit, log10_ratio) = fitted(round, people, protocol).map_err(|reason| match reason {
            Error::CannotFit(reason) => Error::CannotFit(format!("{name}: {reason}")),
            other => other,
        })?;
        let people: Vec<_> =
            people.iter().filter_map(|person| person_in_series(round, person, protocol, &fit.parameters())).collect();
        let ratios: Vec<f64> = people.iter().map(|person| person.log10_ratio).collect();
        let over_people = |statistic: fn(&[SizePoint]) -> Option<f64>| {
            let values: Vec<f64> = people.iter().filter_map(|p| statistic(&p.points)).collect();
            MeanOverPeople::of(&values).ok()
        };
        Ok(Self {
            round,
            name,
            fit,
            log10_ratio,
            log_mean: MeanOverPeople::of(&ratios).ok(),
            origin_line: origin_line(&people, &texels_px),
            exponent: over_people(exponent),
            intercept_px: over_people(intercept_px),
            texels_px,
            people,
        })
    }

    /// The median person's ratio at threshold, radius in texels.
    pub fn ratio(&self) -> f64 {
        10_f64.powf(self.log10_ratio.value)
    }

    /// Its standard error by the delta method: `c ln 10` times the error of the logarithm.
    pub fn ratio_standard_error(&self) -> f64 {
        self.ratio() * std::f64::consts::LN_10 * self.log10_ratio.standard_error
    }

    /// Its 95 % interval, which is symmetric in the logarithm.
    pub fn ratio_ci95(&self) -> [f64; 2] {
        self.log10_ratio.ci95.map(|limit| 10_f64.powf(limit))
    }
}

/// `step, 100 % contrast`, and the kernel where the study has several.
pub(crate) fn series_name(round: Round, protocol: &Protocol) -> String {
    let Round { pattern, contrast, kernel } = round;
    let name = format!("{}, {} % contrast", pattern_name(pattern), (contrast * 1000.0).round() / 10.0);
    match protocol.conditions.kernels.len() {
        1 => name,
        _ => format!("{name}, {}", kernel_name(kernel)),
    }
}

/// The pattern's word in files.
pub(crate) fn pattern_name(pattern: Pattern) -> &'static str {
    match pattern {
        Pattern::Stair => "stair",
        Pattern::Step => "step",
        Pattern::DoubleStep => "double_step",
    }
}

/// The kernel's word in files.
pub(crate) fn kernel_name(kernel: Kernel) -> &'static str {
    let named = Kernel::NAMED.iter().find(|(_, named)| *named == kernel);
    named.map_or("unnamed", |(name, _)| *name)
}

/// The round in which a condition is measured.
pub(crate) fn round_of(condition: &Condition) -> Round {
    Round { pattern: condition.pattern, contrast: condition.contrast, kernel: condition.kernel }
}

/// The mixed model of a round and its median person.
fn fitted(round: Round, people: &[Person], protocol: &Protocol) -> Result<(MixedFit, Interval), Error> {
    let answers: Vec<PersonAnswers> = people.iter().filter_map(|person| answers_of(round, person, protocol)).collect();
    let fit = MixedModel::new(answers, Assumptions::of_protocol(protocol)).fit()?;
    let median = Interval::of(&fit, Quantity::MEDIAN)?;
    Ok((fit, median))
}

/// A person's answers in a round, with those to catch trials, which tell blind ones; `None` where there are none.
pub(crate) fn answers_of(round: Round, person: &Person, protocol: &Protocol) -> Option<PersonAnswers> {
    let here = || person.tracks.iter().filter(|track| round_of(&track.condition) == round).flat_map(Track::responses);
    here().next()?;
    let guess = Assumptions::of_person(person, protocol).guess;
    Some(PersonAnswers::new(guess, here().chain(catch_answers(person, protocol))))
}

/// A person's answers to catch trials.
pub(crate) fn catch_answers(person: &Person, protocol: &Protocol) -> impl Iterator<Item = (f64, bool)> {
    let Checks { catches, catches_seen, .. } = person.checks;
    catch_intensity(protocol).into_iter().flat_map(move |x| (0..catches).map(move |trial| (x, trial < catches_seen)))
}

/// Intensity of the protocol's catch trials; `None` without any.
pub(crate) fn catch_intensity(protocol: &Protocol) -> Option<f64> {
    protocol.catch_trials.map(|rules| -rules.ratio.log10())
}

fn person_in_series(
    round: Round,
    person: &Person,
    protocol: &Protocol,
    fitted: &MixedParameters,
) -> Option<PersonInSeries> {
    let is_here = |track: &&Track| round_of(&track.condition) == round;
    let known = Assumptions::of_person(person, protocol).with(fitted);
    let joint = joint_threshold(person.tracks.iter().filter(is_here), &known).ok()?;
    let points = thresholds_of(person, protocol, |_| Some(*fitted))
        .iter()
        .zip(&person.tracks)
        .filter(|(_, track)| is_here(track))
        .filter_map(|(entry, _)| {
            let radius_px = entry.radius_px()?;
            Some(SizePoint { texel_px: entry.condition.texel_px, radius_px })
        })
        .collect();
    Some(PersonInSeries {
        person: person.code.clone(),
        log10_ratio: joint.log10_ratio,
        measurement_variance: joint.standard_error_log10.powi(2),
        points,
    })
}

fn origin_line(people: &[PersonInSeries], texels_px: &[f64]) -> Option<OriginLine> {
    let mean_points: Vec<SizePoint> = texels_px
        .iter()
        .filter_map(|&texel_px| {
            let radii: Vec<f64> = people
                .iter()
                .flat_map(|person| &person.points)
                .filter(|point| point.texel_px == texel_px)
                .map(|point| point.radius_px)
                .collect();
            let mean = radii.iter().sum::<f64>() / radii.len() as f64;
            (!radii.is_empty()).then_some(SizePoint { texel_px, radius_px: mean })
        })
        .collect();
    let slope = line_through_origin(&mean_points)?;
    let complete = people.iter().all(|person| person.points.len() == texels_px.len());
    let slopes: Vec<f64> = people.iter().filter_map(|p| line_through_origin(&p.points)).collect();
    let over_people = if complete { MeanOverPeople::of(&slopes).ok() } else { None };
    Some(OriginLine { slope, over_people })
}
