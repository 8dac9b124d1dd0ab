//! "Which one was the line?"

use scumble_psychophysics::{Answer, Event, Protocol};

use crate::programs::wait_for;
use crate::screen::Screen;
use crate::sitting::{Sitting, short};

/// Two rounds of two trials, and two trials to practise.
fn short_protocol() -> Protocol {
    let mut protocol = short("two-alternative");
    protocol.schedule.trials_min = 2;
    protocol.schedule.trials_max = 2;
    protocol.practice.ratios = vec![0.5, 1.0];
    protocol
}

#[test]
fn a_session_of_two_pictures_survives_a_crash_and_is_on_disk_answer_by_answer() {
    let folder = tempfile::tempdir().unwrap();
    let screen = Screen::start([1280, 800]);
    let mut sitting = Sitting::start(&screen, folder.path(), short_protocol(), 11, &[]);
    for index in 0.. {
        let Some((trial, corners)) = sitting.next() else { break };
        // A crash while the pictures of the fifth trial are on the screen.
        if index == 4 {
            sitting.crash();
            sitting.resume();
            assert_eq!(sitting.see(&trial), corners, "the same trial at the same place");
        }
        match index {
            0 => sitting.answer("key Left", Answer::Left),
            1 => sitting.answer("key j", Answer::Right),
            2 => {
                // The button below the left picture; its middle is 46 points below the picture's edge.
                let [x, y] = [corners[0][0] + 300, corners[0][1] + 480 + 46];
                sitting.answer(&format!("mousemove {x} {y} click 1"), Answer::Left);
            }
            4 => sitting.answer("key f", Answer::Left),
            _ => sitting.answer("key Right", Answer::Right),
        }
    }
    let record = sitting.finish();
    let kinds = |kind: fn(&Event) -> bool| record.events.iter().filter(|event| kind(event)).count();
    assert_eq!(kinds(|event| matches!(event, Event::Practice(_))), 2);
    assert_eq!(kinds(|event| matches!(event, Event::Trial(_))), 4);
    assert_eq!(kinds(|event| matches!(event, Event::Resume(_))), 1);
    let display = record.header.display.unwrap();
    assert_eq!((display.width_px, display.height_px, display.scale_factor), (1280, 800, 1.0));
}

#[test]
fn a_texel_is_a_physical_pixel_whatever_the_scale_factor() {
    let screen = Screen::start([1601, 1003]);
    for scale in ["1.25", "1.5", "2"] {
        let folder = tempfile::tempdir().unwrap();
        let environment = [("WINIT_X11_SCALE_FACTOR", scale)];
        let mut sitting = Sitting::start(&screen, folder.path(), short_protocol(), 11, &environment);
        let (_, corners) = sitting.next().unwrap();
        let [left, right] = [corners[0], corners[1]];
        assert_eq!(left[1], right[1]);
        assert_eq!(right[0] - left[0], 600 + 32, "width and gap in physical pixels");
    }
}

#[test]
fn escape_hides_the_pictures_and_the_pause_is_on_record() {
    let folder = tempfile::tempdir().unwrap();
    let screen = Screen::start([1280, 800]);
    let mut sitting = Sitting::start(&screen, folder.path(), short_protocol(), 11, &[]);
    let (trial, _) = sitting.next().unwrap();

    screen.input("key Escape");
    let left = sitting.pictures(&trial).remove(0);
    wait_for("no picture", || screen.pixels().find(&left).is_none().then_some(()));
    // An answer to hidden pictures is none.
    screen.input("key Left");
    sitting.see(&trial);
    let record = wait_for("pause and resume on disk", || {
        let record = sitting.record();
        (record.events.len() >= 2).then_some(record)
    });
    assert!(matches!(&record.events[..], [Event::Pause(_), Event::Resume(_)]), "{record:?}");

    // Alt and F4 ask the window manager to close the window.
    screen.input("key alt+F4");
    assert!(!sitting.exit_status().success(), "the session is not complete");
    let record = sitting.record();
    assert!(matches!(record.events.last(), Some(Event::Pause(_))), "{record:?}");
}
