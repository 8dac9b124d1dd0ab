//! Two monitors: one is the participant's.

use crate::pixels::Pixels;
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
    }
}
