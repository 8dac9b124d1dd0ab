//! Whole sessions through the state machine: what is shown, what is learned, what is refused.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

mod support;

use scumble_psychophysics::{
    Answer, Error, Event, Experiment, Pictures, Protocol, Role, Stage, Track, Trial, rehearse,
};
use scumble_stimuli::{Kernel, Pattern, Shape, Stimulus, Transfer};
use support::{NAMES, answers, named, observer, reply, session, small, watch};

fn default_session(seed: u64) -> (Experiment, Vec<Event>) {
    session(&Protocol::two_alternative(), seed, 0)
}

fn measured(events: &[Event]) -> Vec<Trial> {
    let answered = events.iter().filter_map(Event::measured);
    answered.map(|answered| answered.trial).collect()
}

fn at_first_trial(protocol: Protocol) -> Experiment {
    let mut experiment = Experiment::new(protocol, 1, 0).unwrap();
    while !matches!(experiment.stage(), Stage::Trial(_)) {
        match *experiment.stage() {
            Stage::Practice(trial) => drop(experiment.answer(reply(trial.pictures.answers()[0], 1.0)).unwrap()),
            _ => experiment.proceed().unwrap(),
        }
    }
    experiment
}

#[test]
fn the_same_seed_gives_the_same_session_image_for_image() {
    for name in NAMES {
        let (first, second) = (session(&named(name), 7, 1).1, session(&named(name), 7, 1).1);
        assert_eq!(first, second);
        for (a, b) in measured(&first).iter().zip(&measured(&second)).take(6) {
            let pixels = |stimulus: &Stimulus| stimulus.render(96, 72, &Transfer::srgb()).unwrap().into_raw();
            for (a, b) in a.pictures.all().into_iter().zip(b.pictures.all()) {
                assert_eq!(pixels(a), pixels(b));
            }
        }
    }
}

#[test]
fn another_seed_gives_another_session() {
    let (a, b) = (measured(&default_session(1).1), measured(&default_session(2).1));
    assert!(a.iter().zip(&b).all(|(a, b)| a.pictures.all()[0].phase != b.pictures.all()[0].phase));
}

