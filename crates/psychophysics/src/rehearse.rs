//! A simulated person goes through what is left of a session.

use crate::error::Error;
use crate::event::{Event, Reply, Timing};
use crate::experiment::{Experiment, Stage};
use crate::observer::Observer;

/// Fixation interval before each trial, as in the study's window.
const FIXATION_SECS: f64 = 0.5;

/// Answers every trial until the session is finished, and gives the events in order.
pub fn rehearse(experiment: &mut Experiment, observer: &Observer) -> Result<Vec<Event>, Error> {
    let rules = experiment.protocol().pictures;
    let mut events = Vec::new();
    let mut now_secs = 0.0;
    while *experiment.stage() != Stage::Finished {
        match experiment.stage().trial().copied() {
            Some(trial) => {
                let response_time_secs = observer.response_time_secs(&trial);
                let onset_secs = now_secs + FIXATION_SECS;
                now_secs = onset_secs + response_time_secs;
                let reply = Reply {
                    answer: observer.answer(&trial, &rules)?,
                    response_time_secs,
                    pictures_sha256: Vec::new(),
                    timing: Some(Timing { onset_secs, missed_frames: 0 }),
                };
                events.push(experiment.answer(reply)?);
            }
            None => experiment.proceed()?,
        }
    }
    Ok(events)
}
