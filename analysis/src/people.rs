//! Sessions become people with answers.
//!
//! The convergence rule is the experiment's own, which replayed every session. Sessions of one participant code
//! are one person. All sessions must share one protocol, but for what changes no answer's meaning
//! (name, schedule, convergence, practice, centres of priors); simulated people and humans are not mixed. A session that the administrator
//! discarded, or without an answer that stands, is left out with a notice; of one that was ended early the answers count.
//! Answers and people that the protocol's exclusions name are left out, each with its reason.

use std::{
    collections::{BTreeMap, BTreeSet},
    path::PathBuf,
};

use scumble_core::SessionHash;
use scumble_psychophysics::{
    Answered, Condition, Event, Exclusions, Experiment, HEADER_FILE, Protocol, Reason, Role, Round, Session, standing,
};

use crate::{
    Error,
    checks::Checks,
    load::{LoadedSession, NEVER_BEGAN, Sessions, check_kind, directory_name, load_sessions},
    protocols::first_difference,
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
    /// How many answers the protocol's exclusions leave out, by reason.
    pub excluded: BTreeMap<&'static str, u32>,
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
        let rules = experiment.protocol().exclusions.unwrap_or_default();
        let (kept, left_out): (Vec<&Answered>, Vec<&Answered>) = standing(events)
            .into_iter()
            .filter(|answered| answered.trial.role != Role::Practice)
            .partition(|answered| rules.of_response_time(answered.response_time_secs).is_none());
        let runs_of = |condition: &Condition| {
            let tracks = experiment.tracks().iter().zip(0..).filter(|(track, _)| track.condition() == condition);
            let run_of = |(track, index)| Run {
                prior_ratio: scumble_psychophysics::Track::prior_ratio(track),
                round: place(round_of(condition)),
                responses: kept
                    .iter()
                    .filter(|answered| answered.trial.role == Role::Measure && answered.trial.track == Some(index))
                    .map(|answered| (answered.trial.intensity(), answered.correct))
                    .collect(),
                unconverged: track.verdict().reasons(),
            };
            tracks.map(run_of).collect()
        };
        let mut excluded = BTreeMap::new();
        for answered in left_out {
            if let Some(reason) = rules.of_response_time(answered.response_time_secs) {
                *excluded.entry(reason).or_default() += 1;
            }
        }
        let conditions = experiment.protocol().all_conditions().into_iter();
        let tracks = conditions.map(|condition| Track { runs: runs_of(&condition), condition }).collect();
        Self { code: code.to_owned(), tracks, checks: Checks::of(&kept), excluded }
    }

    /// Adds the answers of a further session.
    fn append(&mut self, other: Self) {
        for (track, more) in self.tracks.iter_mut().zip(other.tracks) {
            track.runs.extend(more.runs);
        }
        self.checks = self.checks + other.checks;
        for (reason, count) in other.excluded {
            *self.excluded.entry(reason).or_default() += count;
        }
    }

    /// Why the protocol's exclusions leave the person out; `None` where they do not.
    fn exclusion(&self, rules: &Exclusions) -> Option<String> {
        let Checks { lines, false_alarms, catches, catches_seen } = self.checks;
        let missed = catches - catches_seen;
        let is_above = |count: u32, of: u32, most: Option<f64>| {
            most.is_some_and(|most| of > 0 && f64::from(count) > most * f64::from(of))
        };
        if is_above(missed, catches, rules.catch_misses_max) {
            let most = rules.catch_misses_max.unwrap_or_default();
            return Some(format!("missed {missed} of {catches} catch trials; the protocol allows a share of {most}"));
        }
        if is_above(false_alarms, lines, rules.false_alarms_max) {
            let most = rules.false_alarms_max.unwrap_or_default();
            return Some(format!(
                "called {false_alarms} of {lines} lines artifacts; the protocol allows a share of {most}"
            ));
        }
        None
    }

    fn has_answers(&self) -> bool {
        self.tracks.iter().any(|track| track.responses().next().is_some())
    }
}

