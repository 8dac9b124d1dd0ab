//! The tables and configurations that `quest` and `threshold` take: every damage is named with file, line
//! and what is allowed, and no bytes make the program stop otherwise.

#![allow(clippy::unwrap_used, reason = "a test stops at what it did not expect, in helpers too")]

use std::io::Write;

use proptest::prelude::*;
use scumble_analysis::{
    Count, Error, Parameter, fit_count_table, read_count_table, read_quest_config, read_responses, write_summaries,
};

fn file(bytes: &[u8]) -> tempfile::NamedTempFile {
    let mut file = tempfile::NamedTempFile::new().unwrap();
    file.write_all(bytes).unwrap();
    file
}

/// The message of a reader that must refuse, without the file's name, which it must begin with.
fn refusal<T>(bytes: &[u8], read: impl Fn(&std::path::Path) -> Result<T, Error>) -> String {
    let file = file(bytes);
    let Err(error) = read(file.path()) else { panic!("{:?} is taken", String::from_utf8_lossy(bytes)) };
    let message = error.to_string();
    assert!(message.contains("allowed") && !message.contains('\n'), "{message:?}");
    let name = format!("{}: ", file.path().display());
    message.strip_prefix(&name).unwrap_or_else(|| panic!("{message} names no file")).to_owned()
}

#[test]
fn every_damage_to_a_table_of_responses_is_named() {
    let cases: [(&[u8], &str); 14] = [
        (b"intensity,response\n0,1\n0.1,2\n", "line 3: response is 2;"),
        (b"intensity,response\n0,0.5\n", "line 2: response is 0.5;"),
        (b"intensity,response\n0,-1\n", "line 2: response is -1;"),
        (b"intensity,response\n0,NaN\n", "line 2: response is NaN;"),
        (b"intensity,response\n0,yes\n", "line 2: response is \"yes\";"),
        (b"intensity,response\nNaN,1\n", "line 2: intensity is NaN;"),
        (b"intensity,response\n1e400,1\n", "line 2: intensity is inf;"),
        (b"intensity,response\n,1\n", "line 2: intensity is \"\";"),
        (b"intensity,response\n0,1\n0\n", "line 3: the row has 1 cells;"),
        (b"intensity,answer\n0,1\n", "line 1: column response is missing"),
        (b"intensity,response,response\n0,1,0\n", "line 1: column response stands there twice"),
        (b"intensity,response\n0,1\n\xff,1\n", "line 3: bytes that are not UTF-8"),
        (b"intensity,response\n", "line 2: the table has no row"),
        (b"", "line 1: column intensity is missing"),
    ];
    for (bytes, expected) in cases {
        let message = refusal(bytes, read_responses);
        assert!(message.starts_with(expected), "{expected}: {message}");
    }
}

#[test]
fn every_damage_to_a_table_of_counts_is_named() {
    let cases: [(&[u8], &str); 9] = [
        (b"level,n_correct,n_total\n0.1,3,5\n0,4,5\n", "line 3: level is 0;"),
        (b"level,n_correct,n_total\n1e300,3,5\n", "line 2: level is 1"),
        (b"level,n_correct,n_total\ninf,3,5\n", "line 2: level is inf;"),
        (b"level,n_correct,n_total\n1,3,1e300\n", "line 2: n_correct is 3 of n_total 1"),
        (b"level,n_correct,n_total\n1,2.5,5\n", "line 2: n_correct is 2.5 of n_total 5;"),
        (b"level,n_correct,n_total\n1,-1,5\n", "line 2: n_correct is -1 of n_total 5;"),
        (b"level,n_correct,n_total\n1,1,NaN\n", "line 2: n_correct is 1 of n_total NaN;"),
        (b"level,n_correct,n_total\n1,one,5\n", "line 2: n_correct is \"one\";"),
        (b"level,n_correct,n_total\n1,3,5\n\n2,\xc3(,5\n", "line 4: bytes that are not UTF-8"),
    ];
    for (bytes, expected) in cases {
        let message = refusal(bytes, read_count_table);
        assert!(message.starts_with(expected), "{expected}: {message}");
    }
}

