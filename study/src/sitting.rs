//! One session under way: the experiment, its record and its time, kept in step.
//!
//! Nothing here draws. Whatever happens is an event; the event is on disk, or waits in memory with the
//! session held, before the next stage is shown.

use std::path::Path;
use std::time::Instant;

use jiff::Timestamp;
use scumble_psychophysics::{Display, Event, Experiment, Moment, Reply, SessionHeader, Stage};

use crate::arguments::ResumePolicy;
use crate::clock::{Clock, Mark};
use crate::display;
use crate::recorder::Recorder;
use crate::setup::StudyFolder;

/// A session of a participant, from its instructions to its end.
pub(crate) struct Sitting {
    experiment: Experiment,
    recorder: Recorder,
    clock: Clock,
    pause: Option<Pause>,
    /// Name of the display that the pictures are on; `None` before the first look at it.
    display: Option<String>,
}

/// An interruption that has not ended.
struct Pause {
    began: Mark,
    /// How long it had lasted before the program was started.
    earlier_secs: f64,
    /// What belongs into the record where the session goes on.
    notes: Vec<String>,
    /// Whether the round begins anew then.
    repeats_round: bool,
}

impl Sitting {
    /// A session that nobody has begun, for a folder of the study that holds none.
    pub(crate) fn fresh(study: StudyFolder, directory: &Path, header: SessionHeader) -> anyhow::Result<Self> {
        let experiment = Experiment::new(header.protocol.clone(), header.seed, header.participant_number)?;
        let recorder = Recorder::plan(study, directory, header)?;
        Ok(Self { experiment, recorder, clock: Clock::start(), pause: None, display: None })
    }

    /// An interrupted session, paused.
    pub(crate) fn resume(directory: &Path, policy: ResumePolicy) -> anyhow::Result<Self> {
        let (recorder, session) = Recorder::reopen(directory)?;
        let experiment = session.replay()?;
        let (last_at, now) = (session.last_known_at(), Timestamp::now());
        let (clock, earlier_secs) = Clock::resume(session.header.started_at, last_at, now);
        let mut notes = session.notices;
        if now < last_at {
            notes.push(format!("the clock stands at {now}, before the end of the record at {last_at}"));
        }
        let repeats_round = policy == ResumePolicy::RepeatRound;
        let pause = Some(Pause { began: Mark::now(), earlier_secs, notes, repeats_round });
        Ok(Self { experiment, recorder, clock, pause, display: None })
    }

    /// What happens next.
    pub(crate) fn experiment(&self) -> &Experiment {
        &self.experiment
    }

    /// Where it is kept.
    pub(crate) fn recorder(&self) -> &Recorder {
        &self.recorder
    }

    /// What turns an instant into seconds since it began.
    pub(crate) fn clock(&self) -> &Clock {
        &self.clock
    }

    /// Seconds since it began, on a clock that never runs backwards.
    pub(crate) fn elapsed_secs(&self) -> f64 {
        self.clock.at(Instant::now())
    }

    /// Whether the pictures are hidden until someone goes on.
    pub(crate) fn is_paused(&self) -> bool {
        self.pause.is_some()
    }

    /// Whether a pause makes sense: there is something left to interrupt.
    pub(crate) fn is_open(&self) -> bool {
        *self.experiment.stage() != Stage::Finished && !self.recorder.is_closed()
    }

    /// On from a screen that asks nothing; the session begins with the first one, on this display.
    pub(crate) fn proceed(&mut self, display: impl FnOnce() -> Option<Display>) -> anyhow::Result<()> {
        if !self.recorder.has_begun() {
            self.clock = Clock::start();
            self.recorder.begin(|header| {
                header.started_at = Timestamp::now();
                header.display = display();
            });
        }
        self.experiment.proceed()?;
        self.end_if_finished();
        Ok(())
    }

    /// An answer to the trial on show.
    pub(crate) fn answer(&mut self, reply: Reply) -> anyhow::Result<()> {
        let event = self.experiment.answer(reply)?;
        self.recorder.append(event);
        self.end_if_finished();
        Ok(())
    }

