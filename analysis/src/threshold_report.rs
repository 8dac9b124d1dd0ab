//! What the command `threshold` prints: the fit of a table, 95 % intervals by two methods, goodness of fit.

use serde::Serialize;

use crate::{
    Error,
    count_table::{CORRECT_AT_THRESHOLD, CountTableFit, fit_pooled, model, pooled},
    maximum_likelihood::{Count, Maximum, Model, Parameter, Place, deviance_residuals},
    parametric_bootstrap::{self, RESAMPLES_ALLOWED, Resampling},
    profile_likelihood::{FARTHEST, place_interval, slope_interval},
    weibull::Weibull,
};

/// 95 % intervals; an end that the data do not bound is `null`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Intervals {
    /// Of the location, log10 of the level.
    pub threshold_t: [Option<f64>; 2],
    /// Of the slope per decade.
    pub slope_beta: [Option<f64>; 2],
    /// Of log10 of the level at 82 % correct.
    pub x82: [Option<f64>; 2],
}

/// A level beside the fitted function.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LevelFit {
    /// log10 of the level.
    pub x: f64,
    /// Correct answers.
    pub n_correct: f64,
    /// Answers.
    pub n_total: f64,
    /// Probability of a correct answer by the fit.
    pub p: f64,
    /// Deviance residual: positive where more answers were correct than the fit expects.
    pub residual: f64,
}

/// The fit of a table with its uncertainty; the fields are keys of its JSON, beside those of the fit.
///
/// How often the intervals hold the truth, `examples/threshold_coverage.rs`: two alternatives, slope 3, lapse rate given,
/// seven levels, 400 experiments a row, so standard errors of 1 %. Location, slope, x82:
///
/// | answers a level | profile, % | bootstrap, % | slopes without an upper end | p < 5 % | no estimate |
/// |---|---|---|---|---|---|
/// | 10 | 92.6, 98.5, 92.9 | 92.6, 99.7, 92.0 | 69, 87 % | 4.4 % | 15 % |
/// | 20 | 93.7, 95.0, 93.4 | 93.7, 99.7, 92.3 | 38, 48 % | 4.5 % | 6 % |
/// | 40 | 93.2, 93.9, 93.2 | 92.4, 97.0, 92.4 | 13, 15 % | 4.6 % | 1 % |
///
/// Intervals of a place are a little narrow, of tables that have an estimate; two alternatives with few answers do not
/// bound a slope from above, and the intervals say so.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ThresholdReport {
    /// The fit.
    #[serde(flatten)]
    pub fit: CountTableFit,
    /// By profile likelihood.
    pub ci95_profile: Intervals,
    /// By parametric bootstrap, bias-corrected.
    pub ci95_bootstrap: Intervals,
    /// Probability of at least this deviance if the fitted function is right, by parametric bootstrap.
    pub deviance_p: f64,
    /// Number of the bootstrap's tables.
    pub resamples: u32,
    /// Its seed.
    pub seed: u64,
    /// Every level that was shown, rows of one level together.
    pub levels: Vec<LevelFit>,
    /// A sentence for each `null`.
    pub notes: Vec<String>,
}

impl ThresholdReport {
    /// Fits a table as [`fit_count_table`](crate::fit_count_table) does and says how well it is known; `progress` is called
    /// after each of the bootstrap's tables.
    ///
    /// # Errors
    /// Those of the fit, and a number of resamples that is not allowed.
    pub fn of(
        counts: &[Count],
        guess: f64,
        lapse: Parameter,
        resampling: &Resampling,
        progress: impl Fn() + Sync,
    ) -> Result<Self, Error> {
        let model = model(guess, lapse)?;
        if !RESAMPLES_ALLOWED.contains(&resampling.resamples) {
            let value = resampling.resamples.to_string();
            return Err(Error::Argument { name: "--resamples", value, allowed: "100 to 1000000" });
        }
        let counts = pooled(counts)?;
        let fitted = fit_pooled(&counts, &model)?;
        let fit = CountTableFit::of(&fitted);
        let top = Maximum { weibull: fitted.weibull, ln_likelihood: -fitted.negative_log_likelihood };
        let ci95_profile = by_profile(&counts, &model, &top, &fit)?;
        let refits =
            parametric_bootstrap::refits(&counts, &model, &top.weibull, CORRECT_AT_THRESHOLD, resampling, progress);
        let ci95_bootstrap = by_bootstrap(&refits, &fit)?;
        Ok(Self {
            deviance_p: parametric_bootstrap::p_value(&refits, fit.deviance),
            resamples: resampling.resamples,
            seed: resampling.seed,
            levels: levels(&counts, &top.weibull),
            notes: notes(&fit, &ci95_profile, &ci95_bootstrap),
            ci95_profile,
            ci95_bootstrap,
            fit,
        })
    }
}

