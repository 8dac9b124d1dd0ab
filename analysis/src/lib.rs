//! From sessions of a study to `relation.json`: how large a filter's radius must be, in texels of the
//! shadow map, until the texels are hidden.
//!
//! | Step | Where | Does |
//! |---|---|---|
//! | read | [`Study::read`] | replays every session through the experiment's state machine |
//! | ratio | [`Series`], [`MixedModel`] | per pattern, contrast and kernel: one likelihood of every answer, thresholds log-normal over people; beside it the mean of log10 ratios and the published line through the origin |
//! | threshold | [`thresholds_of`], [`joint_threshold`] | a person's Weibull function by maximum likelihood ([`fit`]) under [`Assumptions`]: everyone's slope and blind trials, guess rate of the protocol or counted |
//! | worst case | [`Analysis`] | the largest ratio under the first kernel is the renderer's number |
//! | fit | [`GoodnessOfFit`] | whether the model fits: cohorts of the fitted model in the same experiment |
//! | population | [`Population`] | from the median person to 90, 95, 99 % of viewers |
//! | what moves it | [`Effect`], [`UnderPrior`] | pattern, contrast, round; the staircases' prior |
//! | files | [`fit_study`] | relation, report, tables, figures, written together |
//!
//! [`Simulation`] makes sessions of observers whose thresholds are known; [`Plan`] foretells from them what a
//! study will give, after [`check_reach`] refused what cannot be measured; [`replay_session`] compares a
//! record, draw for draw and picture for picture, with what its seed leads to; [`Export`] writes sessions as a
//! BIDS dataset, for other laboratories' programs.
//!
//! How well it does on cohorts with a known truth, and how fast: `docs/analysis.md`.
//!
//! # Single pictures
//!
//! The yes-no fit takes the counted false alarms out as a high threshold would, `(H - F) / (1 - F)`; of a person with
//! noisy traces and a strict criterion that leaves too few artifacts told: the ratio is 8 % low at 10 % false alarms, and
//! 16 % low where a guess rate of one half is assumed (the published protocol). Two alternatives need neither assumption.
//!
//! # Limits
//!
//! The slope is estimated under a weak prior, because staircases hardly measure it; what leans on it, rare detection, has
//! wide intervals. The interval of the worst condition ignores that it was chosen after seeing the data. Data that carry no threshold, interval or fit are refused with the reason;
//! no function here returns NaN for them.

mod analysis;
mod assumptions;
mod binomial;
mod checks;
mod column;
mod count_table;
mod crossing;
mod effects;
mod error;
mod estimate;
mod export;
mod figure;
mod fit_figure;
mod fit_outputs;
mod goodness_of_fit;
mod load;
mod maximum_likelihood;
mod mixed_model;
mod outputs;
mod panels;
mod parametric_bootstrap;
mod people;
mod pilot;
mod plan;
mod plan_text;
mod population;
mod population_figure;
mod prior_sensitivity;
mod profile_likelihood;
mod protocols;
mod psychometric_figure;
mod quest_table;
mod reach;
mod replay;
mod report;
mod residual_figure;
mod series;
mod simulation;
mod staircase_figure;
mod study_tables;
mod table;
mod threshold_intervals;
mod threshold_report;
mod thresholds;
mod trial_table;
mod weibull;
mod words;

pub use analysis::{Analysis, SOFTWARE};
pub use assumptions::Assumptions;
pub use checks::Checks;
pub use count_table::{CORRECT_AT_THRESHOLD, CountTableFit, fit_count_table, read_count_table};
pub use effects::Effect;
pub use error::{Error, Unidentified};
pub use estimate::{MeanOverPeople, SizePoint, exponent, intercept_px, line, line_through_origin};
pub use export::{Export, ExportedSession, Status};
pub use fit_figure::{FIT_FIGURE, fit_figure};
pub use fit_outputs::{RELATION, fit_study};
pub use goodness_of_fit::{BAND_ENDS, Band, GoodnessOfFit};
pub use load::{LoadedSession, session_directories};
pub use maximum_likelihood::{
    Count, Fitted, LAPSE_LARGEST, LIKELIHOOD_DROP_95, Model, Parameter, SLOPE_RANGE, deviance_residuals, fit,
    log_likelihood, most_likely,
};
pub use mixed_model::{
    BLIND_PRIOR_SD_LOGIT, Interval, MixedFit, MixedModel, MixedParameters, PersonAnswers, Profiled, Quantity,
    SLOPE_PRIOR_SD_LN,
};
pub use outputs::{Output, write_outputs};
pub use parametric_bootstrap::{RESAMPLES_ALLOWED, Resampling};
pub use people::{Person, Run, Study, Track};
pub use plan::{Accuracy, COHORTS, IntervalForecast, Plan, SeriesForecast, Spread, Staircases};
pub use population::{DETECTIONS, Population, PopulationPoint, VIEWERS};
pub use population_figure::{POPULATION_FIGURE, population_figure};
pub use prior_sensitivity::{UnderPrior, under_priors};
pub use psychometric_figure::{PSYCHOMETRIC_FIGURE, psychometric_figure};
pub use quest_table::{TableAnswer, read_quest_config, read_responses, write_summaries};
pub use reach::check_reach;
pub use replay::{Replayed, hashed_pictures, replay_session};
pub use report::{Figures, REPORT, report_html};
pub use residual_figure::{RESIDUAL_FIGURE, residual_figure};
pub use series::{OriginLine, PersonInSeries, Series};
pub use simulation::{Simulation, with_false_alarms, with_slope};
pub use staircase_figure::{STAIRCASE_FIGURE, staircase_figure};
pub use study_tables::THRESHOLDS_TABLE;
pub use threshold_report::{Intervals, LevelFit, ThresholdReport};
pub use thresholds::{ConditionThreshold, Threshold, joint_threshold, thresholds_of};
pub use trial_table::{TRIALS_COLUMNS, TRIALS_TABLE, trials_columns, trials_csv};
pub use weibull::Weibull;