    /// Looks at the display under the participant's window. The header has the one on which the session begins; every
    /// other one, and the one on which a later run of the program goes on, is noted in the record. Gives whether this
    /// is another one than at the last look.
    pub(crate) fn watch_display(&mut self, display: &Display) -> bool {
        let name = display::name(display);
        if self.display.as_ref() == Some(&name) {
            return false;
        }
        if self.recorder.has_begun() && self.is_open() {
            let note = format!("shown on {name}");
            match &mut self.pause {
                Some(pause) => pause.notes.push(note),
                None => self.note(note),
            }
        }
        self.display = Some(name);
        true
    }

    /// Name of the display that the session is shown on, where that is not the one on which it began.
    pub(crate) fn other_display(&self) -> Option<&str> {
        let first = self.recorder.header().display.as_ref().map(display::name)?;
        self.display.as_deref().filter(|name| *name != first)
    }

    /// Hides the pictures; the trial under way is shown anew afterwards.
    pub(crate) fn pause(&mut self) {
        if self.is_open() && self.pause.is_none() {
            self.recorder.append(Event::Pause(moment(Vec::new())));
            self.pause = Some(Pause { began: Mark::now(), earlier_secs: 0.0, notes: Vec::new(), repeats_round: false });
        }
    }

    /// Goes on after a pause.
    pub(crate) fn go_on(&mut self) {
        if let Some(pause) = self.pause.take() {
            let interrupted_secs = Some(pause.earlier_secs + self.clock.end_pause(pause.began, Mark::now()));
            let mut notes = pause.notes;
            // A round without an answer is as good as repeated; the record says so, or why else it was not.
            if pause.repeats_round
                && let Err(refusal) = self.experiment.clone().repeat_round()
            {
                notes.push(format!("the round was to be repeated and was not: {refusal}"));
            }
            self.recorder.append(Event::Resume(Moment { interrupted_secs, ..moment(notes) }));
            if pause.repeats_round {
                self.repeat_round(self.experiment.progress().round);
            }
            self.end_if_finished();
        }
    }

    /// Puts a note of the administrator into the record.
    pub(crate) fn note(&mut self, note: String) {
        self.recorder.append(Event::Note(moment(vec![note])));
    }

    /// The practice once more; an order that comes too late for it does nothing.
    pub(crate) fn repeat_practice(&mut self) {
        if self.experiment.repeat_practice().is_ok() {
            self.recorder.append(Event::RepeatPractice(moment(Vec::new())));
        }
    }

    /// This round once more, whose answers then do not stand. False, and nothing happens, where it is over or has no
    /// answers: an order may come when the next round is under way.
    pub(crate) fn repeat_round(&mut self, round: u32) -> bool {
        let is_repeated = self.experiment.progress().round == round && self.experiment.repeat_round().is_ok();
        if is_repeated {
            self.recorder.append(Event::RepeatRound(moment(Vec::new())));
        }
        is_repeated
    }

    /// Ends the session early, unless it is over.
    pub(crate) fn stop(&mut self) {
        if self.experiment.stop().is_ok() {
            self.recorder.append(Event::Stop(moment(Vec::new())));
            self.pause = None;
        }
    }

    /// Tries again to write what the disk has refused.
    pub(crate) fn retry(&mut self) {
        self.recorder.retry();
    }

    /// The window closes: an open session is interrupted.
    pub(crate) fn leave(&mut self) {
        self.recorder.retry();
        self.pause();
    }

    fn end_if_finished(&mut self) {
        if *self.experiment.stage() == Stage::Finished && self.pause.is_none() && !self.recorder.is_closed() {
            self.recorder.append(Event::End(moment(Vec::new())));
        }
    }
}

/// This moment, with what is worth knowing about it.
fn moment(notes: Vec<String>) -> Moment {
    Moment { at: Timestamp::now(), notes, interrupted_secs: None }
}

/// Throws an interrupted session away: its record says so, and stays. Gives the number of its participant, which is
/// that of the session that takes its place, so that the order of the rounds is the same.
pub(crate) fn discard(directory: &Path) -> anyhow::Result<u32> {
    let (mut recorder, session) = Recorder::reopen(directory)?;
    recorder.append(Event::Discard(moment(Vec::new())));
    match recorder.problem() {
        Some(problem) => anyhow::bail!("{problem}"),
        None => Ok(session.header.participant_number),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
#[path = "sitting_tests.rs"]
mod tests;
