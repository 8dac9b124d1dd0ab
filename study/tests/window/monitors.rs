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

#[test]
fn beside_another_monitor_the_participants_shows_what_it_shows_alone() {
    let alone = trials(&Screen::start(PARTICIPANT_PX));
    let beside = trials(&Screen::of_monitors(&[PARTICIPANT_PX, OTHER_PX]));
    assert_eq!(alone.len(), beside.len());
    for (alone, beside) in alone.iter().zip(&beside) {
        assert!(*alone == beside.part([0, 0], PARTICIPANT_PX), "the participant's monitor differs");
        let administrator = beside.part([PARTICIPANT_PX[0], 0], OTHER_PX);
        // A display without a window is black.
        let shown = administrator.rgb.iter().filter(|level| **level > 0).count();
        assert!(shown > administrator.rgb.len() / 2, "no administrator's window on the other monitor");
    }
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
fn the_participants_keys_answer_after_the_administrator_has_worked_in_the_other_window() {
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
        sitting.answer_left(false);
        index += 1;
    }
    sitting.finish();
}
