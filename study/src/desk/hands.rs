//! What keys and clicks on the panel order.

use eframe::egui::{Key, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use scumble_psychophysics::Language;

use super::testing::{Rehearsed, Shown, harness};
use super::{DeskState, Disk, Order, Status};

fn panel(status: Status) -> Harness<'static, Shown> {
    let mut harness = harness(status, DeskState::default(), Language::English, Vec2::new(1280.0, 720.0), 1.0);
    harness.run_steps(2);
    harness
}

fn press(harness: &mut Harness<'_, Shown>, key: Key) {
    harness.key_press(key);
    harness.run_steps(3);
}

/// In the first round, where everything but practice can be ordered.
fn in_trial() -> Rehearsed {
    Rehearsed::new("two-alternative").at_trial(9)
}

#[test]
fn f5_pauses_and_goes_on() {
    let mut harness = panel(in_trial().status());
    press(&mut harness, Key::F5);
    harness.state_mut().status = in_trial().status_of(true, Disk::Saved);
    harness.run_steps(2);
    press(&mut harness, Key::F5);
    assert_eq!(harness.state().orders, [Order::Pause, Order::Resume]);
}

#[test]
fn an_order_that_loses_something_is_given_after_a_question_alone() {
    for (key, name, order) in
        [(Key::F8, "Repeat the round", Order::RepeatRound(1)), (Key::F9, "End the session", Order::Stop)]
    {
        // Return right after the key is on "Cancel".
        let mut harness = panel(in_trial().status());
        press(&mut harness, key);
        press(&mut harness, Key::Enter);
        assert_eq!(harness.state().orders, [], "{name}");
        press(&mut harness, key);
        press(&mut harness, Key::Escape);
        assert_eq!(harness.state().orders, [], "{name}");
        press(&mut harness, key);
        press(&mut harness, Key::Tab);
        press(&mut harness, Key::Enter);
        assert_eq!(harness.state().orders, std::slice::from_ref(&order), "{name}");
        press(&mut harness, key);
        harness.get_by_label(name).click();
        harness.run_steps(3);
        assert_eq!(harness.state().orders, [order.clone(), order], "{name}");
    }
}

#[test]
fn a_question_that_no_longer_applies_goes_away() {
    let mut harness = panel(in_trial().status());
    press(&mut harness, Key::F8);
    assert!(harness.query_by_label("Repeat the round").is_some());
    harness.state_mut().status = Rehearsed::new("two-alternative").until(|_| false).status();
    harness.run_steps(2);
    assert!(harness.query_by_label("Repeat the round").is_none());
}

#[test]
fn what_cannot_be_ordered_is_not_ordered_by_its_key() {
    let mut harness = panel(Rehearsed::new("two-alternative").status());
    for key in [Key::F5, Key::F6, Key::F7, Key::F8, Key::F9, Key::Enter] {
        press(&mut harness, key);
    }
    assert_eq!(harness.state().orders, []);
}

#[test]
fn a_note_is_written_and_added_with_the_keyboard_alone() {
    let mut harness = panel(in_trial().status());
    press(&mut harness, Key::F6);
    harness.event(eframe::egui::Event::Text(" a door slammed ".to_owned()));
    harness.run_steps(2);
    press(&mut harness, Key::Enter);
    press(&mut harness, Key::Enter);
    assert_eq!(harness.state().orders, [Order::Note("a door slammed".to_owned())]);
}

#[test]
fn a_round_that_has_begun_can_be_looked_at_and_left_again() {
    let status = Rehearsed::new("two-alternative").until(|e| e.progress().round == 2).status();
    let mut harness = panel(status);
    let click = |harness: &mut Harness<'_, Shown>, name: &str| {
        harness.get_by(|node| node.label().is_some_and(|label| label.starts_with(name) && label.contains(','))).click();
        harness.run_steps(2);
    };
    for (name, chosen) in [("Round 1,", Some(1)), ("Round 3,", Some(1)), ("Round 2,", None)] {
        click(&mut harness, name);
        assert_eq!(harness.state().desk.chosen_round, chosen, "after {name}");
    }
}

#[test]
fn every_order_is_reached_with_tab() {
    let mut harness = panel(Rehearsed::new("two-alternative").at_trial(9).status());
    let mut focused = Vec::new();
    for _ in 0..12 {
        press(&mut harness, Key::Tab);
        let node = harness.query_by(|node| node.is_focused());
        focused.extend(node.and_then(|node| node.accesskit_node().label()));
    }
    for name in ["Light", "Pause   F5", "Repeat round   F8", "End session early   F9"] {
        assert!(focused.iter().any(|label| label == name), "{name} among {focused:?}");
    }
}
