//! Whatever bytes the files hold: no panic, and every refusal names file, line, found and allowed.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

mod support;

use std::path::Path;
use std::sync::LazyLock;

use proptest::prelude::*;
use scumble_psychophysics::{EVENTS_FILE, Event, Experiment, HEADER_FILE, Protocol, Session, SessionHeader, rehearse};
use support::{NAMES, files, named, observer, small};

static FILES: LazyLock<Vec<(String, String)>> = LazyLock::new(|| NAMES.map(files).into());
static PROTOCOLS: LazyLock<Vec<String>> = LazyLock::new(|| NAMES.map(|name| named(name).to_toml().unwrap()).into());

/// One damage of a file.
#[derive(Clone, Debug)]
enum Damage {
    /// Bytes in place of others.
    Replace { at: prop::sample::Index, length: usize, bytes: Vec<u8> },
    /// A piece of the file once more, elsewhere.
    Copy { from: prop::sample::Index, length: usize, to: prop::sample::Index },
    /// A number in place of one of the file's.
    Number { nth: prop::sample::Index, number: String },
}

fn damage() -> impl Strategy<Value = Damage> {
    let bytes = prop_oneof![
        prop::collection::vec(any::<u8>(), 0..8),
        prop::sample::select(vec![
            "\n", "{", "}", "[", "]", "\"", ",", "null", "\u{feff}", "\r\n", "\0", "=", "#", "."
        ])
        .prop_map(|text| text.as_bytes().to_vec()),
    ];
    let number = prop_oneof![
        any::<f64>().prop_map(|number| number.to_string()),
        any::<i64>().prop_map(|number| number.to_string()),
        (-10.0..1000.0).prop_map(|number: f64| number.to_string()),
        prop::sample::select(vec![
            "0",
            "-0.0",
            "1e400",
            "1e308",
            "1e-320",
            "18446744073709551616",
            "4294967295",
            "nan",
            "inf"
        ])
        .prop_map(String::from),
    ];
    prop_oneof![
        (any::<prop::sample::Index>(), 0_usize..8, bytes).prop_map(|(at, length, bytes)| Damage::Replace {
            at,
            length,
            bytes
        }),
        (any::<prop::sample::Index>(), 1_usize..2000, any::<prop::sample::Index>())
            .prop_map(|(from, length, to)| Damage::Copy { from, length, to }),
        (any::<prop::sample::Index>(), number).prop_map(|(nth, number)| Damage::Number { nth, number }),
    ]
}

fn damaged(text: &str, damages: &[Damage]) -> Vec<u8> {
    damages.iter().fold(text.as_bytes().to_vec(), |mut bytes, damage| {
        match damage {
            Damage::Replace { at, length, bytes: new } => {
                let at = at.index(bytes.len() + 1);
                let end = (at + length).min(bytes.len());
                bytes.splice(at..end, new.iter().copied());
            }
            Damage::Copy { from, length, to } => {
                let from = from.index(bytes.len() + 1);
                let piece = bytes[from..(from + length).min(bytes.len())].to_vec();
                let to = to.index(bytes.len() + 1);
                bytes.splice(to..to, piece);
            }
            Damage::Number { nth, number } => {
                let is_part = |byte: &u8| byte.is_ascii_digit() || *byte == b'.' || *byte == b'-';
                let starts: Vec<usize> =
                    (0..bytes.len()).filter(|i| is_part(&bytes[*i]) && (*i == 0 || !is_part(&bytes[*i - 1]))).collect();
                if !starts.is_empty() {
                    let start = starts[nth.index(starts.len())];
                    let end = start + bytes[start..].iter().take_while(|byte| is_part(byte)).count();
                    bytes.splice(start..end, number.bytes());
                }
            }
        }
        bytes
    })
}

/// Whether a message is `FILE:LINE: found; allowed is something` in one line.
fn names_its_place(message: &str, files: &[&str]) -> bool {
    let place = files.iter().find_map(|file| message.strip_prefix(file)?.strip_prefix(':'));
    let Some((line, rest)) = place.and_then(|place| place.split_once(": ")) else { return false };
    let Some((found, allowed)) = rest.split_once("; allowed is ") else { return false };
    line.parse::<usize>().is_ok_and(|line| line > 0)
        && !found.is_empty()
        && !allowed.is_empty()
        && !message.contains('\n')
        && message.len() < 2000
}

