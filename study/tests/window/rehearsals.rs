//! A simulated person at the window, of whom nobody presses a key.

use scumble_psychophysics::{Event, Experiment, Observer, ObserverModel, rehearse};

use crate::screen::Screen;
use crate::sitting::{PARTICIPANT_NUMBER, Sitting, short};

/// Seeds of the sessions and of the people in them.
const SEED: u64 = 61;

#[test]
fn a_rehearsed_session_is_that_of_a_simulation_with_the_pictures_on_the_screen() {
    for name in ["two-alternative", "yes-no", "published"] {
        let folder = tempfile::tempdir().unwrap();
        let screen = Screen::start([1280, 800]);
        let protocol = short(name);
        let rehearsed = Sitting::rehearse(&screen, folder.path(), protocol.clone(), SEED, "weibull");

        let mut experiment = Experiment::new(protocol, SEED, PARTICIPANT_NUMBER).unwrap();
        let person = Observer::new(ObserverModel::default(), SEED).unwrap();
        let simulated = rehearse(&mut experiment, &person).unwrap();
        let answers = |events: &[Event]| -> Vec<_> {
            events.iter().filter_map(Event::answered).map(|answered| (answered.trial, answered.answer)).collect()
        };
        assert_eq!(answers(&rehearsed.events), answers(&simulated), "{name}");
        let answered = rehearsed.events.iter().filter_map(Event::answered);
        assert!(answered.into_iter().all(|answered| !answered.pictures_sha256.is_empty()), "{name}");
    }
}
