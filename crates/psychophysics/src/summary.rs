//! The summaries of a QUEST's posterior, one row a trial, in the columns of the reference tables.

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::grid::Shown;
use crate::quest::Quest;
use crate::quest_config::QuestConfig;

/// One row: the posterior before the first (`trial` 0) or after a trial.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct QuestSummary {
    /// Number of responses so far.
    pub trial: u32,
    /// Intensity shown; none before the first trial.
    pub intensity: Option<f64>,
    /// Response, 0 or 1; none before the first trial.
    pub response: Option<u8>,
    /// Mean of the posterior.
    pub mean: f64,
    /// Its highest point.
    pub mode: f64,
    /// Its median.
    pub median: f64,
    /// Its 5 % quantile.
    pub q05: f64,
    /// Its 95 % quantile.
    pub q95: f64,
    /// The quantile that QUEST places the next trial at.
    pub next_quantile: f64,
    /// Standard deviation of the posterior.
    pub sd: f64,
    /// Probability of the highest point.
    pub pdf_max: f64,
    /// 1 when the intensity lay off the table, else 0.
    pub out_of_range: u8,
}

impl QuestSummary {
    /// The rows of a whole sequence of `(intensity, response)`: the prior, then one a response.
    pub fn of_sequence(config: QuestConfig, responses: &[(f64, bool)]) -> Result<Vec<Self>, Error> {
        let mut quest = Quest::new(config)?;
        let mut rows = vec![Self::of(&quest, 0, None, Shown::OnTable)];
        for ((intensity, response), trial) in responses.iter().zip(1..) {
            let shown_at = quest.update(*intensity, *response)?;
            rows.push(Self::of(&quest, trial, Some((*intensity, *response)), shown_at));
        }
        Ok(rows)
    }

    fn of(quest: &Quest, trial: u32, shown: Option<(f64, bool)>, shown_at: Shown) -> Self {
        Self {
            trial,
            intensity: shown.map(|(intensity, _)| intensity),
            response: shown.map(|(_, response)| u8::from(response)),
            mean: quest.mean(),
            mode: quest.mode(),
            median: quest.quantile(0.5),
            q05: quest.quantile(0.05),
            q95: quest.quantile(0.95),
            next_quantile: quest.quantile(quest.quantile_order()),
            sd: quest.sd(),
            pdf_max: quest.posterior().iter().copied().fold(0.0, f64::max),
            out_of_range: u8::from(shown_at == Shown::OffTable),
        }
    }
}
