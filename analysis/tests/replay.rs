//! Replay of sessions: an untouched record is equal, and every touched number or hash is found.

#![allow(clippy::unwrap_used, reason = "a test stops at what it did not expect, in helpers too")]

use std::{cell::Cell, fs, path::Path, sync::Mutex};

use scumble_analysis::{Replayed, hashed_pictures, replay_session};
use scumble_psychophysics::{
    Display, EVENTS_FILE, Experiment, HEADER_FILE, Observer, ObserverModel, Protocol, Reply, SessionHeader,
    SessionWriter, Software, Stage, read_session,
};
use scumble_stimuli::picture_sha256;

/// A session of 96 x 64 pixels, one pattern and one texel size, with the hashes of its pictures, on an unmeasured
/// display.
fn record(directory: &Path, task: &str) {
    record_on(directory, task, None);
}

/// The same on a display with this table of luminances.
fn record_on(directory: &Path, task: &str, luminance_table: Option<Vec<(u8, f64)>>) {
    let mut protocol = Protocol::named(task).unwrap();
    (protocol.pictures.width_px, protocol.pictures.height_px) = (96, 64);
    protocol.conditions.patterns.truncate(1);
    protocol.conditions.contrasts.truncate(1);
    protocol.conditions.texels_px = vec![4.0];
    protocol.practice.texel_px = 4.0;
    protocol.catch_trials = None;
    let software = Software::of("test", "0");
    let mut header = SessionHeader::new("p-1", protocol.clone(), 5, jiff::Timestamp::UNIX_EPOCH, software);
    let (width_px, height_px, scale_factor) = (1920, 1200, 1.0);
    header.display = Some(Display { width_px, height_px, scale_factor, luminance_table, ..Display::default() });
    let transfer = header.transfer().unwrap();
    let mut experiment = Experiment::new(protocol, 5, header.participant_number).unwrap();
    let person = Observer::new(ObserverModel::default(), 1).unwrap();
    let mut writer = SessionWriter::create(directory, &header).unwrap();
    while *experiment.stage() != Stage::Finished {
        let Some(trial) = experiment.stage().trial().copied() else {
            experiment.proceed().unwrap();
            continue;
        };
        let hash = |stimulus: &scumble_stimuli::Stimulus| picture_sha256(&stimulus.render(96, 64, &transfer).unwrap());
        let pictures_sha256 = trial.pictures.all().into_iter().map(hash).collect();
        let reply = Reply {
            answer: person.answer(&trial, &experiment.protocol().pictures).unwrap(),
            response_time_secs: 1.0,
            pictures_sha256,
            timing: None,
        };
        writer.append(&experiment.answer(reply).unwrap()).unwrap();
    }
}

fn replay(directory: &Path) -> Result<Replayed, String> {
    let session = read_session(directory).map_err(|error| error.to_string())?;
    replay_session(&session, |_| ()).map_err(|error| error.to_string())
}

/// Changes the text of one line of the events, counted from 1.
fn edit(directory: &Path, line: usize, change: impl Fn(&str) -> String) {
    let path = directory.join(EVENTS_FILE);
    let text = fs::read_to_string(&path).unwrap();
    let count = Cell::new(0);
    let changed = text.lines().map(|content| {
        count.set(count.get() + 1);
        (if count.get() == line { change(content) } else { content.to_owned() }) + "\n"
    });
    let changed: String = changed.collect();
    assert_ne!(changed, text, "the edit changed nothing");
    fs::write(&path, changed).unwrap();
}

#[test]
fn an_untouched_record_is_equal_picture_for_picture() {
    for (task, pictures_each) in [("two-alternative", 2), ("yes-no", 1)] {
        let folder = tempfile::tempdir().unwrap();
        record(folder.path(), task);
        let session = read_session(folder.path()).unwrap();
        let drawn = Mutex::new(0);
        let replayed = replay_session(&session, |count| *drawn.lock().unwrap() += count).unwrap();
        assert_eq!(replayed.pictures, pictures_each * (replayed.trials + replayed.practice));
        assert_eq!((replayed.practice, replayed.staircases), (8, 1));
        assert!(replayed.trials >= 10);
        assert_eq!((*drawn.lock().unwrap(), hashed_pictures(&session)), (replayed.pictures, replayed.pictures));
    }
}

#[test]
fn pictures_are_drawn_again_for_the_light_that_the_header_has() {
    let folder = tempfile::tempdir().unwrap();
    let gamma_2 = vec![(0, 0.5), (64, 8.0), (128, 30.8), (192, 68.5), (255, 120.5)];
    record_on(folder.path(), "two-alternative", Some(gamma_2));
    assert!(replay(folder.path()).unwrap().pictures > 20);

    // The same record under another light: its pictures were not those that it says.
    let header = folder.path().join(HEADER_FILE);
    let text = fs::read_to_string(&header).unwrap();
    fs::write(&header, text.replace("30.8", "50.8")).unwrap();
    let message = replay(folder.path()).unwrap_err();
    assert!(message.contains("events.jsonl:1: pictures_sha256[0] is "), "{message}");
}

#[test]
fn a_touched_hash_is_named_with_its_line_and_the_first_one_counts() {
    let folder = tempfile::tempdir().unwrap();
    record(folder.path(), "two-alternative");
    for line in [15, 12] {
        let first_digit = |content: &str| {
            let place = content.find("pictures_sha256\":[\"").unwrap() + 19;
            let digit = if &content[place..=place] == "0" { "1" } else { "0" };
            format!("{}{digit}{}", &content[..place], &content[place + 1..])
        };
        edit(folder.path(), line, first_digit);
        let message = replay(folder.path()).unwrap_err();
        let place = format!("{EVENTS_FILE}:{line}: pictures_sha256[0] is ");
        assert!(message.contains(&place) && !message.contains('\n'), "{message}");
    }
}

#[test]
fn a_placement_that_differs_in_the_last_bit_is_named_with_its_line() {
    let folder = tempfile::tempdir().unwrap();
    record(folder.path(), "two-alternative");
    let next_up = |content: &str| {
        let key = "\"placement_radius_px\":";
        let start = content.find(key).unwrap() + key.len();
        let end = start + content[start..].find(',').unwrap();
        let placement: f64 = content[start..end].parse().unwrap();
        format!("{}{}{}", &content[..start], placement.next_up(), &content[end..])
    };
    edit(folder.path(), 14, next_up);
    let message = replay(folder.path()).unwrap_err();
    assert!(message.contains(&format!("{EVENTS_FILE}:14: ")), "{message}");
}
