//! From sessions of a study to the radius-to-texel relation.

mod analysis;
mod count_table;
mod error;
mod estimate;
mod figure;
mod fit_figure;
mod maximum_likelihood;
mod people;
mod population;
mod quest_table;
mod series;
mod simulation;
mod staircase_figure;
mod table;
mod thresholds;
mod weibull;

pub use analysis::{Analysis, SOFTWARE};
pub use count_table::{CountTableFit, fit_count_table, read_count_table};
pub use error::{Error, Unidentified};
pub use estimate::{MeanOverPeople, SizePoint, exponent, intercept_px, line, line_through_origin};
pub use fit_figure::{FIT_FIGURE, fit_figure};
pub use maximum_likelihood::{
    Count, Fitted, LAPSE_LARGEST, LIKELIHOOD_DROP_95, Model, Parameter, SLOPE_RANGE, fit,
    log_likelihood,
};
pub use people::{LoadedSession, Person, Study, Track};
pub use population::{DETECTIONS, Population, PopulationPoint, SLOPE_CI95, VIEWERS};
pub use quest_table::{read_quest_config, read_responses, write_summaries};
pub use series::{OriginLine, PersonInSeries, Series};
pub use simulation::Simulation;
pub use staircase_figure::{STAIRCASE_FIGURE, staircase_figure};
pub use thresholds::{ConditionThreshold, Threshold, joint_threshold, lapse_of, thresholds_of};
pub use weibull::Weibull;
