//! Sessions become people with answers.
//!
//! The convergence rule is the experiment's own, which replayed every session. Sessions of one participant code
//! are one person. All sessions must share one protocol; simulated people and humans are not mixed. A session that
//! the administrator discarded is left out with a notice; of one that was ended early the answers count.

use std::{collections::BTreeMap, path::PathBuf};

use scumble_core::SessionHash;
use scumble_psychophysics::{Condition, EVENTS_FILE, Event, Experiment, HEADER_FILE, Protocol, Reason, Role, Round};

use crate::{
    Error,
    checks::Checks,
    load::{LoadedSession, check_kind, directory_name, load_sessions},
    series::round_of,
};

/// The answers that one staircase of one session learned from, in the order of the trials.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// Centre of the prior, radius in texels.
    pub prior_ratio: f64,
    /// Place of the round in the session, from 1.
    pub round: u32,
    /// Intensity `log10(texel / radius)` as shown, and whether the answer was right.
    pub responses: Vec<(f64, bool)>,
    /// Why the experiment's convergence rule did not hold at the last trial; empty where it did.
    pub unconverged: Vec<Reason>,
}

/// One person's answers in one condition: every staircase of every session.
#[derive(Debug, Clone, PartialEq)]
pub struct Track {
    /// Pattern, contrast, kernel and texel size.
    pub condition: Condition,
    /// One a prior and session.
    pub runs: Vec<Run>,
}

impl Track {
    /// Every answer, run after run.
    pub fn responses(&self) -> impl Iterator<Item = (f64, bool)> {
        self.runs.iter().flat_map(|run| run.responses.iter().copied())
    }

    /// Number of runs that met the experiment's convergence rule.
    pub fn converged(&self) -> usize {
        self.runs.iter().filter(|run| run.unconverged.is_empty()).count()
    }
}

/// One person.
#[derive(Debug, Clone, PartialEq)]
pub struct Person {
    /// The participant code.
    pub code: String,
    /// The answers that staircases learned from, in the order of the protocol's conditions.
    pub tracks: Vec<Track>,
    /// The answers to the trials between them.
    pub checks: Checks,
}

impl Person {
    /// The person who gave the answers of `events` in an experiment; those that do not stand are left out.
    pub fn of(code: &str, experiment: &Experiment, events: &[Event]) -> Self {
        let mut rounds: Vec<Round> = Vec::new();
        for track in experiment.tracks() {
            let round = round_of(track.condition());
            if !rounds.contains(&round) {
                rounds.push(round);
            }
        }
        let place = |round: Round| rounds.iter().position(|other| *other == round).map_or(0, |index| index as u32 + 1);
        let runs_of = |condition: &Condition| {
            let here = experiment.tracks().iter().filter(|track| track.condition() == condition);
            here.map(|track| Run {
                prior_ratio: track.prior_ratio(),
                round: place(round_of(condition)),
                responses: track.responses().to_vec(),
                unconverged: track.verdict().reasons(),
            })
            .collect()
        };
        let conditions = experiment.protocol().all_conditions().into_iter();
        let tracks = conditions.map(|condition| Track { runs: runs_of(&condition), condition }).collect();
        Self { code: code.to_owned(), tracks, checks: Checks::of(events) }
    }

    /// Adds the answers of a further session.
    fn append(&mut self, other: Self) {
        for (track, more) in self.tracks.iter_mut().zip(other.tracks) {
            track.runs.extend(more.runs);
        }
        self.checks = self.checks + other.checks;
    }
}

/// All people of a study.
#[derive(Debug, Clone)]
pub struct Study {
    /// The protocol that all sessions share.
    pub protocol: Protocol,
    /// The people, by code.
    pub people: Vec<Person>,
    /// The sessions, by path; empty for a study that never was on disk.
    pub sessions: Vec<LoadedSession>,
    /// What the reader dropped or missed, in sentences.
    pub notices: Vec<String>,
}

impl Study {
    /// Reads sessions; each path is a session or a folder of sessions. Discarded ones are left out with a notice.
    ///
    /// # Errors
    /// Names the folder without sessions, the damaged file and line, the session with another
    /// protocol, or the copy of a session.
    pub fn read(paths: &[PathBuf]) -> Result<Self, Error> {
        let (loaded, discarded): (Vec<_>, Vec<_>) =
            load_sessions(paths)?.into_iter().partition(|(loaded, _)| !loaded.session.is_discarded());
        let left_out = discarded.iter().map(|(LoadedSession { session, .. }, _)| {
            format!("{}: the administrator discarded the session; it is left out", session.directory.display())
        });
        let mut notices: Vec<String> = left_out.collect();
        check_alike(&loaded)?;
        let Some((first, _)) = loaded.first() else {
            let reason = match notices.is_empty() {
                true => "no session was given".to_owned(),
                false => notices.join("; "),
            };
            return Err(Error::CannotFit(reason));
        };

        let protocol = first.session.header.protocol.clone();
        let mut people: BTreeMap<String, Person> = BTreeMap::new();
        for (LoadedSession { session, .. }, experiment) in &loaded {
            notices.extend(session.notices.iter().cloned());
            if !session.is_complete() {
                let directory = session.directory.display();
                let progress = experiment.progress();
                let how = if session.is_closed() { "was ended early" } else { "was not finished" };
                notices.push(format!(
                    "{directory}: the session {how}: round {} of {}, {} trials",
                    progress.round, progress.rounds, progress.trials
                ));
            }
            let person = Person::of(&session.header.participant, experiment, &session.events);
            match people.get_mut(&person.code) {
                Some(known) => known.append(person),
                None => _ = people.insert(person.code.clone(), person),
            }
        }
        let sessions = loaded.into_iter().map(|(session, _)| session).collect();
        Ok(Self { protocol, people: people.into_values().collect(), sessions, notices })
    }

    /// Number of measured trials.
    pub fn trial_count(&self) -> usize {
        let tracks = self.people.iter().flat_map(|person| &person.tracks);
        tracks.flat_map(|track| &track.runs).map(|run| run.responses.len()).sum()
    }

    /// Whether the answers are those of simulated people.
    pub fn is_simulated(&self) -> bool {
        self.sessions.iter().any(|loaded| loaded.session.header.simulated_observer.is_some())
    }

    /// Name and content hash of every session.
    pub fn session_hashes(&self) -> Vec<SessionHash> {
        let of = |loaded: &LoadedSession| SessionHash {
            session: directory_name(&loaded.session.directory),
            sha256: loaded.sha256.clone(),
        };
        self.sessions.iter().map(of).collect()
    }
}

/// Refuses a session without a measured trial, a second protocol, and humans among simulated people.
fn check_alike(loaded: &[(LoadedSession, Experiment)]) -> Result<(), Error> {
    let Some((first, _)) = loaded.first() else { return Ok(()) };
    let first = &first.session;
    for (LoadedSession { session, .. }, _) in loaded {
        if !session.standing().iter().any(|answered| answered.trial.role == Role::Measure) {
            let reason = "the session has no measured trial that stands; leave it out".to_owned();
            return Err(Error::File { path: session.directory.join(EVENTS_FILE), reason });
        }
        if session.header.protocol != first.header.protocol {
            let other = first.directory.display();
            let reason = format!("its protocol differs from that of {other}; a fit takes one protocol");
            return Err(Error::File { path: session.directory.join(HEADER_FILE), reason });
        }
        check_kind(first, session)?;
    }
    Ok(())
}
