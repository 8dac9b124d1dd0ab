//! Pictures of the participant's screens, compared with those in `tests/snapshots`.
//!
//! `UPDATE_SNAPSHOTS=true cargo test -p scumble-study` draws them anew.

use std::time::Duration;

use eframe::egui::Ui;
use egui_kittest::{Harness, SnapshotResults};
use scumble_psychophysics::{Answer, Experiment, Language, Protocol, Task};
use scumble_stimuli::Transfer;

use super::*;
use crate::presentation::{Presentation, Screen};
use crate::theme;
use crate::words::words;

/// Draws a screen of 1280 x 720 points, the smallest that holds two pictures, and compares it.
///
/// The comparison is kittest's own: a pixel fails where its colour is visibly another one, no pixel may
/// fail. Type is rasterised on the CPU, so that drivers differ in rounding alone.
fn check(results: &mut SnapshotResults, name: &str, mut show: impl FnMut(&mut Ui)) {
    let draw = |ui: &mut Ui| {
        theme::dress_screen(ui);
        show(ui);
    };
    let mut harness =
        Harness::builder().with_size([1280.0, 720.0]).with_context_setup(theme::apply).wgpu().build_ui(draw);
    harness.run_steps(2);
    harness.snapshot(format!("participant_{name}"));
    results.extend_harness(&mut harness);
}

const LANGUAGES: [(&str, Language); 2] = [("en", Language::English), ("de", Language::German)];

#[test]
fn instructions_look_as_they_did() {
    let mut results = SnapshotResults::new();
    for (code, language) in LANGUAGES {
        for name in ["two-alternative", "yes-no"] {
            let (protocol, mut examples) = (Protocol::named(name).unwrap(), Examples::default());
            check(&mut results, &format!("instructions_{name}_{code}"), |ui| {
                _ = instructions(ui, &mut examples, &protocol, &words(language).participant).unwrap();
            });
        }
    }
}

#[test]
fn trials_look_as_they_did() {
    let mut results = SnapshotResults::new();
    for name in ["two-alternative", "yes-no"] {
        let mut protocol = Protocol::named(name).unwrap();
        protocol.pictures.dithered = false;
        let mut experiment = Experiment::new(protocol, 1, 1).unwrap();
        experiment.proceed().unwrap();
        let display = Screen { size_px: [600, 480], transfer: Transfer::srgb(), refresh_hz: None };
        let mut shown = Presentation::new(*experiment.stage().trial().unwrap(), Duration::ZERO);
        check(&mut results, &format!("trial_{name}"), |ui| {
            _ = trial(ui, &mut shown, &experiment, &display, &words(Language::English).participant).unwrap();
        });
    }
}

#[test]
fn pages_between_trials_look_as_they_did() {
    let mut results = SnapshotResults::new();
    let english = &words(Language::English).participant;
    let experiment = Experiment::new(Protocol::two_alternative(), 1, 1).unwrap();
    check(&mut results, "feedback_right", |ui| _ = feedback(ui, true, Answer::Left, english));
    check(&mut results, "feedback_wrong", |ui| _ = feedback(ui, false, Answer::No, english));
    check(&mut results, "rest_first", |ui| _ = rest(ui, Task::TwoAlternative, [1, 4], false, english));
    check(&mut results, "rest_within", |ui| _ = rest(ui, Task::YesNo, [2, 4], true, english));
    check(&mut results, "paused", |ui| _ = paused(ui, experiment.progress(), english));
    check(&mut results, "finished", |ui| _ = finished(ui, english));
}

#[test]
fn the_page_before_the_administrators_panel_looks_as_it_did() {
    let mut results = SnapshotResults::new();
    for (code, language) in LANGUAGES {
        check(&mut results, &format!("in_charge_{code}"), |ui| _ = in_charge(ui, &words(language).desk));
    }
}

#[test]
fn pages_of_trouble_look_as_they_did() {
    let mut results = SnapshotResults::new();
    let english = &words(Language::English).participant;
    let problem = "/media/lab/study1/p07/events.jsonl: No space left on device (os error 28)";
    check(&mut results, "unsaved", |ui| _ = unsaved(ui, problem, english));
    check(&mut results, "stopped", |ui| _ = stopped(ui, "the picture cannot be drawn", "study1/p07".as_ref(), english));
    let mut protocol = Protocol::two_alternative();
    protocol.pictures.width_px = 900;
    check(&mut results, "too_small", |ui| assert!(too_small(ui, &protocol, english)));
}
