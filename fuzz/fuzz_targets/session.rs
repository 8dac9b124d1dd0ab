//! Sessions: header and events, read and replayed. The input is `session.json` followed by
//! `events.jsonl`; the header ends with the first line that is a closing brace.

#![no_main]

use std::path::Path;

use libfuzzer_sys::fuzz_target;
use scumble_fuzz::assert_names_its_place;
use scumble_psychophysics::{EVENTS_FILE, HEADER_FILE, Session};

fuzz_target!(|bytes: &[u8]| {
    let end = bytes.windows(3).position(|window| window == b"\n}\n").map_or(bytes.len(), |place| place + 3);
    let (header, events) = bytes.split_at(end);
    if let Err(error) = Session::parse(Path::new(""), header, events).and_then(|session| session.replay()) {
        assert_names_its_place(&error.to_string(), &[HEADER_FILE, EVENTS_FILE]);
    }
});
