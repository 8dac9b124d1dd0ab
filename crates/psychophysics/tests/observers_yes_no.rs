//! Hits, false alarms, d' and criterion of single pictures, against tables, closed forms and people whose
//! parameters are known.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

use scumble_psychophysics::{
    Experiment, Observer, ObserverModel, Pictures, Protocol, Role, SignalDetectionObserver, Stage, Trial, YesNoCounts,
    YesNoReport, rehearse,
};
use scumble_stimuli::{Shape, Stimulus};

fn counts(hits: u32, artifacts: u32, false_alarms: u32, lines: u32) -> YesNoCounts {
    YesNoCounts { artifacts, hits, lines, false_alarms }
}

#[test]
fn the_statistics_are_those_of_tables_of_the_normal_distribution() {
    // Counts whose corrected rates are table values, such as 34.5 / 50 = 0.69 and 15.5 / 50 = 0.31 with
    // d' 0.992 (Macmillan & Creelman 2005: "about 1"); digits from Python's statistics.NormalDist.
    let table = [
        (counts(34, 49, 15, 49), 0.69, 0.31, 0.991_700_695, 0.0, 0.264_851_08),
        (counts(20, 24, 3, 24), 0.82, 0.14, 1.995_684_429, 0.082_477_126, 0.436_559_159),
        (counts(5, 9, 1, 9), 0.55, 0.15, 1.162_094_736, 0.455_386_021, 0.660_402_56),
        (counts(30, 30, 0, 30), 30.5 / 31.0, 0.5 / 31.0, 4.282_396_242, 0.0, 0.807_009_916),
    ];
    for (counts, hit_rate, false_alarm_rate, d_prime, criterion, standard_error) in table {
        let found = counts.statistics().unwrap();
        assert!((found.hit_rate - hit_rate).abs() < 1e-12 && (found.false_alarm_rate - false_alarm_rate).abs() < 1e-12);
        assert!((found.d_prime - d_prime).abs() < 1e-8, "{found:?}");
        assert!((found.criterion - criterion).abs() < 1e-8, "{found:?}");
        assert!((found.d_prime_standard_error - standard_error).abs() < 1e-8, "{found:?}");
        assert!((found.criterion_standard_error - 0.5 * standard_error).abs() < 1e-8, "{found:?}");
    }
}

#[test]
fn someone_who_tells_nothing_has_d_prime_0_with_the_closed_form_of_its_error() {
    let found = counts(5, 10, 5, 10).statistics().unwrap();
    assert!(found.d_prime.abs() < 1e-12 && found.criterion.abs() < 1e-12);
    // Both rates one half, where the density is 1 / sqrt(2 pi): variance 2 x (1/4) 2 pi / 10.
    assert!((found.d_prime_standard_error - (std::f64::consts::PI / 10.0).sqrt()).abs() < 1e-12);
    let (low, high) = found.d_prime_interval95();
    assert!((low + high).abs() < 1e-12 && (high / found.d_prime_standard_error - 1.959_964).abs() < 1e-6);
}

#[test]
fn exchanging_the_answers_turns_the_criterion_and_exchanging_the_pictures_turns_d_prime() {
    let plain = counts(20, 24, 3, 30).statistics().unwrap();
    let answers = counts(30 - 3, 30, 24 - 20, 24).statistics().unwrap();
    assert!((answers.d_prime - plain.d_prime).abs() < 1e-12 && (answers.criterion + plain.criterion).abs() < 1e-12);
    let pictures = counts(3, 30, 20, 24).statistics().unwrap();
    assert!((pictures.d_prime + plain.d_prime).abs() < 1e-12 && (pictures.criterion - plain.criterion).abs() < 1e-12);
    assert!((pictures.d_prime_standard_error - plain.d_prime_standard_error).abs() < 1e-12);
}

#[test]
fn without_lines_or_artifacts_there_is_no_d_prime() {
    assert_eq!(counts(3, 4, 0, 0).statistics(), None);
    assert_eq!(counts(0, 0, 3, 4).statistics(), None);
    assert_eq!((counts(3, 4, 0, 0).hit_share(), counts(3, 4, 0, 0).false_alarm_share()), (Some(0.75), None));
}

