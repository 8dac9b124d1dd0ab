//! A pattern at a contrast under a kernel, over all people and texel sizes: both estimators of the ratio and the
//! tests of the relation's form.
//!
//! *Ours*: per person one ratio, by maximum likelihood from the answers at all texel sizes
//! ([`joint_threshold`]), then the mean of its logarithm over people with Student's t interval
//! ([`MeanOverPeople`]). People weigh equally.
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
    estimate::{MeanOverPeople, SizePoint, exponent, intercept_px, line_through_origin},
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
    /// Our estimator, log10 of the ratio.
    pub log10_ratio: MeanOverPeople,
    /// The published estimator.
    pub origin_line: OriginLine,
    /// Exponent `g` over people; `None` where fewer than two people have two sizes.
    pub exponent: Option<MeanOverPeople>,
    /// Intercept over people, pixels.
    pub intercept_px: Option<MeanOverPeople>,
}

impl Series {
    /// The series of a round. People whose answers do not carry a ratio are left out.
    ///
    /// # Errors
    /// Fewer than two people have a ratio here.
    pub fn of(round: Round, people: &[Person], protocol: &Protocol) -> Result<Self, Error> {
        let mut texels_px = protocol.conditions.texels_px.clone();
        texels_px.sort_by(f64::total_cmp);
        let name = series_name(round, protocol);
        let people: Vec<_> = people.iter().filter_map(|person| person_in_series(round, person, protocol)).collect();
        let ratios: Vec<f64> = people.iter().map(|person| person.log10_ratio).collect();
        let log10_ratio = MeanOverPeople::of(&ratios).map_err(|reason| match reason {
            Error::CannotFit(reason) => Error::CannotFit(format!("{name}: {reason}")),
            other => other,
        })?;
        let over_people = |statistic: fn(&[SizePoint]) -> Option<f64>| {
            let values: Vec<f64> = people.iter().filter_map(|p| statistic(&p.points)).collect();
            MeanOverPeople::of(&values).ok()
        };
        Ok(Self {
            round,
            name,
            log10_ratio,
            origin_line: origin_line(&people, &texels_px)?,
            exponent: over_people(exponent),
            intercept_px: over_people(intercept_px),
            texels_px,
            people,
        })
    }

    /// The median person's ratio at threshold, radius in texels.
    pub fn ratio(&self) -> f64 {
        10_f64.powf(self.log10_ratio.mean)
    }

    /// Its standard error by the delta method: `c ln 10` times the error of the logarithm.
    pub fn ratio_standard_error(&self) -> f64 {
        self.ratio() * std::f64::consts::LN_10 * self.log10_ratio.standard_error
    }

    /// Its 95 % interval, which is symmetric in the logarithm.
    pub fn ratio_ci95(&self) -> [f64; 2] {
        self.log10_ratio.ci95.map(|limit| 10_f64.powf(limit))
    }

    /// Mean over people of the measurement variance of a person's mean, log10 units squared.
    pub fn measurement_variance(&self) -> f64 {
        let sum: f64 = self.people.iter().map(|person| person.measurement_variance).sum();
        sum / self.people.len() as f64
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

fn person_in_series(round: Round, person: &Person, protocol: &Protocol) -> Option<PersonInSeries> {
    let is_here = |track: &&Track| round_of(&track.condition) == round;
    let known = Assumptions::of_person(person, protocol);
    let joint = joint_threshold(person.tracks.iter().filter(is_here), &known).ok()?;
    let points = thresholds_of(person, protocol)
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

fn origin_line(people: &[PersonInSeries], texels_px: &[f64]) -> Result<OriginLine, Error> {
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
    let no_line = || Error::CannotFit("no texel size has a radius".to_owned());
    let slope = line_through_origin(&mean_points).ok_or_else(no_line)?;
    let complete = people.iter().all(|person| person.points.len() == texels_px.len());
    let slopes: Vec<f64> = people.iter().filter_map(|p| line_through_origin(&p.points)).collect();
    let over_people = if complete { MeanOverPeople::of(&slopes).ok() } else { None };
    Ok(OriginLine { slope, over_people })
}
