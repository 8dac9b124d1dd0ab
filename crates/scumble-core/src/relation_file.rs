//! `relation.json`: what a study found, and the one file in which study and renderer meet.
//!
//! Schema `scumble/relation/1`. `schema` and `ratio` are required; the rest tells where the ratio comes from.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::error::Error;
use crate::relation::{RATIO_MAX, Relation};

/// The schema that this crate reads and writes.
pub const SCHEMA: &str = "scumble/relation/1";

const RATIO_ALLOWED: &str = "a finite number above 0, at most 64";

/// The whole file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RelationFile {
    /// [`SCHEMA`].
    pub schema: String,
    /// The median person's threshold: filter radius in texels.
    pub ratio: Estimate,
    /// Thresholds of a share of viewers at a probability of detection.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub population: Vec<PopulationPoint>,
    /// The kernel that the stimuli were filtered with, `disc`; another kernel has another ratio.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kernel: Option<String>,
    /// Tests of the relation's form r = c a^g + b.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tests: Option<FormTests>,
    /// The model that the ratio comes from.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub model: Option<ModelParameters>,
    /// The same ratio by other estimators.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub other_estimators: Vec<OtherEstimator>,
    /// Thresholds by pattern and contrast.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub conditions: Vec<ConditionEstimate>,
    /// Name of the protocol that the people followed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub protocol: Option<String>,
    /// Number of people.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub people: Option<u64>,
    /// Number of trials that entered the fit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub trials: Option<u64>,
    /// The sessions that entered the fit.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub sessions: Vec<SessionHash>,
    /// Name and version of the program that wrote the file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub software: Option<String>,
}

/// A number with its uncertainty.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Estimate {
    /// The estimate.
    pub value: f64,
    /// Its standard error, in its unit.
    pub standard_error: f64,
    /// Its 95 % confidence interval, lower end first.
    pub ci95: [f64; 2],
}

/// The ratio that hides texels from a share of viewers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PopulationPoint {
    /// Share of viewers, 0..1, whose threshold is at most `ratio`.
    pub viewers: f64,
    /// Probability, 0..1, at which such a viewer still sees the texels.
    pub detection: f64,
    /// Filter radius in texels.
    pub ratio: Estimate,
}

/// Is the relation a line through the origin?
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FormTests {
    /// b of r = c a + b, in pixels, against 0.
    pub intercept: NullTest,
    /// g of r = c a^g, against 1.
    pub exponent: NullTest,
}

/// People as the fit describes them: log-normal thresholds, Weibull psychometric functions.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModelParameters {
    /// Standard deviation between people, log10 of the ratio.
    pub between_sd_log10: f64,
    /// Slope of the psychometric function per log10 unit.
    pub slope_per_log10: f64,
    /// Share of trials answered blindly.
    pub blind_share: f64,
}

/// The ratio by another estimator than the file's own.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OtherEstimator {
    /// `mean_of_logarithms`, of thresholds fitted to one person at a time; `line_through_origin` of the mean radii.
    pub name: String,
    /// Filter radius in texels.
    pub ratio: Estimate,
}

/// A two-sided test of a null hypothesis.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct NullTest {
    /// The estimate with its interval.
    pub estimate: Estimate,
    /// The value under the null hypothesis.
    pub null: f64,
    /// Probability of an estimate at least as far from `null`, when `null` is true.
    pub p_value: f64,
}

/// The ratio in one condition.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ConditionEstimate {
    /// `stair`, `step` or `double_step`.
    pub pattern: String,
    /// 0..1, of linear luminance.
    pub contrast: f64,
    /// Kernel that the ratio holds for, where it is known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kernel: Option<String>,
    /// Filter radius in texels.
    pub ratio: Estimate,
    /// Whether the model that the ratio comes from fits the answers, where that was tested.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub goodness_of_fit: Option<GoodnessOfFit>,
}

/// A test of the model against the answers of a condition, by simulated cohorts that obey the model.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct GoodnessOfFit {
    /// Pearson's sum of squared differences over people and bands of detectability.
    pub chi_square: f64,
    /// Its mean over the cohorts.
    pub expected: f64,
    /// Share of cohorts, the data among them, with as large a sum: up to 0.05 the model is doubtful.
    pub p_value: f64,
    /// Right answers, less expected ones, in late less early halves of the staircases, in standard deviations.
    pub drift: f64,
    /// Share of cohorts, the data among them, with as large a drift either way: up to 0.05 people learn or tire.
    pub drift_p_value: f64,
    /// Number of cohorts.
    pub cohorts: u64,
}