/// The counts of `shown` artifacts and as many lines at one ratio.
fn asked(person: &SignalDetectionObserver, trial: &Trial, shown: u32, seed: u64) -> YesNoCounts {
    let rules = Protocol::two_alternative().pictures;
    let observer = Observer::new(ObserverModel::SignalDetection(*person), seed).unwrap();
    let called_artifact = |shape, number| {
        let picture = Stimulus { shape, ..*trial.pictures.all()[0] };
        let trial = Trial { number, pictures: Pictures::Single { picture }, ..*trial };
        let correct = trial.is_correct(observer.answer(&trial, &rules).unwrap());
        u32::from(correct == (shape == Shape::Artifact))
    };
    counts(
        (0..shown).map(|number| called_artifact(Shape::Artifact, number)).sum(),
        shown,
        (shown..2 * shown).map(|number| called_artifact(Shape::Line, number)).sum(),
        shown,
    )
}

#[test]
fn a_person_of_signal_detection_is_recovered_and_the_errors_are_the_scatter() {
    let mut experiment = Experiment::new(Protocol::two_alternative(), 1, 0).unwrap();
    experiment.proceed().unwrap();
    let trial = *experiment.stage().trial().unwrap();
    let trial = Trial { radius_px: 3.0 * trial.condition.texel_px, role: Role::Measure, ..trial };
    for criterion_sds in [0.2, 1.0] {
        let person =
            SignalDetectionObserver { criterion_sds, lapse_probability: 0.0, ..SignalDetectionObserver::default() };
        let d_prime = person.d_prime(&trial);
        let all: Vec<_> = (0..400).map(|seed| asked(&person, &trial, 100, seed).statistics().unwrap()).collect();
        let mean = |of: &dyn Fn(usize) -> f64| (0..400).map(of).sum::<f64>() / 400.0;
        let (mean_d, mean_c) = (mean(&|i| all[i].d_prime), mean(&|i| all[i].criterion));
        let scatter = mean(&|i| (all[i].d_prime - mean_d).powi(2)).sqrt();
        let standard_error = mean(&|i| all[i].d_prime_standard_error);
        // 400 repetitions: standard error scatter / 20; the log-linear rule shrinks d' by some 1 %.
        assert!((mean_d - d_prime).abs() < 3.0 * scatter / 20.0 + 0.01 * d_prime, "{mean_d} {d_prime} {scatter}");
        let criterion = criterion_sds - 0.5 * d_prime;
        assert!((mean_c - criterion).abs() < 1.5 * scatter / 20.0 + 0.01, "{mean_c} {criterion}");
        // The standard deviation of 400 numbers is known to 3.5 %.
        assert!((scatter / standard_error - 1.0).abs() < 0.11, "{scatter} {standard_error}");
    }
}

#[test]
fn a_yes_no_session_is_counted_round_by_round() {
    let protocol = Protocol::named("yes-no").unwrap();
    let mut all = YesNoCounts::default();
    let (mut seen, mut shown) = (0, 0);
    for seed in 0..10 {
        let person = Observer::new(ObserverModel::named("signal-detection").unwrap(), seed).unwrap();
        let mut experiment = Experiment::new(protocol.clone(), seed, 0).unwrap();
        let events = rehearse(&mut experiment, &person).unwrap();
        let report = YesNoReport::of(&events);
        assert_eq!(report.rounds.len(), 4);
        let sum = |of: fn(&YesNoCounts) -> u32| report.rounds.iter().map(of).sum::<u32>();
        let rounds = counts(sum(|c| c.hits), sum(|c| c.artifacts), sum(|c| c.false_alarms), sum(|c| c.lines));
        assert_eq!(rounds, report.overall);
        let measured: u32 = experiment.tracks().iter().map(|track| track.trials()).sum();
        assert_eq!(report.overall.artifacts, measured);
        let main = events.iter().filter_map(|event| event.answered()).filter(|a| a.trial.role != Role::Practice);
        assert_eq!(main.count() as u32, report.overall.artifacts + report.overall.lines + report.catch_shown);
        all.lines += report.overall.lines;
        all.false_alarms += report.overall.false_alarms;
        (seen, shown) = (seen + report.catch_seen, shown + report.catch_shown);
    }
    // A tenth of some 2000 lines: standard error 0.007. Plain artifacts are missed by lapses alone, 1 %.
    assert!((all.false_alarm_share().unwrap() - 0.1).abs() < 0.02, "{all:?}");
    assert!(shown > 40 && f64::from(seen) > 0.93 * f64::from(shown), "{seen} of {shown}");
}

#[test]
fn a_session_of_pairs_has_no_hits_and_no_false_alarms() {
    let mut experiment = Experiment::new(Protocol::two_alternative(), 1, 0).unwrap();
    let events = rehearse(&mut experiment, &Observer::new(ObserverModel::default(), 1).unwrap()).unwrap();
    assert_eq!(*experiment.stage(), Stage::Finished);
    let report = YesNoReport::of(&events);
    assert_eq!((report.clone(), report.catch_share()), (YesNoReport::default(), None));
}
