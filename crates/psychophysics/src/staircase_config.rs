//! The staircase's parameters as they stand in protocol files and in `session.json`.
//!
//! `method = "quest"` takes one slope, one lapse and a placement rule; `method = "quest_plus"` takes
//! lists of slopes and lapses, and places by expected entropy. What belongs to the other method is
//! refused, and so is an unknown key.

use serde::{Deserialize, Serialize};

use crate::error::{Error, require};
use crate::quest::Quest;
use crate::quest_config::{PlacementRule, QuestConfig};
use crate::quest_plus::{QuestPlus, QuestPlusConfig};
use crate::staircase::Staircase;

/// Which adaptive procedure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum StaircaseMethod {
    /// [`Quest`]: the threshold, with slope and lapse assumed.
    Quest,
    /// [`QuestPlus`]: threshold, slope and lapse.
    QuestPlus,
}

/// Every parameter of the staircases.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StaircaseConfig {
    /// The procedure.
    pub method: StaircaseMethod,
    /// Centres of the threshold's prior, radius in texels: one staircase a condition and centre.
    pub prior_ratios: Vec<f64>,
    /// Standard deviation of the threshold's prior, above 0; one much larger than the table is a
    /// uniform prior.
    pub prior_sd_log10: f64,
    /// Probability of a response 1 at the threshold.
    pub threshold_probability: f64,
    /// Probability of a response 1 by guessing.
    pub guess_probability: f64,
    /// Step of the table of thresholds.
    pub table_step_log10: f64,
    /// Width of the table of thresholds.
    pub table_width_log10: f64,
    /// For `quest`: the slope assumed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub slope_per_log10: Option<f64>,
    /// For `quest`: the share of blind responses assumed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lapse_probability: Option<f64>,
    /// For `quest`: what is shown next; the quantile where it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub placement: Option<PlacementRule>,
    /// For `quest_plus`: the slopes compared, rising.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub slopes_per_log10: Vec<f64>,
    /// For `quest_plus`: the shares of blind responses compared, rising.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub lapse_probabilities: Vec<f64>,
}

impl StaircaseConfig {
    /// QUEST with Kreuzer 2017's parameters (4.2): threshold probability 0.82, gamma 0.5, delta 0.01,
    /// beta 3.5. The prior, 3 texels with an SD of 0.6 log10, is this project's, as the published one has no unit; step
    /// and width of the table are Psychtoolbox's.
    pub fn quest() -> Self {
        Self {
            method: StaircaseMethod::Quest,
            prior_ratios: vec![3.0],
            prior_sd_log10: 0.6,
            threshold_probability: 0.82,
            guess_probability: 0.5,
            table_step_log10: 0.01,
            table_width_log10: 5.0,
            slope_per_log10: Some(3.5),
            lapse_probability: Some(0.01),
            placement: Some(PlacementRule::Quantile),
            slopes_per_log10: Vec::new(),
            lapse_probabilities: Vec::new(),
        }
    }

    /// QUEST+ that measures the same threshold with the same prior.
    ///
    /// Thresholds: the same width; a step of 0.02 log10 (5 %) is a third of the SD that 40 trials
    /// reach. Slopes: half octaves about 3.5, from a curve twice as flat to one twice as steep; evenly
    /// in the logarithm, as the information on a slope depends on its ratio to the true one. Lapses:
    /// QUEST's 1 %, 3 % and 10 %, the range from an attentive to a bored person; 0 is left out, as it
    /// makes a single slip impossible.
    pub fn quest_plus() -> Self {
        Self {
            method: StaircaseMethod::QuestPlus,
            table_step_log10: 0.02,
            slope_per_log10: None,
            lapse_probability: None,
            placement: None,
            slopes_per_log10: vec![1.75, 2.5, 3.5, 5.0, 7.0],
            lapse_probabilities: vec![0.01, 0.03, 0.1],
            ..Self::quest()
        }
    }

