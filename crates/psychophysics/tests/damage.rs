//! Damaged sessions: an error that names file, line, found and allowed; never a panic, never silence.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

mod support;

use std::path::Path;

use scumble_psychophysics::{EVENTS_FILE, HEADER_FILE, Session, SessionWriter};
use serde_json::{Value, json};
use support::files;

/// Reads and replays a session from bytes.
fn read(header: &[u8], events: &[u8]) -> Result<Session, String> {
    let session = Session::parse(Path::new("study/P07"), header, events).map_err(|error| error.to_string())?;
    session.replay().map_err(|error| error.to_string())?;
    Ok(session)
}

/// The complaint about damaged events.
fn complaint(name: &str, events: &[u8]) -> String {
    read(files(name).0.as_bytes(), events).expect_err("damage was accepted")
}

/// Asserts where the complaint points and what it says.
fn assert_says(message: &str, file: &str, line: usize, [found, allowed]: [&str; 2]) {
    let (place, rest) = message.split_once(": ").unwrap();
    assert_eq!(Path::new(place), Path::new("study/P07").join(format!("{file}:{line}")), "{message}");
    let (message_found, message_allowed) = rest.split_once("; allowed is ").unwrap_or_else(|| panic!("{message}"));
    assert!(message_found.contains(found) && message_allowed.contains(allowed), "{found}, {allowed}: {message}");
    assert!(message.chars().count() < 700 && !message.contains(char::is_control), "{message}");
}

/// The events with one line replaced, counted from 1.
fn with_line(events: &str, number: usize, line: &str) -> String {
    let replaced = |(index, old): (usize, &str)| if index + 1 == number { line.to_owned() } else { old.to_owned() };
    events.lines().enumerate().map(replaced).map(|line| line + "\n").collect()
}

fn line(events: &str, number: usize) -> &str {
    events.lines().nth(number - 1).unwrap()
}