fn by_profile(counts: &[Count], model: &Model, top: &Maximum, fit: &CountTableFit) -> Result<Intervals, Error> {
    let at = |place, value| place_interval(counts, model, top, place, (value, fit.se_t));
    Ok(Intervals {
        threshold_t: at(Place::Location, fit.threshold_t)?,
        slope_beta: fit.se_beta.map_or(Ok([None; 2]), |error| slope_interval(counts, model, top, error))?,
        x82: fit.x82.map_or(Ok([None; 2]), |x82| at(Place::Correct(CORRECT_AT_THRESHOLD), x82))?,
    })
}

fn by_bootstrap(refits: &[parametric_bootstrap::Refit], fit: &CountTableFit) -> Result<Intervals, Error> {
    let of = |quantity: fn(&parametric_bootstrap::Refit) -> [f64; 2], value| {
        let allowed: Vec<[f64; 2]> = refits.iter().map(quantity).collect();
        parametric_bootstrap::interval(&allowed, value)
    };
    Ok(Intervals {
        threshold_t: of(|refit| refit.location, fit.threshold_t)?,
        slope_beta: of(|refit| refit.slope, fit.slope_beta)?,
        x82: fit.x82.map_or(Ok([None; 2]), |x82| of(|refit| refit.at_correct, x82))?,
    })
}

fn levels(counts: &[Count], weibull: &Weibull) -> Vec<LevelFit> {
    let of = |(count, residual): (&Count, f64)| LevelFit {
        x: count.x,
        n_correct: count.correct,
        n_total: count.total,
        p: weibull.correct(count.x),
        residual,
    };
    counts.iter().zip(deviance_residuals(counts, weibull)).map(of).collect()
}

/// A sentence for each end that is missing.
fn notes(fit: &CountTableFit, profile: &Intervals, bootstrap: &Intervals) -> Vec<String> {
    let mut notes = Vec::new();
    let exists = fit.x82.is_some();
    let quantities = |intervals: &Intervals| {
        [("threshold_t", intervals.threshold_t), ("slope_beta", intervals.slope_beta), ("x82", intervals.x82)]
    };
    let missing = |(name, ends): (&'static str, [Option<f64>; 2])| {
        let sides = ends.into_iter().zip(["below", "above"]).filter(|(end, _)| end.is_none());
        sides.filter(move |_| name != "x82" || exists).map(move |(_, side)| (name, side))
    };
    if !exists {
        notes.push("x82: the function never has 82 % correct answers".to_owned());
    }
    for (name, side) in quantities(profile).into_iter().flat_map(missing) {
        let within = match (name, side) {
            ("slope_beta", "above") => "a jump from guessing to certainty fits too".to_owned(),
            ("slope_beta", _) => "a function that hardly depends on the level fits too".to_owned(),
            _ => format!("what lies {FARTHEST} decades beyond the levels fits too"),
        };
        notes.push(format!("ci95_profile: the answers do not bound {name} from {side}: {within}"));
    }
    for (name, side) in quantities(bootstrap).into_iter().flat_map(missing) {
        notes.push(format!("ci95_bootstrap: the resampled tables do not bound {name} from {side}"));
    }
    notes
}
