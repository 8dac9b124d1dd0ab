//! A simulated person goes through what is left of a session, without rests between the trials.

use crate::error::Error;
use crate::event::{Event, Reply, Timing};
use crate::experiment::Experiment;
use crate::observer::Observer;
use crate::stage::Stage;

/// Fixation interval before each trial, as in the study's window.
const FIXATION_SECS: f64 = 0.5;

/// Answers every trial until the session is finished, and gives the events in order.
pub fn rehearse(experiment: &mut Experiment, observer: &Observer) -> Result<Vec<Event>, Error> {
    let rules = experiment.protocol().pictures;
    let mut events = Vec::new();
    while *experiment.stage() != Stage::Finished {
        match experiment.stage().trial().copied() {
            Some(trial) => {
                let response_time_secs = observer.response_time_secs(&trial);
                let onset_secs = experiment.answered_secs() + FIXATION_SECS;
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