/// A session by its content.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SessionHash {
    /// Name of the session's directory.
    pub session: String,
    /// SHA-256 of the session's files, in hexadecimal.
    pub sha256: String,
}

impl RelationFile {
    /// A file that holds a relation and no more.
    #[must_use]
    pub fn of(relation: &Relation) -> Self {
        let ratio =
            Estimate { value: relation.ratio(), standard_error: relation.standard_error(), ci95: relation.ci95() };
        Self {
            schema: SCHEMA.to_owned(),
            ratio,
            population: Vec::new(),
            kernel: Some("disc".to_owned()),
            tests: None,
            model: None,
            other_estimators: Vec::new(),
            conditions: Vec::new(),
            protocol: None,
            people: None,
            trials: None,
            sessions: Vec::new(),
            software: None,
        }
    }

    /// Reads and checks a file.
    ///
    /// # Errors
    /// Names the field, what it holds and what is allowed: another schema, a number that is missing, not finite, <= 0
    /// or above 64, an interval that does not enclose its value.
    pub fn from_json(json: &str) -> Result<Self, Error> {
        let tree: Value = serde_json::from_str(json)?;
        check_schema(&tree)?;
        check_estimate(&tree["ratio"], "ratio")?;
        for (i, point) in tree["population"].as_array().into_iter().flatten().enumerate() {
            let path = format!("population[{i}]");
            check_estimate(&point["ratio"], &format!("{path}.ratio"))?;
            number(&point["viewers"], &format!("{path}.viewers"), |x| x > 0.0 && x < 1.0, "a share between 0 and 1")?;
            number(
                &point["detection"],
                &format!("{path}.detection"),
                |x| x > 0.0 && x < 1.0,
                "a probability between 0 and 1",
            )?;
        }
        Ok(serde_json::from_value(tree)?)
    }

    /// The file as indented JSON.
    ///
    /// # Errors
    /// What [`RelationFile::from_json`] refuses is not written either; NaN is not a number of JSON.
    pub fn to_json(&self) -> Result<String, Error> {
        let json = serde_json::to_string_pretty(self)?;
        Self::from_json(&json)?;
        Ok(json)
    }

    /// The median person's threshold, ready to size maps.
    ///
    /// # Errors
    /// As [`Relation::new`].
    pub fn relation(&self) -> Result<Relation, Error> {
        Relation::new(self.ratio.value, self.ratio.standard_error, self.ratio.ci95)
    }

    /// The relation that hides texels from this share of viewers at this probability of detection, if the curve holds
    /// it.
    ///
    /// # Errors
    /// [`Error::Field`] when the curve has no such point.
    pub fn relation_for(&self, viewers: f64, detection: f64) -> Result<Relation, Error> {
        let same = |a: f64, b: f64| (a - b).abs() < 1e-9;
        let point = self.population.iter().find(|p| same(p.viewers, viewers) && same(p.detection, detection));
        let point = point.ok_or_else(|| Error::Field {
            field: "population".to_owned(),
            found: format!("without viewers {viewers} at detection {detection}"),
            allowed: "a point of the file's population curve",
        })?;
        Relation::new(point.ratio.value, point.ratio.standard_error, point.ratio.ci95)
    }
}

fn check_schema(tree: &Value) -> Result<(), Error> {
    if tree["schema"].as_str() == Some(SCHEMA) {
        return Ok(());
    }
    Err(Error::Field { field: "schema".to_owned(), found: found(&tree["schema"]), allowed: "\"scumble/relation/1\"" })
}

