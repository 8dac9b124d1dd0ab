//! Intervals and goodness of fit by parametric bootstrap: the fitted function answers anew at the same levels, as often,
//! and every such table is fitted (Efron & Tibshirani 1993; Wichmann & Hill 2001, parts I and II).
//!
//! An interval is made of the bias-corrected percentiles of the refits: levels `Phi(2 z0 -+ 1.96)`, `z0` the normal
//! quantile of the share of refits below the estimate. A slope fitted to few answers is on average too steep, and plain
//! percentiles double that error.
//!
//! A table that bounds nothing counts as the whole range that it allows: where every answer of it is correct the location
//! is arbitrarily low and the slope anything. So an end is missing where too many of the tables miss it.
//!
//! The p-value of the deviance is the share of tables, the data among them, whose deviance is at least that of the data:
//! uniform if the function is right, for any number of answers a level, where the chi-squared distribution fails for few.

use rand_chacha::{
    ChaCha8Rng,
    rand_core::{Rng, SeedableRng},
};
use rayon::prelude::*;
use statrs::distribution::{ContinuousCDF, Normal};

use crate::{
    Error,
    binomial::Binomial,
    maximum_likelihood::{Count, Limit, Maximum, Model, SLOPE_RANGE, Search, all_seen, constant_deviance, deviance},
    weibull::Weibull,
};

/// Numbers of resamples that make sense: below, 2.5 % are no two tables; above, nothing changes but the time.
pub const RESAMPLES_ALLOWED: std::ops::RangeInclusive<u32> = 100..=1_000_000;

/// The normal quantile of 97.5 %.
const NORMAL_975: f64 = 1.959_963_984_540_054;

/// How often the fitted function answers anew.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Resampling {
    /// Number of tables, one of [`RESAMPLES_ALLOWED`].
    pub resamples: u32,
    /// Every draw follows from it; a table's draws do not depend on the others.
    pub seed: u64,
}

impl Default for Resampling {
    /// 2000 tables: 50 lie beyond each end, which leaves an end an error of a tenth of a standard error.
    fn default() -> Self {
        Self { resamples: 2000, seed: 1 }
    }
}

/// What a refitted table allows a quantity to be: one value, or a range where it bounds none.
type Allowed = [f64; 2];

/// What one table says.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Refit {
    /// Location, log10 units.
    pub location: Allowed,
    /// Slope per decade.
    pub slope: Allowed,
    /// Intensity of the share of correct answers asked for.
    pub at_correct: Allowed,
    /// Deviance of its own most likely function.
    pub deviance: f64,
}

/// Answers of `weibull`, the fit of `model`, to the levels of `counts`, which have whole numbers of answers, and what
/// refits say of them; `progress` is called after each.
pub(crate) fn refits(
    counts: &[Count],
    model: &Model,
    weibull: &Weibull,
    correct: f64,
    resampling: &Resampling,
    progress: impl Fn() + Sync,
) -> Vec<Refit> {
    let table = |count: &Count| Binomial::new(count.total, weibull.answers(count.x));
    let tables: Vec<Binomial> = counts.iter().map(table).collect();
    let refit = |number| {
        let mut draw = draws(resampling.seed, number);
        let answered = |(count, table): (&Count, &Binomial)| Count { correct: table.draw(draw()), ..*count };
        let answers: Vec<Count> = counts.iter().zip(&tables).map(answered).collect();
        progress();
        Refit::of(&answers, model, weibull, correct)
    };
    (0..resampling.resamples).into_par_iter().map(refit).collect()
}

