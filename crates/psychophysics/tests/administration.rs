//! What an administrator may do to a session: repeat practice or a round, end it early, note; and which answers
//! stand after it.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

mod support;

use std::path::Path;

use proptest::prelude::*;
use scumble_psychophysics::{
    Answered, EVENTS_FILE, Event, Experiment, Protocol, Reply, Role, Session, SessionHeader, Stage, Timing, standing,
};
use scumble_stimuli::Pattern;
use support::{header, moment, named, reply, small};

/// Two rounds of a few trials with rests within, so that every screen comes soon.
fn protocol(name: &str) -> Protocol {
    let mut protocol = small(name);
    protocol.conditions.patterns = vec![Pattern::Stair, Pattern::Step];
    protocol.schedule.rest_every_trials = Some(2);
    protocol
}

/// What people do in a session, in any order.
#[derive(Clone, Copy, Debug)]
enum Act {
    Answer {
        first: bool,
    },
    Proceed,
    RepeatPractice,
    RepeatRound,
    Stop,
    Note,
    /// The program is killed and started again.
    Restart,
}

fn act() -> impl Strategy<Value = Act> {
    prop_oneof![
        20 => any::<bool>().prop_map(|first| Act::Answer { first }),
        12 => Just(Act::Proceed),
        2 => Just(Act::RepeatPractice),
        2 => Just(Act::RepeatRound),
        1 => Just(Act::Note),
        2 => Just(Act::Restart),
        1 => Just(Act::Stop),
    ]
}

/// A session and its record.
struct Sitting {
    header: SessionHeader,
    experiment: Experiment,
    events: Vec<Event>,
    /// Answers that stand, by the definition.
    standing: Vec<Answered>,
}

impl Sitting {
    fn new(protocol: Protocol) -> Self {
        let header = header(protocol);
        let experiment = Experiment::resume(&header, &[]).unwrap();
        Self { header, experiment, events: Vec::new(), standing: Vec::new() }
    }

    /// Does it, if the stage allows it.
    fn act(&mut self, act: Act) -> Result<(), scumble_psychophysics::Error> {
        match act {
            Act::Answer { first } => {
                let onset_secs = self.events.len() as f64;
                let answers = self.experiment.stage().trial().map(|trial| trial.pictures.answers());
                let answer = answers.map_or(scumble_psychophysics::Answer::Left, |[a, b]| if first { a } else { b });
                let timing = Some(Timing { onset_secs, missed_frames: 0 });
                let event = self.experiment.answer(Reply { timing, ..reply(answer, 0.5) })?;
                self.standing.extend(event.answered().cloned());
                self.events.push(event);
            }
            Act::Proceed => self.experiment.proceed()?,
            Act::RepeatPractice => {
                self.experiment.repeat_practice()?;
                self.events.push(Event::RepeatPractice(moment("")));
            }
            Act::RepeatRound => {
                let round = self.experiment.progress().round;
                self.experiment.repeat_round()?;
                self.standing.retain(|answered| answered.trial.round != round);
                self.events.push(Event::RepeatRound(moment("")));
            }
            Act::Stop => {
                self.experiment.stop()?;
                self.events.push(Event::Stop(moment("fire alarm")));
            }
            Act::Note => self.events.push(Event::Note(moment("looked away"))),
            Act::Restart => self.experiment = Experiment::resume(&self.header, &self.events).unwrap(),
        }
        Ok(())
    }

    fn is_closed(&self) -> bool {
        self.events.last().is_some_and(Event::is_last)
    }

    /// Goes on from every screen that asks nothing.
    fn go_on(&mut self) {
        self.experiment = settled(&self.experiment);
    }

    /// Answers until `count` answers after practice stand.
    fn answer_until(&mut self, count: u32) {
        while self.experiment.progress().answered < count {
            self.go_on();
            self.act(Act::Answer { first: true }).unwrap();
        }
    }

    /// The record as it is read back.
    fn read(&self) -> Session {
        let header = serde_json::to_vec(&self.header).unwrap();
        let lines: String = self.events.iter().map(|event| serde_json::to_string(event).unwrap() + "\n").collect();
        Session::parse(Path::new("P07"), &header, lines.as_bytes()).unwrap()
    }
}

/// A machine behind the screens that ask nothing, which are not in the record.
fn settled(experiment: &Experiment) -> Experiment {
    let mut experiment = experiment.clone();
    while matches!(experiment.stage(), Stage::Instructions | Stage::Feedback { .. } | Stage::Rest { .. }) {
        experiment.proceed().unwrap();
    }
    experiment
}