/// A configuration with one line a key.
fn config(change: &str, to: &str) -> Vec<u8> {
    let text = "{\n\"tGuess\": 0,\n\"tGuessSd\": 1,\n\"pThreshold\": 0.82,\n\"beta\": 3.5,\n\"delta\": 0.01,\n\"gamma\": 0.5\n}\n";
    assert!(text.contains(change), "{change}");
    text.replacen(change, to, 1).into_bytes()
}

#[test]
fn every_damage_to_a_configuration_is_named() {
    let cases = [
        (config("\"beta\": 3.5,\n", ""), "line 7: missing field `beta`"),
        (config("\"beta\": 3.5", "\"bета\": 3.5"), "line 5: unknown field"),
        (config("\"beta\": 3.5", "\"beta\": \"3.5\""), "line 5: invalid type"),
        (config("\"beta\": 3.5", "\"beta\": 1e400"), "line 5: number out of range"),
        (config("\"beta\": 3.5", "\"beta\": -1"), "line 5: beta is -1"),
        (config("\"delta\": 0.01", "\"delta\": 1"), "line 6: delta is 1"),
        (config("\"tGuessSd\": 1", "\"tGuessSd\": 0"), "line 3: tGuessSd is 0"),
        (config("0.82", "0.5"), "line 4: threshold probability is 0.5"),
        (config("\"beta\": 3.5", "\"range\": 0.02,\n\"beta\": 0.1"), "line 5: range is"),
        (config("\"beta\"", "\"range\": 1e9,\n\"beta\""), "line 5: range / grain"),
        (b"[1, 2]".to_vec(), "line 1: "),
        (b"{\n\xff}".to_vec(), "line 2: bytes that are not UTF-8"),
        (Vec::new(), "line 1: EOF"),
    ];
    for (bytes, expected) in cases {
        let message = refusal(&bytes, read_quest_config);
        assert!(message.starts_with(expected), "{expected}: {message}");
    }
}

#[test]
fn an_answer_that_no_threshold_explains_is_named_with_its_line() {
    // Hits at the table's lower end, with neither guesses nor slips, leave nothing of a high threshold.
    let never_slips = file(&config("\"delta\": 0.01,\n\"gamma\": 0.5", "\"delta\": 0,\n\"gamma\": 0"));
    let config = read_quest_config(never_slips.path()).unwrap();
    let table = file(format!("intensity,response\n\n{}1e300,0\n2,1\n", "-1e300,1\n".repeat(30)).as_bytes());
    let answers = read_responses(table.path()).unwrap();
    let error = write_summaries(&config, &answers, [never_slips.path(), table.path()], Vec::new()).unwrap_err();
    let message = error.to_string();
    assert!(message.contains(": line 33: ") && message.contains("allowed"), "{message}");
}

#[test]
fn spaces_a_mark_of_byte_order_other_columns_and_line_ends_are_taken() {
    let table = file(b"\xef\xbb\xbfnote, response ,intensity\r\n\"a, b\",1, -0.5\r\n,0,1e-3\r\n");
    let answers = read_responses(table.path()).unwrap();
    let numbers: Vec<(f64, bool)> = answers.iter().map(|answer| (answer.intensity, answer.response)).collect();
    assert_eq!(numbers, [(-0.5, true), (0.001, false)]);
}

/// Bytes that begin like a table and go on anyhow.
fn almost_a_table(header: &'static str) -> impl Strategy<Value = Vec<u8>> {
    let cell = prop_oneof![
        Just("0".to_owned()),
        Just("1".to_owned()),
        any::<f64>().prop_map(|number| number.to_string()),
        "[ -~]{0,6}",
    ];
    let row = proptest::collection::vec(cell, 1..5).prop_map(|cells| cells.join(","));
    let rows = proptest::collection::vec(row, 0..6).prop_map(|rows| rows.join("\n"));
    (rows, proptest::collection::vec(any::<u8>(), 0..8)).prop_map(move |(rows, tail)| {
        let mut bytes = format!("{header}\n{rows}").into_bytes();
        bytes.extend(tail);
        bytes
    })
}

