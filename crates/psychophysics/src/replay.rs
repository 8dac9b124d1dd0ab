//! Resuming a session: its recorded answers are fed to a new state machine.
//!
//! What the machine shows must be what the record says was shown, bit for bit: every draw and every
//! state of a staircase follows from seed, participant's number, protocol and answers by arithmetic that
//! is the same on every platform.

use crate::error::Error;
use crate::event::{Answered, Event, Reply};
use crate::experiment::{Experiment, Stage};
use crate::header::SessionHeader;
use crate::trial::Trial;

impl Experiment {
    /// The session as it stood after `events`.
    ///
    /// Errors name the first event that the header's seed and protocol do not lead to.
    pub fn resume(header: &SessionHeader, events: &[Event]) -> Result<Self, Error> {
        header.check()?;
        let mut experiment = Self::new(header.protocol.clone(), header.seed, header.participant_number)?;
        for (index, event) in events.iter().enumerate() {
            if let Some(answered) = event.answered() {
                experiment.replay(index, event, answered)?;
            }
            let ends = matches!(event, Event::End(_));
            if ends && *experiment.stage() != Stage::Finished {
                return Err(differs(index, "the end", experiment.stage().name()));
            }
        }
        Ok(experiment)
    }

    fn replay(&mut self, index: usize, event: &Event, answered: &Answered) -> Result<(), Error> {
        while matches!(self.stage(), Stage::Instructions | Stage::Feedback { .. } | Stage::Rest { .. }) {
            self.proceed()?;
        }
        let recorded = &answered.trial;
        let Some(expected) = self.stage().trial() else {
            return Err(differs(index, describe(recorded), self.stage().name()));
        };
        if expected != recorded {
            return Err(differs(index, describe(recorded), describe(expected)));
        }
        let reply = Reply {
            answer: answered.answer,
            response_time_secs: answered.response_time_secs,
            pictures_sha256: answered.pictures_sha256.clone(),
        };
        let replayed = self.answer(reply)?;
        if replayed != *event {
            return Err(differs(index, format!("{event:?}"), format!("{replayed:?}")));
        }
        Ok(())
    }
}

fn differs(index: usize, found: impl Into<String>, allowed: impl Into<String>) -> Error {
    Error::Replay { index, found: found.into(), allowed: allowed.into() }
}

fn describe(trial: &Trial) -> String {
    format!(
        "{:?} trial {} of round {}: {:?}, contrast {}, texel {} px, radius {} px, right answer {:?}, phase {}",
        trial.role,
        trial.number,
        trial.round,
        trial.condition.pattern,
        trial.condition.contrast,
        trial.condition.texel_px,
        trial.radius_px,
        trial.pictures.right_answer(),
        trial.pictures.all()[0].phase
    )
}
