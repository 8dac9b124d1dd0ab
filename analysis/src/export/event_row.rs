//! The events of a session as rows of a BIDS events table, in the order of their onsets.
//!
//! A trial's onset was measured: the frame that first showed its pictures. Pauses, notes and the like have the
//! time of day alone, and a clock can be set back in between; so their onset is the time of day since the
//! session began, no earlier than the answer before them in the record and no later than the pictures that
//! follow. A note may be written while pictures are shown: it comes no later than their answer.

use jiff::Timestamp;
use scumble_psychophysics::{Answered, EVENTS_FILE, Event, Moment, Session};

use crate::Error;
use crate::column::{Cell, word};

/// An event with its place in time.
pub(super) struct EventRow<'a> {
    /// Seconds from the beginning of the session.
    pub(super) onset_secs: f64,
    /// The event.
    pub(super) event: &'a Event,
    /// Whether its answer stands; `None` without an answer.
    pub(super) stands: Option<bool>,
    /// Its line in the record, from 1.
    pub(super) line: usize,
}

impl EventRow<'_> {
    /// Its answer.
    pub(super) fn answered(&self) -> Option<&Answered> {
        self.event.answered()
    }

    /// Its time of day and notes, where it has no answer.
    pub(super) fn moment(&self) -> Option<&Moment> {
        self.event.moment()
    }

    /// The role of an answered trial, else the event's word in the record.
    pub(super) fn trial_type(&self) -> Cell {
        match self.event {
            Event::Trial(answered) | Event::Catch(answered) | Event::Practice(answered) => word(answered.trial.role),
            Event::Pause(_) => Some("pause".to_owned()),
            Event::Resume(_) => Some("resume".to_owned()),
            Event::Note(_) => Some("note".to_owned()),
            Event::RepeatPractice(_) => Some("repeat_practice".to_owned()),
            Event::RepeatRound(_) => Some("repeat_round".to_owned()),
            Event::End(_) => Some("end".to_owned()),
            Event::Stop(_) => Some("stop".to_owned()),
            Event::Discard(_) => Some("discard".to_owned()),
        }
    }
}

/// A row an event.
///
/// # Errors
/// An answer without onset.
pub(super) fn event_rows(session: &Session) -> Result<Vec<EventRow<'_>>, Error> {
    let mut standing = session.standing().into_iter().peekable();
    let mut rows = Vec::with_capacity(session.events.len());
    // The end of the last answer, and the last moment: no later event without answer comes before.
    let mut earliest_secs = 0.0_f64;
    for (index, event) in session.events.iter().enumerate() {
        let onset_secs = match event.moment() {
            Some(moment) => {
                let latest_secs = latest_secs(event, &session.events[index + 1..]).max(earliest_secs);
                earliest_secs = elapsed_secs(session.header.started_at, moment.at).clamp(earliest_secs, latest_secs);
                earliest_secs
            }
            None => {
                let (onset_secs, end_secs) = shown_secs(event).ok_or_else(|| without_onset(session, index + 1))?;
                earliest_secs = earliest_secs.max(end_secs);
                onset_secs
            }
        };
        let stands = event.answered().map(|answered| standing.next_if(|next| std::ptr::eq(*next, answered)).is_some());
        rows.push(EventRow { onset_secs, event, stands, line: index + 1 });
    }
    rows.sort_by(|one, other| one.onset_secs.total_cmp(&other.onset_secs));
    Ok(rows)
}

/// The onset of a trial's pictures, and the time of their answer; `None` where it was not recorded.
fn shown_secs(event: &Event) -> Option<(f64, f64)> {
    let answered = event.answered()?;
    let onset_secs = answered.timing?.onset_secs;
    Some((onset_secs, onset_secs + answered.response_time_secs))
}

/// When an event without answer was at the latest, as the next answer after it tells.
fn latest_secs(event: &Event, later: &[Event]) -> f64 {
    let Some((onset_secs, end_secs)) = later.iter().find_map(shown_secs) else { return f64::INFINITY };
    if matches!(event, Event::Note(_)) { end_secs } else { onset_secs }
}

/// What the clock says; 0 where it was set back to before the beginning.
fn elapsed_secs(started_at: Timestamp, at: Timestamp) -> f64 {
    at.duration_since(started_at).as_secs_f64().max(0.0)
}

fn without_onset(session: &Session, line: usize) -> Error {
    let reason = format!(
        "line {line} has no onset, and BIDS wants one for every event; the session was recorded as {}, allowed is a \
         session that was recorded with onsets: leave this one out by naming the others",
        session.header.schema
    );
    Error::File { path: session.directory.join(EVENTS_FILE), reason }
}
