//! Whole sessions through the state machine: what is shown, what is learned, what is refused.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

use scumble_psychophysics::{
    Answer, Error, Event, Experiment, ObserverParameters, Pictures, Protocol, Reply, Stage, Trial, WeibullObserver,
    rehearse,
};
use scumble_stimuli::{Pattern, Shape, Stimulus, Transfer};

fn observer(seed: u64) -> WeibullObserver {
    WeibullObserver::new(ObserverParameters::default(), seed).unwrap()
}

fn session(seed: u64) -> (Experiment, Vec<Event>) {
    let mut experiment = Experiment::new(Protocol::two_alternative(), seed, 0).unwrap();
    let events = rehearse(&mut experiment, &observer(seed)).unwrap();
    (experiment, events)
}

fn reply(answer: Answer, response_time_secs: f64) -> Reply {
    Reply { answer, response_time_secs, pictures_sha256: Vec::new() }
}

fn measured(events: &[Event]) -> Vec<Trial> {
    let answered = events.iter().filter_map(Event::measured);
    answered.map(|answered| answered.trial).collect()
}

fn at_first_trial(protocol: Protocol) -> Experiment {
    let mut experiment = Experiment::new(protocol, 1, 0).unwrap();
    while !matches!(experiment.stage(), Stage::Trial(_)) {
        match experiment.stage() {
            Stage::Practice(_) => drop(experiment.answer(reply(Answer::Left, 1.0)).unwrap()),
            _ => experiment.proceed().unwrap(),
        }
    }
    experiment
}

#[test]
fn the_same_seed_gives_the_same_session_image_for_image() {
    let (first, second) = (session(7).1, session(7).1);
    assert_eq!(first, second);
    for (a, b) in measured(&first).iter().zip(&measured(&second)).take(6) {
        let pixels = |stimulus: &Stimulus| stimulus.render(96, 72, &Transfer::srgb()).unwrap().into_raw();
        for (a, b) in a.pictures.all().into_iter().zip(b.pictures.all()) {
            assert_eq!(pixels(a), pixels(b));
        }
    }
}

#[test]
fn another_seed_gives_another_session() {
    let (a, b) = (measured(&session(1).1), measured(&session(2).1));
    assert!(a.iter().zip(&b).all(|(a, b)| a.pictures.all()[0].phase != b.pictures.all()[0].phase));
}

#[test]
fn a_session_has_four_rounds_of_three_sizes_and_each_size_ten_to_twenty_eight_trials() {
    let (experiment, events) = session(3);
    assert_eq!(experiment.tracks().len(), 12);
    let conditions = experiment.protocol().all_conditions();
    for track in experiment.tracks() {
        assert!(conditions.contains(track.condition()));
        assert!((10..=28).contains(&track.trials()) && track.is_done());
        assert!(track.trials() == 28 || track.verdict().is_converged());
    }
    for (round, tracks) in (1..).zip(experiment.tracks().chunks(3)) {
        let of_round = measured(&events).into_iter().filter(|t| t.round == round);
        for trial in of_round {
            assert_eq!(trial.condition.pattern, tracks[0].condition().pattern);
            assert_eq!(trial.condition.contrast, tracks[0].condition().contrast);
        }
    }
}

#[test]
fn every_round_comes_first_in_some_session() {
    let mut first_rounds: Vec<String> = (0..40)
        .map(|seed| {
            let experiment = Experiment::new(Protocol::two_alternative(), seed, 0).unwrap();
            let condition = experiment.tracks()[0].condition();
            format!("{:?} {}", condition.pattern, condition.contrast)
        })
        .collect();
    first_rounds.sort();
    first_rounds.dedup();
    assert_eq!(first_rounds.len(), 4);
}

#[test]
fn the_sizes_of_a_round_never_run_apart_by_more_than_one_trial() {
    let trials = measured(&session(5).1);
    for round in 1..=4 {
        let of_round: Vec<_> = trials.iter().filter(|trial| trial.round == round).collect();
        // Until the tenth trial no QUEST may stop, so the first 30 trials are ten whole cycles.
        for cycle in of_round[..30].chunks(3) {
            let mut sizes: Vec<f64> = cycle.iter().map(|trial| trial.condition.texel_px).collect();
            sizes.sort_by(f64::total_cmp);
            assert_eq!(sizes, [5.0, 10.0, 20.0]);
        }
    }
}

#[test]
fn the_two_pictures_differ_in_shape_dithering_and_tilt_alone() {
    let (_, events) = session(4);
    for trial in measured(&events) {
        let Pictures::Pair { left, right } = trial.pictures else { panic!("{:?}", trial.pictures) };
        let (line, artifact) = if trial.is_correct(Answer::Left) { (left, right) } else { (right, left) };
        assert_eq!((line.shape, artifact.shape), (Shape::Line, Shape::Artifact));
        assert_ne!(line.dither_seed, artifact.dither_seed);
        let twin = Stimulus { shape: Shape::Line, dither_seed: line.dither_seed, tilt_rad: line.tilt_rad, ..artifact };
        assert_eq!(line, twin);
        assert_eq!(line.radius_px, trial.radius_px);
    }
}

