//! Simulated people with known thresholds: what the sessions find, and what they must not find.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

use scumble_psychophysics::{
    Answer, Cohort, Convergence, Experiment, Observer, ObserverModel, Protocol, Reply, Stage, Track, rehearse,
};

fn cohort() -> Cohort {
    Cohort { median: ObserverModel::default(), between_sd_log10: 0.1, seed: 77 }
}

/// Errors of the estimates in log10 of the ratio, over every QUEST of `people` sessions.
fn errors_log10(protocol: &Protocol, people: u32) -> Vec<f64> {
    let cohort = cohort();
    (0..people)
        .flat_map(|index| {
            let person = cohort.person(index).unwrap();
            let seed = cohort.session_seed(index);
            let mut experiment = Experiment::new(protocol.clone(), seed, 0).unwrap();
            rehearse(&mut experiment, &person).unwrap();
            let error = |track: &Track| {
                let truth = person.model().threshold_ratio(track.condition()).unwrap();
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
            let person = Observer::new(ObserverModel::default(), seed).unwrap();
            let mut experiment = Experiment::new(protocol.clone(), seed, 0).unwrap();
            rehearse(&mut experiment, &person).unwrap();
            for track in experiment.tracks() {
                let truth = person.model().threshold_ratio(track.condition()).unwrap();
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
    let guess = Reply { answer: Answer::Left, response_time_secs: 0.3, pictures_sha256: Vec::new(), timing: None };
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