/// Uniform numbers in 0..1, multiples of 2^-53, of a table or cohort: ChaCha with 8 rounds, its key the seed and its stream the table.
pub(crate) fn draws(seed: u64, table: u32) -> impl FnMut() -> f64 {
    let mut key = [0; 32];
    key[..8].copy_from_slice(&seed.to_le_bytes());
    let mut generator = ChaCha8Rng::from_seed(key);
    generator.set_stream(table.into());
    move || (generator.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}

impl Refit {
    /// The fit to `answers` that `parent` gave.
    fn of(answers: &[Count], model: &Model, parent: &Weibull, correct: f64) -> Self {
        const ANY: Allowed = [f64::NEG_INFINITY, f64::INFINITY];
        // From the grid too: small tables have several maxima, and the parent's is often not the highest.
        let found = Search::of(model).highest(answers, Some(parent));
        let place =
            |place: f64, deviance: f64| Self { location: [place; 2], slope: ANY, at_correct: [place; 2], deviance };
        let Some(top) = found else {
            return Self { location: ANY, slope: ANY, at_correct: ANY, deviance: f64::INFINITY };
        };
        match Limit::constant(answers, model, &top, 0.0) {
            Some(Limit::Seen) => place(f64::NEG_INFINITY, constant_deviance(answers, all_seen(answers, model))),
            Some(_) => place(f64::INFINITY, constant_deviance(answers, [model.guess, 1.0 - model.guess])),
            None => Self {
                location: [top.weibull.location; 2],
                slope: [slope(answers, model, &top); 2],
                at_correct: top.weibull.x_at_correct(correct).map_or(ANY, |x| [x; 2]),
                deviance: deviance(answers, &top.weibull),
            },
        }
    }
}

/// The slope of the maximum: infinite where a jump is as likely, nothing where no slope is flat enough.
fn slope(answers: &[Count], model: &Model, top: &Maximum) -> f64 {
    let slope = top.weibull.slope;
    if slope <= SLOPE_RANGE[0] {
        f64::NEG_INFINITY
    } else if slope > STEEP && Limit::is_slope(SLOPE_RANGE[1], answers, model, top, 0.0) {
        f64::INFINITY
    } else {
        slope
    }
}

/// Slope above which a refit is asked whether it is a jump: published slopes end at 10.
const STEEP: f64 = 12.0;

/// The bias-corrected 95 % interval of a quantity whose estimate is `value`; an end is `None` where too many tables miss it.
///
/// # Errors
/// None that the standard normal distribution allows.
pub(crate) fn interval(allowed: &[Allowed], value: f64) -> Result<[Option<f64>; 2], Error> {
    let normal = Normal::new(0.0, 1.0).map_err(|reason| Error::CannotFit(format!("normal distribution: {reason}")))?;
    let below = |end: f64| {
        if end < value {
            1.0
        } else if end == value {
            0.5
        } else {
            0.0
        }
    };
    let count = allowed.len() as f64;
    let share = allowed.iter().flatten().map(|end| below(*end)).sum::<f64>() / (2.0 * count);
    let z0 = normal.inverse_cdf(share);
    let rank = |z: f64| normal.cdf(2.0 * z0 + z) * (count + 1.0);
    Ok([(0, -NORMAL_975), (1, NORMAL_975)].map(|(end, z)| {
        let mut ends: Vec<f64> = allowed.iter().map(|allowed| allowed[end]).collect();
        ends.sort_by(f64::total_cmp);
        // Where hardly a refit is on one side of the estimate, the percentiles may lie beyond it: they bound nothing.
        quantile(&ends, rank(z)).filter(|end| (end - value) * z >= 0.0)
    }))
}

/// The value at a rank from 1 on, between neighbours by proportion; `None` outside of the ranks, or where it is infinite.
fn quantile(sorted: &[f64], rank: f64) -> Option<f64> {
    let at = |rank: f64| (rank >= 1.0).then(|| sorted.get(rank as usize - 1)).flatten();
    let (below, above) = (at(rank.floor())?, at(rank.ceil())?);
    let value = below + (above - below) * rank.fract();
    value.is_finite().then_some(value)
}

/// The p-value of a deviance: share of tables, the data among them, with one at least as large.
pub(crate) fn p_value(refits: &[Refit], deviance: f64) -> f64 {
    // A deviance that only rounding tells from the data's is as large.
    let least = deviance - DEVIANCE_ROUNDING * deviance.max(1.0);
    let larger = refits.iter().filter(|refit| refit.deviance >= least).count();
    (larger + 1) as f64 / (refits.len() + 1) as f64
}

/// Relative rounding of a deviance, generously.
const DEVIANCE_ROUNDING: f64 = 1e-9;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_symmetric_bootstrap_gives_plain_percentiles() {
        let values: Vec<Allowed> = (0..1999).map(|index| [f64::from(index - 999); 2]).collect();
        let [low, high] = interval(&values, 0.0).unwrap();
        // Ranks 0.025 x 2000 and 0.975 x 2000.
        assert!((low.unwrap() + 950.0).abs() < 1e-6 && (high.unwrap() - 950.0).abs() < 1e-6, "{low:?} {high:?}");
    }

    #[test]
    fn percentiles_move_against_the_bias() {
        // 69.1 % of the refits are below the estimate: z0 = 0.5, levels Phi(-0.96) = 16.9 % and Phi(2.96) = 99.85 %.
        let values: Vec<Allowed> = (1..=9999).map(|index| [f64::from(index); 2]).collect();
        let [low, high] = interval(&values, 6914.6).unwrap();
        assert!((low.unwrap() - 1685.0).abs() < 5.0 && (high.unwrap() - 9984.6).abs() < 1.0, "{low:?} {high:?}");
    }

    #[test]
    fn tables_that_bound_nothing_take_away_the_ends_that_they_miss() {
        let mut values: Vec<Allowed> = (0..1000).map(|index| [f64::from(index); 2]).collect();
        values[..30].fill([f64::NEG_INFINITY; 2]);
        let [low, high] = interval(&values, 499.5).unwrap();
        assert!(low.is_none() && high.is_some());
        values[..30].fill([f64::NEG_INFINITY, f64::INFINITY]);
        assert_eq!(interval(&values, 499.5).unwrap(), [None, None]);
    }

    #[test]
    fn an_estimate_beyond_all_tables_has_no_interval() {
        assert_eq!(interval(&[[1.0; 2]; 200], 2.0).unwrap(), [None, None]);
    }

    #[test]
    fn a_table_has_the_same_draws_whatever_the_others() {
        let first = |seed, table| draws(seed, table)();
        assert_eq!(first(7, 3), first(7, 3));
        assert_ne!(first(7, 3), first(7, 4));
        assert_ne!(first(7, 3), first(8, 3));
    }
}
