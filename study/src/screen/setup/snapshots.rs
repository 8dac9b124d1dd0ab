//! A picture of every page.
//!
//! `UPDATE_SNAPSHOTS=true cargo test -p scumble-study` draws them anew. The comparison is kittest's own: a pixel
//! fails where its colour is visibly another one, no pixel may fail. Type is rasterised on the CPU and every other
//! edge lies on whole pixels or is feathered by the mesh, so that drivers differ in rounding alone.

use std::path::Path;

use eframe::egui::Vec2;
use egui_kittest::SnapshotOptions;
use scumble_psychophysics::{Experience, Language, Vision};

use super::testing::*;
use crate::session_folder::Found;
use crate::setup::{Given, RecentFolders, Setup};

fn shot(setup: Setup, name: &str) {
    let mut harness = settled(setup);
    harness.snapshot(format!("setup_{name}"));
}

#[test]
fn the_first_page_shows_a_new_study() {
    shot(Setup::new(given(Path::new(NEW_WHOLE))), "study");
}

#[test]
fn the_first_page_offers_recent_studies_to_who_names_none() {
    let mut recent = RecentFolders::default();
    // Folders of this crate, so that they are there.
    ["src", "tests", "tests/setup", MEASURED].iter().for_each(|folder| recent.remember_as(Path::new(folder)));
    let setup = Setup::new(Given { recent, participant: String::new(), ..given(Path::new("")) });
    shot(setup, "recent");
}

#[test]
fn the_first_page_says_how_to_go_on_with_an_interrupted_session() {
    let find = Box::new(|study: &Path, code: &str| Ok(Found::Interrupted(interrupted(study.join(code)))));
    let setup = Setup::new(Given { find, ..given(Path::new(NEW_WHOLE)) });
    shot(setup, "interrupted");
}

#[test]
fn the_first_page_names_what_is_wrong() {
    let participant = "Erika Mustermann".to_owned();
    shot(Setup::new(Given { participant, ..given(Path::new(NEW_WHOLE)) }), "problem");
}

#[test]
fn the_screen_page_shows_card_and_sizes() {
    let mut setup = after(new_study(), 1);
    setup.calibration.distance_cm = "60".to_owned();
    setup.calibration.set_matched(true, 1.0);
    shot(setup, "screen");
}

#[test]
fn the_brightness_page_shows_rows_beside_a_grey() {
    let mut setup = after(new_study(), 2);
    setup.gamma.lighten(46);
    setup.gamma.matched = true;
    shot(setup, "brightness");
}

#[test]
fn the_brightness_page_says_what_to_do_with_a_display_that_is_not_srgb() {
    let mut setup = after(new_study(), 2);
    setup.gamma.lighten(32);
    setup.gamma.matched = true;
    shot(setup, "brightness_not_srgb");
}

#[test]
fn the_brightness_page_shows_a_measured_curve() {
    shot(after(Setup::new(given(Path::new(MEASURED))), 2), "brightness_measured");
}

#[test]
fn the_room_page_says_what_to_write() {
    shot(after(new_study(), 3), "room");
}

#[test]
fn the_consent_page_shows_the_text() {
    shot(after(Setup::new(given(Path::new(MEASURED))), 4), "consent");
}

#[test]
fn who_does_not_agree_is_told_that_nothing_was_recorded() {
    let mut setup = after(Setup::new(given(Path::new(MEASURED))), 4);
    setup.decline();
    shot(setup, "declined");
}

#[test]
fn the_page_about_the_participant_may_stay_empty() {
    let mut setup = after(new_study(), 4);
    setup.about.vision = Some(Vision::Corrected);
    shot(setup, "about");
}

