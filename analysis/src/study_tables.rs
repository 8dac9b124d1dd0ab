//! The thresholds of a study as a table: one row a person and condition.

use std::path::Path;

use serde::Serialize;

use crate::{
    Error,
    series::{kernel_name, pattern_name},
    threshold_intervals::ThresholdIntervals,
    thresholds::ConditionThreshold,
};

/// File name of the table of thresholds.
pub const THRESHOLDS_TABLE: &str = "thresholds.csv";
/// Beginning of the header of [`THRESHOLDS_TABLE`].
pub const THRESHOLDS_MARK: &str = "person,pattern,contrast,kernel,texel_px,trials,correct,staircases,converged";

#[derive(Serialize)]
struct ThresholdRow<'a> {
    person: &'a str,
    pattern: &'static str,
    contrast: f64,
    kernel: &'static str,
    texel_px: f64,
    trials: usize,
    correct: usize,
    staircases: usize,
    converged: usize,
    unconverged: String,
    ratio: Option<f64>,
    log10_ratio: Option<f64>,
    standard_error_log10: Option<f64>,
    profile_low95: Option<f64>,
    profile_high95: Option<f64>,
    bootstrap_low95: Option<f64>,
    bootstrap_high95: Option<f64>,
    radius_px: Option<f64>,
    reason: String,
}

/// All thresholds as CSV with the ends of their 95 % intervals, ratios by both methods; where there is none, the cells are empty
/// and `reason` says why.
///
/// # Errors
/// The writer's.
pub(crate) fn thresholds_csv(
    thresholds: &[ConditionThreshold],
    intervals: &[ThresholdIntervals],
) -> Result<String, Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for (entry, of) in thresholds.iter().zip(intervals) {
        let [profile, bootstrap] =
            [of.profile, of.bootstrap].map(|ends| ends.map(|end| end.map(|log10| 10_f64.powf(log10))));
        let found = entry.threshold.ok();
        let row = ThresholdRow {
            person: &entry.person,
            pattern: pattern_name(entry.condition.pattern),
            contrast: entry.condition.contrast,
            kernel: kernel_name(entry.condition.kernel),
            texel_px: entry.condition.texel_px,
            trials: entry.trials,
            correct: entry.correct,
            staircases: entry.staircases,
            converged: entry.converged,
            unconverged: entry.unconverged.join("; "),
            ratio: found.map(|threshold| threshold.ratio()),
            log10_ratio: found.map(|threshold| threshold.log10_ratio),
            standard_error_log10: found.map(|threshold| threshold.standard_error_log10),
            profile_low95: profile[0],
            profile_high95: profile[1],
            bootstrap_low95: bootstrap[0],
            bootstrap_high95: bootstrap[1],
            radius_px: entry.radius_px(),
            reason: entry.threshold.err().map_or_else(String::new, |reason| reason.to_string()),
        };
        writer.serialize(row).map_err(|error| table_error(THRESHOLDS_TABLE, error))?;
    }
    finish(THRESHOLDS_TABLE, writer)
}

fn table_error(name: &str, error: csv::Error) -> Error {
    Error::io(Path::new(name))(error.into())
}

fn finish(name: &str, writer: csv::Writer<Vec<u8>>) -> Result<String, Error> {
    let bytes = writer.into_inner().map_err(|error| table_error(name, error.into_error().into()))?;
    let not_text = |error| Error::File { path: name.into(), reason: format!("{error}") };
    String::from_utf8(bytes).map_err(not_text)
}
