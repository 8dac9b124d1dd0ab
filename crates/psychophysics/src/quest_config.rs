//! The parameters of one QUEST, in Psychtoolbox's names, as `analysis quest --config` reads them.

use serde::de::IgnoredAny;
use serde::{Deserialize, Deserializer, Serialize};

use crate::error::{Error, require};
use crate::grid::Grid;
use crate::psychometric::Psychometric;

/// Which summary of the posterior is shown next.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PlacementRule {
    /// The quantile of the order that minimises the expected variance (Pelli 1987).
    #[default]
    Quantile,
    /// The mean (King-Smith et al. 1994).
    Mean,
    /// The mode (Watson & Pelli 1983).
    Mode,
}

/// Parameters of one QUEST. Intensity and threshold have the same unit, usually log10.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", from = "ConfigFile")]
pub struct QuestConfig {
    /// Centre of the prior and of the table of thresholds.
    pub t_guess: f64,
    /// Standard deviation of the prior, above 0.
    pub t_guess_sd: f64,
    /// Probability of a response 1 at the threshold.
    pub p_threshold: f64,
    /// Slope of the psychometric function.
    pub beta: f64,
    /// Share of blind responses.
    pub delta: f64,
    /// Probability of a response 1 by guessing.
    pub gamma: f64,
    /// Step of the table.
    pub grain: f64,
    /// Width of the table; it reaches half of it to either side of `t_guess`.
    pub range: f64,
    /// What is shown next.
    pub placement: PlacementRule,
}

impl QuestConfig {
    /// Refuses parameters outside their ranges; the error names the parameter.
    pub fn check(&self) -> Result<(), Error> {
        Grid::check(("tGuess", self.t_guess), ("grain", self.grain), ("range", self.range))?;
        let sd = self.t_guess_sd;
        require(sd.is_finite() && sd > 0.0, "tGuessSd", sd, "a finite number above 0")?;
        self.psychometric().check()
    }

    /// The psychometric function of these parameters.
    pub fn psychometric(&self) -> Psychometric {
        Psychometric { beta: self.beta, delta: self.delta, gamma: self.gamma, threshold_probability: self.p_threshold }
    }

    /// Table points on either side of `t_guess`: half of `range / grain`, rounded up.
    pub fn half_points(&self) -> usize {
        self.grid().half
    }

    /// The table of thresholds.
    pub(crate) fn grid(&self) -> Grid {
        Grid::new(self.t_guess, self.grain, self.range)
    }
}

/// What a configuration file may hold: the parameters, and the notes and derived values that the
/// reference tables keep beside them. Any other key is a typing error and refused.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
struct ConfigFile {
    t_guess: f64,
    t_guess_sd: f64,
    p_threshold: f64,
    beta: f64,
    delta: f64,
    gamma: f64,
    #[serde(default = "default_grain")]
    grain: f64,
    #[serde(default = "default_range")]
    range: f64,
    #[serde(default)]
    placement: PlacementRule,
    #[serde(default, deserialize_with = "ignore", rename = "unit")]
    _unit: (),
    #[serde(default, deserialize_with = "ignore", rename = "note")]
    _note: (),
    #[serde(default, deserialize_with = "ignore", rename = "dim")]
    _dim: (),
    #[serde(default, deserialize_with = "ignore", rename = "n_table")]
    _n_table: (),
    #[serde(default, deserialize_with = "ignore", rename = "xThreshold_interp")]
    _x_threshold_interp: (),
    #[serde(default, deserialize_with = "ignore", rename = "xThreshold_analytic")]
    _x_threshold_analytic: (),
    #[serde(default, deserialize_with = "ignore", rename = "quantileOrder")]
    _quantile_order: (),
    #[serde(default, deserialize_with = "ignore", rename = "normalizePdf")]
    _normalize_pdf: (),
    #[serde(default, deserialize_with = "ignore", rename = "p_at_minus_inf")]
    _p_at_minus_inf: (),
    #[serde(default, deserialize_with = "ignore", rename = "p_at_plus_inf")]
    _p_at_plus_inf: (),
}

/// QuestCreate's default grain.
fn default_grain() -> f64 {
    0.01
}

/// QuestCreate's default range.
fn default_range() -> f64 {
    5.0
}

fn ignore<'de, D: Deserializer<'de>>(deserializer: D) -> Result<(), D::Error> {
    IgnoredAny::deserialize(deserializer).map(|_| ())
}

impl From<ConfigFile> for QuestConfig {
    fn from(file: ConfigFile) -> Self {
        Self {
            t_guess: file.t_guess,
            t_guess_sd: file.t_guess_sd,
            p_threshold: file.p_threshold,
            beta: file.beta,
            delta: file.delta,
            gamma: file.gamma,
            grain: file.grain,
            range: file.range,
            placement: file.placement,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const JSON: &str = r#"{"tGuess": 0.3, "tGuessSd": 0.5, "pThreshold": 0.82, "beta": 3.5,
        "delta": 0.01, "gamma": 0.5}"#;

    #[test]
    fn grain_and_range_default_to_those_of_quest_create() {
        let config: QuestConfig = serde_json::from_str(JSON).unwrap();
        assert_eq!((config.grain, config.range), (0.01, 5.0));
        assert_eq!(config.half_points(), 250);
        config.check().unwrap();
    }

    #[test]
    fn a_misspelt_key_is_refused_by_name() {
        let json = JSON.replace("}", r#", "grian": 0.02}"#);
        let error = serde_json::from_str::<QuestConfig>(&json).unwrap_err();
        assert!(error.to_string().contains("grian"));
    }

    #[test]
    fn a_configuration_survives_its_file() {
        let config: QuestConfig = serde_json::from_str(JSON).unwrap();
        let file = serde_json::to_string(&config).unwrap();
        assert_eq!(serde_json::from_str::<QuestConfig>(&file).unwrap(), config);
    }

    #[test]
    fn numbers_out_of_range_are_refused_by_name() {
        let config: QuestConfig = serde_json::from_str(JSON).unwrap();
        let broken = [
            ("tGuess ", QuestConfig { t_guess: f64::NAN, ..config }),
            ("tGuessSd", QuestConfig { t_guess_sd: 0.0, ..config }),
            ("grain", QuestConfig { grain: -0.01, ..config }),
            ("range", QuestConfig { range: f64::INFINITY, ..config }),
            ("range / grain", QuestConfig { grain: 1e-9, ..config }),
            ("gamma", QuestConfig { gamma: 1.0, ..config }),
            ("delta", QuestConfig { delta: -0.1, ..config }),
        ];
        for (name, config) in broken {
            let message = config.check().unwrap_err().to_string();
            assert!(message.starts_with(name), "{name}: {message}");
        }
    }
}
