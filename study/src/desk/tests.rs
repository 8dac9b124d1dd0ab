//! What a status says of sessions of simulated people.

use scumble_psychophysics::{Event, Role, Stage, Track};

use super::testing::Rehearsed;
use super::{Activity, Bands, Barrier, Disk, Order, RoundState, Status};

#[test]
fn every_chart_holds_its_staircases_responses_verdict_and_estimate() {
    for protocol in ["two-alternative", "yes-no", "published"] {
        let session = Rehearsed::new(protocol).at_trial(70);
        let status = session.status();
        let charts: Vec<_> = status.rounds.iter().flat_map(|round| &round.charts).collect();
        assert_eq!(charts.len(), session.experiment.tracks().len(), "{protocol}");
        for (chart, track) in charts.iter().zip(session.experiment.tracks()) {
            let shown =
                |point: &super::Point| ((point.ratio.log10() + intensity(track, point)).abs() < 1e-12, point.is_right);
            let expected: Vec<_> = track.responses().iter().map(|(_, is_right)| (true, *is_right)).collect();
            assert_eq!(chart.points.iter().map(shown).collect::<Vec<_>>(), expected, "{protocol}");
            assert_eq!(chart.trials(), track.trials());
            assert_eq!(chart.ratio_intervals90.len(), track.responses().len() + 1);
            assert_eq!(chart.ratio_intervals90.last(), Some(&track.estimate().ratio_interval90));
            assert_eq!(chart.estimate, track.estimate());
            assert_eq!(chart.verdict.reasons(), track.verdict().reasons());
            assert_eq!((chart.texel_px, chart.is_done), (track.condition().texel_px, track.is_done()));
        }
        assert_eq!(status.rounds.iter().map(super::Round::trials).sum::<u32>(), status.progress.trials);
    }
}

/// Intensity of the response that a point stands for.
fn intensity(track: &Track, point: &super::Point) -> f64 {
    track.responses()[point.number as usize - 1].0
}

#[test]
fn intervals_that_are_kept_equal_those_computed_anew() {
    let mut bands = Bands::default();
    let mut session = Rehearsed::new("two-alternative");
    for number in [1, 2, 20, 33] {
        session = session.at_trial(number);
        assert_eq!(status_with(&session, &mut bands), session.status(), "at trial {number}");
    }
    session.experiment.repeat_round().unwrap();
    session.events.push(Event::RepeatRound(session.moment("")));
    assert_eq!(status_with(&session, &mut bands), session.status(), "in the repeated round");
}

fn status_with(session: &Rehearsed, bands: &mut Bands) -> Status {
    Status::of(session.given(false, Disk::Saved), bands).unwrap()
}

#[test]
fn a_repeated_round_has_no_points_and_earlier_rounds_keep_theirs() {
    let in_second = |experiment: &scumble_psychophysics::Experiment| {
        matches!(experiment.stage(), Stage::Trial(trial) if trial.round == 2) && experiment.tracks()[3].trials() > 4
    };
    let mut session = Rehearsed::new("two-alternative").until(in_second);
    let before = session.status();
    assert!(before.answers_of_round > 0);
    session.experiment.repeat_round().unwrap();
    session.events.push(Event::RepeatRound(session.moment("")));
    let after = session.status();
    assert_eq!(after.rounds[0], before.rounds[0]);
    assert_eq!(after.rounds[0].state, RoundState::Done);
    assert_eq!((after.rounds[1].trials(), after.rounds[1].state), (0, RoundState::UnderWay));
    assert_eq!(after.answers_of_round, 0);
    assert_eq!(after.barrier(&Order::RepeatRound(2)), Some(Barrier::RoundUnanswered));
    assert_eq!(before.barrier(&Order::RepeatRound(1)), Some(Barrier::RoundOver));
}

