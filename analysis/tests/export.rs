//! BIDS datasets by value: every answer of the record is in the table that other programs read, and every column
//! and word of a table is described beside it.

#![allow(clippy::unwrap_used, reason = "a test stops at what it did not expect, in helpers too")]

mod lab;

use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
    path::{Path, PathBuf},
};

use lab::{Sitting, header, small};
use scumble_analysis::{Export, Simulation, session_directories};
use scumble_psychophysics::{Answered, EVENTS_FILE, Event, HEADER_FILE, ObserverModel, Role, read_session};
use serde_json::Value;

const MORNING: &str = "2026-03-01T09:30:00Z";

/// A row by column.
type Row = BTreeMap<String, String>;

fn rows(path: &Path) -> Vec<Row> {
    csv::ReaderBuilder::new().delimiter(b'\t').from_path(path).unwrap().deserialize().map(Result::unwrap).collect()
}

fn json(path: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

/// Every file of a folder whose name ends so, in order.
fn files(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        match entry.is_dir() {
            true => found.extend(files(&entry, ending)),
            false if entry.to_str().unwrap().ends_with(ending) => found.push(entry),
            false => {}
        }
    }
    found.sort();
    found
}

fn export(sessions: &Path, out: &Path) -> Export {
    let export = Export::read(&[sessions.to_path_buf()]).unwrap();
    export.write(out).unwrap();
    export
}

fn refusal(sessions: &Path, out: &Path) -> String {
    let export = Export::read(&[sessions.to_path_buf()]).and_then(|export| export.write(out));
    export.unwrap_err().to_string()
}

fn answers(events: &[Event]) -> Vec<&Answered> {
    events.iter().filter_map(Event::answered).collect()
}

/// The number in a cell.
fn number(row: &Row, column: &str) -> f64 {
    row[column].parse().unwrap_or_else(|_| panic!("{column} is {}", row[column]))
}

/// A session whose events `go` makes; in `folder/directory`.
fn sit(folder: &Path, directory: &str, code: &str, go: impl FnOnce(&mut Sitting)) {
    let header = header(code, small("two-alternative"), MORNING);
    go(&mut Sitting::new(&folder.join(directory), &header));
}

#[test]
fn every_answer_of_a_simulated_study_is_a_row_with_its_numbers() {
    for protocol in ["two-alternative", "yes-no", "published"] {
        let folder = tempfile::tempdir().unwrap();
        let (sessions, out) = (folder.path().join("sessions"), folder.path().join("bids"));
        let simulation = Simulation {
            protocol: small(protocol),
            observers: 2,
            seed: 3,
            median: ObserverModel::default(),
            between_sd_log10: 0.1,
        };
        simulation.write(&sessions, || ()).unwrap();
        export(&sessions, &out);

        for code in ["sim-0001", "sim-0002"] {
            let session = read_session(&sessions.join(code)).unwrap();
            let label = code.replace('-', "");
            let task = protocol.replace('-', "");
            let rows = rows(&out.join(format!("sub-{label}/beh/sub-{label}_task-{task}_events.tsv")));
            assert_eq!(rows.len(), session.events.len());
            let answers = answers(&session.events);
            let rows: Vec<_> = rows.iter().filter(|row| row["answer"] != "n/a").collect();
            assert_eq!(rows.len(), answers.len());
            for (row, answered) in rows.iter().zip(&answers) {
                let trial = &answered.trial;
                assert_eq!(number(row, "onset"), answered.timing.unwrap().onset_secs);
                assert_eq!(number(row, "duration"), answered.response_time_secs);
                assert_eq!(number(row, "response_time"), answered.response_time_secs);
                assert_eq!(number(row, "trial_number"), f64::from(trial.number));
                assert_eq!(number(row, "radius_px"), trial.radius_px);
                assert_eq!(number(row, "placement_radius_px"), trial.placement_radius_px);
                assert_eq!(number(row, "ratio"), trial.ratio());
                assert_eq!(number(row, "phase"), trial.pictures.all()[0].phase);
                assert_eq!(row["track"], trial.track.map_or("n/a".to_owned(), |track| track.to_string()));
                assert_eq!(row["correct"], if answered.correct { "1" } else { "0" });
                assert_eq!(row["correct"] == "1", row["answer"] == row["right_answer"]);
                assert_eq!(row["stands"], "1");
            }
            let correct: f64 = rows.iter().map(|row| number(row, "correct")).sum();
            assert_eq!(correct as usize, answers.iter().filter(|answered| answered.correct).count());
            let measured = rows.iter().filter(|row| row["trial_type"] == "measure").count();
            assert_eq!(measured, answers.iter().filter(|answered| answered.trial.role == Role::Measure).count());
        }
    }
}

