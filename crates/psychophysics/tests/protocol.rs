//! Protocol files: what they hold survives them, and what they refuse is named by file, line, found and
//! allowed.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

mod support;

use std::path::Path;

use scumble_psychophysics::{Experiment, Protocol, SessionHeader};
use support::{NAMES, header, named};

const FILE: &str = "study/my.toml";

/// The complaint about a file, which begins with its name.
fn complaint(text: &[u8]) -> String {
    Protocol::from_toml(Path::new(FILE), text).unwrap_err().to_string()
}

/// The text of a shipped protocol.
fn text_of(name: &str) -> String {
    std::fs::read_to_string(format!("{}/protocols/{name}.toml", env!("CARGO_MANIFEST_DIR"))).unwrap()
}

/// Asserts that the protocol with `from` replaced by `to` is refused at the line at which `at` stands, in
/// words that hold `found` and, as what is allowed, `allowed`.
fn assert_refused(name: &str, [from, to, at]: [&str; 3], [found, allowed]: [&str; 2]) {
    let text = text_of(name);
    assert!(text.contains(from), "{from}");
    let text = text.replacen(from, to, 1);
    let line = 1 + text[..text.find(at).unwrap()].matches('\n').count();
    let message = complaint(text.as_bytes());
    let (message_found, message_allowed) = message.split_once("; allowed is ").unwrap_or_else(|| panic!("{message}"));
    assert!(message_found.starts_with(&format!("{FILE}:{line}: ")), "line {line}, {to}: {message}");
    assert!(message_found.contains(found) && message_allowed.contains(allowed), "{found}, {allowed}: {message}");
}

#[test]
fn a_protocol_survives_its_file_and_the_header_of_a_session() {
    for name in NAMES {
        let mut protocol = named(name);
        for rest in [None, Some(17)] {
            protocol.schedule.rest_every_trials = rest;
            let text = protocol.to_toml().unwrap();
            assert_eq!(Protocol::from_toml(Path::new(FILE), &text).unwrap(), protocol);
            let json = serde_json::to_string_pretty(&header(protocol.clone())).unwrap();
            assert_eq!(serde_json::from_str::<SessionHeader>(&json).unwrap().protocol, protocol);
        }
    }
}

#[test]
fn a_name_on_the_command_line_gives_its_protocol_and_another_one_the_list() {
    for name in NAMES {
        assert_eq!(Protocol::open(name).unwrap().name, name);
    }
    assert_eq!(named("two-alternative"), Protocol::two_alternative());
    let error = Protocol::open("three-alternative").unwrap_err();
    let allowed = "published, two-alternative, yes-no, or a file that ends in .toml";
    assert_eq!(error.to_string(), format!("protocol is three-alternative; allowed is {allowed}"));
}

#[test]
fn a_file_on_the_command_line_gives_its_protocol_or_its_error() {
    let root = tempfile::tempdir().unwrap();
    let path = root.path().join("mine.toml");
    let open = || Protocol::open(path.to_str().unwrap());
    assert!(open().unwrap_err().to_string().contains("mine.toml: "));
    std::fs::write(&path, text_of("yes-no")).unwrap();
    assert_eq!(open().unwrap(), named("yes-no"));
    std::fs::write(&path, b"name = 'a'\n\ntask = '\xff'\n").unwrap();
    let message = open().unwrap_err().to_string();
    assert!(message.contains("mine.toml:3: bytes that are not UTF-8; allowed is text in UTF-8"), "{message}");
}

#[test]
fn line_ends_of_windows_and_a_byte_order_mark_are_text_all_the_same() {
    let text = text_of("yes-no").replace('\n', "\r\n");
    assert_eq!(Protocol::from_toml(Path::new(FILE), &text).unwrap(), named("yes-no"));
    let text = format!("\u{feff}{}", text_of("yes-no"));
    assert_eq!(Protocol::from_toml(Path::new(FILE), &text).unwrap(), named("yes-no"));
}

