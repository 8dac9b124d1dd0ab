//! A line of `events.jsonl` as it is read: every key that some event has, so that an error can name the
//! key, and which of them belong to which event.

use jiff::Timestamp;
use serde::{Deserialize, Deserializer};

use crate::event::{Answered, DURATION_ALLOWED, Event, Moment, Timing, is_duration};
use crate::trial::{Answer, Trial};

/// The keys of a line. A key that is there has a value: `null` is none.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct EventLine {
    event: Kind,
    #[serde(default, deserialize_with = "given")]
    trial: Option<Trial>,
    #[serde(default, deserialize_with = "given")]
    answer: Option<Answer>,
    #[serde(default, deserialize_with = "given")]
    correct: Option<bool>,
    #[serde(default, deserialize_with = "given")]
    response_time_secs: Option<f64>,
    #[serde(default, deserialize_with = "given")]
    pictures_sha256: Option<Vec<String>>,
    #[serde(default, deserialize_with = "given")]
    timing: Option<Timing>,
    #[serde(default, deserialize_with = "given")]
    at: Option<Timestamp>,
    #[serde(default, deserialize_with = "given")]
    notes: Option<Vec<String>>,
    #[serde(default, deserialize_with = "given")]
    interrupted_secs: Option<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Kind {
    Trial,
    Catch,
    Practice,
    Pause,
    Resume,
    Note,
    RepeatPractice,
    RepeatRound,
    End,
    Stop,
    Discard,
}

fn given<'de, T: Deserialize<'de>, D: Deserializer<'de>>(deserializer: D) -> Result<Option<T>, D::Error> {
    T::deserialize(deserializer).map(Some)
}

impl TryFrom<EventLine> for Event {
    type Error = String;

    fn try_from(line: EventLine) -> Result<Self, String> {
        Ok(match line.event {
            Kind::Trial => Self::Trial(line.answered()?),
            Kind::Catch => Self::Catch(line.answered()?),
            Kind::Practice => Self::Practice(line.answered()?),
            Kind::Pause => Self::Pause(line.moment()?),
            Kind::Resume => Self::Resume(line.moment()?),
            Kind::Note => Self::Note(line.moment()?),
            Kind::RepeatPractice => Self::RepeatPractice(line.moment()?),
            Kind::RepeatRound => Self::RepeatRound(line.moment()?),
            Kind::End => Self::End(line.moment()?),
            Kind::Stop => Self::Stop(line.moment()?),
            Kind::Discard => Self::Discard(line.moment()?),
        })
    }
}

impl EventLine {
    fn answered(self) -> Result<Answered, String> {
        let foreign = [
            ("at", self.at.is_some()),
            ("notes", self.notes.is_some()),
            ("interrupted_secs", self.interrupted_secs.is_some()),
        ];
        refuse(foreign, "trial, catch and practice")?;
        Ok(Answered {
            trial: needed("trial", self.trial)?,
            answer: needed("answer", self.answer)?,
            correct: needed("correct", self.correct)?,
            response_time_secs: needed("response_time_secs", self.response_time_secs)?,
            pictures_sha256: self.pictures_sha256.unwrap_or_default(),
            timing: self.timing,
        })
    }

    fn moment(self) -> Result<Moment, String> {
        let foreign = [
            ("trial", self.trial.is_some()),
            ("answer", self.answer.is_some()),
            ("correct", self.correct.is_some()),
            ("response_time_secs", self.response_time_secs.is_some()),
            ("pictures_sha256", self.pictures_sha256.is_some()),
            ("timing", self.timing.is_some()),
        ];
        refuse(foreign, "other than trial, catch and practice")?;
        let interrupted_secs = self.interrupted_secs;
        if let Some(secs) = interrupted_secs.filter(|secs| !is_duration(*secs)) {
            return Err(format!("interrupted_secs {secs}, expected {DURATION_ALLOWED}"));
        }
        Ok(Moment { at: needed("at", self.at)?, notes: self.notes.unwrap_or_default(), interrupted_secs })
    }
}

/// In the form of serde's own complaint, which the reader turns into its words.
fn needed<T>(key: &str, value: Option<T>) -> Result<T, String> {
    value.ok_or_else(|| format!("missing field `{key}`"))
}

fn refuse<const N: usize>(keys: [(&str, bool); N], events: &str) -> Result<(), String> {
    match keys.into_iter().find(|(_, is_given)| *is_given) {
        Some((key, _)) => Err(format!("the key {key}, expected no such key with the events {events}")),
        None => Ok(()),
    }
}