/// A set-up in which something is measured and something is not, on its last page.
fn filled_in(language: Language) -> Setup {
    let mut setup = Setup::new(Given { language, ..given(Path::new(MEASURED)) });
    setup.calibration.distance_cm = "60".to_owned();
    setup.room = "Ceiling lamps off, blinds closed, no reflections.".to_owned();
    let mut setup = after(setup, 4);
    setup.agree(jiff::Timestamp::from_second(1_800_000_000).unwrap());
    setup.about.age = "27".to_owned();
    setup.about.graphics_experience = Some(Experience::Some);
    after(setup, 1)
}

#[test]
fn the_summary_shows_what_will_be_recorded_and_what_is_missing() {
    shot(filled_in(Language::English), "summary");
}

#[test]
fn the_summary_says_that_the_window_is_not_on_the_chosen_monitor() {
    let mut setup = filled_in(Language::English);
    let [chosen, other] = [0, 1].map(|index| setup.monitors().0[index].clone());
    for found in [None, Some(chosen)] {
        setup.find_on(found);
        assert_eq!(setup.elsewhere(), None);
    }
    setup.find_on(Some(other));
    shot(setup, "summary_elsewhere");
}

#[test]
fn the_first_page_fits_the_german_words() {
    shot(Setup::new(Given { language: Language::German, ..given(Path::new(NEW_WHOLE)) }), "study_german");
}

#[test]
fn the_summary_fits_the_german_words() {
    shot(filled_in(Language::German), "summary_german");
}

#[test]
fn a_screen_of_3840_by_2160_has_larger_type_and_the_same_page() {
    let mut setup = after(new_study(), 1);
    setup.calibration.distance_cm = "60".to_owned();
    let mut harness = harness(setup, Vec2::new(3840.0, 2160.0), 1.0);
    harness.run();
    let picture = harness.render().unwrap();
    let quarter = image::imageops::resize(&picture, 960, 540, image::imageops::FilterType::Triangle);
    if let Err(error) = egui_kittest::try_image_snapshot(&quarter, "setup_screen_4k") {
        panic!("{error}");
    }
}

#[test]
fn a_picture_with_another_letter_fails_the_comparison() {
    if std::env::var_os("UPDATE_SNAPSHOTS").is_some() {
        return; // The comparison would write its own answer.
    }
    let known = tempfile::tempdir().unwrap();
    let name = "setup_study.png";
    std::fs::copy(Path::new("tests/snapshots").join(name), known.path().join(name)).unwrap();
    let options = SnapshotOptions::new().output_path(known.path());
    for (code, is_known) in [("p07", true), ("p01", false)] {
        let mut harness = settled(Setup::new(Given { participant: code.to_owned(), ..given(Path::new(NEW_WHOLE)) }));
        let picture = harness.render().unwrap();
        assert_eq!(egui_kittest::try_image_snapshot_options(&picture, "setup_study", &options).is_ok(), is_known);
    }
}

#[test]
fn rows_are_physical_pixels_and_the_grey_is_the_level_at_any_scale_factor() {
    for scale in [1.0, 1.25, 1.5, 2.0] {
        let mut setup = after(new_study(), 2);
        setup.gamma.lighten(46);
        let level = setup.gamma.level();
        let mut harness = harness(setup, Vec2::new(1280.0, 720.0), scale);
        harness.run();
        let picture = harness.render().unwrap();
        let grey = |x: u32, y: u32| picture.get_pixel(x, y).0[0];
        // Down a column through the rows, and one through the grey.
        let [rows_x, grey_x] = [200.0, 520.0].map(|x| (x * scale) as u32);
        let [top, bottom] = [150.0, 350.0].map(|y| (y * scale) as u32);
        let alternate = (top..bottom).all(|y| [grey(rows_x, y), grey(rows_x, y + 1)].iter().sum::<u8>() == 255);
        assert!(alternate, "rows at {scale}: {:?}", (top..top + 9).map(|y| grey(rows_x, y)).collect::<Vec<_>>());
        assert!((top..bottom).all(|y| grey(grey_x, y) == level), "grey at {scale}");
    }
}