#[test]
fn a_sidecar_describes_exactly_the_columns_of_its_table_and_every_word_in_them() {
    let folder = tempfile::tempdir().unwrap();
    let (sessions, out) = (folder.path().join("sessions"), folder.path().join("bids"));
    sit(&sessions, "a", "p01", |sitting| {
        sitting.answer(4);
        sitting.interrupt(60.0);
        sitting.repeat_round();
        sitting.moment(Event::Note, "a note");
        sitting.finish();
    });
    let mut yes_no = Sitting::new(&sessions.join("b"), &header("p02", small("yes-no"), MORNING));
    yes_no.finish();
    export(&sessions, &out);

    let events = files(&out, "_events.tsv");
    let sidecar_of = |table: &PathBuf| (table.clone(), table.with_extension("json"));
    let mut pairs: Vec<_> = events.iter().map(sidecar_of).collect();
    pairs.push(sidecar_of(&out.join("participants.tsv")));
    pairs.extend(files(&out, "_scans.tsv").into_iter().map(|table| (table, out.join("scans.json"))));
    assert_eq!(pairs.len(), 5);
    for (table, sidecar) in pairs {
        let described = json(&sidecar);
        let described = described.as_object().unwrap();
        let names: BTreeSet<&str> =
            described.keys().map(String::as_str).filter(|name| *name != "StimulusPresentation").collect();
        for row in rows(&table) {
            assert_eq!(row.keys().map(String::as_str).collect::<BTreeSet<_>>(), names, "{}", table.display());
            for (name, cell) in &row {
                assert!(!cell.is_empty());
                assert!(described[name]["Description"].as_str().is_some_and(|text| text.ends_with('.')), "{name}");
                let levels = described[name].get("Levels").map(|levels| levels.as_object().unwrap());
                let known = levels.is_none_or(|levels| cell == "n/a" || levels.contains_key(cell));
                assert!(known, "{name} has no level {cell}");
            }
        }
    }
}

#[test]
fn the_participant_the_display_and_the_course_of_the_session_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let (sessions, out) = (folder.path().join("sessions"), folder.path().join("bids"));
    sit(&sessions, "a", "p-07_a", Sitting::finish);
    let mut old = header("p08", small("two-alternative"), MORNING);
    old.demographics.as_mut().unwrap().age_years = Some(95);
    let mut stopped = Sitting::new(&sessions.join("b"), &old);
    stopped.answer(5);
    stopped.moment(Event::Stop, "felt sick");
    export(&sessions, &out);

    let participants = rows(&out.join("participants.tsv"));
    let cells = |row: &Row, names: &[&str]| names.iter().map(|name| row[*name].clone()).collect::<Vec<_>>();
    let said = ["participant_id", "participant_code", "age", "gender", "handedness", "vision", "graphics_experience"];
    let expected = ["sub-p07a", "p-07_a", "28", "female", "ambidextrous", "corrected", "expert"];
    assert_eq!(cells(&participants[0], &said), expected);
    assert_eq!(participants[1]["age"], "89");
    let done = ["simulated", "sessions", "status", "standing_trials", "px_per_degree"];
    assert_eq!(cells(&participants[0], &done), ["0", "1", "complete", "6", "66.25"]);
    assert_eq!(cells(&participants[1], &done), ["0", "1", "stopped", "3", "66.25"]);

    let scans = rows(&out.join("sub-p07a/sub-p07a_scans.tsv"));
    let told = ["filename", "acq_time", "status", "answers", "missed_frames", "room", "gamma_check_level", "record"];
    let expected = [
        "beh/sub-p07a_task-twoalternative_events.tsv",
        "2026-03-01T09:30:00.000000Z",
        "complete",
        "8",
        "2",
        r"blinds\tdown, one lamp",
        "187",
        "a",
    ];
    assert_eq!(cells(&scans[0], &told), expected);
    let screen = &json(&out.join("sub-p07a/beh/sub-p07a_task-twoalternative_events.json"))["StimulusPresentation"];
    assert_eq!(screen["ScreenResolution"], serde_json::json!([3840, 2160]));
    assert_eq!(screen["ScreenSize"], serde_json::json!([0.6, 0.3375]));
    assert_eq!(screen["ScreenDistance"], 0.6);
}