#[test]
fn the_three_protocols_differ_where_their_comments_say_so() {
    let (published, two, yes_no) = (named("published"), named("two-alternative"), named("yes-no"));
    for protocol in [&published, &two, &yes_no] {
        // Kreuzer 2017, 4.1.3 and 4.2: two patterns, two contrasts, three texels, the parameters of QUEST.
        assert_eq!(protocol.rounds().len(), 4);
        assert_eq!(protocol.all_conditions().len(), 12);
        assert_eq!(protocol.conditions.texels_px, [5.0, 10.0, 20.0]);
        let staircase = &protocol.staircase;
        assert_eq!((staircase.slope_per_log10, staircase.lapse_probability), (Some(3.5), Some(0.01)));
        assert_eq!(protocol.schedule.trials_min, 10);
    }
    for protocol in [&published, &two] {
        let staircase = &protocol.staircase;
        assert_eq!((staircase.threshold_probability, staircase.guess_probability), (0.82, 0.5));
    }
    assert!(!published.pictures.dithered && published.pictures.tilt_range_rad == 0.0);
    assert!(published.line_trials.is_none() && published.catch_trials.is_none());
    // p = delta gamma + (1 - delta) (1 - (1 - gamma) e), with the e that gives 0.82 at gamma 0.5.
    let missed = 2.0 * (1.0 - (0.82 - 0.005) / 0.99);
    let gamma = yes_no.staircase.guess_probability;
    let equal = 0.01 * gamma + 0.99 * (1.0 - (1.0 - gamma) * missed);
    assert!((yes_no.staircase.threshold_probability - equal).abs() < 5e-4, "{equal}");
    assert!((1.0 - missed - 0.65).abs() < 0.005, "65 % are seen");
}

#[test]
fn what_is_no_toml_is_refused_at_its_line() {
    for (edit, complaint) in [
        (["width_px = 600", "width_px 600", "width_px 600"], ["", ""]),
        (["width_px = 600", "width_px = ", "width_px = "], ["", ""]),
        (["[schedule]", "[schedule", "[schedule"], ["", ""]),
        (["name = \"yes-no\"", "name = \"yes-no", "name = \"yes-no"], ["", ""]),
        (["height_px = 480", "width_px = 480", "width_px = 480"], ["duplicate key", ""]),
        (["[schedule]", "[pictures]", "[pictures]\norder"], ["duplicate key", ""]),
        (["trials_max = 24", "trials_max = 99999999999999999999", "trials_max = 9999"], ["", ""]),
        (["ratio_min = 0.5", "ratio_min = 0.5.1", "ratio_min = 0.5.1"], ["", ""]),
        (["ratio_min = 0.5", "ratio_min = 0,5", "ratio_min = 0,5"], ["", ""]),
        (["height_px = 480", "height_px = 4\u{0}80", "height_px = 4"], ["", ""]),
    ] {
        assert_refused("yes-no", edit, complaint);
    }
    let deep = format!("name = {}{}", "[".repeat(100_000), "]".repeat(100_000));
    assert!(complaint(deep.as_bytes()).starts_with(&format!("{FILE}:1: ")));
    assert!(complaint(b"").starts_with(&format!("{FILE}:1: no key name; allowed is ")));
    assert!(complaint(&[0; 64]).starts_with(&format!("{FILE}:1: ")));
}

#[test]
fn a_key_that_is_unknown_missing_or_without_its_unit_is_refused_by_name() {
    for (edit, complaint) in [
        (["width_px = 600", "width = 600", "width = 600"], ["pictures.width", "width_px"]),
        (["width_px = 600", "width_mm = 600", "width_mm = 600"], ["pictures.width_mm", "width_px"]),
        (["tilt_range_rad", "tilt_range_deg", "tilt_range_deg"], ["tilt_range_deg", "tilt_range_rad"]),
        (["texels_px = [", "texels = [", "texels = ["], ["conditions.texels", "texels_px"]),
        (["trials_max", "trial_max", "trial_max"], ["schedule.trial_max", "trials_max"]),
        (["[schedule]", "[schedules]", "[schedules]"], ["schedules", "schedule"]),
        (["name =", "nmae =", "nmae ="], ["nmae", "name"]),
        (["height_px = 480\n", "", "[pictures]"], ["no key pictures.height_px", "pictures.height_px"]),
        (["ratios = [0.5", "#", "[practice]"], ["no key practice.ratios", ""]),
        (["share = 0.5", "", "[line_trials]"], ["no key line_trials.share", ""]),
        (["prior_ratios = [3.0]\n", "", "[staircase]"], ["no key staircase.prior_ratios", ""]),
        (["slope_per_log10 = 3.5\n", "", "[staircase]"], ["slope_per_log10 is missing", "quest"]),
        (
            ["method = \"quest\"", "method = \"quest_plus\"", "slope_per_log10 ="],
            ["slope_per_log10 is given", "slopes"],
        ),
    ] {
        assert_refused("yes-no", edit, complaint);
    }
}

