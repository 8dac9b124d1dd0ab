//! Sessions as a laboratory records them: a clock, notes, interruptions, repeated rounds.

#![allow(dead_code, reason = "each test program uses a part of it")]
#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

use std::path::Path;

use jiff::{SignedDuration, Timestamp};
use scumble_psychophysics::{
    Consent, Demographics, Display, Event, Experience, Experiment, Gender, Handedness, Moment, Observer, ObserverModel,
    Protocol, Reply, SessionHeader, SessionWriter, Software, Stage, Timing, Vision,
};

/// From the end of an answer to the next pictures.
const FIXATION_SECS: f64 = 0.5;

/// A protocol of one round, two staircases of three trials, two practice trials.
pub fn small(name: &str) -> Protocol {
    let mut protocol = Protocol::named(name).unwrap();
    protocol.conditions.patterns.truncate(1);
    protocol.conditions.contrasts.truncate(1);
    protocol.conditions.texels_px.truncate(2);
    protocol.practice.ratios.truncate(2);
    (protocol.schedule.trials_min, protocol.schedule.trials_max) = (3, 3);
    protocol
}

/// A person of whom everything is known, at a display of which everything is known.
pub fn header(code: &str, protocol: Protocol, started_at: &str) -> SessionHeader {
    let software = Software::of("scumble-study", "0.1.0");
    let started_at: Timestamp = started_at.parse().unwrap();
    let mut header = SessionHeader::new(code, protocol, 11, started_at, software);
    header.display = Some(display());
    header.demographics = Some(Demographics {
        age_years: Some(28),
        gender: Some(Gender::Female),
        handedness: Some(Handedness::Both),
        vision: Some(Vision::Corrected),
        graphics_experience: Some(Experience::Expert),
    });
    header.consent = Some(Consent { text_sha256: "0".repeat(64), agreed_at: started_at });
    header.room = Some("blinds\tdown, one lamp".to_owned());
    header
}

fn display() -> Display {
    Display {
        monitor: Some("DELL U2720Q".to_owned()),
        width_px: 3840,
        height_px: 2160,
        scale_factor: 1.5,
        px_per_degree: Some(66.25),
        refresh_hz: Some(60.0),
        window_px: Some([3840, 2160]),
        px_per_mm: Some(6.4),
        viewing_distance_mm: Some(600.0),
        luminance_table: None,
        gamma_check_level: Some(187),
    }
}

/// A session under way, on disk.
pub struct Sitting {
    experiment: Experiment,
    person: Observer,
    writer: SessionWriter,
    started_at: Timestamp,
    /// Seconds from the beginning.
    pub now_secs: f64,
}

impl Sitting {
    /// Sits a person down.
    pub fn new(directory: &Path, header: &SessionHeader) -> Self {
        Self {
            experiment: Experiment::new(header.protocol.clone(), header.seed, header.participant_number).unwrap(),
            person: Observer::new(ObserverModel::default(), header.seed).unwrap(),
            writer: SessionWriter::create(directory, header).unwrap(),
            started_at: header.started_at,
            now_secs: 0.0,
        }
    }

    /// Answers trials until none is left or `most` are answered; calls `before` with each trial's onset before its
    /// answer is written.
    pub fn answer_while(&mut self, most: usize, mut before: impl FnMut(&mut Self, f64)) {
        let mut answered = 0;
        while answered < most && *self.experiment.stage() != Stage::Finished {
            let Some(trial) = self.experiment.stage().trial().copied() else {
                self.experiment.proceed().unwrap();
                continue;
            };
            let onset_secs = self.now_secs + FIXATION_SECS;
            before(self, onset_secs);
            let response_time_secs = self.person.response_time_secs(&trial);
            let reply = Reply {
                answer: self.person.answer(&trial, &self.experiment.protocol().pictures).unwrap(),
                response_time_secs,
                pictures_sha256: Vec::new(),
                timing: Some(Timing { onset_secs, missed_frames: u32::from(trial.number == 2) }),
            };
            let event = self.experiment.answer(reply).unwrap();
            self.writer.append(&event).unwrap();
            self.now_secs = onset_secs + response_time_secs;
            answered += 1;
        }
    }

    /// Answers `count` trials.
    pub fn answer(&mut self, count: usize) {
        self.answer_while(count, |_, _| ());
    }

    /// Answers all that are left.
    pub fn finish(&mut self) {
        self.answer(usize::MAX);
        self.moment(Event::End, "");
    }

    /// Writes an event without answer, by a clock that is right.
    pub fn moment(&mut self, event: fn(Moment) -> Event, note: &str) {
        self.moment_at(self.now_secs, event, note);
    }

    /// Writes an event without answer at the time that the clock shows, seconds from the beginning.
    pub fn moment_at(&mut self, clock_secs: f64, event: fn(Moment) -> Event, note: &str) {
        let at = self.started_at + SignedDuration::from_secs_f64(clock_secs);
        let notes = if note.is_empty() { Vec::new() } else { vec![note.to_owned()] };
        self.writer.append(&event(Moment { at, notes, interrupted_secs: None })).unwrap();
    }

    /// Interrupts the session and takes it up again.
    pub fn interrupt(&mut self, secs: f64) {
        self.moment(Event::Pause, "");
        self.now_secs += secs;
        let at = self.started_at + SignedDuration::from_secs_f64(self.now_secs);
        self.writer.append(&Event::Resume(Moment { at, notes: Vec::new(), interrupted_secs: Some(secs) })).unwrap();
    }

    /// Lets the round under way begin anew.
    pub fn repeat_round(&mut self) {
        self.experiment.repeat_round().unwrap();
        self.moment(Event::RepeatRound, "");
    }
}