/// All people of a study.
#[derive(Debug, Clone)]
pub struct Study {
    /// The protocol that all sessions share.
    pub protocol: Protocol,
    /// The people, by code.
    pub people: Vec<Person>,
    /// Codes of the people whom the protocol's exclusions leave out.
    pub excluded_people: BTreeSet<String>,
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
        let Sessions { loaded: all, never_began } = load_sessions(paths)?;
        let of_path = |path: PathBuf| format!("{}: left out: {NEVER_BEGAN}", path.display());
        let mut notices: Vec<String> = never_began.into_iter().map(of_path).collect();
        let (loaded, left_out): (Vec<_>, Vec<_>) =
            all.into_iter().partition(|(loaded, _)| reason_to_leave_out(&loaded.session).is_none());
        notices.extend(left_out.iter().filter_map(|(LoadedSession { session, .. }, _)| {
            Some(format!("{}: left out: {}", session.directory.display(), reason_to_leave_out(session)?))
        }));
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
        for code in people.keys() {
            let count = loaded.iter().filter(|(loaded, _)| loaded.session.header.participant == *code).count();
            if count > 1 {
                notices.push(format!("{code}: {count} sessions of this code are taken for one person's"));
            }
        }
        let sessions = loaded.into_iter().map(|(session, _)| session).collect();
        let (people, excluded_people) = apply_exclusions(people.into_values(), &protocol, &mut notices);
        if people.is_empty() {
            return Err(Error::CannotFit(notices.join("; ")));
        }
        Ok(Self { protocol, people, excluded_people, sessions, notices })
    }

    /// The study of people who never were on disk; those whom the protocol excludes are left out with a notice.
    ///
    /// # Errors
    /// Nobody is left.
    pub fn of(protocol: Protocol, people: Vec<Person>) -> Result<Self, Error> {
        let mut notices = Vec::new();
        let (people, excluded_people) = apply_exclusions(people.into_iter(), &protocol, &mut notices);
        if people.is_empty() {
            return Err(Error::CannotFit(notices.join("; ")));
        }
        Ok(Self { protocol, people, excluded_people, sessions: Vec::new(), notices })
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

    /// Geometric mean of the simulated people's own thresholds in a round, as ratios; `None` for humans, and for observers
    /// whose thresholds follow from the pictures.
    pub fn true_ratio(&self, round: Round) -> Option<f64> {
        let condition = self.protocol.all_conditions().into_iter().find(|condition| round_of(condition) == round)?;
        let log10 = |loaded: &LoadedSession| {
            let observer = loaded.session.header.simulated_observer.as_ref()?;
            Some(observer.threshold_ratio(&condition)?.log10())
        };
        let all: Vec<f64> = self.sessions.iter().map(log10).collect::<Option<_>>()?;
        (!all.is_empty()).then(|| 10_f64.powf(all.iter().sum::<f64>() / all.len() as f64))
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

/// Why a session does not enter a fit; `None` where it does.
fn reason_to_leave_out(session: &Session) -> Option<&'static str> {
    let has_answers = || session.standing().iter().any(|answered| answered.trial.role == Role::Measure);
    match session.is_discarded() {
        true => Some("the administrator discarded the session"),
        false if !has_answers() => Some("the session has no measured trial that stands"),
        false => None,
    }
}

/// Splits people by the protocol's exclusions; what is left out gets a sentence among the notices.
fn apply_exclusions(
    people: impl Iterator<Item = Person>,
    protocol: &Protocol,
    notices: &mut Vec<String>,
) -> (Vec<Person>, BTreeSet<String>) {
    let rules = protocol.exclusions.unwrap_or_default();
    let (mut kept, mut excluded) = (Vec::new(), BTreeSet::new());
    for person in people {
        let code = &person.code;
        notices.extend(
            person.excluded.iter().map(|(reason, count)| format!("{code}: answers left out: {count} {reason}")),
        );
        let no_answer = || (!person.has_answers()).then(|| "no answer is left".to_owned());
        match person.exclusion(&rules).or_else(no_answer) {
            Some(reason) => {
                notices.push(format!("{code}: left out: {reason}"));
                excluded.insert(code.clone());
            }
            None => kept.push(person),
        }
    }
    (kept, excluded)
}

/// Refuses protocols that give an answer another meaning, and humans among simulated people.
fn check_alike(loaded: &[(LoadedSession, Experiment)]) -> Result<(), Error> {
    let Some((first, _)) = loaded.first() else { return Ok(()) };
    let first = &first.session;
    for (LoadedSession { session, .. }, _) in loaded {
        if let Some(difference) = first_difference(&first.header.protocol, &session.header.protocol)? {
            let other = first.directory.display();
            let reason = format!("its protocol differs from that of {other}: {difference}");
            return Err(Error::File { path: session.directory.join(HEADER_FILE), reason });
        }
        check_kind(first, session)?;
    }
    Ok(())
}
