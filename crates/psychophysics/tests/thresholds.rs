//! Simulated people with known thresholds: what the sessions find, and what they must not find.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

use scumble_psychophysics::{
    Answer, Condition, Convergence, Experiment, ObserverParameters, Population, Protocol, Reply, Stage, Track,
    WeibullObserver, rehearse,
};
use scumble_stimuli::{Kernel, Pattern};

fn population() -> Population {
    Population { median: ObserverParameters::default(), between_sd_log10: 0.1, seed: 77 }
}

/// Errors of the estimates in log10 of the ratio, over every QUEST of `people` sessions.
fn errors_log10(protocol: &Protocol, people: u32) -> Vec<f64> {
    let population = population();
    (0..people)
        .flat_map(|index| {
            let person = population.person(index).unwrap();
            let seed = population.session_seed(index);
            let mut experiment = Experiment::new(protocol.clone(), seed, 0).unwrap();
            rehearse(&mut experiment, &person).unwrap();
            let error = |track: &Track| {
                let truth = person.parameters().threshold_ratio(track.condition());
                (track.estimate().ratio / truth).log10()
            };
            experiment.tracks().iter().map(error).collect::<Vec<_>>()
        })
        .collect()
}

/// Mean, standard deviation and standard error of the mean.
fn moments(values: &[f64]) -> (f64, f64, f64) {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let squares = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>();
    let sd = (squares / (count - 1.0)).sqrt();
    (mean, sd, sd / count.sqrt())
}

#[test]
fn forty_trials_a_quest_find_the_threshold_without_bias_within_monte_carlo_error() {
    let mut protocol = Protocol::two_alternative();
    protocol.schedule.trials_min = 40;
    protocol.schedule.trials_max = 40;
    let (mean, sd, standard_error) = moments(&errors_log10(&protocol, 100));
    assert!(mean.abs() < 3.0 * standard_error, "{mean} +- {standard_error}");
    assert!((0.04..0.07).contains(&sd), "{sd}");
}

#[test]
fn the_default_protocol_finds_the_threshold_within_one_and_a_half_percent_on_average() {
    // Stopping when it looks good costs a little: the bias is smaller than 1.5 % = 0.0065 log10.
    let errors = errors_log10(&Protocol::two_alternative(), 200);
    let (mean, sd, standard_error) = moments(&errors);
    assert!(mean.abs() < 0.0065, "{mean} +- {standard_error}");
    assert!(sd < 0.1, "{sd}");
}

#[test]
fn a_person_is_right_as_often_as_the_psychometric_function_says() {
    let mut protocol = Protocol::two_alternative();
    protocol.practice.ratios.clear();
    let mut experiment = Experiment::new(protocol, 1, 0).unwrap();
    while !matches!(experiment.stage(), Stage::Trial(_)) {
        experiment.proceed().unwrap();
    }
    let mut trial = *experiment.stage().trial().unwrap();
    let parameters = ObserverParameters::default();
    let threshold = parameters.threshold_ratio(&trial.condition);
    for (factor, probability) in [(1.0, 0.82), (0.1, 0.995), (10.0, 0.5)] {
        trial.radius_px = factor * threshold * trial.condition.texel_px;
        assert!((parameters.probability_correct(&trial) - probability).abs() < 5e-4);
        let right = (0..4000).filter(|seed| {
            let person = WeibullObserver::new(parameters, *seed).unwrap();
            trial.is_correct(person.answer(&trial))
        });
        let share = right.count() as f64 / 4000.0;
        let standard_error = (probability * (1.0 - probability) / 4000.0f64).sqrt();
        assert!((share - probability).abs() < 4.0 * standard_error, "{factor}: {share}");
    }
}

#[test]
fn thresholds_of_the_conditions_are_the_published_ones() {
    let condition = |pattern, contrast, texel_px| Condition { pattern, contrast, texel_px, kernel: Kernel::Disc };
    let person = ObserverParameters::default();
    let ratio = |c| person.threshold_ratio(&c);
    assert!((ratio(condition(Pattern::Step, 1.0, 5.0)) - 3.47).abs() < 1e-12);
    assert!((ratio(condition(Pattern::Step, 1.0, 20.0)) - 3.47).abs() < 1e-12);
    assert!((ratio(condition(Pattern::Stair, 1.0, 10.0)) - 2.5).abs() < 1e-12);
    assert!((ratio(condition(Pattern::Step, 0.5, 10.0)) - 0.95 * 3.47).abs() < 1e-12);
}