/// The record alone leads to the machine, and the machine learned from what stands.
fn check(sitting: &Sitting) -> Result<(), TestCaseError> {
    let Sitting { header, experiment, events, standing: expected, .. } = sitting;
    let resumed = Experiment::resume(header, events).unwrap();
    prop_assert_eq!(resumed.tracks(), experiment.tracks());
    prop_assert_eq!(resumed.progress(), experiment.progress());
    if !matches!(events.last(), Some(Event::Stop(_))) {
        prop_assert_eq!(settled(&resumed), settled(experiment));
    }
    let session = sitting.read();
    prop_assert_eq!(&session.events, events);
    prop_assert_eq!(session.is_closed(), sitting.is_closed());

    prop_assert_eq!(&standing(events).into_iter().cloned().collect::<Vec<_>>(), expected);
    let count = |is: fn(&Role) -> bool| expected.iter().filter(|answered| is(&answered.trial.role)).count() as u32;
    prop_assert_eq!(experiment.progress().answered, count(|role| *role != Role::Practice));
    prop_assert_eq!(experiment.progress().trials, count(|role| *role == Role::Measure));
    for (index, track) in (0..).zip(experiment.tracks()) {
        let of_track = expected.iter().filter(|a| a.trial.role == Role::Measure && a.trial.track == Some(index));
        let responses: Vec<_> = of_track.map(|answered| (answered.trial.intensity(), answered.correct)).collect();
        prop_assert_eq!(track.responses(), responses);
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn whatever_people_do_the_record_alone_leads_to_the_same_session(
        which in 0_usize..3,
        acts in prop::collection::vec(act(), 1..80),
    ) {
        let mut sitting = Sitting::new(protocol(support::NAMES[which]));
        for act in acts {
            if sitting.is_closed() {
                break;
            }
            let (before, recorded) = (sitting.experiment.clone(), sitting.events.len());
            if sitting.act(act).is_err() {
                prop_assert_eq!((&sitting.experiment, sitting.events.len()), (&before, recorded), "a refusal changes nothing");
            }
            if sitting.events.len() > recorded {
                check(&sitting)?;
            }
        }
    }
}

#[test]
fn practice_once_more_shows_other_pictures_of_the_same_ratios_and_leads_back_to_the_round() {
    for answered in [0, 2] {
        let mut sitting = Sitting::new(protocol("two-alternative"));
        sitting.answer_until(answered);
        if answered == 0 {
            while !matches!(sitting.experiment.stage(), Stage::Rest { .. }) {
                let is_trial = sitting.experiment.stage().trial().is_some();
                sitting.act(if is_trial { Act::Answer { first: true } } else { Act::Proceed }).unwrap();
            }
        }
        let rest = *sitting.experiment.stage();
        sitting.act(Act::RepeatPractice).unwrap();
        for number in 3..=4 {
            let Stage::Practice(trial) = *sitting.experiment.stage() else {
                panic!("{:?}", sitting.experiment.stage())
            };
            assert_eq!(trial.number, number);
            let first = sitting.events[number as usize - 3].answered().unwrap().trial;
            assert_eq!(trial.ratio(), first.ratio());
            assert_ne!(trial.pictures, first.pictures);
            sitting.act(Act::Answer { first: false }).unwrap();
            sitting.act(Act::Proceed).unwrap();
        }
        assert_eq!(*sitting.experiment.stage(), rest);
        check(&sitting).unwrap();
    }
}

#[test]
fn a_round_once_more_begins_at_its_priors_with_other_pictures_and_leaves_the_rounds_before_it_alone() {
    let mut sitting = Sitting::new(protocol("two-alternative"));
    let fresh = sitting.experiment.tracks().to_vec();
    // Two staircases of three trials a round: round 1 is whole, round 2 has 3 answers.
    sitting.answer_until(9);
    let tracks = sitting.experiment.tracks().to_vec();
    let before: Vec<_> = standing(&sitting.events).into_iter().map(|answered| answered.trial).collect();
    sitting.act(Act::RepeatRound).unwrap();

    let rest = Stage::Rest { round: 2, rounds: 2, within_round: false };
    assert_eq!(*sitting.experiment.stage(), rest, "the rest that stands before the round");
    assert_eq!(sitting.experiment.tracks()[..2], tracks[..2]);
    assert_eq!(sitting.experiment.tracks()[2..], fresh[2..]);
    assert_eq!(sitting.experiment.progress().answered, 6);
    sitting.go_on();
    let trial = *sitting.experiment.stage().trial().unwrap();
    assert_eq!((trial.number, trial.round), (10, 2), "numbers go on counting");
    assert!(before.iter().all(|shown| shown.pictures != trial.pictures));
    sitting.answer_until(12);
    assert_eq!(*sitting.experiment.stage(), Stage::Finished);
    let numbers: Vec<u32> = standing(&sitting.events).iter().skip(2).map(|answered| answered.trial.number).collect();
    assert_eq!(numbers, [1, 2, 3, 4, 5, 6, 10, 11, 12, 13, 14, 15]);
    check(&sitting).unwrap();
}

#[test]
fn what_the_stage_does_not_allow_is_refused_with_what_is_allowed() {
    let said = |sitting: &mut Sitting, act: Act| sitting.act(act).unwrap_err().to_string();
    let mut sitting = Sitting::new(protocol("two-alternative"));
    let only_round = "allowed is trial and rest, after the round's first answer";
    assert_eq!(said(&mut sitting, Act::RepeatRound), format!("repeat_round at the stage instructions; {only_round}"));
    sitting.answer_until(1);
    sitting.go_on();
    assert_eq!(
        said(&mut sitting, Act::RepeatPractice),
        "repeat_practice at the stage trial; allowed is instructions, practice, feedback and rest"
    );
    // Between two rounds the one is over and the other not begun.
    sitting.answer_until(6);
    assert_eq!(said(&mut sitting, Act::RepeatRound), format!("repeat_round at the stage rest; {only_round}"));
    sitting.act(Act::Stop).unwrap();
    assert_eq!(said(&mut sitting, Act::Stop), "stop at the stage finished; allowed is every other stage");
    assert_eq!(said(&mut sitting, Act::RepeatRound), format!("repeat_round at the stage finished; {only_round}"));
}

#[test]
fn an_event_of_the_administrator_where_it_could_not_be_is_named_by_its_line() {
    let mut sitting = Sitting::new(named("two-alternative"));
    sitting.act(Act::Note).unwrap();
    sitting.events.push(Event::RepeatRound(moment("")));
    let message = sitting.read().replay().unwrap_err().to_string();
    let found =
        format!("{EVENTS_FILE}:2: repeat_round at the stage practice; allowed is repeat_round at trial and rest");
    assert!(message.contains(&found), "{message}");
}

#[test]
fn nothing_follows_an_end_a_stop_or_a_discard() {
    for (last, is_complete, is_discarded) in
        [(Event::Stop(moment("")), false, false), (Event::Discard(moment("")), false, true)]
    {
        let mut sitting = Sitting::new(protocol("yes-no"));
        sitting.answer_until(3);
        assert!(!sitting.read().is_closed());
        sitting.events.push(last);
        let session = sitting.read();
        assert!(session.is_closed());
        assert_eq!((session.is_complete(), session.is_discarded()), (is_complete, is_discarded));
        assert!(session.replay().is_ok());
        sitting.events.push(Event::Note(moment("")));
        let (header, lines) = (serde_json::to_vec(&sitting.header).unwrap(), &sitting.events);
        let lines: String = lines.iter().map(|event| serde_json::to_string(event).unwrap() + "\n").collect();
        let message = Session::parse(Path::new("P07"), &header, lines.as_bytes()).unwrap_err().to_string();
        assert!(message.ends_with("an event after the end; allowed is nothing"), "{message}");
    }
}

#[test]
fn an_onset_before_the_previous_one_is_no_answer() {
    let mut sitting = Sitting::new(protocol("two-alternative"));
    sitting.answer_until(2);
    sitting.go_on();
    let before = sitting.experiment.clone();
    let answer = before.stage().trial().unwrap().pictures.answers()[0];
    for onset_secs in [0.5, -1.0, f64::NAN, f64::INFINITY] {
        let timing = Some(Timing { onset_secs, missed_frames: 0 });
        let error = sitting.experiment.answer(Reply { timing, ..reply(answer, 1.0) }).unwrap_err();
        assert!(error.to_string().starts_with("timing.onset_secs is"), "{error}");
        assert_eq!(sitting.experiment, before);
    }
}

#[test]
fn the_record_tells_the_latest_moment_that_it_knows() {
    let started_at: jiff::Timestamp = "2026-03-01T09:30:00Z".parse().unwrap();
    let mut sitting = Sitting::new(protocol("two-alternative"));
    assert_eq!(sitting.read().last_known_at(), started_at);
    sitting.answer_until(1);
    // Three answers at 0, 1 and 2 s, each after half a second.
    let at = |millis: i64| started_at + jiff::SignedDuration::from_millis(millis);
    assert_eq!(sitting.read().last_known_at(), at(2500));
    sitting.act(Act::Note).unwrap();
    assert_eq!(sitting.read().last_known_at(), moment("").at);
    // A clock that was set back does not take the moment back.
    let early = scumble_psychophysics::Moment { at: at(-5000), ..moment("") };
    sitting.events.push(Event::Pause(early));
    assert_eq!(sitting.read().last_known_at(), moment("").at);
}