#[test]
fn sessions_of_a_participant_are_numbered_in_the_order_of_time() {
    let folder = tempfile::tempdir().unwrap();
    let (sessions, out) = (folder.path().join("sessions"), folder.path().join("bids"));
    for (directory, started_at) in [("a", "2026-03-02T09:30:00Z"), ("b", MORNING)] {
        Sitting::new(&sessions.join(directory), &header("p01", small("two-alternative"), started_at)).finish();
    }
    sit(&sessions, "c", "p02", Sitting::finish);
    let export = export(&sessions, &out);
    let names: Vec<_> = export.sessions.iter().map(|session| session.name()).collect();
    assert_eq!(names, ["sub-p01_ses-1", "sub-p01_ses-2", "sub-p02_ses-1"]);
    let scans = rows(&out.join("sub-p01/ses-1/sub-p01_ses-1_scans.tsv"));
    assert_eq!(scans[0]["record"], "b");
    assert!(out.join("sub-p01/ses-2/beh/sub-p01_ses-2_task-twoalternative_events.tsv").exists());
    let participants = rows(&out.join("participants.tsv"));
    assert_eq!((participants.len(), participants[0]["sessions"].as_str()), (2, "2"));
    assert_eq!(participants[0]["standing_trials"], "12");
}

#[test]
fn codes_that_share_a_label_get_folders_of_their_own() {
    let folder = tempfile::tempdir().unwrap();
    let (sessions, out) = (folder.path().join("sessions"), folder.path().join("bids"));
    for code in ["p07", "p-07", "P07", "p_07"] {
        sit(&sessions, code, code, Sitting::finish);
    }
    export(&sessions, &out);
    let of: BTreeMap<String, String> = rows(&out.join("participants.tsv"))
        .into_iter()
        .map(|row| (row["participant_code"].clone(), row["participant_id"].clone()))
        .collect();
    let lower: BTreeSet<String> = of.values().map(|label| label.to_lowercase()).collect();
    assert_eq!((of.len(), lower.len()), (4, 4));
    for label in of.values() {
        assert!(label["sub-".len()..].chars().all(|letter| letter.is_ascii_alphanumeric()), "{label}");
        assert_eq!(files(&out.join(label), "_events.tsv").len(), 1);
    }
}

#[test]
fn answers_of_a_repeated_round_stay_in_the_table_and_do_not_stand() {
    let folder = tempfile::tempdir().unwrap();
    let (sessions, out) = (folder.path().join("sessions"), folder.path().join("bids"));
    sit(&sessions, "a", "p01", |sitting| {
        sitting.answer(2 + 4);
        sitting.repeat_round();
        sitting.finish();
    });
    let export = export(&sessions, &out);
    let rows = rows(&files(&out, "_events.tsv")[0]);
    let measured =
        |stands: &str| rows.iter().filter(|row| row["trial_type"] == "measure" && row["stands"] == stands).count();
    assert_eq!((measured("0"), measured("1")), (4, 6));
    let repeated = rows.iter().position(|row| row["trial_type"] == "repeat_round").unwrap();
    assert!(rows[..repeated].iter().all(|row| row["trial_type"] != "measure" || row["stands"] == "0"));
    assert_eq!((export.sessions[0].answers(), export.sessions[0].standing_trials()), (12, 6));
}