#[test]
fn minutes_left_are_the_trials_left_at_this_sessions_pace() {
    // Three seconds a trial; half of the trials are lines and 3 % catch trials where the protocol has them.
    for (protocol, measured_share) in [("two-alternative", 1.0), ("yes-no", 0.5 * 0.97)] {
        let status = Rehearsed::new(protocol).at_trial(40).status();
        let left = status.minutes_left.unwrap();
        let progress = &status.progress;
        for (minutes, trials) in [(left.at_least, progress.trials_at_least), (left.at_most, progress.trials_at_most)] {
            let expected = f64::from(trials - progress.trials) / measured_share * 3.0 / 60.0;
            assert!((minutes / expected - 1.0).abs() < 1e-9, "{protocol}: {minutes} instead of {expected}");
        }
        assert!(left.at_least < left.at_most);
    }
    assert_eq!(Rehearsed::new("two-alternative").at_trial(3).status().minutes_left, None);
    assert_eq!(Rehearsed::new("two-alternative").until(|_| false).status().minutes_left, None);
}

#[test]
fn lines_and_catch_trials_are_counted_with_their_wrong_answers() {
    let session = Rehearsed::new("yes-no").at_trial(150);
    let status = session.status();
    for (tally, role) in [(status.lines.unwrap(), Role::Line), (status.catch_trials.unwrap(), Role::Catch)] {
        let of_role: Vec<_> =
            session.events.iter().filter_map(Event::answered).filter(|answered| answered.trial.role == role).collect();
        assert!(!of_role.is_empty());
        assert_eq!(tally.trials as usize, of_role.len());
        assert_eq!(tally.wrong as usize, of_role.iter().filter(|answered| !answered.correct).count());
    }
    let none = Rehearsed::new("published").at_trial(5).status();
    assert_eq!((none.lines, none.catch_trials), (None, None));
}

#[test]
fn missed_frames_are_summed_and_notes_are_listed_with_their_time() {
    let mut session = Rehearsed::new("two-alternative").at_trial(10);
    session.events.push(Event::Note(session.moment("a door slammed")));
    let status = session.status();
    // The fourth trial of practice and the fourth measured one came a refresh late.
    assert_eq!(status.missed_frames, 2);
    assert_eq!(status.notes.len(), 1);
    assert_eq!((status.notes[0].text.as_str(), status.notes[0].at_secs), ("a door slammed", session.now_secs));
}

#[test]
fn what_can_be_ordered_follows_the_experiment() {
    let orders = [
        Order::Pause,
        Order::Resume,
        Order::Note("x".into()),
        Order::RepeatPractice,
        Order::RepeatRound(1),
        Order::Stop,
    ];
    let barriers = |status: &Status| orders.clone().map(|order| status.barrier(&order));

    let instructions = Rehearsed::new("two-alternative").status();
    assert_eq!(instructions.activity(), Activity::Instructions);
    assert_eq!(barriers(&instructions), [Some(Barrier::NotBegun); 6]);

    let practice = Rehearsed::new("two-alternative").until(|e| matches!(e.stage(), Stage::Practice(_))).status();
    let (unpaused, unanswered) = (Some(Barrier::NotPaused), Some(Barrier::RoundUnanswered));
    assert_eq!(barriers(&practice), [None, unpaused, None, None, unanswered, None]);

    let trial = Rehearsed::new("two-alternative").at_trial(9);
    let between = Some(Barrier::BetweenTrials);
    assert_eq!(barriers(&trial.status()), [None, unpaused, None, between, None, None]);
    let paused = trial.status_of(true, Disk::Saved);
    assert_eq!(barriers(&paused), [Some(Barrier::AlreadyPaused), None, None, between, None, None]);
    assert_eq!(paused.activity(), Activity::Paused);

    let stopped = Status { stopped: Some("no picture".to_owned()), ..trial.status() };
    let [pause, resume, note, practice, round, stop] = barriers(&stopped);
    assert_eq!([pause, resume, practice, round, stop], [Some(Barrier::Stopped); 5]);
    assert_eq!((note, stopped.activity()), (None, Activity::Stopped));

    let mut over = Rehearsed::new("two-alternative").until(|_| false);
    assert_eq!(barriers(&over.status()), [Some(Barrier::Over); 6]);
    assert_eq!(over.status().activity(), Activity::Complete);
    over.events.push(Event::Stop(over.moment("")));
    assert_eq!(over.status().activity(), Activity::EndedEarly);
}

#[test]
fn time_that_goes_by_makes_no_new_status_and_an_answer_does() {
    let mut session = Rehearsed::new("two-alternative").at_trial(9);
    let status = session.status();
    session.now_secs += 0.5;
    assert_eq!(session.status(), status);
    assert_ne!(session.at_trial(10).status(), status);
}
