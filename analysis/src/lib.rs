//! From sessions of a study to `relation.json`: how large a filter's radius must be, in texels of the
//! shadow map, until the texels are hidden.
//!
//! | Step | Where | Does |
//! |---|---|---|
//! | read | [`Study::read`] | replays every session through the experiment's state machine |
//! | threshold | [`thresholds_of`], [`joint_threshold`] | Weibull function by maximum likelihood ([`fit`]) under [`Assumptions`]: slope and lapses of the protocol, guess rate of the protocol or counted |
//! | ratio | [`Series`] | per pattern, contrast and kernel: mean of log10 ratios over people with Student's t, beside the published line through the origin |
//! | worst case | [`Analysis`] | the largest ratio under the first kernel is the renderer's number |
//! | population | [`Population`] | from the median person to 90, 95, 99 % of viewers |
//! | files | [`fit_study`] | relation, report, tables, figures, written together |
//!
//! [`Simulation`] makes sessions of observers whose thresholds are known; [`Plan`] foretells from them what a
//! study will give, after [`check_reach`] refused what cannot be measured; [`replay_session`] compares a
//! record, draw for draw and picture for picture, with what its seed leads to; [`Export`] writes sessions as a
//! BIDS dataset, for other laboratories' programs.
//!
//! # How well it does
//!
//! Simulated cohorts, `examples/coverage.rs`: log-normal people, median 3.47, between-person SD 0.1
//! log10, slope 3.5, lapse 0.01, the whole two-alternative protocol; step pattern at 100 % contrast.
//!
//! | | 10 people, 600 cohorts | 20 people, 300 | 40 people, 450 | 10 people of slope 2.5, 150 |
//! |---|---|---|---|---|
//! | bias of the ratio | +1.0 % | +1.0 % | +1.2 % | -2.0 % |
//! | RMS error, log10 | 0.036 | 0.027 | 0.019 | 0.041 |
//! | coverage of its 95 % interval | 93.8 % | 94.0 % | 91.1 % | 92.0 % |
//! | worst condition instead: bias, coverage | +1.2 %, 94.0 % | +1.0 %, 93.7 % | +1.2 %, 91.1 % | -1.1 %, 92.0 % |
//! | line through the origin against 3.47 | +9.3 % | +8.9 % | +9.3 % | +10.1 % |
//! | exponent 1, intercept 0 rejected at 5 % | 4.8 %, 4.2 % | 5.0 %, 5.3 % | 5.1 %, 5.1 % | 5.3 %, 6.7 % |
//! | 95 % of viewers at 10 %: bias, coverage | -0.1 %, 99.3 % | +1.0 %, 100 % | +1.7 %, 100 % | -22.7 %, 86.7 % |
//!
//! Coverages have a standard error of 1 to 2 %; at 40 people the bias is a third of a standard error
//! and the interval covers too rarely. The mean over three separate fits per person, one a
//! texel size, overstated the ratio by 5 % and covered in 90 % of cohorts; the line through the origin
//! inherits that and adds 3 % because its target is the mean person. The population interval is wide
//! when the slope is the assumed one, because it allows for others; with people of slope 2.5, at the
//! edge of what it allows, it is too narrow.
//!
//! # What a protocol makes of it
//!
//! Command `plan`, 1000 sessions each, step at 100 % contrast: bias of a person's ratio, standard
//! deviation of one measurement, and coverage of the interval of ten people (standard error 2 to 5 %).
//!
//! | people | two-alternative | yes-no | published |
//! |---|---|---|---|
//! | of high threshold, false alarms 10 % | +1.0 %, 0.042 log10, 94 % | +0.4 %, 0.037, 94 % | -12 %, 0.031, 69 % |
//! | of signal detection, false alarms 10 % | +2.2 %, 0.039, 94 % | -7.6 %, 0.028, 87 % | -16 %, 0.023, 46 % |
//!
//! The published protocol assumes a guess rate of one half where these people guess in a tenth of the
//! trials. The yes-no fit takes the counted false alarms out as a high threshold would, `(H - F) / (1 - F)`;
//! of a person with noisy traces and a strict criterion that leaves too few artifacts told. Two
//! alternatives need neither assumption.
//!
//! # Limits
//!
//! The slope is held at the protocol's. The interval of the worst condition ignores that it was chosen
//! after seeing the data. Data that carry no threshold, interval or fit are refused with the reason;
//! no function here returns NaN for them.

mod analysis;
mod assumptions;
mod binomial;
mod checks;
mod count_table;
mod crossing;
mod effects;
mod error;
mod estimate;
mod export;
mod figure;
mod fit_figure;
mod fit_outputs;
mod load;
mod maximum_likelihood;
mod mixed_model;
mod outputs;
mod panels;
mod parametric_bootstrap;
mod people;
mod plan;
mod plan_text;
mod population;
mod population_figure;
mod prior_sensitivity;
mod profile_likelihood;
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
mod threshold_report;
mod thresholds;
mod weibull;

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
pub use study_tables::{THRESHOLDS_TABLE, TRIALS_TABLE, thresholds_csv, trials_csv};
pub use threshold_report::{Intervals, LevelFit, ThresholdReport};
pub use thresholds::{ConditionThreshold, Threshold, joint_threshold, thresholds_of};
pub use weibull::Weibull;
