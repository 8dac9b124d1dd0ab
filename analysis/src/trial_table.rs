//! `trials.csv`: every answer after practice, one row a trial, and `trials.json`, what each of its columns means.
//!
//! Thresholds use the rows whose role is `measure` and that nothing leaves out: `stands` is 1 and `excluded` is empty.

use std::path::Path;

use scumble_psychophysics::{Answered, Role};

use crate::{
    Error,
    column::{self, Levels, Sidecar, YES_NO, flag, number, word},
    load::{LoadedSession, directory_name},
    people::Study,
    words::{ANSWERS, KERNELS, PATTERNS},
};

/// File name of the table of trials.
pub const TRIALS_TABLE: &str = "trials.csv";
/// File name of the description of its columns.
pub const TRIALS_COLUMNS: &str = "trials.json";
/// Beginning of the header of [`TRIALS_TABLE`], by which a re-run knows its own file.
pub(crate) const TRIALS_MARK: &str = "person,session,";
/// What every description of the columns holds.
pub(crate) const TRIALS_COLUMNS_MARK: &str = "\"LongName\": \"Participant\"";

/// An answer with what it belongs to.
struct Row<'a> {
    study: &'a Study,
    loaded: &'a LoadedSession,
    answered: &'a Answered,
    stands: bool,
}

type Column<'a> = column::Column<Row<'a>>;

const ROLES: Levels = &[
    ("measure", "trial whose answer a staircase learned from"),
    ("line", "a filtered line alone, to count false alarms"),
    ("catch", "an artifact that everyone sees who looks"),
];

const EXCLUDED: Levels = &[
    ("person", "the protocol leaves out all of this person's answers"),
    ("answered too fast", "sooner after the pictures than the protocol takes"),
    ("answered too slowly", "later after the pictures than the protocol takes"),
];

/// All answers after practice as CSV: tidy, one row a trial, in the order of sessions and trials.
///
/// # Errors
/// The writer's.
pub fn trials_csv(study: &Study) -> Result<String, Error> {
    let rows: Vec<Row> = study.sessions.iter().flat_map(|loaded| rows_of(study, loaded)).collect();
    column::csv(Path::new(TRIALS_TABLE), &columns(), &rows)
}

/// The meaning of every column as JSON: name, description, unit and, where there is a fixed set, the words.
///
/// # Errors
/// The serializer's.
pub fn trials_columns() -> Result<String, Error> {
    let text = serde_json::to_string_pretty(&Sidecar(&columns()));
    let text = text.map_err(|error| Error::File { path: TRIALS_COLUMNS.into(), reason: error.to_string() })?;
    Ok(text + "\n")
}

fn rows_of<'a>(study: &'a Study, loaded: &'a LoadedSession) -> impl Iterator<Item = Row<'a>> {
    let standing = loaded.session.standing();
    let answers = loaded.session.events.iter().filter_map(|event| event.answered());
    let stands = move |answered: &Answered| standing.iter().any(|other| std::ptr::eq(*other, answered));
    answers.filter(|answered| answered.trial.role != Role::Practice).map(move |answered| Row {
        study,
        loaded,
        answered,
        stands: stands(answered),
    })
}

/// Every column, in order.
fn columns<'a>() -> Vec<Column<'a>> {
    let mut columns = whose();
    columns.extend(what());
    columns.extend(answer());
    columns
}

/// Whose answer it is and where it is recorded.
fn whose<'a>() -> Vec<Column<'a>> {
    vec![
        Column::new("person", "Participant", "Code of the participant.", |row| {
            Some(row.loaded.session.header.participant.clone())
        }),
        Column::new("session", "Session", "Folder of the session's record.", |row| {
            Some(directory_name(&row.loaded.session.directory))
        }),
        Column::new("source", "Source", "Folder that the session's folder lies in, such as a laboratory's.", |row| {
            Some(directory_name(row.loaded.session.directory.parent()?)).filter(|name| !name.is_empty())
        }),
        Column::new("record_format", "Format of the record", "Schema and version of the session's files.", |row| {
            Some(row.loaded.session.header.schema.clone())
        }),
        Column::new("protocol", "Protocol", "Name of the session's protocol.", |row| {
            Some(row.loaded.session.header.protocol.name.clone())
        }),
        Column::new("trial", "Number of the trial", "From 1 through the session, practice apart.", |row| {
            Some(row.answered.trial.number.to_string())
        }),
        Column::new("round", "Round", "From 1.", |row| Some(row.answered.trial.round.to_string())),
    ]
}

