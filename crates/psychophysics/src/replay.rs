//! Resuming a session: its recorded answers are fed to a new state machine.
//!
//! What the machine shows must be what the record says was shown, bit for bit: every draw and every
//! state of a staircase follows from seed, participant's number, protocol and answers by arithmetic that
//! is the same on every platform.

use serde_json::Value;

use crate::complaint::quoted;
use crate::error::Error;
use crate::event::{Answered, Event, Reply};
use crate::experiment::Experiment;
use crate::header::SessionHeader;
use crate::stage::Stage;
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
            experiment.obey(event).map_err(|error| match error {
                Error::Stage { call, stage, allowed } => {
                    differs(index, format!("{call} at the stage {stage}"), format!("{call} at {allowed}"))
                }
                other => other,
            })?;
            let ends = matches!(event, Event::End(_));
            if ends && *experiment.stage() != Stage::Finished {
                let found = format!("the end of the session at the stage {}", experiment.stage().name());
                return Err(differs(index, found, "an end after the last trial"));
            }
        }
        Ok(experiment)
    }

    /// Does what the administrator did.
    fn obey(&mut self, event: &Event) -> Result<(), Error> {
        match event {
            Event::RepeatPractice(_) => self.repeat_practice(),
            Event::RepeatRound(_) => {
                // The screens between the last answer and this moment are not in the record.
                while matches!(self.stage(), Stage::Instructions | Stage::Feedback { .. }) {
                    self.proceed()?;
                }
                self.repeat_round()
            }
            Event::Stop(_) => self.stop(),
            _ => Ok(()),
        }
    }

    fn replay(&mut self, index: usize, event: &Event, answered: &Answered) -> Result<(), Error> {
        while matches!(self.stage(), Stage::Instructions | Stage::Feedback { .. } | Stage::Rest { .. }) {
            self.proceed()?;
        }
        let recorded = &answered.trial;
        let Some(expected) = self.stage().trial() else {
            let found = format!("{} trial {}", recorded.role.name(), recorded.number);
            return Err(differs(index, found, self.stage().name()));
        };
        if expected != recorded {
            return Err(trials_differ(index, recorded, expected));
        }
        let reply = Reply {
            answer: answered.answer,
            response_time_secs: answered.response_time_secs,
            pictures_sha256: answered.pictures_sha256.clone(),
            timing: answered.timing,
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

/// The error that names the first key in which two trials differ.
fn trials_differ(index: usize, found: &Trial, allowed: &Trial) -> Error {
    let place = format!("{} trial {}", found.role.name(), found.number);
    match first_difference("trial", &tree(found), &tree(allowed)) {
        Some((key, found, allowed)) => {
            differs(index, format!("{key} is {} in {place}", quoted(&found)), quoted(&allowed))
        }
        None => differs(index, place, "another trial"),
    }
}

/// The trial as it stands in the file.
fn tree(trial: &Trial) -> Value {
    serde_json::to_value(trial).unwrap_or(Value::Null)
}

/// The first leaf that differs, its key and both values.
fn first_difference(key: &str, found: &Value, allowed: &Value) -> Option<(String, String, String)> {
    let (Value::Object(found), Value::Object(allowed)) = (found, allowed) else {
        return (found != allowed).then(|| (key.to_owned(), found.to_string(), allowed.to_string()));
    };
    let keys = allowed.keys().chain(found.keys().filter(|name| !allowed.contains_key(*name)));
    let mut differences = keys.filter_map(|name| {
        let value = |tree: &serde_json::Map<String, Value>| tree.get(name).cloned().unwrap_or(Value::Null);
        first_difference(&format!("{key}.{name}"), &value(found), &value(allowed))
    });
    differences.next()
}