#[test]
fn a_hostile_note_stays_one_cell_and_stands_where_it_was_written() {
    let folder = tempfile::tempdir().unwrap();
    let (sessions, out) = (folder.path().join("sessions"), folder.path().join("bids"));
    let hostile = "tab\there, line\nend, \"quotes\", back\\slash, n/a\r\n\u{2028}";
    sit(&sessions, "a", "p01", |sitting| {
        sitting.answer(3);
        // While the fourth trial's pictures are shown.
        sitting.answer_while(1, |sitting, onset_secs| sitting.moment_at(onset_secs + 0.01, Event::Note, hostile));
        sitting.finish();
    });
    export(&sessions, &out);
    let table = files(&out, "_events.tsv").remove(0);
    let text = fs::read_to_string(&table).unwrap();
    let cells_a_line: BTreeSet<usize> = text.lines().map(|line| line.split('\t').count()).collect();
    assert_eq!(cells_a_line.len(), 1, "for a reader who knows no quotes");
    let rows = rows(&table);
    let place = rows.iter().position(|row| row["trial_type"] == "note").unwrap();
    assert_eq!(rows[place]["notes"], r#"tab\there, line\nend, "quotes", back\\slash, n/a\r\n\u{2028}"#);
    assert_eq!(place, 4, "after the onset of the fourth trial");
    assert!((number(&rows[4], "onset") - number(&rows[3], "onset") - 0.01).abs() < 1e-6);
    assert_eq!((rows[3]["line"].as_str(), rows[4]["line"].as_str()), ("5", "4"));
}

#[test]
fn onsets_are_in_order_whatever_the_clock_did() {
    let folder = tempfile::tempdir().unwrap();
    let (sessions, out) = (folder.path().join("sessions"), folder.path().join("bids"));
    sit(&sessions, "a", "p01", |sitting| {
        sitting.answer(3);
        sitting.interrupt(86_400.0);
        sitting.answer(1);
        sitting.moment_at(-7200.0, Event::Note, "clock set back");
        sitting.answer(1);
        sitting.moment_at(1e6, Event::Pause, "clock set forward");
        sitting.moment_at(10.0, Event::Resume, "and back");
        sitting.finish();
    });
    export(&sessions, &out);
    let rows = rows(&files(&out, "_events.tsv")[0]);
    assert!(rows.is_sorted_by(|one, other| number(one, "onset") <= number(other, "onset")));
    let lines: Vec<_> = rows.iter().map(|row| number(row, "line")).collect();
    assert!(lines.is_sorted(), "the order of the record: {lines:?}");
    assert_eq!(rows[4]["interrupted_secs"], "86400");
    assert!(number(&rows[4], "onset") - number(&rows[3], "onset") >= 86_399.0);
}

#[test]
fn discarded_sessions_and_sessions_without_an_answer_are_left_out_with_the_reason() {
    let folder = tempfile::tempdir().unwrap();
    let (sessions, out) = (folder.path().join("sessions"), folder.path().join("bids"));
    sit(&sessions, "a", "p01", Sitting::finish);
    sit(&sessions, "b", "p02", |sitting| {
        sitting.answer(4);
        sitting.moment(Event::Discard, "");
    });
    sit(&sessions, "c", "p03", |_| ());
    sit(&sessions, "d", "p04", |sitting| sitting.answer(4));
    let export = export(&sessions, &out);
    let names: Vec<_> = export.sessions.iter().map(|session| (session.name(), session.status().name())).collect();
    assert_eq!(names, [("sub-p01".to_owned(), "complete"), ("sub-p04".to_owned(), "unfinished")]);
    let reasons: Vec<_> = export.left_out.iter().map(|(_, reason)| *reason).collect();
    assert_eq!(reasons, ["the administrator discarded it", "it has no answer"]);
    assert_eq!(files(&out, "_events.tsv").len(), 2);

    let alone = refusal(&sessions.join("b"), &folder.path().join("other"));
    assert!(alone.contains("discarded"), "{alone}");
}

#[test]
fn what_is_there_is_never_replaced_and_a_refusal_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let (sessions, out) = (folder.path().join("sessions"), folder.path().join("bids"));
    sit(&sessions, "a", "p01", Sitting::finish);
    fs::create_dir(&out).unwrap();
    export(&sessions, &out);
    let before = files(&out, "");
    let again = refusal(&sessions, &out);
    assert!(again.contains("bids: holds") && again.contains("allowed is a folder that is empty"), "{again}");
    assert_eq!(files(&out, ""), before);

    let file = folder.path().join("file");
    fs::write(&file, "a letter").unwrap();
    assert!(refusal(&sessions, &file).contains("file: is no folder"));
    assert_eq!(fs::read_to_string(&file).unwrap(), "a letter");
    let current = refusal(&sessions, Path::new("."));
    assert!(current.contains("is the current folder"), "{current}");

    // The record goes on while it is exported: the dataset is not made.
    let export = Export::read(std::slice::from_ref(&sessions)).unwrap();
    let events = sessions.join("a").join(EVENTS_FILE);
    fs::write(&events, fs::read_to_string(&events).unwrap() + "{").unwrap();
    let changed = export.write(&folder.path().join("new/bids")).unwrap_err().to_string();
    assert!(changed.contains("went on"), "{changed}");
    assert_eq!(fs::read_dir(folder.path().join("new")).unwrap().count(), 0);
}