    /// The slope that an analysis may take as known: QUEST's, or the middle one of QUEST+'s list.
    ///
    /// Panics on a configuration that [`check`](Self::check) refuses.
    pub fn central_slope_per_log10(&self) -> f64 {
        self.slope_per_log10.unwrap_or_else(|| middle(&self.slopes_per_log10))
    }

    /// The share of blind responses that an analysis may take as known, as for the slope.
    pub fn central_lapse_probability(&self) -> f64 {
        self.lapse_probability.unwrap_or_else(|| middle(&self.lapse_probabilities))
    }

    /// Refuses parameters outside their ranges and those of the other method; the error names the key.
    pub fn check(&self) -> Result<(), Error> {
        self.staircase(0.0).map(|_| ())
    }

    /// The staircase at its prior about `centre_log10`, an intensity. Errors as in
    /// [`check`](Self::check), or a centre that is not finite.
    pub fn staircase(&self, centre_log10: f64) -> Result<Staircase, Error> {
        self.check_numbers()?;
        self.check_method()?;
        Ok(match self.method {
            StaircaseMethod::Quest => Staircase::Quest(Quest::new(self.quest_config(centre_log10)?)?),
            StaircaseMethod::QuestPlus => Staircase::QuestPlus(QuestPlus::new(QuestPlusConfig {
                prior_centre_log10: centre_log10,
                prior_sd_log10: self.prior_sd_log10,
                threshold_probability: self.threshold_probability,
                guess_probability: self.guess_probability,
                slopes_per_log10: self.slopes_per_log10.clone(),
                lapse_probabilities: self.lapse_probabilities.clone(),
                table_step_log10: self.table_step_log10,
                table_width_log10: self.table_width_log10,
            })?),
        })
    }

    fn quest_config(&self, centre_log10: f64) -> Result<QuestConfig, Error> {
        let needed = |field, value: Option<f64>| {
            value.ok_or_else(|| Error::parameter(field, "missing", "a number where the method is quest"))
        };
        Ok(QuestConfig {
            t_guess: centre_log10,
            t_guess_sd: self.prior_sd_log10,
            p_threshold: self.threshold_probability,
            beta: needed("slope_per_log10", self.slope_per_log10)?,
            delta: needed("lapse_probability", self.lapse_probability)?,
            gamma: self.guess_probability,
            grain: self.table_step_log10,
            range: self.table_width_log10,
            placement: self.placement.unwrap_or_default(),
        })
    }

    /// Ranges, under the names of this file's keys.
    fn check_numbers(&self) -> Result<(), Error> {
        let positive: [(&str, &[f64]); 5] = [
            ("prior_sd_log10", &[self.prior_sd_log10]),
            ("table_step_log10", &[self.table_step_log10]),
            ("table_width_log10", &[self.table_width_log10]),
            ("slope_per_log10", self.slope_per_log10.as_slice()),
            ("slopes_per_log10", &self.slopes_per_log10),
        ];
        for (field, value) in positive.into_iter().flat_map(|(field, values)| values.iter().map(move |v| (field, *v))) {
            require(value.is_finite() && value > 0.0, field, value, "a finite number above 0")?;
        }
        let probabilities: [(&str, &[f64]); 3] = [
            ("guess_probability", &[self.guess_probability]),
            ("lapse_probability", self.lapse_probability.as_slice()),
            ("lapse_probabilities", &self.lapse_probabilities),
        ];
        for (field, value) in
            probabilities.into_iter().flat_map(|(field, values)| values.iter().map(move |v| (field, *v)))
        {
            require((0.0..1.0).contains(&value), field, value, "0 to below 1")?;
        }
        self.check_threshold_probability()
    }

    fn check_threshold_probability(&self) -> Result<(), Error> {
        let most_lapses = self.lapse_probability.iter().chain(&self.lapse_probabilities).fold(0.0, |a, b| b.max(a));
        let ceiling = 1.0 - most_lapses * (1.0 - self.guess_probability);
        require(
            self.threshold_probability > self.guess_probability && self.threshold_probability < ceiling,
            "threshold_probability",
            self.threshold_probability,
            "strictly between guess_probability and 1 - lapse (1 - guess_probability), the ends of the psychometric function",
        )
    }

