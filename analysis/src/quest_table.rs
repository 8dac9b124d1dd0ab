//! QUEST on a table of answers (command `quest`): the posterior's summaries before the first and
//! after each response, for comparison with other implementations.

use std::{io::Write, path::Path};

use scumble_psychophysics::{QuestConfig, QuestSummary};
use serde::{Deserialize, Serialize};

use crate::Error;

#[derive(Deserialize)]
struct ResponseRow {
    intensity: f64,
    response: f64,
}

/// One row of the output. Lists the fields of [`QuestSummary`] because the CSV writer flattens none.
#[derive(Serialize)]
struct SummaryRow<'a> {
    config: &'a str,
    sequence: &'a str,
    trial: u32,
    intensity: Option<f64>,
    response: Option<u8>,
    mean: f64,
    mode: f64,
    median: f64,
    q05: f64,
    q95: f64,
    next_quantile: f64,
    sd: f64,
    pdf_max: f64,
    out_of_range: u8,
}

/// Reads a QUEST configuration with the keys of Psychtoolbox (`tGuess`, `tGuessSd`, `pThreshold`,
/// `beta`, `delta`, `gamma`, `grain`, `range`).
///
/// # Errors
/// Names file, line and key of what is missing, unknown or out of range.
pub fn read_quest_config(path: &Path) -> Result<QuestConfig, Error> {
    let text = std::fs::read_to_string(path).map_err(Error::io(path))?;
    let config: QuestConfig = serde_json::from_str(&text).map_err(|error| {
        let (line, reason) = (error.line() as u64, error.to_string());
        Error::Table { path: path.to_path_buf(), line, reason }
    })?;
    config.check().map_err(|error| {
        let reason = error.to_string();
        Error::File { path: path.to_path_buf(), reason }
    })?;
    Ok(config)
}

/// Reads a table of `intensity,response`; a response is 0 or 1.
///
/// # Errors
/// Names file and line of the first cell that is not allowed.
pub fn read_responses(path: &Path) -> Result<Vec<(f64, bool)>, Error> {
    let mut responses = Vec::new();
    crate::table::read_rows(path, &["intensity", "response"], |row: ResponseRow| {
        if !row.intensity.is_finite() {
            return Err(format!("intensity is {}; allowed is a finite number", row.intensity));
        }
        if row.response != 0.0 && row.response != 1.0 {
            return Err(format!("response is {}; allowed is 0 or 1", row.response));
        }
        responses.push((row.intensity, row.response == 1.0));
        Ok(())
    })?;
    Ok(responses)
}

/// Writes the summaries as CSV. `config_name` and `sequence_name` fill the columns `config` and
/// `sequence`.
///
/// # Errors
/// A response that QUEST refuses, or the writer's error.
pub fn write_summaries(
    config: QuestConfig,
    responses: &[(f64, bool)],
    [config_name, sequence_name]: [&str; 2],
    out: impl Write,
) -> Result<(), Error> {
    let mut writer = csv::Writer::from_writer(out);
    for row in QuestSummary::of_sequence(config, responses)? {
        let row = SummaryRow {
            config: config_name,
            sequence: sequence_name,
            trial: row.trial,
            intensity: row.intensity,
            response: row.response,
            mean: row.mean,
            mode: row.mode,
            median: row.median,
            q05: row.q05,
            q95: row.q95,
            next_quantile: row.next_quantile,
            sd: row.sd,
            pdf_max: row.pdf_max,
            out_of_range: row.out_of_range,
        };
        writer.serialize(row).map_err(|error| Error::io(Path::new("output"))(error.into()))?;
    }
    writer.flush().map_err(Error::io(Path::new("output")))
}
