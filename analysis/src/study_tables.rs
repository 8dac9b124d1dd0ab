//! The study as tables: one row a trial, one row a threshold.

use std::path::Path;

use scumble_psychophysics::{Answer, Role};
use serde::Serialize;

use crate::{
    Error,
    load::directory_name,
    people::Study,
    series::{kernel_name, pattern_name},
    thresholds::ConditionThreshold,
};

/// File name of the table of trials.
pub const TRIALS_TABLE: &str = "trials.csv";
/// File name of the table of thresholds.
pub const THRESHOLDS_TABLE: &str = "thresholds.csv";
/// Beginning of the header of [`TRIALS_TABLE`], by which a re-run knows its own file.
pub const TRIALS_MARK: &str = "person,session,trial,round,role,track,pattern,contrast,kernel,texel_px,radius_px";
/// Beginning of the header of [`THRESHOLDS_TABLE`].
pub const THRESHOLDS_MARK: &str = "person,pattern,contrast,kernel,texel_px,trials,correct,staircases,converged";

#[derive(Serialize)]
struct TrialRow<'a> {
    person: &'a str,
    session: &'a str,
    trial: u32,
    round: u32,
    role: &'static str,
    track: Option<u32>,
    pattern: &'static str,
    contrast: f64,
    kernel: &'static str,
    texel_px: f64,
    radius_px: f64,
    ratio: f64,
    clamped: u8,
    right_answer: &'static str,
    answer: &'static str,
    correct: u8,
    response_time_secs: f64,
    excluded: &'static str,
}

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
    radius_px: Option<f64>,
    reason: String,
}

/// All answers after practice that stand as CSV: tidy, one row a trial. Thresholds use the rows whose role is
/// `measure` and whose `excluded` is empty: it says why the protocol leaves the answer out, `person` where it does so with
/// all of a person's. `track` is the staircase of the session, counted from 0, and empty for a catch trial.
///
/// # Errors
/// The writer's.
pub fn trials_csv(study: &Study) -> Result<String, Error> {
    let rules = study.protocol.exclusions.unwrap_or_default();
    let rows = study.sessions.iter().flat_map(|loaded| {
        let session = &loaded.session;
        let name = directory_name(&session.directory);
        session
            .standing()
            .into_iter()
            .filter(|answered| answered.trial.role != Role::Practice)
            .map(move |answered| (session.header.participant.as_str(), name.clone(), answered))
    });
    let mut writer = csv::Writer::from_writer(Vec::new());
    for (person, session, answered) in rows {
        let trial = &answered.trial;
        let row = TrialRow {
            person,
            session: &session,
            trial: trial.number,
            round: trial.round,
            role: role_name(trial.role),
            track: trial.track,
            pattern: pattern_name(trial.condition.pattern),
            contrast: trial.condition.contrast,
            kernel: kernel_name(trial.condition.kernel),
            texel_px: trial.condition.texel_px,
            radius_px: trial.radius_px,
            ratio: trial.ratio(),
            clamped: trial.is_clamped().into(),
            right_answer: answer_name(trial.pictures.right_answer()),
            answer: answer_name(answered.answer),
            correct: answered.correct.into(),
            response_time_secs: answered.response_time_secs,
            excluded: match study.excluded_people.contains(person) {
                true => "person",
                false => rules.of_response_time(answered.response_time_secs).unwrap_or_default(),
            },
        };
        writer.serialize(row).map_err(|error| table_error(TRIALS_TABLE, error))?;
    }
    finish(TRIALS_TABLE, writer)
}

/// All thresholds as CSV; where there is none, the cells are empty and `reason` says why.
///
/// # Errors
/// The writer's.
pub fn thresholds_csv(thresholds: &[ConditionThreshold]) -> Result<String, Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for entry in thresholds {
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
            radius_px: entry.radius_px(),
            reason: entry.threshold.err().map_or_else(String::new, |reason| reason.to_string()),
        };
        writer.serialize(row).map_err(|error| table_error(THRESHOLDS_TABLE, error))?;
    }
    finish(THRESHOLDS_TABLE, writer)
}

fn role_name(role: Role) -> &'static str {
    match role {
        Role::Practice => "practice",
        Role::Measure => "measure",
        Role::Line => "line",
        Role::Catch => "catch",
    }
}

fn answer_name(answer: Answer) -> &'static str {
    match answer {
        Answer::Left => "left",
        Answer::Right => "right",
        Answer::Yes => "yes",
        Answer::No => "no",
    }
}

fn table_error(name: &str, error: csv::Error) -> Error {
    Error::io(Path::new(name))(error.into())
}

fn finish(name: &str, writer: csv::Writer<Vec<u8>>) -> Result<String, Error> {
    let bytes = writer.into_inner().map_err(|error| table_error(name, error.into_error().into()))?;
    let not_text = |error| Error::File { path: name.into(), reason: format!("{error}") };
    String::from_utf8(bytes).map_err(not_text)
}
