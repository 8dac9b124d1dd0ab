//! The administrator's panel: on the other monitor where there are two, else over the participant's screen.

use scumble_psychophysics::Event;

use crate::pixels::Pixels;
use crate::programs::wait_for;
use crate::screen::Screen;
use crate::sitting::{Sitting, short};

const PARTICIPANT_PX: [u32; 2] = [1280, 800];
const OTHER_PX: [u32; 2] = [1440, 900];

/// What is on the screen while each trial of a session waits for its answer.
fn trials(screen: &Screen) -> Vec<Pixels> {
    let folder = tempfile::tempdir().unwrap();
    let mut sitting = Sitting::start(screen, folder.path(), short("two-alternative"), 31, &[]);
    let mut trials = Vec::new();
    while sitting.next().is_some() {
        trials.push(screen.pixels());
        sitting.answer_left(true);
    }
    let display = sitting.finish().header.display.unwrap();
    assert_eq!([display.width_px, display.height_px], PARTICIPANT_PX);
    trials
}

/// Whether the administrator's window is on the monitor to the right of the participant's.
fn has_administrator(screen: &Pixels) -> bool {
    let other = screen.part([PARTICIPANT_PX[0], 0], OTHER_PX);
    // A display without a window is black.
    other.rgb.iter().filter(|level| **level > 0).count() > other.rgb.len() / 2
}

#[test]
fn beside_another_monitor_the_participants_shows_what_it_shows_alone() {
    let alone = trials(&Screen::start(PARTICIPANT_PX));
    let beside = trials(&Screen::of_monitors(&[PARTICIPANT_PX, OTHER_PX]));
    assert_eq!(alone.len(), beside.len());
    for (alone, beside) in alone.iter().zip(&beside) {
        assert!(*alone == beside.part([0, 0], PARTICIPANT_PX), "the participant's monitor differs");
        assert!(has_administrator(beside), "no administrator's window on the other monitor");
    }
}

/// Whether the panel, whose ground is darker than any page of the participant's, is on the screen.
fn shows_panel(screen: &Screen) -> bool {
    let pixels = screen.pixels();
    pixels.rgb.iter().filter(|level| (1..64).contains(*level)).count() > pixels.rgb.len() / 2
}

#[test]
fn on_one_monitor_the_charts_come_after_a_page_that_return_alone_leads_on_from() {
    let folder = tempfile::tempdir().unwrap();
    let screen = Screen::start(PARTICIPANT_PX);
    let mut sitting = Sitting::start(&screen, folder.path(), short("yes-no"), 34, &[]);
    let mut index = 0;
    while let Some((trial, _)) = sitting.next() {
        if index == 1 {
            // With the mouse away, so that a page has one look.
            screen.input("mousemove 1279 799");
            let pictures = sitting.pictures(&trial);
            screen.input("key F10");
            let page = wait_for("the page before the panel", || {
                let pixels = screen.pixels();
                (pixels.find(&pictures[0]).is_none() && pixels == screen.pixels()).then_some(pixels)
            });
            // What participants press leads nowhere.
            for key in ["key space", "key Left", "key Right", "key F5"] {
                screen.input(key);
            }
            assert!(!shows_panel(&screen));
            assert!(page == screen.pixels(), "the page before the panel stays");
            screen.input("key Return");
            wait_for("the panel", || shows_panel(&screen).then_some(()));
            screen.input("key F10");
            wait_for("no panel", || (!shows_panel(&screen)).then_some(()));
            screen.input("key F10");
            wait_for("the page before the panel", || (screen.pixels() == page).then_some(()));
            screen.input("key Escape");
            wait_for("the paused page", || (screen.pixels() != page && !shows_panel(&screen)).then_some(()));
            // The space bar goes on from the pause, as always.
            sitting.see(&trial);
            sitting.interrupted();
        }
        sitting.answer_left(false);
        index += 1;
    }
    sitting.finish();
}

#[test]
fn on_one_monitor_the_administrators_panel_hides_the_pictures_and_the_session_goes_on_behind_it() {
    let folder = tempfile::tempdir().unwrap();
    let screen = Screen::start(PARTICIPANT_PX);
    let mut sitting = Sitting::start(&screen, folder.path(), short("yes-no"), 32, &[]);
    let mut index = 0;
    while let Some((trial, _)) = sitting.next() {
        if index == 1 {
            sitting.hide_and_show(&trial, "key F10");
        }
        sitting.answer_left(false);
        index += 1;
    }
    let record = sitting.finish();
    let kinds = |kind: fn(&Event) -> bool| record.events.iter().filter(|event| kind(event)).count();
    let [pauses, resumptions] =
        [kinds(|event| matches!(event, Event::Pause(_))), kinds(|event| matches!(event, Event::Resume(_)))];
    assert_eq!([pauses, resumptions], [1, 1]);
}

#[test]
fn the_participants_keys_answer_after_the_administrator_has_worked_in_the_other_window_or_it_was_opened_again() {
    let folder = tempfile::tempdir().unwrap();
    let screen = Screen::of_monitors(&[PARTICIPANT_PX, OTHER_PX]);
    let mut sitting = Sitting::start(&screen, folder.path(), short("yes-no"), 33, &[]);
    let mut index = 0;
    while let Some((trial, _)) = sitting.next() {
        if index == 1 {
            wait_for("the keyboard in the administrator's window", || {
                screen.input("mousemove 2000 450 click 1");
                screen.title_with_keyboard().contains("administrator").then_some(())
            });
            sitting.hide_and_show(&trial, "key F5");
        }
        if index == 2 {
            // Closed, and opened again; the window manager gives a new window the keyboard.
            for is_open in [false, true] {
                screen.input("key F10");
                wait_for("the administrator's window", || {
                    (has_administrator(&screen.pixels()) == is_open).then_some(())
                });
            }
            wait_for("the keyboard in the participant's window", || {
                (!screen.title_with_keyboard().contains("administrator")).then_some(())
            });
        }
        sitting.answer_left(false);
        index += 1;
    }
    sitting.finish();
}