#[test]
fn side_mirroring_and_polarity_are_fair_coins_and_phase_is_uniform() {
    let trials: Vec<Trial> = (0..10).flat_map(|seed| measured(&session(seed).1)).collect();
    let count = trials.len() as f64;
    let share = |of: fn(&Trial) -> bool| trials.iter().filter(|t| of(t)).count() as f64 / count;
    // Four standard errors of a share.
    let slack = 4.0 * (0.25 / count).sqrt();
    let left = |trial: &Trial| trial.is_correct(Answer::Left);
    let shares = [
        share(left),
        share(|trial| trial.pictures.all()[0].mirrored),
        share(|trial| trial.pictures.all()[0].inverted),
        share(|trial| trial.pictures.all()[0].phase < 0.5),
        share(|trial| trial.is_correct(Answer::Left) == trial.pictures.all()[0].mirrored),
        share(|trial| trial.is_correct(Answer::Left) == trial.pictures.all()[0].inverted),
        share(|trial| trial.is_correct(Answer::Left) == (trial.pictures.all()[0].phase < 0.5)),
    ];
    assert!(shares.iter().all(|s| (s - 0.5).abs() < slack), "{shares:?}");
}

#[test]
fn practice_gives_feedback_and_teaches_no_quest() {
    let protocol = Protocol::two_alternative();
    let mut experiment = Experiment::new(protocol.clone(), 9, 0).unwrap();
    experiment.proceed().unwrap();
    for (number, ratio) in (1..).zip(&protocol.practice.ratios) {
        let Stage::Practice(trial) = *experiment.stage() else { panic!("{}", experiment.stage().name()) };
        assert_eq!((trial.number, trial.round), (number, 0));
        assert!((trial.ratio() - ratio).abs() < 1e-12);
        let side = [Answer::Left, Answer::Right][number as usize % 2];
        let event = experiment.answer(reply(side, 0.5)).unwrap();
        let correct = trial.is_correct(side);
        assert!(matches!(event, Event::Practice(answered) if answered.correct == correct));
        assert_eq!(*experiment.stage(), Stage::Feedback { correct });
        experiment.proceed().unwrap();
    }
    let first_rest = Stage::Rest { round: 1, rounds: 4, within_round: false };
    assert_eq!(*experiment.stage(), first_rest);
    let prior = protocol.staircase_at(3.0).unwrap();
    assert!(experiment.tracks().iter().all(|track| *track.staircase() == prior));
}

#[test]
fn a_rest_stands_before_every_round() {
    let mut experiment = at_first_trial(Protocol::two_alternative());
    let mut rests = vec![];
    let person = observer(1);
    while *experiment.stage() != Stage::Finished {
        match *experiment.stage() {
            Stage::Trial(trial) => {
                let progress = experiment.progress();
                assert_eq!(progress.round, trial.round);
                assert_eq!(progress.trials + 1, trial.number);
                assert!(progress.trials < progress.trials_at_least);
                assert!(progress.trials_at_least <= progress.trials_at_most);
                experiment.answer(reply(person.answer(&trial), 1.0)).unwrap();
            }
            Stage::Rest { round, rounds, .. } => {
                rests.push((round, rounds));
                experiment.proceed().unwrap();
            }
            stage => panic!("{}", stage.name()),
        }
    }
    assert_eq!(rests, [(2, 4), (3, 4), (4, 4)]);
    let progress = experiment.progress();
    assert_eq!(progress.trials, progress.trials_at_least);
    assert_eq!(progress.trials, progress.trials_at_most);
}

#[test]
fn quest_learns_from_the_radius_shown_where_the_picture_cannot_hold_the_one_asked_for() {
    let mut protocol = Protocol::two_alternative();
    // Radii up to 60 - 20 px: the threshold of 69 px at the largest texel cannot be shown.
    protocol.pictures.height_px = 120;
    let mut experiment = Experiment::new(protocol.clone(), 3, 0).unwrap();
    let events = rehearse(&mut experiment, &observer(3)).unwrap();
    let trials = measured(&events);
    let clamped: Vec<_> = trials.iter().filter(|trial| trial.is_clamped()).collect();
    assert!(clamped.len() > 10);
    for trial in clamped {
        let (smallest_px, largest_px) = protocol.radius_range_px(trial.condition.texel_px);
        assert!(trial.radius_px == smallest_px || trial.radius_px == largest_px);
    }
    for track in experiment.tracks() {
        let mut staircase = protocol.staircase_at(3.0).unwrap();
        let of_track = events.iter().filter_map(Event::measured);
        for answered in of_track.filter(|a| a.trial.condition == *track.condition()) {
            let shown = answered.trial.intensity();
            staircase.update(shown, answered.correct).unwrap();
        }
        assert_eq!(staircase, *track.staircase());
    }
    let largest_step = experiment
        .tracks()
        .iter()
        .filter(|track| track.condition().pattern == Pattern::Step && track.condition().texel_px == 20.0);
    // The threshold lies beyond what was shown, which the rule must not call converged.
    assert!(largest_step.clone().count() == 2);
    assert!(largest_step.clone().all(|track| !track.verdict().is_inside()));
}

#[test]
fn calls_that_the_stage_does_not_take_are_refused_and_change_nothing() {
    let mut experiment = Experiment::new(Protocol::two_alternative(), 1, 0).unwrap();
    let error = experiment.answer(reply(Answer::Left, 1.0)).unwrap_err();
    assert!(error.to_string().contains("answer at the stage instructions"));

    let mut experiment = at_first_trial(Protocol::two_alternative());
    let before = experiment.clone();
    assert!(matches!(experiment.proceed(), Err(Error::Stage { .. })));
    for secs in [-0.1, f64::NAN, f64::INFINITY] {
        let error = experiment.answer(reply(Answer::Left, secs)).unwrap_err();
        assert!(error.to_string().starts_with("response_time_secs is"));
    }
    assert_eq!(experiment, before);
}

#[test]
fn a_protocol_without_practice_starts_with_the_first_rest() {
    let mut protocol = Protocol::two_alternative();
    protocol.practice.ratios.clear();
    let mut experiment = Experiment::new(protocol, 1, 0).unwrap();
    experiment.proceed().unwrap();
    assert!(matches!(experiment.stage(), Stage::Rest { round: 1, .. }));
}