#[test]
fn people_are_log_normal_about_the_median_person() {
    let logs: Vec<f64> = (0..2000).map(|i| population().person(i).unwrap().parameters().ratio.log10()).collect();
    let (mean, sd, standard_error) = moments(&logs);
    assert!((mean - 3.47f64.log10()).abs() < 4.0 * standard_error, "{mean}");
    assert!((sd - 0.1).abs() < 0.007, "{sd}");
}

#[test]
fn a_person_is_the_same_each_time_and_different_from_the_next() {
    let population = population();
    assert_eq!(population.person(3).unwrap(), population.person(3).unwrap());
    assert_ne!(population.person(3).unwrap(), population.person(4).unwrap());
    assert_ne!(population.session_seed(3), population.session_seed(4));
}

#[test]
fn parameters_of_a_person_out_of_range_are_refused_by_name() {
    let good = ObserverParameters::default();
    let broken = [
        ("ratio", ObserverParameters { ratio: 0.0, ..good }),
        ("stair_factor", ObserverParameters { stair_factor: f64::NAN, ..good }),
        ("half_contrast_factor", ObserverParameters { half_contrast_factor: -1.0, ..good }),
        ("delta", ObserverParameters { lapse_probability: 1.0, ..good }),
        ("beta", ObserverParameters { slope_per_log10: 0.0, ..good }),
    ];
    for (name, parameters) in broken {
        let message = WeibullObserver::new(parameters, 1).unwrap_err().to_string();
        assert!(message.starts_with(&format!("{name} is")), "{message}");
    }
    let negative = Population { between_sd_log10: -0.1, ..population() };
    assert!(negative.person(0).is_err());
}

#[test]
fn a_prior_two_log_units_off_is_not_called_converged_where_its_spread_alone_says_so() {
    // Kreuzer 2017's prior read literally: 3 % of the texel, with a coefficient of variation of 1.
    let mut literal = Protocol::two_alternative();
    literal.staircase.prior_ratios[0] = 0.03;
    literal.staircase.prior_sd_log10 = 0.36;
    literal.pictures.ratio_min = 0.003;
    literal.conditions.texels_px = vec![10.0];
    literal.convergence.interval_width_log10 = 0.5;
    let mut spread_alone = literal.clone();
    spread_alone.convergence = Convergence {
        responses_of_each_kind: 0,
        edge_distance_log10: 0.0,
        half_agreement_sds: 1e9,
        ..literal.convergence
    };
    let wrong_but_converged = |protocol: &Protocol| {
        let mut count = 0;
        for seed in 0..25 {
            let person = WeibullObserver::new(ObserverParameters::default(), seed).unwrap();
            let mut experiment = Experiment::new(protocol.clone(), seed, 0).unwrap();
            rehearse(&mut experiment, &person).unwrap();
            for track in experiment.tracks() {
                let truth = person.parameters().threshold_ratio(track.condition());
                let error_log10 = (track.estimate().ratio / truth).log10();
                let is_wrong = error_log10.abs() > 0.3;
                count += u32::from(is_wrong && track.verdict().is_converged());
            }
        }
        count
    };
    // Of 100 QUESTs.
    let spread_alone = wrong_but_converged(&spread_alone);
    assert!(spread_alone >= 95, "{spread_alone}");
    assert_eq!(wrong_but_converged(&literal), 0);
}

#[test]
fn someone_who_guesses_is_hardly_ever_called_converged() {
    let guess = Reply { answer: Answer::Left, response_time_secs: 0.3, pictures_sha256: Vec::new() };
    let mut converged = 0;
    for seed in 0..30 {
        let mut experiment = Experiment::new(Protocol::two_alternative(), seed, 0).unwrap();
        while *experiment.stage() != Stage::Finished {
            match experiment.stage().trial() {
                // The side of the line is random, so a constant answer is a guess.
                Some(_) => drop(experiment.answer(guess.clone()).unwrap()),
                None => experiment.proceed().unwrap(),
            }
        }
        let tracks = experiment.tracks().iter();
        converged += tracks.filter(|t| t.verdict().is_converged()).count();
    }
    // Of 360 QUESTs.
    assert!(converged <= 12, "{converged}");
}
