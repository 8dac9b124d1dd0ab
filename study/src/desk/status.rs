//! Everything that the administrator sees, as a snapshot.

use scumble_psychophysics::{
    Answered, Condition, Error, Event, Experiment, Progress, Role, SessionHeader, Stage, Task, standing,
};

use super::{Bands, Chart, MinutesLeft};

/// What a snapshot is made from.
pub(crate) struct Given<'a> {
    pub(crate) experiment: &'a Experiment,
    pub(crate) header: &'a SessionHeader,
    /// All of them, those that wait for the disk too.
    pub(crate) events: &'a [Event],
    /// Since the session began.
    pub(crate) elapsed_secs: f64,
    /// Whether there is a record.
    pub(crate) has_begun: bool,
    pub(crate) is_paused: bool,
    /// Why the program cannot go on.
    pub(crate) stopped: Option<&'a str>,
    /// Round that was over when its repetition was ordered.
    pub(crate) refused_round: Option<u32>,
    /// Display on show, where the session began on another one.
    pub(crate) other_display: Option<&'a str>,
    pub(crate) disk: Disk,
}

/// A session at a moment.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Status {
    pub(crate) participant: String,
    pub(crate) protocol: String,
    pub(crate) task: Task,
    /// Whole minutes since the session began: a status differs from the one before it when there is something new to
    /// show, and not because time goes by.
    pub(crate) elapsed_minutes: u32,
    pub(crate) stage: Stage,
    pub(crate) has_begun: bool,
    pub(crate) is_paused: bool,
    pub(crate) is_over: bool,
    /// Whether it was ended before the last trial.
    pub(crate) is_ended_early: bool,
    /// Why the program cannot go on.
    pub(crate) stopped: Option<String>,
    /// Round that was over when the latest order, to repeat it, came.
    pub(crate) refused_round: Option<u32>,
    /// Display on show, where the session began on another one.
    pub(crate) other_display: Option<String>,
    pub(crate) has_practice: bool,
    pub(crate) can_repeat_practice: bool,
    pub(crate) can_repeat_round: bool,
    /// Answers that a repeated round would replace.
    pub(crate) answers_of_round: u32,
    pub(crate) progress: Progress,
    /// In the order of the session.
    pub(crate) rounds: Vec<Round>,
    /// Lines among the trials of one picture; a wrong answer is a false alarm. `None` where the protocol has none.
    pub(crate) lines: Option<Tally>,
    /// Artifacts that everyone sees; a wrong answer is a miss. `None` where the protocol has none.
    pub(crate) catch_trials: Option<Tally>,
    /// `None` while the pace is not known, and at the end.
    pub(crate) minutes_left: Option<MinutesLeft>,
    /// Refreshes by which pictures came too late, summed over the session.
    pub(crate) missed_frames: u32,
    /// In order.
    pub(crate) notes: Vec<Note>,
    pub(crate) disk: Disk,
}

/// What the participant is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Activity {
    Instructions,
    Practice,
    /// Number of the trial.
    Trial(u32),
    /// The round that follows.
    RestBefore(u32),
    /// The round under way.
    RestWithin(u32),
    Paused,
    Complete,
    EndedEarly,
    /// The program could not go on.
    Stopped,
}

/// A round, with a chart for each of its staircases.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Round {
    /// From 1.
    pub(crate) number: u32,
    /// Of its first staircase; the others differ in texel size or prior.
    pub(crate) condition: Condition,
    pub(crate) state: RoundState,
    pub(crate) charts: Vec<Chart>,
}

/// How far a round is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum RoundState {
    Done,
    UnderWay,
    Ahead,
}

/// Trials of a kind, and how many of them were answered wrongly.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Tally {
    pub(crate) trials: u32,
    pub(crate) wrong: u32,
}

/// A note in the record.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Note {
    /// Since the session began, as the computer's clock tells; below 0 where it was set back.
    pub(crate) at_secs: f64,
    pub(crate) text: String,
}

/// Whether the answers reach the disk.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Disk {
    Saved,
    /// The disk refuses them; they wait in memory.
    Waiting {
        problem: String,
    },
}

