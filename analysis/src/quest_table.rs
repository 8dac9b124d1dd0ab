//! QUEST on a table of answers (command `quest`): the posterior's summaries before the first and
//! after each response, for comparison with other implementations.

use std::{io::Write, path::Path};

use scumble_psychophysics::{Quest, QuestConfig, QuestSummary};
use serde::Serialize;

use crate::{
    Error,
    table::{read_rows, read_text},
};

/// One answer of a table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TableAnswer {
    /// Its line in the file.
    pub line: u64,
    /// Intensity shown.
    pub intensity: f64,
    /// The response.
    pub response: bool,
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
    let text = read_text(path)?;
    let config: QuestConfig = serde_json::from_str(&text).map_err(|error| {
        let reason = format!(
            "{error}; allowed are numbers under tGuess, tGuessSd, pThreshold, beta, delta and gamma, and grain and \
             range where they differ from 0.01 and 5"
        );
        Error::Table { path: path.to_path_buf(), line: error.line() as u64, reason }
    })?;
    // A prior is made too: it finds what the ranges of single keys do not.
    config.check().and_then(|()| Quest::new(config).map(|_| ())).map_err(|error| {
        let reason = error.to_string();
        Error::Table { path: path.to_path_buf(), line: line_of_key(&text, &reason), reason }
    })?;
    Ok(config)
}

/// The line of the key with which a complaint begins; 1 where it begins with none.
fn line_of_key(text: &str, complaint: &str) -> u64 {
    let key = match complaint.split_whitespace().next() {
        Some("threshold") => "pThreshold",
        Some(word) => word,
        None => "",
    };
    let place = text.find(&format!("\"{key}\"")).unwrap_or(0);
    1 + text[..place].matches('\n').count() as u64
}

/// Reads a table of `intensity,response`; a response is 0 or 1.
///
/// # Errors
/// Names file and line of the first cell that is not allowed.
pub fn read_responses(path: &Path) -> Result<Vec<TableAnswer>, Error> {
    let mut answers = Vec::new();
    read_rows(path, ["intensity", "response"], |line, [intensity, response]| {
        if !intensity.is_finite() {
            return Err(format!("intensity is {intensity}; allowed is a finite number"));
        }
        if response != 0.0 && response != 1.0 {
            return Err(format!("response is {response}; allowed is 0 or 1"));
        }
        answers.push(TableAnswer { line, intensity, response: response == 1.0 });
        Ok(())
    })?;
    Ok(answers)
}

/// Writes the summaries as CSV. The columns `config` and `sequence` are the names of the files.
///
/// # Errors
/// A response that QUEST refuses, with the line of `responses` that holds it; the writer's error.
pub fn write_summaries(
    config: &QuestConfig,
    answers: &[TableAnswer],
    [config_file, responses_file]: [&Path; 2],
    out: impl Write,
) -> Result<(), Error> {
    let [config_name, sequence_name] = [&stem(config_file), &stem(responses_file)];
    let responses: Vec<(f64, bool)> = answers.iter().map(|answer| (answer.intensity, answer.response)).collect();
    let rows = QuestSummary::of_sequence(*config, &responses)
        .map_err(|error| refused_answer(config, answers, responses_file, error))?;
    let mut writer = csv::Writer::from_writer(out);
    for row in rows {
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

/// The refusal with the line of the first answer that QUEST refuses.
fn refused_answer(
    config: &QuestConfig,
    answers: &[TableAnswer],
    file: &Path,
    error: scumble_psychophysics::Error,
) -> Error {
    let Ok(mut quest) = Quest::new(*config) else { return error.into() };
    match answers.iter().find(|answer| quest.update(answer.intensity, answer.response).is_err()) {
        Some(answer) => Error::Table { path: file.to_path_buf(), line: answer.line, reason: error.to_string() },
        None => error.into(),
    }
}

/// A file's name without folder and ending.
fn stem(path: &Path) -> String {
    path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned())
}