#[test]
fn a_value_of_another_type_is_refused_by_its_key() {
    for (edit, complaint) in [
        (
            ["width_px = 600", "width_px = \"600\"", "width_px = \""],
            ["pictures.width_px is string \"600\"", "whole number"],
        ),
        (["width_px = 600", "width_px = 600.5", "width_px = 600.5"], ["pictures.width_px", "whole number"]),
        (["width_px = 600", "width_px = -600", "width_px = -600"], ["-600", "whole number from 0"]),
        (["width_px = 600", "width_px = 4294967296", "width_px = 4"], ["4294967296", "to 4294967295"]),
        (["dithered = true", "dithered = 1", "dithered = 1"], ["pictures.dithered", "true or false"]),
        (["task = \"yes_no\"", "task = \"yes-no\"", "task ="], ["task is `yes-no`", "two_alternative or yes_no"]),
        (["\"step\"", "\"steps\"", "patterns ="], ["conditions.patterns[1] is `steps`", "step, double_step"]),
        (["\"disc\"", "\"disk\"", "kernels ="], ["conditions.kernels[0] is `disk`", "poisson25_rotated"]),
        (["[1.0, 0.5]", "1.0", "contrasts ="], ["conditions.contrasts", "list"]),
        (["[1.0, 0.5]", "[1.0, \"half\"]", "contrasts ="], ["conditions.contrasts[1]", "a number"]),
        (["order = \"latin_square\"", "order = \"sorted\"", "order ="], ["schedule.order", "random or latin_square"]),
        (["[line_trials]", "[[line_trials]]", "[[line_trials]]"], ["line_trials", ""]),
        (["[practice]", "[practice.more]", "[practice.more]"], ["practice.more", ""]),
    ] {
        assert_refused("yes-no", edit, complaint);
    }
}

#[test]
fn a_value_out_of_range_is_refused_at_its_line() {
    for (edit, complaint) in [
        (["[1.0, 0.5]", "[\n1.0,\n0.0]", "0.0]"], ["conditions.contrasts[1] is 0", "above 0 to 1"]),
        (["[1.0, 0.5]", "[1.5]", "contrasts ="], ["conditions.contrasts[0] is 1.5", "above 0 to 1"]),
        (["[1.0, 0.5]", "[]", "contrasts ="], ["conditions.contrasts is empty", "at least one"]),
        (["[1.0, 0.5]", "[1.0, nan]", "contrasts ="], ["conditions.contrasts[1] is NaN", "above 0"]),
        (["[5.0, 10.0, 20.0]", "[5.0, 240.0]", "texels_px ="], ["conditions.texels_px[1] is 240", "half the picture"]),
        (["[5.0, 10.0, 20.0]", "[-5.0]", "texels_px ="], ["conditions.texels_px[0] is -5", "1 pixel or more"]),
        (["[5.0, 10.0, 20.0]", "[1e-320]", "texels_px ="], ["conditions.texels_px[0] is 1e-320", "1 pixel or more"]),
        (["[3.0]", "[3.0, -3.0]", "prior_ratios ="], ["staircase.prior_ratios[1] is -3", "0.001 to 1000"]),
        (["width_px = 600", "width_px = 0", "width_px ="], ["pictures.width_px is 0", "1 to 16384"]),
        (["height_px = 480", "height_px = 100000", "height_px ="], ["pictures.height_px is 100000", "1 to 16384"]),
        (["ratio_min = 0.5", "ratio_min = 0", "ratio_min ="], ["pictures.ratio_min is 0", "0.001 to 1000"]),
        (["ratio_min = 0.5", "ratio_min = 1e308", "ratio_min ="], ["pictures.ratio_min is 1e308", "0.001 to 1000"]),
        (["tilt_range_rad = 0.1", "tilt_range_rad = 2.0", "tilt_range_rad ="], ["tilt_range_rad is 2", "0 to 0.2 rad"]),
        (["trials_min = 10", "trials_min = 0", "trials_min ="], ["schedule.trials_min is 0", "1 or more"]),
        (["rest_every_trials = 60", "rest_every_trials = 0", "rest_every"], ["rest_every_trials is 0", "no such key"]),
        (["prior_sd_log10 = 0.6", "prior_sd_log10 = 0.0", "prior_sd"], ["staircase.prior_sd_log10 is 0", "above 0"]),
        (
            ["threshold_probability = 0.712", "threshold_probability = 0.1", "threshold"],
            ["threshold_probability is 0.1", "between"],
        ),
        (["table_step_log10 = 0.01", "table_step_log10 = 1e-6", "[staircase]"], ["", "table points"]),
        (
            ["table_width_log10 = 5.0", "table_width_log10 = 50.0", "table_width"],
            ["table_width_log10 is 50", "0 to 20"],
        ),
        (
            ["interval_width_log10 = 0.3", "interval_width_log10 = -1", "interval"],
            ["convergence.interval_width", "above 0"],
        ),
        (["name = \"yes-no\"", "name = \" \"", "name ="], ["name is", "a word"]),
    ] {
        assert_refused("yes-no", edit, complaint);
    }
}

