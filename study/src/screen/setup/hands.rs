//! What keys, mouse and dropped folders do on the pages.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use eframe::egui::{self, Key, Modifiers, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use scumble_psychophysics::Protocol;

use super::testing::*;
use crate::arguments::ResumePolicy;
use crate::session_folder::Found;
use crate::setup::{Given, Page, RecentFolders, Setup, SetupAction};

fn press(harness: &mut Harness<'static, Shown>, keys: &[Key]) {
    for key in keys {
        harness.key_press(*key);
        harness.step();
    }
}

#[test]
fn the_keyboard_alone_reaches_the_start() {
    let mut harness = at_720(new_study());
    harness.run();
    press(&mut harness, &[Key::Enter]);
    assert_eq!(harness.state().0.page(), Page::Screen);
    harness.event(egui::Event::Text("60".to_owned()));
    harness.step();
    press(&mut harness, &[Key::Enter]);
    press(&mut harness, &[Key::ArrowRight, Key::ArrowRight]);
    harness.key_press_modifiers(Modifiers::SHIFT, Key::ArrowLeft);
    harness.step();
    press(&mut harness, &[Key::Enter]);
    assert_eq!(harness.state().0.calibration.px_per_mm(), Some(333.0 / 85.6));
    assert_eq!(harness.state().0.calibration.distance_mm(), Ok(Some(600.0)));
    press(&mut harness, &[Key::Enter]);
    assert_eq!(harness.state().0.page(), Page::Brightness);
    press(&mut harness, &[Key::ArrowUp, Key::ArrowDown, Key::ArrowUp, Key::Enter]);
    assert_eq!(harness.state().0.gamma.matched_level(), Some(144));
    press(&mut harness, &[Key::Enter]);
    assert_eq!(harness.state().0.page(), Page::Room);
    press(&mut harness, &[Key::Enter, Key::Tab, Key::Enter]);
    assert_eq!(harness.state().0.page(), Page::About);
    press(&mut harness, &[Key::Enter]);
    assert_eq!(harness.state().0.page(), Page::Summary);
    press(&mut harness, &[Key::Enter]);
    let Some(SetupAction::Done(ready)) = harness.state_mut().1.pop() else { panic!("not done") };
    assert_eq!((ready.participant.as_str(), ready.study.protocol()), ("p07", &Protocol::two_alternative()));
    assert_eq!(ready.measured.gamma_check_level, Some(144));
}

fn asked(mut harness: Harness<'static, Shown>) -> Option<SetupAction> {
    harness.run_steps(2);
    harness.state_mut().1.pop()
}

#[test]
fn the_outlines_edge_is_dragged_by_the_pixels_of_the_mouse_at_any_scale_factor() {
    for scale in [1.0, 1.25, 2.0] {
        let mut harness = harness(after(new_study(), 1), Vec2::new(1280.0, 720.0), scale);
        harness.run_steps(2);
        let before = harness.state().0.calibration.card_width_px(scale.into());
        let edge = harness.get_by_label("Outline of a card").rect().right_center() - Vec2::new(4.0, 0.0);
        harness.drag_at(edge);
        harness.step();
        for moved_px in [10.0, 25.0, 40.0] {
            harness.hover_at(edge + Vec2::new(moved_px / scale, 0.0));
            harness.step();
        }
        harness.drop_at(edge + Vec2::new(40.0 / scale, 0.0));
        harness.step();
        assert_eq!(harness.state().0.calibration.card_width_px(scale.into()), before + 40, "at {scale}");
    }
}

#[test]
fn a_number_key_picks_a_recent_study_unless_it_is_typed_into_a_line() {
    let mut recent = RecentFolders::default();
    ["src", MEASURED].iter().for_each(|folder| recent.remember_as(Path::new(folder)));
    let setup = |recent: &RecentFolders| Setup::new(Given { recent: recent.clone(), ..given(Path::new("")) });
    let mut harness = at_720(setup(&recent));
    press(&mut harness, &[Key::Num2]);
    assert_eq!(harness.state().0.study().folder(), "src");

    let mut typed_into = at_720(setup(&recent));
    typed_into.key_press_modifiers(Modifiers::SHIFT, Key::Tab);
    typed_into.step();
    press(&mut typed_into, &[Key::Num2]);
    assert_eq!(typed_into.state().0.study().folder(), "");
}

#[test]
fn an_empty_page_has_the_keyboard_on_the_newest_study_and_without_one_in_the_line_for_a_folder() {
    let mut recent = RecentFolders::default();
    ["src", MEASURED].iter().for_each(|folder| recent.remember_as(Path::new(folder)));
    let mut harness = at_720(Setup::new(Given { recent, participant: String::new(), ..given(Path::new("")) }));
    press(&mut harness, &[Key::Enter]);
    harness.event(egui::Event::Text("p12".to_owned()));
    harness.step();
    let study = harness.state().0.study();
    assert_eq!((study.folder(), study.participant()), (MEASURED, "p12"));

    let mut harness = at_720(Setup::new(given(Path::new(""))));
    harness.event(egui::Event::Text("study1".to_owned()));
    harness.step();
    assert_eq!(harness.state().0.study().folder(), "study1");
}