impl Status {
    /// The session as it stands. Errors: responses that a staircase refuses, which no experiment holds.
    pub(crate) fn of(given: Given<'_>, bands: &mut Bands) -> Result<Self, Error> {
        let Given { experiment, header, events, elapsed_secs, has_begun, is_paused, stopped, .. } = given;
        let (protocol, progress, stage) = (experiment.protocol(), experiment.progress(), *experiment.stage());
        let answers = standing(events);
        let is_over = stage == Stage::Finished || events.last().is_some_and(Event::is_last);
        let minutes_left = MinutesLeft::of(&progress, protocol, events).filter(|_| !is_over);
        let tally = |role: Role| {
            let of_role = || answers.iter().filter(move |answered| answered.trial.role == role);
            Tally {
                trials: of_role().count() as u32,
                wrong: of_role().filter(|answered| !answered.correct).count() as u32,
            }
        };
        Ok(Self {
            participant: header.participant.clone(),
            protocol: protocol.name.clone(),
            task: protocol.task,
            elapsed_minutes: (elapsed_secs / 60.0) as u32,
            stage,
            has_begun,
            is_paused,
            is_over,
            is_ended_early: matches!(events.last(), Some(Event::Stop(_) | Event::Discard(_))),
            stopped: stopped.map(str::to_owned),
            refused_round: given.refused_round,
            other_display: given.other_display.map(str::to_owned),
            has_practice: !protocol.practice.ratios.is_empty(),
            can_repeat_practice: experiment.clone().repeat_practice().is_ok(),
            can_repeat_round: experiment.clone().repeat_round().is_ok(),
            answers_of_round: answers.iter().filter(|answered| answered.trial.round == progress.round).count() as u32,
            progress,
            rounds: rounds(experiment, &answers, bands)?,
            lines: protocol.line_trials.map(|_| tally(Role::Line)),
            catch_trials: protocol.catch_trials.map(|_| tally(Role::Catch)),
            minutes_left,
            missed_frames: events.iter().filter_map(|event| Some(event.answered()?.timing?.missed_frames)).sum(),
            notes: notes(header, events),
            disk: given.disk,
        })
    }

    /// The stage in one word.
    pub(crate) fn activity(&self) -> Activity {
        match self.stage {
            _ if self.is_ended_early => Activity::EndedEarly,
            _ if self.is_over => Activity::Complete,
            _ if self.stopped.is_some() => Activity::Stopped,
            _ if self.is_paused => Activity::Paused,
            Stage::Instructions => Activity::Instructions,
            Stage::Practice(_) | Stage::Feedback { .. } => Activity::Practice,
            Stage::Trial(trial) => Activity::Trial(trial.number),
            Stage::Rest { round, within_round: false, .. } => Activity::RestBefore(round),
            Stage::Rest { round, within_round: true, .. } => Activity::RestWithin(round),
            Stage::Finished => Activity::Complete,
        }
    }
}

impl Round {
    /// Trials that its staircases learned from.
    pub(crate) fn trials(&self) -> u32 {
        self.charts.iter().map(Chart::trials).sum()
    }

    /// Most such trials.
    pub(crate) fn trials_at_most(&self) -> u32 {
        self.charts.iter().map(|chart| if chart.is_done { chart.trials() } else { chart.trials_max }).sum()
    }
}

fn rounds(experiment: &Experiment, answers: &[&Answered], bands: &mut Bands) -> Result<Vec<Round>, Error> {
    let (protocol, progress, tracks) = (experiment.protocol(), experiment.progress(), experiment.tracks());
    let chart = |index: usize, bands: &mut Bands| {
        let is_its_own =
            |answered: &&&Answered| answered.trial.role == Role::Measure && answered.trial.track == Some(index as u32);
        let its_own: Vec<&Answered> = answers.iter().filter(is_its_own).copied().collect();
        let ratio_intervals90 = bands.of(protocol, index, &tracks[index])?;
        Ok(Chart::new(&tracks[index], &its_own, ratio_intervals90, &protocol.schedule))
    };
    let per_round = tracks.len() / progress.rounds as usize;
    let round = |number: u32| {
        let first = (number as usize - 1) * per_round;
        let charts: Vec<Chart> =
            (first..first + per_round).map(|index| chart(index, bands)).collect::<Result<_, Error>>()?;
        let state = match number.cmp(&progress.round) {
            _ if charts.iter().all(|chart| chart.is_done) => RoundState::Done,
            std::cmp::Ordering::Equal => RoundState::UnderWay,
            _ => RoundState::Ahead,
        };
        Ok(Round { number, condition: *tracks[first].condition(), state, charts })
    };
    (1..=progress.rounds).map(round).collect()
}

fn notes(header: &SessionHeader, events: &[Event]) -> Vec<Note> {
    let of_event = |event: &Event| {
        let moment = event.moment()?;
        let at_secs = moment.at.duration_since(header.started_at).as_secs_f64();
        Some(moment.notes.iter().map(move |text| Note { at_secs, text: text.clone() }).collect::<Vec<_>>())
    };
    events.iter().filter_map(of_event).flatten().collect()
}