#[test]
fn a_session_that_was_recorded_without_onsets_is_refused_with_its_line() {
    let folder = tempfile::tempdir().unwrap();
    let (sessions, out) = (folder.path().join("sessions"), folder.path().join("bids"));
    sit(&sessions, "a", "p01", Sitting::finish);
    for file in [EVENTS_FILE, HEADER_FILE] {
        let path = sessions.join("a").join(file);
        let text = fs::read_to_string(&path).unwrap().replace("scumble/session/3", "scumble/session/2");
        let without = |line: &str| {
            let Some(start) = line.find(",\"timing\":{") else { return line.to_owned() };
            let end = start + line[start..].find('}').unwrap() + 1;
            format!("{}{}", &line[..start], &line[end..])
        };
        fs::write(&path, text.lines().map(|line| without(line) + "\n").collect::<String>()).unwrap();
    }
    let message = refusal(&sessions, &out);
    assert!(
        message.contains("events.jsonl: line 1 has no onset") && message.contains("scumble/session/2"),
        "{message}"
    );
    assert!(!out.exists());
}

#[test]
fn copies_and_simulated_people_among_humans_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let (sessions, out) = (folder.path().join("sessions"), folder.path().join("bids"));
    sit(&sessions, "a", "p01", Sitting::finish);
    sit(&sessions, "b", "p01", Sitting::finish);
    assert!(refusal(&sessions, &out).contains("a copy of the session"));

    fs::remove_dir_all(sessions.join("b")).unwrap();
    let mut simulated = header("p02", small("two-alternative"), MORNING);
    simulated.simulated_observer = Some(ObserverModel::default());
    Sitting::new(&sessions.join("c"), &simulated).finish();
    assert!(refusal(&sessions, &out).contains("is simulated"));
    assert!(!out.exists());
}

#[test]
fn the_records_in_the_dataset_are_the_sessions_and_can_be_exported_again() {
    let folder = tempfile::tempdir().unwrap();
    let (sessions, out) = (folder.path().join("sessions"), folder.path().join("bids"));
    sit(&sessions, "a", "p-01", Sitting::finish);
    sit(&sessions, "b", "p-02", Sitting::finish);
    export(&sessions, &out);
    let records = session_directories(&out.join("sourcedata")).unwrap();
    for (record, original) in records.iter().zip(["a", "b"]) {
        let original = read_session(&sessions.join(original)).unwrap();
        let record = read_session(record).unwrap();
        assert_eq!((record.header, record.events), (original.header, original.events));
    }
    let again = folder.path().join("again");
    export(&out.join("sourcedata"), &again);
    let tables =
        |folder: &Path| files(folder, "_events.tsv").iter().map(|path| fs::read(path).unwrap()).collect::<Vec<_>>();
    assert_eq!(tables(&again), tables(&out));
}