/// Reads a protocol; one that is accepted runs a session whose record is read back.
fn check_protocol(bytes: &[u8]) -> Result<(), TestCaseError> {
    match Protocol::from_toml(Path::new("a.toml"), bytes) {
        Err(error) => prop_assert!(names_its_place(&error.to_string(), &["a.toml"]), "{}", error),
        Ok(protocol) => {
            let again = Protocol::from_toml(Path::new("a.toml"), protocol.to_toml().unwrap());
            prop_assert_eq!(again.unwrap(), protocol.clone());
            check_trials(protocol)?;
        }
    }
    Ok(())
}

/// What a protocol in range leads to can be drawn, written and read.
fn check_trials(mut protocol: Protocol) -> Result<(), TestCaseError> {
    // A session of any length would do; these are over in no time.
    protocol.practice.ratios.truncate(3);
    protocol.schedule.trials_min = protocol.schedule.trials_min.min(2);
    protocol.schedule.trials_max = protocol.schedule.trials_max.min(2);
    let Ok(mut experiment) = Experiment::new(protocol.clone(), 3, 1) else { return Ok(()) };
    let events = rehearse(&mut experiment, &observer(3)).unwrap();
    for answered in events.iter().filter_map(Event::answered) {
        for picture in answered.trial.pictures.all() {
            prop_assert!(picture.check().is_ok(), "{:?}", picture);
        }
    }
    let header = SessionHeader { seed: 3, participant_number: 1, ..support::header(protocol) };
    let header = serde_json::to_string(&header).unwrap();
    let lines: String = events.iter().map(|event| serde_json::to_string(event).unwrap() + "\n").collect();
    let read = Session::parse(Path::new(""), header.as_bytes(), lines.as_bytes());
    prop_assert_eq!(read.unwrap().replay().unwrap(), experiment);
    Ok(())
}

fn check_session(header: &[u8], events: &[u8]) -> Result<(), TestCaseError> {
    let replayed = Session::parse(Path::new(""), header, events).and_then(|session| session.replay());
    if let Err(error) = replayed {
        prop_assert!(names_its_place(&error.to_string(), &[HEADER_FILE, EVENTS_FILE]), "{}", error);
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn arbitrary_bytes_are_refused_at_a_line(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        prop_assert!(names_its_place(&Protocol::from_toml(Path::new("a.toml"), &bytes).unwrap_err().to_string(), &["a.toml"]));
        check_session(&bytes, b"")?;
        check_session(FILES[1].0.as_bytes(), &bytes)?;
    }

    #[test]
    fn a_damaged_protocol_is_refused_at_a_line_or_runs(
        which in 0_usize..3,
        damages in prop::collection::vec(damage(), 1..4),
    ) {
        check_protocol(&damaged(&PROTOCOLS[which], &damages))?;
    }

    #[test]
    fn a_damaged_session_is_refused_at_a_line_or_replays(
        which in 0_usize..3,
        of_header in prop::collection::vec(damage(), 0..2),
        of_events in prop::collection::vec(damage(), 0..3),
    ) {
        let (header, events) = &FILES[which];
        check_session(&damaged(header, &of_header), &damaged(events, &of_events))?;
    }
}

#[test]
fn a_message_without_file_line_found_or_allowed_is_seen() {
    assert!(names_its_place("a:1: b; allowed is c", &["a"]));
    for message in
        ["a: b; allowed is c", "a:0: b; allowed is c", "a:1: b", "b:1: b; allowed is c", "a:1: b\n; allowed is c"]
    {
        assert!(!names_its_place(message, &["a"]), "{message}");
    }
}

#[test]
fn the_extremes_of_every_range_make_sessions_that_can_be_drawn_and_read() {
    for name in NAMES {
        for (texel_px, ratio_min, side_px) in [(1.0, 0.001, 16_384), (1.0, 0.001, 3), (4000.0, 0.5, 16_384)] {
            let mut protocol = small(name);
            protocol.conditions.texels_px = vec![texel_px];
            (protocol.pictures.width_px, protocol.pictures.height_px) = (side_px, side_px);
            (protocol.pictures.ratio_min, protocol.pictures.tilt_range_rad) = (ratio_min, 0.2);
            protocol.staircase.prior_ratios = vec![0.001, 1000.0];
            protocol.staircase.prior_sd_log10 = 1e6;
            (protocol.staircase.table_step_log10, protocol.staircase.table_width_log10) = (1.0, 20.0);
            (protocol.practice.texel_px, protocol.practice.ratios) = (texel_px, vec![ratio_min]);
            if let Some(catch) = &mut protocol.catch_trials {
                (catch.texel_px, catch.ratio, catch.share) = (texel_px, ratio_min, 0.5);
            }
            protocol.check().unwrap();
            check_trials(protocol).unwrap();
        }
    }
}