/// What was shown.
fn what<'a>() -> Vec<Column<'a>> {
    vec![
        Column::new("role", "Role", "What the trial is for.", |row| word(row.answered.trial.role)).of_levels(ROLES),
        Column::new(
            "track",
            "Staircase",
            "The staircase that chose the radius, from 0 in the order of the session; empty for line and catch trials.",
            |row| Some(row.answered.trial.track?.to_string()),
        ),
        Column::new("pattern", "Pattern", "How the silhouette lies on the texels.", |row| {
            word(row.answered.trial.condition.pattern)
        })
        .of_levels(PATTERNS),
        Column::new("contrast", "Contrast", "Lit side relative to the brightest, 0 to 1.", |row| {
            number(row.answered.trial.condition.contrast)
        }),
        Column::new("kernel", "Filter", "What blurs the silhouette.", |row| word(row.answered.trial.condition.kernel))
            .of_levels(KERNELS),
        Column::new("texel_px", "Texel", "Side of a shadow-map texel on the screen, in physical pixels.", |row| {
            number(row.answered.trial.condition.texel_px)
        })
        .in_units("px"),
        Column::new("radius_px", "Radius", "Radius of the filter as shown.", |row| {
            number(row.answered.trial.radius_px)
        })
        .in_units("px"),
        Column::new("ratio", "Ratio", "Radius as shown, in texels.", |row| number(row.answered.trial.ratio()))
            .in_units("texel"),
        Column::new(
            "clamped",
            "Clamped",
            "Whether the staircase asked for a radius that pictures cannot hold.",
            |row| flag(row.answered.trial.is_clamped()),
        )
        .of_levels(YES_NO),
    ]
}

/// What was answered, how, and whether it counts.
fn answer<'a>() -> Vec<Column<'a>> {
    vec![
        Column::new("right_answer", "Right answer", "What the pictures were made from.", |row| {
            word(row.answered.trial.pictures.right_answer())
        })
        .of_levels(ANSWERS),
        Column::new("answer", "Answer", "To the question: which one was the line, or was it a line.", |row| {
            word(row.answered.answer)
        })
        .of_levels(ANSWERS),
        Column::new("correct", "Correct", "Whether the answer was right.", |row| flag(row.answered.correct))
            .of_levels(YES_NO),
        Column::new(
            "response_time_secs",
            "Response time",
            "From the first frame of the pictures to the answer.",
            |row| number(row.answered.response_time_secs),
        )
        .in_units("s"),
        Column::new(
            "missed_frames",
            "Missed frames",
            "Display refreshes by which the pictures came later than due; empty in records that do not have it.",
            |row| Some(row.answered.timing?.missed_frames.to_string()),
        ),
        Column::new("stands", "Stands", "Whether the answer counts.", |row| flag(row.stands))
            .of_levels(&[("1", "yes"), ("0", "no: its round was repeated later")]),
        Column::new("excluded", "Excluded", "Why the protocol leaves an answer out; empty where it does not.", |row| {
            let rules = row.study.protocol.exclusions.unwrap_or_default();
            match row.study.excluded_people.contains(&row.loaded.session.header.participant) {
                true => Some("person".to_owned()),
                false => rules.of_response_time(row.answered.response_time_secs).map(str::to_owned),
            }
        })
        .of_levels(EXCLUDED),
    ]
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::Simulation;
    use scumble_psychophysics::{ObserverModel, Protocol};

    /// The study of two simulated people with catch and line trials, from disk.
    fn study() -> (tempfile::TempDir, Study) {
        let folder = tempfile::tempdir().unwrap();
        let protocol = Protocol::named("yes-no").unwrap();
        let median = ObserverModel::default();
        let simulation = Simulation { protocol, observers: 2, seed: 3, median, between_sd_log10: 0.1 };
        simulation.write(folder.path(), || ()).unwrap();
        let study = Study::read(&[folder.path().to_path_buf()]).unwrap();
        (folder, study)
    }

    #[test]
    fn every_column_is_described_and_every_word_in_it() {
        let (_folder, study) = study();
        let table = trials_csv(&study).unwrap();
        let described: serde_json::Value = serde_json::from_str(&trials_columns().unwrap()).unwrap();
        let mut reader = csv::Reader::from_reader(table.as_bytes());
        let header = reader.headers().unwrap().clone();
        assert_eq!(header.iter().collect::<BTreeSet<_>>().len(), described.as_object().unwrap().len());
        let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
        for (index, name) in header.iter().enumerate() {
            let column = &described[name];
            assert!(column["Description"].as_str().is_some_and(|text| text.ends_with('.')), "{name}: {column}");
            let Some(levels) = column["Levels"].as_object() else { continue };
            for row in &rows {
                assert!(row[index].is_empty() || levels.contains_key(&row[index]), "{name}: {}", &row[index]);
            }
        }
    }

    #[test]
    fn every_recorded_answer_after_practice_has_its_row() {
        let (_folder, study) = study();
        let answers = study.sessions.iter().flat_map(|loaded| &loaded.session.events).filter_map(|e| e.answered());
        let counted = answers.filter(|answered| answered.trial.role != Role::Practice).count();
        assert_eq!(trials_csv(&study).unwrap().lines().count(), counted + 1);
    }

    #[test]
    fn an_earlier_table_and_description_are_known_by_their_marks() {
        let (_folder, study) = study();
        assert!(trials_csv(&study).unwrap().starts_with(TRIALS_MARK));
        assert!(trials_columns().unwrap().contains(TRIALS_COLUMNS_MARK));
    }
}
