//! A picture of the panel in each of its states.
//!
//! `UPDATE_SNAPSHOTS=true cargo test -p scumble-study` draws them anew. The comparison is kittest's own, threshold 0.6
//! a pixel and no pixel above it: type is rasterised on the CPU, so that drivers differ by rounding at the feathered
//! edges of marks and bands, which stays far below a visible change of colour.

use eframe::egui::Vec2;
use egui_kittest::Harness;
use scumble_psychophysics::{Event, Language, Stage};

use super::testing::{Rehearsed, harness};
use super::{DeskState, Disk, Status};

/// Draws the panel of a laptop's size, with the keyboard at rest.
fn shot(status: Status, desk: DeskState, language: Language, name: &str) {
    let mut harness = panel(status, desk, language);
    harness.snapshot(format!("desk_{name}"));
}

fn panel(status: Status, desk: DeskState, language: Language) -> Harness<'static, super::testing::Shown> {
    let mut harness = harness(status, desk, language, Vec2::new(1280.0, 720.0), 1.0);
    harness.run_steps(3);
    harness
}

fn light() -> DeskState {
    DeskState { is_dark: false, ..DeskState::default() }
}

/// In the second round, with a note.
fn mid_round(protocol: &str) -> Rehearsed {
    let mut session = Rehearsed::new(protocol).until(|experiment| {
        matches!(experiment.stage(), Stage::Trial(trial) if trial.round == 2)
            && experiment.tracks()[3..6].iter().all(|track| track.trials() >= 8)
    });
    session.events.push(Event::Note(session.moment("A door slammed in the corridor.")));
    session
}

#[test]
fn practice_has_no_points_yet_and_says_what_cannot_be_ordered() {
    let session =
        Rehearsed::new("two-alternative").until(|experiment| matches!(experiment.stage(), Stage::Practice(_)));
    shot(session.status(), DeskState::default(), Language::English, "practice");
}

#[test]
fn in_the_middle_of_a_round_the_charts_converge() {
    shot(mid_round("two-alternative").status(), DeskState::default(), Language::English, "dark");
}

#[test]
fn the_light_panel_shows_an_earlier_round() {
    let desk = DeskState { chosen_round: Some(1), ..light() };
    shot(mid_round("two-alternative").status(), desk, Language::English, "light");
}

#[test]
fn ending_the_session_is_asked_about_in_place() {
    let mut harness = panel(mid_round("two-alternative").status(), DeskState::default(), Language::English);
    harness.key_press(eframe::egui::Key::F9);
    harness.run_steps(3);
    harness.snapshot("desk_confirm");
}

#[test]
fn the_german_panel_of_single_pictures_counts_false_alarms() {
    shot(mid_round("yes-no").status(), light(), Language::German, "german");
}

#[test]
fn a_disk_that_refuses_answers_is_said_at_the_top() {
    let disk = Disk::Waiting { problem: "study1/p07/events.jsonl: No space left on device".to_owned() };
    shot(mid_round("two-alternative").status_of(true, disk), DeskState::default(), Language::English, "waiting");
}

#[test]
fn what_the_program_cannot_work_around_is_said_at_the_top() {
    let stopped = Some("the picture of trial 71 cannot be drawn".to_owned());
    let status = Status { stopped, ..mid_round("two-alternative").status() };
    shot(status, DeskState::default(), Language::English, "stopped");
}

#[test]
fn a_display_other_than_the_first_is_said_at_the_top() {
    let other_display = Some("HDMI-1, 1920 x 1080 pixels, scale factor 1.00, 59.94 Hz".to_owned());
    let status = Status { other_display, ..mid_round("two-alternative").status() };
    shot(status, DeskState::default(), Language::English, "other_display");
}

#[test]
fn an_order_that_came_too_late_is_said_above_the_orders() {
    let status = Status { refused_round: Some(1), ..mid_round("two-alternative").status() };
    shot(status, DeskState::default(), Language::German, "too_late");
}

#[test]
#[ignore = "writes large pictures to look at into the temporary folder"]
fn at_3840_by_2160_and_in_a_narrow_window() {
    let large = Vec2::new(3840.0, 2160.0);
    let narrow = Vec2::new(640.0, 1100.0);
    for (name, size_px, pixels_per_point) in
        [("desk_4k_scale_2", large, 2.0), ("desk_4k_scale_1", large, 1.0), ("desk_narrow", narrow, 1.0)]
    {
        let size = size_px / pixels_per_point;
        let status = mid_round("two-alternative").status();
        let mut harness = harness(status, DeskState::default(), Language::English, size, pixels_per_point);
        harness.run_steps(3);
        harness.render().unwrap().save(std::env::temp_dir().join(format!("{name}.png"))).unwrap();
    }
}