#[test]
fn a_line_that_is_no_event_is_named() {
    let (_, events) = files("two-alternative");
    let fourth = line(&events, 4);
    let deep = format!("{}1{}", "[".repeat(10_000), "]".repeat(10_000));
    let cases: [(&str, [&str; 2]); 17] = [
        (&fourth[..40], ["an end before everything is closed", "one event"]),
        ("", ["an empty line", "one event"]),
        ("\0\0\0\0", ["no value of JSON", "one event"]),
        ("null", ["null", "a group of keys"]),
        ("{}", ["no key event", "event"]),
        (r#"{"event":"trial"}"#, ["no key trial", "trial"]),
        (r#"{"event":"fire"}"#, ["event is `fire`", "trial, catch, practice, pause, resume, note, repeat_practice"]),
        (r#"{"event":"pause","notes":[]}"#, ["no key at", "at"]),
        (r#"{"event":"pause","at":"yesterday"}"#, ["at: ", "one event"]),
        (r#"{"event":"pause","at":null}"#, ["null", ""]),
        (
            r#"{"event":"resume","at":"2026-03-01T09:40:00Z","interrupted_secs":-1.5}"#,
            ["interrupted_secs -1.5", "at least 0"],
        ),
        (r#"{"event":"pause","at":"2026-03-01T09:40:00Z","answer":"left"}"#, ["the key answer", "no such key"]),
        (&deep, ["", ""]),
        (&format!("{{\"{}\":1}}", "x".repeat(1_000_000)), ["unknown key", "event, trial, answer"]),
        (&format!("{{\"event\":\"{}\"}}", "\\u0000".repeat(1000)), ["event is", ""]),
        (&format!("{fourth}{fourth}"), ["trailing characters", "one event"]),
        (&format!("\u{feff}{fourth}"), ["", "one event"]),
    ];
    for (damage, words) in cases {
        let damaged = with_line(&events, 4, damage);
        assert_says(&complaint("two-alternative", damaged.as_bytes()), EVENTS_FILE, 4, words);
    }
}

#[test]
fn a_value_that_no_event_has_is_named_by_its_key() {
    let (_, events) = files("two-alternative");
    let number = r#""response_time_secs":"#;
    for (key, to, words) in [
        (number, r#""response_time_ms":"#, ["unknown key response_time_ms", "response_time_secs"]),
        (number, r#""response_time_secs":-"#, ["response_time_secs is -", "at least 0"]),
        (number, r#""response_time_secs":1e400,"x":"#, ["response_time_secs: number out of range", ""]),
        (number, r#""response_time_secs":"slow","x":"#, ["response_time_secs is string \"slow\"", "a number"]),
        (number, r#""response_time_secs":NaN,"x":"#, ["response_time_secs", ""]),
        (number, r#""response_time_secs":1,"response_time_secs":"#, ["response_time_secs twice", "once"]),
        (number, r#""pictures_sha256":["x"],"response_time_secs":"#, ["pictures_sha256 is", "SHA-256"]),
        (r#""number":"#, r#""number":18446744073709551615,"x":"#, ["trial.number is integer", "to 4294967295"]),
        (r#""number":"#, r#""number":-"#, ["trial.number is integer `-", "whole number"]),
        (r#""number":"#, r#""number":0.5,"x":"#, ["trial.number is floating point `0.5`", "whole number"]),
        (r#""kernel":"disc""#, r#""kernel":"disk""#, ["trial.condition.kernel is `disk`", "disc, box"]),
        (r#""answer":""#, r#""answer":"up-"#, ["answer is `up-", "left, right, yes, no"]),
        (
            r#""placement_radius_px":"#,
            r#""placement_radius_px":null,"x":"#,
            ["placement_radius_px is null", "a number"],
        ),
        (r#""phase":"#, r#""phase":true,"x":"#, ["phase is boolean `true`", "a number"]),
        (r#""onset_secs":"#, r#""onset_secs":-"#, ["timing.onset_secs is -", "at least 0"]),
        (r#""onset_secs":"#, r#""onset_secs":0.1,"x":"#, ["the unknown key timing.x", "missed_frames"]),
        (r#""missed_frames":0"#, r#""missed_frames":-1"#, ["timing.missed_frames is integer `-1`", "whole number"]),
        (r#""timing":{"#, r#""interrupted_secs":3.5,"timing":{"#, ["the key interrupted_secs", "no such key"]),
        (r#""pictures":{"pair""#, r#""pictures":{"trio""#, ["trial.pictures", "pair or single"]),
    ] {
        let fourth = line(&events, 4);
        assert!(fourth.contains(key), "{fourth}");
        let damaged = with_line(&events, 4, &fourth.replacen(key, to, 1));
        assert_says(&complaint("two-alternative", damaged.as_bytes()), EVENTS_FILE, 4, words);
    }
}

#[test]
fn an_answer_that_contradicts_its_trial_is_named() {
    let (_, events) = files("two-alternative");
    let fourth = line(&events, 4);
    let flipped = match fourth.contains(r#""correct":true"#) {
        true => fourth.replace(r#""correct":true"#, r#""correct":false"#),
        false => fourth.replace(r#""correct":false"#, r#""correct":true"#),
    };
    let other = |path: &[&str], value: Value| {
        let mut tree: Value = serde_json::from_str(fourth).unwrap();
        let place = path.iter().fold(&mut tree, |tree, key| &mut tree[*key]);
        *place = value;
        tree.to_string()
    };
    let artifact = |side| other(&["trial", "pictures", "pair", side, "shape"], json!("artifact"));
    let both = if artifact("left") == other(&[], serde_json::from_str(fourth).unwrap()) { "right" } else { "left" };
    for (damage, words) in [
        (flipped, ["correct is ", "right one"]),
        (other(&["answer"], json!("yes")), ["answer is yes", "left and right"]),
        (other(&["event"], json!("catch")), ["trial.role is measure under another event", "trial for measure"]),
        (other(&["trial", "role"], json!("line")), ["trial.role is line", "event of the role"]),
        (other(&["trial", "round"], json!(0)), ["trial.round is 0", "1 or more"]),
        (other(&["trial", "track"], Value::Null), ["trial.track is null", "index"]),
        (other(&["trial", "radius_px"], json!(1e308)), ["trial.pictures is of something else", "radius"]),
        (other(&["trial", "radius_px"], json!(0.0)), ["trial.radius_px is 0", "above 0"]),
        (artifact(both), ["trial.pictures is of the role measure", "a line and an artifact"]),
    ] {
        let damaged = with_line(&events, 4, &damage);
        assert_says(&complaint("two-alternative", damaged.as_bytes()), EVENTS_FILE, 4, words);
    }
}

#[test]
fn missing_doubled_and_swapped_lines_are_named() {
    for name in support::NAMES {
        let (header, events) = files(name);
        let lines: Vec<&str> = events.lines().collect();
        let joined = |lines: &[&str]| lines.iter().map(|line| format!("{line}\n")).collect::<String>();
        let count = lines.len();
        for at in 0..count {
            let mut missing = lines.clone();
            missing.remove(at);
            let mut doubled = lines.clone();
            doubled.insert(at, lines[at]);
            for (damaged, line) in [(missing, at + 1), (doubled, at + 2)] {
                // Without its end a session is not damaged, it goes on.
                if damaged != lines[..count - 1] {
                    let message = read(header.as_bytes(), joined(&damaged).as_bytes()).unwrap_err();
                    assert_says(&message, EVENTS_FILE, line, ["", ""]);
                }
            }
            if at + 1 < count {
                let mut swapped = lines.clone();
                swapped.swap(at, at + 1);
                let message = read(header.as_bytes(), joined(&swapped).as_bytes()).unwrap_err();
                // What stands before its place is named, and what stands behind the end. A practice trial and
                // another one count by themselves, so there it is the earlier onset that is out of place.
                let is_practice = |line: &str| line.contains("\"event\":\"practice\"");
                let is_behind = at + 2 == count || is_practice(lines[at]) != is_practice(lines[at + 1]);
                let line = if is_behind { at + 2 } else { at + 1 };
                assert_says(&message, EVENTS_FILE, line, ["", ""]);
            }
        }
    }
}

#[test]
fn an_edit_of_anything_that_was_shown_is_found_and_named() {
    for name in support::NAMES {
        let (header, events) = files(name);
        for number in 1..events.lines().count() {
            let tree: Value = serde_json::from_str(line(&events, number)).unwrap();
            let mut leaves = vec![];
            find_leaves(&tree["trial"], "/trial".into(), &mut leaves);
            assert!(leaves.len() > 20);
            for leaf in leaves {
                let mut edited = tree.clone();
                let value = edited.pointer_mut(&leaf).unwrap();
                *value = match &*value {
                    Value::Number(number) if number.is_u64() => json!(number.as_u64().unwrap() + 1),
                    Value::Number(number) => json!(number.as_f64().unwrap() * (1.0 + f64::EPSILON) + 1e-300),
                    Value::Bool(value) => json!(!value),
                    Value::String(word) => json!(format!("{word}s")),
                    _ => json!(1),
                };
                let damaged = with_line(&events, number, &edited.to_string());
                let message = read(header.as_bytes(), damaged.as_bytes()).expect_err(&leaf);
                assert_says(&message, EVENTS_FILE, number, ["", ""]);
            }
        }
    }
}

/// The JSON pointers of every value that holds no other.
fn find_leaves(tree: &Value, pointer: String, leaves: &mut Vec<String>) {
    match tree {
        Value::Object(map) => {
            map.iter().for_each(|(key, value)| find_leaves(value, format!("{pointer}/{key}"), leaves))
        }
        _ => leaves.push(pointer),
    }
}

#[test]
fn an_edited_draw_is_told_with_what_the_seed_leads_to() {
    let (header, events) = files("two-alternative");
    let fourth = line(&events, 4);
    let mut tree: Value = serde_json::from_str(fourth).unwrap();
    for side in ["left", "right"] {
        tree["trial"]["pictures"]["pair"][side]["phase"] = json!(0.25);
    }
    let damaged = with_line(&events, 4, &tree.to_string());
    let message = read(header.as_bytes(), damaged.as_bytes()).unwrap_err();
    let found = "trial.pictures.pair.left.phase is 0.25 in measure trial 2";
    assert_says(&message, EVENTS_FILE, 4, [found, "to which the seed and the answers before lead"]);
}

#[test]
fn what_editors_and_converters_do_to_a_session_is_named() {
    let (header, events) = files("yes-no");
    let crlf = events.replace('\n', "\r\n");
    assert_says(&complaint("yes-no", crlf.as_bytes()), EVENTS_FILE, 1, ["carriage return", "line feeds"]);
    let bom = format!("\u{feff}{events}");
    assert_says(&complaint("yes-no", bom.as_bytes()), EVENTS_FILE, 1, ["byte order mark", "without"]);
    let mut bytes = events.clone().into_bytes();
    let third = events.match_indices('\n').nth(1).unwrap().0 + 20;
    bytes[third] = 0xff;
    assert_says(&complaint("yes-no", &bytes), EVENTS_FILE, 3, ["not UTF-8", "UTF-8"]);
    let message = read(header.replace('\n', "\r\n").as_bytes(), events.as_bytes()).unwrap_err();
    assert_says(&message, HEADER_FILE, 1, ["carriage return", "line feeds"]);
    let message = read(format!("\u{feff}{header}").as_bytes(), events.as_bytes()).unwrap_err();
    assert_says(&message, HEADER_FILE, 1, ["byte order mark", "without"]);
}

#[test]
fn a_tail_without_its_line_break_is_dropped_with_a_notice_whatever_it_holds() {
    let (header, events) = files("two-alternative");
    let whole = events.len();
    for tail in [b"{\"event\":".as_slice(), &[0; 5000], &[0xff, 0xfe], "né".as_bytes(), b"\r"] {
        let bytes = [events.as_bytes(), tail].concat();
        let session = read(header.as_bytes(), &bytes).unwrap();
        let [notice] = session.notices.as_slice() else { panic!("{:?}", session.notices) };
        let line = events.lines().count() + 1;
        let place = format!("{EVENTS_FILE}:{line}: the last line was cut off after {} bytes", tail.len());
        assert!(notice.contains(&place) && notice.len() < 2000, "{notice}");
        assert_eq!(session.events.len(), line - 1);
    }
    assert!(read(header.as_bytes(), &events.as_bytes()[..whole]).unwrap().notices.is_empty());
    assert!(read(header.as_bytes(), b"").unwrap().events.is_empty(), "a session before its first answer");
}

#[test]
fn a_damaged_header_is_named_by_line_and_key() {
    let (header, events) = files("yes-no");
    for (from, to, at, words) in [
        ("\"P07\"", "\"Ada Lovelace\"", "\"participant\"", ["participant is \"Ada Lovelace\"", "a code"]),
        ("\"trials_max\": 3", "\"trials_max\": 2", "\"trials_max\"", ["schedule.trials_max is 2", "trials_min"]),
        ("\"seed\"", "\"sed\"", "\"sed\"", ["unknown key sed", "seed"]),
        ("\"seed\": 11", "\"seed\": -11", "\"seed\"", ["seed is integer `-11`", "whole number"]),
        ("\"seed\": 11", "\"seed\": 18446744073709551616", "\"seed\"", ["seed", "whole number"]),
        (
            "\"participant_number\": 7",
            "\"participant_number\": 4294967296",
            "\"participant_number\"",
            ["participant_number is", "to 4294967295"],
        ),
        (
            "\"width_px\": 600",
            "\"width_px\": null",
            "\"width_px\"",
            ["protocol.pictures.width_px is null", "whole number"],
        ),
        ("\"display\": null,\n", "", "}\n", ["no key display", "display"]),
        ("\"started_at\": \"2026", "\"started_at\": \"in 2026", "\"started_at\"", ["started_at", ""]),
        (
            "\"ratio_min\": 0.5",
            "\"ratio_min\": 1e400",
            "\"ratio_min\"",
            ["protocol.pictures.ratio_min: number out of range", ""],
        ),
        ("\"ratio\": 0.5", "\"ratio\": 0.4", "\"ratio\": 0.4", ["catch_trials.ratio is 0.4", "ratio_min"]),
    ] {
        assert!(header.contains(from), "{from}: {header}");
        let damaged = header.replacen(from, to, 1);
        let place = if at == "}\n" { damaged.len() } else { damaged.find(at).unwrap() };
        let line = damaged[..place].matches('\n').count() + usize::from(at != "}\n");
        let message = read(damaged.as_bytes(), events.as_bytes()).unwrap_err();
        assert_says(&message, HEADER_FILE, line, words);
    }
    for (damaged, line) in [("", 1), ("{", 1), ("[]", 1), ("\0\0", 1), ("{\n\"schema\": 2}", 2)] {
        let message = read(damaged.as_bytes(), events.as_bytes()).unwrap_err();
        assert_says(&message, HEADER_FILE, line, ["", ""]);
    }
}

#[test]
fn a_session_of_another_version_is_refused_as_that() {
    let (header, events) = files("two-alternative");
    for version in ["1", "4"] {
        // Its keys are another version's too.
        let other =
            header.replace("session/3", &format!("session/{version}")).replace("\"participant_number\"", "\"age\"");
        let message = read(other.as_bytes(), events.as_bytes()).unwrap_err();
        let found = format!("schema is scumble/session/{version}");
        assert_says(&message, HEADER_FILE, 2, [&found, "scumble/session/3; another version of the program recorded"]);
    }
}

#[test]
fn another_seed_in_the_header_is_found_at_the_first_trial() {
    let (header, events) = files("two-alternative");
    let message = read(header.replace("\"seed\": 11", "\"seed\": 12").as_bytes(), events.as_bytes()).unwrap_err();
    assert_says(&message, EVENTS_FILE, 1, ["trial.", "the seed"]);
}

#[test]
fn damage_is_refused_by_the_writer_and_left_as_it_is() {
    let (header, events) = files("two-alternative");
    let root = tempfile::tempdir().unwrap();
    let write = |file: &str, text: &str| std::fs::write(root.path().join(file), text).unwrap();
    let other = events.replacen("\"number\":2", "\"number\":3", 1);
    for (header, events) in [(header.as_str(), other.as_str()), ("{}", &events), (&header, "x\n")] {
        write(HEADER_FILE, header);
        write(EVENTS_FILE, events);
        assert!(SessionWriter::reopen(root.path()).is_err());
        let left = |file: &str| std::fs::read_to_string(root.path().join(file)).unwrap();
        assert_eq!((left(HEADER_FILE).as_str(), left(EVENTS_FILE).as_str()), (header, events));
    }
}