#[derive(Debug)]
struct Dropped(PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        Err("a folder".to_owned())
    }
}

#[test]
fn a_folder_that_is_dropped_becomes_the_study() {
    let mut harness = at_720(Setup::new(given(Path::new(""))));
    harness.input_mut().dropped_files.push(Arc::new(Dropped(MEASURED.into())));
    harness.step();
    assert_eq!(harness.state().0.study().folder(), MEASURED);
    assert!(harness.state().0.consent_text().is_some());
}

#[test]
fn a_monitor_and_what_to_do_with_an_interrupted_session_are_asked_of_the_program() {
    let harness = at_720(new_study());
    harness.get_by_label_contains("Built-in").click();
    assert_eq!(asked(harness), Some(SetupAction::Monitor(1)));

    let offered = [
        ("Go on with it", ResumePolicy::Continue),
        ("Repeat its round", ResumePolicy::RepeatRound),
        ("Discard it", ResumePolicy::Discard),
    ];
    let directory = std::env::current_dir().unwrap().join(NEW).join("p07");
    for (label, policy) in offered {
        let find = |study: &Path, code: &str| Ok(Found::Interrupted(interrupted(study.join(code))));
        let harness = at_720(Setup::new(Given { find: Box::new(find), ..given(Path::new(NEW)) }));
        harness.get_by_label(label).click();
        assert_eq!(asked(harness), Some(SetupAction::Interrupted(directory.clone(), policy)));
    }
}

#[test]
fn the_language_is_that_of_the_very_page_it_is_chosen_on() {
    let mut harness = at_720(new_study());
    harness.get_by_label("Deutsch").click();
    harness.run_steps(2);
    assert!(harness.query_by_label("Weiter").is_some());
}

#[test]
fn who_does_not_agree_ends_the_program_and_who_agrees_goes_on() {
    let consent = || after(Setup::new(given(Path::new(MEASURED))), 4);
    let mut agrees = at_720(consent());
    press(&mut agrees, &[Key::Enter, Key::Space]);
    assert_eq!(agrees.state().0.page(), Page::Consent, "nobody agrees by a key alone");
    press(&mut agrees, &[Key::Tab, Key::Enter]);
    assert_eq!(agrees.state().0.page(), Page::About);

    let mut declines = at_720(consent());
    press(&mut declines, &[Key::Tab, Key::Tab, Key::Enter]);
    assert_eq!(declines.state().0.page(), Page::Declined);
    declines.get_by_label("Close the program").click();
    assert_eq!(asked(declines), Some(SetupAction::Quit));
}

#[test]
fn keys_move_a_text_that_is_longer_than_the_page() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("consent.txt"), "a line of the text\n".repeat(90)).unwrap();
    let mut harness = at_720(after(Setup::new(given(folder.path())), 4));
    let top = |harness: &Harness<'static, Shown>| harness.get_by_label_contains("a line of the text").rect().top();
    let before = top(&harness);
    press(&mut harness, &[Key::PageDown]);
    harness.run_steps(8);
    let below = top(&harness);
    assert!(below < before - 300.0, "{before} {below}");
    press(&mut harness, &[Key::ArrowUp, Key::PageUp]);
    harness.run_steps(8);
    assert_eq!(top(&harness), before);
}

proptest::proptest! {
    #![proptest_config(proptest::prelude::ProptestConfig::with_cases(12))]

    #[test]
    fn no_sequence_of_keys_leads_to_a_page_without_a_way_back(keys in proptest::collection::vec(0..KEYS.len(), 1..60)) {
        let mut harness = at_720(Setup::new(given(Path::new(MEASURED))));
        for key in keys {
            press(&mut harness, &[KEYS[key]]);
        }
        for _ in 0..7 {
            press(&mut harness, &[Key::Escape]);
        }
        proptest::prop_assert_eq!(harness.state().0.page(), Page::Study);
    }
}

/// What a hand does that knows nothing of the pages, with the keys that move on among them often.
const KEYS: [Key; 16] = [
    Key::Tab,
    Key::Tab,
    Key::Tab,
    Key::Enter,
    Key::Enter,
    Key::Enter,
    Key::Space,
    Key::ArrowUp,
    Key::ArrowDown,
    Key::ArrowLeft,
    Key::ArrowRight,
    Key::Escape,
    Key::Backspace,
    Key::PageDown,
    Key::Num1,
    Key::Y,
];