#[test]
fn a_session_has_four_rounds_of_three_sizes_and_each_size_ten_to_thirty_six_trials() {
    let (experiment, events) = default_session(3);
    assert_eq!(experiment.tracks().len(), 12);
    let conditions = experiment.protocol().all_conditions();
    for track in experiment.tracks() {
        assert!(conditions.contains(track.condition()));
        assert!((10..=36).contains(&track.trials()) && track.is_done());
        assert!(track.trials() == 36 || track.verdict().is_converged());
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
    let trials = measured(&default_session(5).1);
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
    let (_, events) = default_session(4);
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
        assert_eq!(*experiment.stage(), Stage::Feedback { correct, right_answer: trial.pictures.right_answer() });
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
                experiment.answer(reply(person.answer(&trial, &experiment.protocol().pictures).unwrap(), 1.0)).unwrap();
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

#[test]
fn a_response_of_one_means_a_right_answer_whatever_the_task() {
    for name in NAMES {
        let protocol = named(name);
        let mut experiment = at_first_trial(protocol.clone());
        let mut ones = 0;
        while let Stage::Trial(trial) = *experiment.stage() {
            let [first, second] = trial.pictures.answers();
            let answer = if trial.number % 2 == 0 { first } else { second };
            experiment.answer(reply(answer, 1.0)).unwrap();
            let Some(track) = trial.track.filter(|_| trial.role == Role::Measure) else { continue };
            let is_one = match trial.pictures {
                Pictures::Pair { left, .. } => (answer == Answer::Left) == (left.shape == Shape::Line),
                // The single picture that a staircase chose is an artifact: "no, it was no line".
                Pictures::Single { picture } => {
                    assert_eq!(picture.shape, Shape::Artifact);
                    answer == Answer::No
                }
            };
            assert_eq!(experiment.tracks()[track as usize].responses().last(), Some(&(trial.intensity(), is_one)));
            ones += u32::from(is_one);
        }
        assert!(ones > 5, "{name}");
    }
}

#[test]
fn lines_and_catch_trials_come_as_often_as_the_protocol_says() {
    let protocol = named("yes-no");
    let all: Vec<Role> = answers(&protocol, 40).concat().iter().map(|answered| answered.trial.role).collect();
    let count = |role: Role| all.iter().filter(|found| **found == role).count() as f64;
    let total = all.len() as f64;
    let within_four_errors = |found: f64, of: f64, share: f64| {
        let standard_error = (share * (1.0 - share) / of).sqrt();
        assert!((found / of - share).abs() < 4.0 * standard_error, "{found} of {of}, not {share}");
    };
    within_four_errors(count(Role::Catch), total, 0.03);
    within_four_errors(count(Role::Line), total - count(Role::Catch), 0.5);

    for name in ["published", "two-alternative"] {
        let is_measured = |answered: &scumble_psychophysics::Answered| answered.trial.role == Role::Measure;
        assert!(answers(&named(name), 2).concat().iter().all(is_measured));
    }
}

#[test]
fn a_line_has_the_condition_and_radius_of_its_staircase_and_teaches_it_nothing() {
    let mut lines = 0;
    for seed in 0..3 {
        let mut before: Option<(Trial, Vec<Track>)> = None;
        // The radius that the last line of each staircase was shown at, until the staircase's own trial.
        let mut last_line_px = std::collections::HashMap::new();
        watch(&named("yes-no"), seed, 0, |experiment| {
            if let Some((trial, tracks)) = before.take() {
                assert_eq!(trial.role == Role::Measure, tracks != experiment.tracks(), "{:?}", trial.role);
            }
            let Some(trial) = experiment.stage().trial().copied() else { return };
            before = Some((trial, experiment.tracks().to_vec()));
            let Some(track) = trial.track else { return };
            assert_eq!(trial.condition, *experiment.tracks()[track as usize].condition());
            if let Some(radius_px) = last_line_px.remove(&track) {
                assert_eq!(trial.placement_radius_px, radius_px);
            }
            if trial.role == Role::Line {
                lines += 1;
                last_line_px.insert(track, trial.placement_radius_px);
                assert!(trial.pictures.all().iter().all(|picture| picture.shape == Shape::Line));
            }
        });
    }
    assert!(lines > 100, "{lines}");
}

#[test]
fn a_catch_trial_is_a_plain_artifact_of_the_round_and_teaches_nothing() {
    let mut protocol = named("yes-no");
    if let Some(catch) = &mut protocol.catch_trials {
        (catch.share, catch.ratio, catch.texel_px) = (0.4, 0.7, 15.0);
    }
    let mut last: Option<Vec<Track>> = None;
    let mut caught = 0;
    watch(&protocol, 4, 0, |experiment| {
        if let Some(tracks) = last.take() {
            assert_eq!(tracks, experiment.tracks());
        }
        let Some(trial) = experiment.stage().trial().filter(|trial| trial.role == Role::Catch) else { return };
        caught += 1;
        last = Some(experiment.tracks().to_vec());
        assert_eq!((trial.track, trial.condition.texel_px), (None, 15.0));
        assert!((trial.ratio() - 0.7).abs() < 1e-12 && !trial.is_clamped());
        let of_round = experiment.tracks()[(trial.round as usize - 1) * 3].condition();
        assert_eq!((trial.condition.pattern, trial.condition.contrast), (of_round.pattern, of_round.contrast));
        assert!(trial.pictures.all().iter().all(|picture| picture.shape == Shape::Artifact));
    });
    assert!(caught > 50, "{caught}");
}

#[test]
fn catch_trials_at_two_alternatives_show_the_line_beside_the_plain_artifact() {
    let mut protocol = named("two-alternative");
    protocol.catch_trials = named("yes-no").catch_trials;
    let all = answers(&protocol, 4).concat();
    let caught: Vec<_> = all.iter().filter(|answered| answered.trial.role == Role::Catch).collect();
    assert!(caught.len() > 5);
    assert!(caught.iter().all(|answered| matches!(answered.trial.pictures, Pictures::Pair { .. })));
}

#[test]
fn participants_that_follow_each_other_fill_a_latin_square_of_rounds() {
    let protocol = named("yes-no");
    let order = |number: u32, seed: u64| {
        let experiment = Experiment::new(protocol.clone(), seed, number).unwrap();
        let conditions = experiment.tracks().chunks(3).map(|tracks| tracks[0].condition());
        let rounds = protocol.rounds();
        let place = |c: &scumble_psychophysics::Condition| {
            rounds.iter().position(|r| r.pattern == c.pattern && r.contrast == c.contrast).unwrap()
        };
        conditions.map(place).collect::<Vec<_>>()
    };
    // Williams 1949: each round once in each place, each once behind each other one.
    let square: Vec<_> = (0..4).map(|number| order(number, 1)).collect();
    assert_eq!(square, [[0, 1, 3, 2], [1, 2, 0, 3], [2, 3, 1, 0], [3, 0, 2, 1]]);
    assert_eq!(order(5, 1), square[1]);
    assert_eq!(order(2, 99), square[2], "the seed does not change it");
}

#[test]
fn two_priors_give_two_staircases_a_condition_whose_trials_interleave() {
    let mut protocol = named("two-alternative");
    protocol.staircase.prior_ratios = vec![2.0, 6.0];
    let (experiment, events) = session(&protocol, 3, 0);
    assert_eq!(experiment.tracks().len(), 24);
    for pair in experiment.tracks().chunks(2) {
        assert_eq!(pair[0].condition(), pair[1].condition());
    }
    let trials = measured(&events);
    for round in 1..=4 {
        let of_round: Vec<_> = trials.iter().filter(|trial| trial.round == round).collect();
        for cycle in of_round[..60].chunks(6) {
            let mut tracks: Vec<u32> = cycle.iter().filter_map(|trial| trial.track).collect();
            tracks.sort_unstable();
            let first = (round - 1) * 6;
            assert_eq!(tracks, (first..first + 6).collect::<Vec<_>>());
        }
    }
    // The first radius of each staircase is its own prior's.
    for trial in trials.iter().filter(|trial| trial.number <= 6) {
        let prior = if trial.track.unwrap() % 2 == 0 { 2.0 } else { 6.0 };
        let first_px = trial.condition.texel_px / libm::exp10(protocol.staircase_at(prior).unwrap().placement());
        assert!((trial.placement_radius_px / first_px - 1.0).abs() < 1e-12);
    }
}

#[test]
fn progress_counts_an_answer_of_every_role_and_apart_from_them_those_that_a_staircase_learned_from() {
    let (mut answered, mut measured) = (0, 0);
    watch(&named("yes-no"), 2, 0, |experiment| {
        if let Stage::Trial(trial) = *experiment.stage() {
            let progress = experiment.progress();
            assert_eq!((progress.answered, progress.trials), (answered, measured));
            answered += 1;
            measured += u32::from(trial.role == Role::Measure);
        }
    });
    assert!(answered > measured + 100, "{answered} {measured}");
}

#[test]
fn rests_within_a_round_come_after_so_many_trials_and_never_at_its_end() {
    let mut protocol = named("yes-no");
    protocol.schedule.rest_every_trials = Some(7);
    let (mut since, mut within, mut last_was_rest, mut round) = (0, 0, false, 1);
    watch(&protocol, 2, 0, |experiment| match *experiment.stage() {
        Stage::Rest { round: next, within_round, .. } => {
            assert!(!last_was_rest);
            assert_eq!(within_round, next == round && experiment.progress().trials > 0);
            if within_round {
                assert_eq!(since, 7);
                within += 1;
            } else {
                assert!(since <= 7);
            }
            (since, last_was_rest, round) = (0, true, next);
        }
        Stage::Trial(_) => {
            since += 1;
            assert!(since <= 7);
            last_was_rest = false;
        }
        _ => (),
    });
    assert!(within > 20, "{within}");
}

#[test]
fn progress_moves_forward_only_and_ends_where_it_said() {
    for name in NAMES {
        let mut last = Experiment::new(named(name), 6, 0).unwrap().progress();
        watch(&named(name), 6, 0, |experiment| {
            let now = experiment.progress();
            assert!(now.trials >= last.trials && now.trials <= last.trials + 1);
            assert!(now.trials_at_least >= last.trials_at_least && now.trials_at_most <= last.trials_at_most);
            assert!(now.trials <= now.trials_at_least && now.trials_at_least <= now.trials_at_most);
            assert!(now.round >= last.round && now.round <= now.rounds);
            last = now;
        });
        assert_eq!((last.trials, last.round), (last.trials_at_least, last.rounds));
        assert_eq!(last.trials, last.trials_at_most);
    }
}

#[test]
fn every_pattern_under_every_kernel_makes_a_round_that_can_be_drawn() {
    for name in NAMES {
        let mut protocol = small(name);
        protocol.conditions.patterns = vec![Pattern::Stair, Pattern::Step, Pattern::DoubleStep];
        protocol.conditions.kernels = Kernel::NAMED.iter().map(|(_, kernel)| *kernel).collect();
        let (experiment, events) = session(&protocol, 8, 0);
        assert_eq!(experiment.progress().rounds, 18);
        let mut seen: Vec<(Pattern, Kernel)> = vec![];
        for trial in measured(&events) {
            let condition = (trial.condition.pattern, trial.condition.kernel);
            if !seen.contains(&condition) {
                seen.push(condition);
                for picture in trial.pictures.all() {
                    assert_eq!((picture.pattern, picture.kernel), condition);
                    picture.render(40, 30, &Transfer::srgb()).unwrap();
                }
            }
        }
        assert_eq!(seen.len(), 18);
    }
}

#[test]
fn a_protocol_without_dithering_has_no_seeds_and_one_with_it_a_seed_a_picture() {
    for dithered in [false, true] {
        let mut protocol = named("two-alternative");
        protocol.pictures.dithered = dithered;
        let mut seeds: Vec<u64> = vec![];
        for answered in answers(&protocol, 1).concat() {
            let of_trial = answered.trial.pictures.all().into_iter().filter_map(|picture| picture.dither_seed);
            seeds.extend(of_trial);
        }
        assert_eq!(seeds.is_empty(), !dithered);
        let count = seeds.len();
        seeds.sort_unstable();
        seeds.dedup();
        assert_eq!(seeds.len(), count, "no two pictures share their noise");
    }
}