#[test]
fn parameters_that_contradict_each_other_are_refused_at_the_line_of_one_of_them() {
    let line_trials = "contrast = 1.0\n[line_trials]\nshare = 0.5\n";
    let edit = ["contrast = 1.0\n", line_trials, "[line_trials]"];
    assert_refused("two-alternative", edit, ["line_trials is given", "no such table with the task two_alternative"]);
    for (edit, complaint) in [
        (["trials_min = 10", "trials_min = 25", "trials_max ="], ["schedule.trials_max is 24", "trials_min to 10000"]),
        (["[1.0, 0.5]", "[1.0, 0.5, 1.0]", "contrasts ="], ["conditions.contrasts[2] is 1.0 again", "once"]),
        (
            ["\"stair\", \"step\"", "\"stair\", \"stair\"", "patterns ="],
            ["conditions.patterns[1] is Stair again", "once"],
        ),
        (["[3.0]", "[3.0, 3]", "prior_ratios ="], ["staircase.prior_ratios[1] is 3.0 again", "once"]),
        (
            ["ratio = 0.5\ntexel_px = 20.0", "ratio = 0.5\ntexel_px = 200.0", "texel_px = 200"],
            ["catch_trials.texel_px is 200", "half"],
        ),
        (["ratio = 0.5\n", "ratio = 0.4\n", "ratio = 0.4"], ["catch_trials.ratio is 0.4", "ratio_min"]),
        (["2.0, 2.0]", "2.0, 12.0]", "ratios = [0.5"], ["practice.ratios[7] is 12", "what the picture can show"]),
        (["share = 0.03", "share = 0.6", "share = 0.6"], ["catch_trials.share is 0.6", "above 0 to 0.5"]),
        (["share = 0.5", "share = 1.0", "share = 1.0"], ["line_trials.share is 1", "above 0 to 0.9"]),
    ] {
        assert_refused("yes-no", edit, complaint);
    }
}

#[test]
fn more_staircases_than_anyone_answers_are_refused() {
    let mut protocol = named("two-alternative");
    protocol.conditions.texels_px = (1..=251).map(|index| f64::from(index) * 0.1).collect();
    let message = Experiment::new(protocol, 1, 0).unwrap_err().to_string();
    assert!(message.starts_with("conditions is 1004 staircases"), "{message}");
}

#[test]
fn the_prior_is_three_texels_and_the_intensity_the_negative_logarithm_of_the_ratio() {
    let staircase = Protocol::two_alternative().staircase_at(3.0).unwrap();
    assert!((staircase.mean() + 3f64.log10()).abs() < 1e-12);
    assert!((staircase.sd() - 0.6).abs() < 1e-3);
}
