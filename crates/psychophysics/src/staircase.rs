//! The staircase of a track: QUEST or QUEST+, behind the calls that a session needs.

use crate::error::Error;
use crate::grid::Shown;
use crate::quest::Quest;
use crate::quest_plus::QuestPlus;

/// The state of one adaptive procedure. Intensities and thresholds are log10.
#[derive(Clone, Debug, PartialEq)]
pub enum Staircase {
    /// Threshold alone; slope and lapse are assumed.
    Quest(Quest),
    /// Threshold, slope and lapse together.
    QuestPlus(QuestPlus),
}

impl Staircase {
    /// Learns a response at the intensity that was *shown*.
    ///
    /// A NaN or infinite intensity and a response that no parameters explain are errors; the state is
    /// then unchanged.
    pub fn update(&mut self, intensity_shown: f64, response: bool) -> Result<Shown, Error> {
        match self {
            Self::Quest(quest) => quest.update(intensity_shown, response),
            Self::QuestPlus(quest_plus) => quest_plus.update(intensity_shown, response),
        }
    }

    /// The intensity to show next.
    pub fn placement(&self) -> f64 {
        match self {
            Self::Quest(quest) => quest.placement(),
            Self::QuestPlus(quest_plus) => quest_plus.placement(),
        }
    }

    /// Mean of the threshold's posterior.
    pub fn mean(&self) -> f64 {
        match self {
            Self::Quest(quest) => quest.mean(),
            Self::QuestPlus(quest_plus) => quest_plus.mean(),
        }
    }

    /// Standard deviation of the threshold's posterior.
    pub fn sd(&self) -> f64 {
        match self {
            Self::Quest(quest) => quest.sd(),
            Self::QuestPlus(quest_plus) => quest_plus.sd(),
        }
    }

    /// Quantile of the threshold's posterior; `order` is clamped to 0..=1.
    pub fn quantile(&self, order: f64) -> f64 {
        match self {
            Self::Quest(quest) => quest.quantile(order),
            Self::QuestPlus(quest_plus) => quest_plus.quantile(order),
        }
    }

    /// Probability of each threshold from one end of [`table_range`](Self::table_range) to the other,
    /// equally spaced; sums to 1.
    pub fn threshold_posterior(&self) -> &[f64] {
        match self {
            Self::Quest(quest) => quest.posterior(),
            Self::QuestPlus(quest_plus) => quest_plus.threshold_posterior(),
        }
    }

    /// Lowest and highest threshold of the table.
    pub fn table_range(&self) -> (f64, f64) {
        let grid = self.table().grid();
        (grid.centre + grid.offset(0), grid.centre + grid.offset(grid.len() - 1))
    }

    /// Mean and standard deviation of the threshold that these responses alone, `(intensity shown,
    /// response)`, leave of the prior. Errors as in [`update`](Self::update).
    pub fn mean_and_sd_after(&self, responses: &[(f64, bool)]) -> Result<(f64, f64), Error> {
        let table = self.table();
        let weights = table.threshold_after(responses)?;
        Ok((table.grid().mean(&weights), table.grid().sd(&weights)))
    }

    fn table(&self) -> &crate::posterior::Posterior {
        match self {
            Self::Quest(quest) => quest.table(),
            Self::QuestPlus(quest_plus) => quest_plus.table(),
        }
    }
}