    /// Refuses the keys of the other method; a missing key is found where its value is taken.
    fn check_method(&self) -> Result<(), Error> {
        let (foreign, allowed) = match self.method {
            StaircaseMethod::Quest => (
                vec![
                    ("slopes_per_log10", !self.slopes_per_log10.is_empty()),
                    ("lapse_probabilities", !self.lapse_probabilities.is_empty()),
                ],
                "no such key with method quest, which takes one slope_per_log10 and one lapse_probability",
            ),
            StaircaseMethod::QuestPlus => (
                vec![
                    ("slope_per_log10", self.slope_per_log10.is_some()),
                    ("lapse_probability", self.lapse_probability.is_some()),
                    ("placement", self.placement.is_some()),
                ],
                "no such key with method quest_plus, which takes the lists slopes_per_log10 and lapse_probabilities and places by expected entropy",
            ),
        };
        foreign.into_iter().try_for_each(|(field, is_given)| require(!is_given, field, "given", allowed))
    }
}

/// The middle of a list, the lower of two.
fn middle(values: &[f64]) -> f64 {
    values[(values.len() - 1) / 2]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quest_plus(step: f64, slopes: &[f64], lapses: &[f64]) -> StaircaseConfig {
        StaircaseConfig {
            table_step_log10: step,
            slopes_per_log10: slopes.to_vec(),
            lapse_probabilities: lapses.to_vec(),
            ..StaircaseConfig::quest_plus()
        }
    }

    #[test]
    fn both_presets_are_usable_and_survive_their_file() {
        for config in [StaircaseConfig::quest(), StaircaseConfig::quest_plus()] {
            config.check().unwrap();
            let file = serde_json::to_string(&config).unwrap();
            assert_eq!(serde_json::from_str::<StaircaseConfig>(&file).unwrap(), config);
            let file = toml::to_string(&config).unwrap();
            assert_eq!(toml::from_str::<StaircaseConfig>(&file).unwrap(), config);
        }
    }

    #[test]
    fn a_staircase_stands_at_its_prior_about_the_centre_that_it_is_given() {
        for config in [StaircaseConfig::quest(), StaircaseConfig::quest_plus()] {
            let staircase = config.staircase(-0.477).unwrap();
            assert!((staircase.mean() + 0.477).abs() < 1e-12);
            assert!((staircase.sd() - 0.6).abs() < 1e-3);
            let (lowest, highest) = staircase.table_range();
            assert!((lowest + 2.977).abs() < 1e-12 && (highest - 2.023).abs() < 1e-12);
        }
    }

    #[test]
    fn quest_places_by_the_rule_of_its_file_and_by_the_quantile_without_one() {
        let with = |placement| StaircaseConfig { placement, ..StaircaseConfig::quest() };
        let placed = |config: StaircaseConfig| {
            let mut staircase = config.staircase(0.0).unwrap();
            for response in [true, true, false] {
                staircase.update(0.2, response).unwrap();
            }
            let Staircase::Quest(quest) = &staircase else { panic!("another method") };
            (staircase.placement(), quest.clone())
        };
        let (placement, quest) = placed(with(Some(PlacementRule::Mean)));
        assert_eq!(placement, quest.mean());
        let (placement, quest) = placed(with(Some(PlacementRule::Mode)));
        assert_eq!(placement, quest.mode());
        for rule in [Some(PlacementRule::Quantile), None] {
            let (placement, quest) = placed(with(rule));
            assert_eq!(placement, quest.quantile(quest.quantile_order()));
        }
    }

    #[test]
    fn what_an_analysis_takes_as_known_is_quests_or_the_middle_of_the_list() {
        let (quest, plus) = (StaircaseConfig::quest(), StaircaseConfig::quest_plus());
        assert_eq!((quest.central_slope_per_log10(), quest.central_lapse_probability()), (3.5, 0.01));
        assert_eq!((plus.central_slope_per_log10(), plus.central_lapse_probability()), (3.5, 0.03));
    }

    #[test]
    fn the_keys_of_the_other_method_are_refused_and_its_own_are_required_by_name() {
        let (quest, plus) = (StaircaseConfig::quest(), StaircaseConfig::quest_plus());
        let broken = [
            ("slopes_per_log10 is given", StaircaseConfig { slopes_per_log10: vec![3.5], ..quest.clone() }),
            ("lapse_probabilities is given", StaircaseConfig { lapse_probabilities: vec![0.0], ..quest.clone() }),
            ("slope_per_log10 is missing", StaircaseConfig { slope_per_log10: None, ..quest.clone() }),
            ("lapse_probability is missing", StaircaseConfig { lapse_probability: None, ..quest }),
            ("slope_per_log10 is given", StaircaseConfig { slope_per_log10: Some(3.5), ..plus.clone() }),
            ("lapse_probability is given", StaircaseConfig { lapse_probability: Some(0.0), ..plus.clone() }),
            ("placement is given", StaircaseConfig { placement: Some(PlacementRule::Mean), ..plus.clone() }),
            ("slopes_per_log10 is empty", StaircaseConfig { slopes_per_log10: vec![], ..plus.clone() }),
            ("lapse_probabilities is empty", StaircaseConfig { lapse_probabilities: vec![], ..plus }),
        ];
        for (message, config) in broken {
            let found = config.check().unwrap_err().to_string();
            assert!(found.starts_with(message), "{message}: {found}");
        }
    }

    #[test]
    fn numbers_out_of_range_are_refused_under_the_names_of_the_file() {
        let quest = StaircaseConfig::quest;
        let broken = [
            ("prior_sd_log10 is 0", StaircaseConfig { prior_sd_log10: 0.0, ..quest() }),
            ("prior_sd_log10 is -1", StaircaseConfig { prior_sd_log10: -1.0, ..quest() }),
            ("table_step_log10 is NaN", StaircaseConfig { table_step_log10: f64::NAN, ..quest() }),
            ("table_width_log10 is inf", StaircaseConfig { table_width_log10: f64::INFINITY, ..quest() }),
            ("guess_probability is 1", StaircaseConfig { guess_probability: 1.0, ..quest() }),
            ("threshold_probability is 0.5", StaircaseConfig { threshold_probability: 0.5, ..quest() }),
            ("threshold_probability is 0.4", StaircaseConfig { threshold_probability: 0.4, ..quest() }),
            ("threshold_probability is 0.995", StaircaseConfig { threshold_probability: 0.995, ..quest() }),
            ("slope_per_log10 is -3.5", StaircaseConfig { slope_per_log10: Some(-3.5), ..quest() }),
            ("lapse_probability is 1", StaircaseConfig { lapse_probability: Some(1.0), ..quest() }),
            ("slopes_per_log10 is 0", quest_plus(0.02, &[0.0, 1.0], &[0.01])),
            ("slopes_per_log10 is [3.0, 2.0]", quest_plus(0.02, &[3.0, 2.0], &[0.01])),
            ("lapse_probabilities is [0.1, 0.1]", quest_plus(0.02, &[3.0], &[0.1, 0.1])),
            ("lapse_probabilities is -0.1", quest_plus(0.02, &[3.0], &[-0.1])),
            ("threshold_probability is 0.82", quest_plus(0.02, &[3.0], &[0.0, 0.4])),
            ("points of the grid is 150003", quest_plus(1e-4, &[2.0, 3.0, 4.0], &[0.01])),
        ];
        for (message, config) in broken {
            let found = config.check().unwrap_err().to_string();
            assert!(found.starts_with(message), "{message}: {found}");
        }
    }

    #[test]
    fn an_unknown_key_and_an_unknown_method_are_refused_by_name() {
        let file = serde_json::to_string(&StaircaseConfig::quest()).unwrap();
        for (from, to) in [("prior_sd_log10", "prior_sd"), ("\"quest\"", "\"zest\""), ("quantile", "median")] {
            let error = serde_json::from_str::<StaircaseConfig>(&file.replace(from, to)).unwrap_err().to_string();
            assert!(error.contains(to.trim_matches('"')), "{error}");
        }
    }
}
