//! Studies too small or too strange to carry much: a defined answer or a refusal in words, never a number that is none.

#![allow(clippy::unwrap_used, reason = "a test stops at what it did not expect, in helpers too")]

use std::fs;

use proptest::prelude::*;
use scumble_analysis::{RELATION, Simulation, Study, fit_study};
use scumble_psychophysics::{ObserverModel, Protocol, WeibullObserver};

/// A protocol of one pattern at one contrast, with the first `sizes` texels and `trials` trials a staircase, which converge
/// easily, so that the fit has to say what it cannot carry.
fn small(name: &str, sizes: usize, trials: u32) -> Protocol {
    let mut protocol = Protocol::named(name).unwrap();
    protocol.conditions.texels_px.truncate(sizes);
    protocol.conditions.patterns.truncate(1);
    protocol.conditions.contrasts.truncate(1);
    protocol.convergence.interval_width_log10 = 1.5;
    protocol.convergence.responses_of_each_kind = 1;
    protocol.convergence.edge_distance_log10 = 0.01;
    protocol.convergence.half_agreement_sds = 6.0;
    (protocol.schedule.trials_min, protocol.schedule.trials_max) = (trials, trials);
    protocol
}

/// Words by which numbers that are none are written.
fn holds_no_number(content: &str) -> Option<&'static str> {
    let words = |text: &str, word: &str| text.split(|c: char| !c.is_ascii_alphanumeric()).any(|found| found == word);
    ["NaN", "nan", "inf", "Infinity"].into_iter().find(|word| words(content, word))
}

#[test]
fn a_number_that_is_none_is_found_in_a_file() {
    assert_eq!(holds_no_number("{\"ratio\": NaN}"), Some("NaN"));
    assert_eq!(holds_no_number("a,inf,b"), Some("inf"));
    assert_eq!(holds_no_number("the information of an infant"), None);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 16, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_small_study_is_fitted_with_numbers_or_refused_in_one_line(
        name in prop::sample::select(vec!["two-alternative", "yes-no", "published"]),
        people in 1..5_u32,
        sizes in 1..4_usize,
        trials in 1..15_u32,
        ratio in 0.5..20.0_f64,
        lapse_probability in prop::sample::select(vec![0.0, 0.01, 0.3]),
        between_sd_log10 in prop::sample::select(vec![0.0, 0.1, 0.6]),
        seed in any::<u64>(),
    ) {
        let folder = tempfile::tempdir().unwrap();
        let person = WeibullObserver { lapse_probability, ..WeibullObserver::default() };
        let median = ObserverModel::Weibull(person).with_ratio(ratio).unwrap();
        let protocol = small(name, sizes, trials);
        let simulation = Simulation { protocol, observers: people, seed, median, between_sd_log10 };
        simulation.write(&folder.path().join("sessions"), || ()).unwrap();
        let out = folder.path().join("out");
        let study = Study::read(&[folder.path().join("sessions")]);
        match study.and_then(|study| fit_study(&study, &out)) {
            Ok(analysis) => {
                let [low, high] = analysis.worst().ratio_ci95();
                prop_assert!(low > 0.0 && low <= analysis.worst().ratio() && analysis.worst().ratio() <= high);
            }
            Err(reason) => {
                let reason = reason.to_string();
                prop_assert!(reason.len() > 20 && !reason.contains('\n') && holds_no_number(&reason).is_none(), "{reason}");
                prop_assert!(!out.join(RELATION).exists());
            }
        }
        for file in fs::read_dir(&out).into_iter().flatten() {
            let path = file.unwrap().path();
            let content = fs::read_to_string(&path).unwrap();
            prop_assert_eq!(holds_no_number(&content), None, "{}", path.display());
        }
    }
}

#[test]
fn the_order_in_which_sessions_are_given_changes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let median = ObserverModel::default();
    let protocol = small("two-alternative", 2, 24);
    let simulation = Simulation { protocol, observers: 4, seed: 8, median, between_sd_log10: 0.1 };
    let sessions = simulation.write(&folder.path().join("sessions"), || ()).unwrap();
    let [forth, back] = [false, true].map(|is_back| {
        let mut paths = sessions.clone();
        if is_back {
            paths.reverse();
        }
        let out = folder.path().join(if is_back { "back" } else { "forth" });
        fit_study(&Study::read(&paths).unwrap(), &out).unwrap();
        ["relation.json", "trials.csv", "thresholds.csv", "report.html"]
            .map(|name| fs::read_to_string(out.join(name)).unwrap())
    });
    assert_eq!(forth, back);
}
