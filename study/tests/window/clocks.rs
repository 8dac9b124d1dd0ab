//! A computer's clock can be set at any time; a session's time goes on.

use jiff::SignedDuration;
use scumble_psychophysics::Event;

use crate::clock::Clock;
use crate::screen::Screen;
use crate::sitting::{Sitting, short};

#[test]
fn a_session_goes_on_when_the_clock_is_set_back_and_its_time_never_decreases() {
    let folder = tempfile::tempdir().unwrap();
    let screen = Screen::start([1280, 800]);
    let clock = Clock::new(folder.path());
    let environment = clock.environment();
    let mut sitting = Sitting::start(&screen, folder.path(), short("two-alternative"), 51, &environment);
    let mut index = 0;
    while let Some((trial, _)) = sitting.next() {
        match index {
            0 => clock.set(SignedDuration::from_hours(-2)),
            1 => {
                sitting.crash();
                clock.set(SignedDuration::from_hours(-26));
                sitting.resume();
                sitting.see(&trial);
            }
            _ => clock.set(SignedDuration::from_hours(-27)),
        }
        sitting.answer_left(true);
        index += 1;
    }
    let record = sitting.finish();
    let onsets = record.events.iter().filter_map(Event::answered).map(|answered| answered.timing.unwrap().onset_secs);
    assert!(onsets.is_sorted(), "{record:?}");
    let ages: Vec<f64> =
        record.events.iter().filter_map(Event::moment).filter_map(|moment| moment.interrupted_secs).collect();
    assert!(ages.len() == 1 && ages[0] >= 0.0, "{ages:?}");
}