fn check_estimate(tree: &Value, path: &str) -> Result<(), Error> {
    let in_range = |x: f64| x > 0.0 && x <= RATIO_MAX;
    let value = number(&tree["value"], &format!("{path}.value"), in_range, RATIO_ALLOWED)?;
    // As Relation::new, which takes -0 for a sign error.
    let is_error = |x: f64| x >= 0.0 && x.is_sign_positive();
    let allowed = "a finite number, 0 or above, without a minus sign";
    number(&tree["standard_error"], &format!("{path}.standard_error"), is_error, allowed)?;
    let ends = tree["ci95"].as_array().filter(|ends| ends.len() == 2);
    let ends = ends.ok_or_else(|| Error::Field {
        field: format!("{path}.ci95"),
        found: found(&tree["ci95"]),
        allowed: "two numbers",
    })?;
    number(&ends[0], &format!("{path}.ci95[0]"), |x| x > 0.0 && x <= value, "a number above 0, at most the value")?;
    number(&ends[1], &format!("{path}.ci95[1]"), |x| x >= value, "a finite number, at least the value")?;
    Ok(())
}

/// The finite number at a path, or an error that names the path.
fn number(tree: &Value, path: &str, holds: impl Fn(f64) -> bool, allowed: &'static str) -> Result<f64, Error> {
    match tree.as_f64() {
        Some(x) if x.is_finite() && holds(x) => Ok(x),
        _ => Err(Error::Field { field: path.to_owned(), found: found(tree), allowed }),
    }
}

fn found(tree: &Value) -> String {
    if tree.is_null() { "missing or null".to_owned() } else { tree.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(ratio: &str) -> String {
        format!("{{\"schema\": \"scumble/relation/1\", \"ratio\": {ratio}}}")
    }

    #[test]
    fn a_file_survives_writing_and_reading() {
        let mut written = RelationFile::of(&Relation::published());
        let ratio = Estimate { value: 9.7, standard_error: 1.0, ci95: [8.0, 11.9] };
        written.population.push(PopulationPoint { viewers: 0.95, detection: 0.1, ratio });
        written.sessions.push(SessionHash { session: "p01".to_owned(), sha256: "00ff".to_owned() });
        written.people = Some(10);
        let read = RelationFile::from_json(&written.to_json().unwrap()).unwrap();
        assert_eq!(read, written);
        assert_eq!(read.relation().unwrap(), Relation::published());
        assert_eq!(read.relation_for(0.95, 0.1).unwrap().ratio(), 9.7);
        assert!(read.relation_for(0.95, 0.2).unwrap_err().to_string().contains("population"));
    }

    #[test]
    fn a_damaged_file_is_refused_with_the_name_of_the_field() {
        let good = r#"{"value": 3.5, "standard_error": 0.3, "ci95": [2.9, 4.1]}"#;
        assert!(RelationFile::from_json(&file(good)).is_ok());
        let damaged = [
            (file(good).replace("relation/1", "relation/2"), "\"schema\""),
            (file(good).replace("\"schema\"", "\"scheme\""), "\"schema\""),
            (file(r#"{"standard_error": 0.3, "ci95": [2.9, 4.1]}"#), "\"ratio.value\""),
            (file(&good.replace("3.5", "0")), "\"ratio.value\""),
            (file(&good.replace("3.5", "-3.5")), "\"ratio.value\""),
            (file(&good.replace("3.5", "64.1")), "\"ratio.value\""),
            (file(&good.replace("3.5", "null")), "\"ratio.value\""),
            (file(&good.replace("3.5", "\"3.5\"")), "\"ratio.value\""),
            (file(&good.replace("0.3", "-0.3")), "\"ratio.standard_error\""),
            (file(&good.replace("0.3", "-0.0")), "\"ratio.standard_error\""),
            (file(&good.replace("2.9", "3.6")), "\"ratio.ci95[0]\""),
            (file(&good.replace("4.1", "3.4")), "\"ratio.ci95[1]\""),
            (file(&good.replace("[2.9, 4.1]", "[2.9]")), "\"ratio.ci95\""),
        ];
        for (json, field) in damaged {
            let message = RelationFile::from_json(&json).unwrap_err().to_string();
            assert!(message.contains(field) && message.contains("allowed"), "{message}");
        }
        for json in ["", "[]", &file("NaN"), &file(&good.replace("3.5", "1e999"))] {
            assert!(RelationFile::from_json(json).is_err(), "{json}");
        }
    }

    #[test]
    fn nan_is_not_written() {
        let mut file = RelationFile::of(&Relation::published());
        file.ratio.value = f64::NAN;
        assert!(file.to_json().is_err());
    }
}