proptest! {
    #[test]
    fn arbitrary_bytes_are_read_or_refused(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
        let file = file(&bytes);
        let _ = read_responses(file.path());
        let _ = read_count_table(file.path());
        let _ = read_quest_config(file.path());
    }

    #[test]
    fn what_is_almost_a_table_is_read_or_refused(
        responses in almost_a_table("intensity,response"),
        counts in almost_a_table("level,n_correct,n_total"),
    ) {
        if let Ok(answers) = read_responses(file(&responses).path()) {
            prop_assert!(answers.iter().all(|answer| answer.intensity.is_finite()));
        }
        if let Ok(counts) = read_count_table(file(&counts).path()) {
            prop_assert!(counts.iter().all(|count| count.x.is_finite() && count.correct <= count.total));
        }
    }

    #[test]
    fn any_counts_have_a_finite_fit_or_a_reason(
        rows in proptest::collection::vec((-12.0..12.0_f64, 0.0..=1.0_f64, 0..6), 1..7),
        guess in 0.0..0.8_f64,
        lapse in prop_oneof![Just(Parameter::Free), (0.0..0.2_f64).prop_map(Parameter::Fixed)],
    ) {
        let count = |(x, share, digits): (f64, f64, i32)| {
            let total = 10_f64.powi(digits).floor();
            Count { x, correct: (share * total).round(), total }
        };
        let counts: Vec<Count> = rows.into_iter().map(count).collect();
        match fit_count_table(&counts, guess, lapse) {
            Ok(fit) => prop_assert!(
                [fit.threshold_t, fit.slope_beta, fit.lapse, fit.nll, fit.deviance, fit.se_t].iter().all(|v| v.is_finite()),
                "{fit:?}"
            ),
            Err(error) => prop_assert!(!error.to_string().is_empty()),
        }
    }

    #[test]
    fn any_configuration_is_answered_with_finite_numbers_or_refused(
        t_guess in -1e3..1e3_f64,
        t_guess_sd in 1e-3..1e3_f64,
        p_threshold in 0.0..1.0_f64,
        beta in 0.1..20.0_f64,
        delta in 0.0..1.0_f64,
        gamma in 0.0..1.0_f64,
        grain in 0.001..0.5_f64,
        range in 0.1..10.0_f64,
        answers in proptest::collection::vec((-5.0..5.0_f64, any::<bool>()), 0..20),
    ) {
        let json = format!(
            "{{\"tGuess\": {t_guess}, \"tGuessSd\": {t_guess_sd}, \"pThreshold\": {p_threshold}, \"beta\": {beta}, \
             \"delta\": {delta}, \"gamma\": {gamma}, \"grain\": {grain}, \"range\": {range}}}"
        );
        let config_file = file(json.as_bytes());
        let Ok(config) = read_quest_config(config_file.path()) else { return Ok(()) };
        let rows: String = answers.iter().map(|(x, response)| format!("{},{}\n", x + t_guess, u8::from(*response))).collect();
        let table = file(format!("intensity,response\n{}0,1\n", rows).as_bytes());
        let answers = read_responses(table.path()).unwrap();
        let mut out = Vec::new();
        match write_summaries(&config, &answers, [config_file.path(), table.path()], &mut out) {
            Ok(()) => {
                let text = String::from_utf8(out).unwrap();
                prop_assert_eq!(text.lines().count(), answers.len() + 2);
                prop_assert!(!text.contains("NaN") && !text.contains("inf"), "{}", text);
            }
            Err(error) => prop_assert!(error.to_string().contains("probability 0"), "{error}"),
        }
    }
}
