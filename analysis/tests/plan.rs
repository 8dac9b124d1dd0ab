//! The forecast of a study: it finds what the simulated people were made with, and refuses what cannot
//! be measured.

#![allow(clippy::unwrap_used, reason = "a test stops at what it did not expect, in helpers too")]

use std::{fs, path::Path, process::Command, sync::Mutex};

use scumble_analysis::{Plan, Simulation};
use scumble_psychophysics::{ObserverModel, Protocol};
use scumble_stimuli::Kernel;

fn simulation(protocol: Protocol, observers: u32) -> Simulation {
    Simulation { protocol, observers, seed: 1, median: ObserverModel::default(), between_sd_log10: 0.1 }
}

fn refusal(simulation: &Simulation) -> String {
    Plan::of(simulation, 5.0, || ()).unwrap_err().to_string()
}

#[test]
fn honest_protocols_are_foretold_without_bias_and_with_intervals_that_hold_the_truth() {
    for name in ["two-alternative", "yes-no"] {
        let finished = Mutex::new(0);
        let plan = Plan::of(&simulation(Protocol::named(name).unwrap(), 200), 6.0, || *finished.lock().unwrap() += 1);
        let plan = plan.unwrap();
        assert_eq!((plan.sessions, *finished.lock().unwrap(), plan.series.len()), (200, 200, 4));
        assert_eq!(plan.worst, "step, 100 % contrast");
        assert!((plan.worst_ratio - 3.47).abs() < 1e-9);
        assert!((plan.minutes.mean - plan.trials.mean / 10.0).abs() < 1e-9);
        assert!(plan.trials.q05 < plan.trials.mean && plan.trials.mean < plan.trials.q95);

        // A person's ratio has an SD of some 0.05 log10: the mean of 200 is known to 0.0035.
        let worst = plan.series.iter().find(|series| series.name == plan.worst).unwrap();
        assert!(worst.person_ratio.bias_log10.abs() < 0.015, "{name}: {worst:?}");
        assert!((0.02..0.08).contains(&worst.person_ratio.sd_log10), "{name}: {worst:?}");
        assert!(worst.threshold.sd_log10 > worst.person_ratio.sd_log10);

        let ends = &plan.staircases;
        let reasons = ends.wide + ends.one_sided + ends.at_edge + ends.halves_differ;
        assert!(ends.count == 200 * 12 && ends.converged > ends.count * 8 / 10 && ends.converged < ends.count);
        assert!(reasons >= ends.count - ends.converged);

        let widths: Vec<f64> = plan.intervals.iter().map(|interval| interval.median_width).collect();
        assert!(widths.len() == 3 && widths.windows(2).all(|pair| pair[1] < pair[0]), "{widths:?}");
        // The coverage of ten people has a standard error of 4.9 %.
        let coverage = plan.intervals[0].coverage.unwrap();
        assert!(coverage > 0.95 - 3.0 * 0.049, "{name}: {coverage}");
    }
}

#[test]
fn the_published_protocol_is_foretold_to_be_biased_by_people_who_rarely_say_yes_to_artifacts() {
    let plan = Plan::of(&simulation(Protocol::named("published").unwrap(), 200), 5.0, || ()).unwrap();
    // A guess rate of one half is assumed where it is one tenth: misses in which nothing was seen count
    // as if they were rarer than they are.
    let worst = plan.series.iter().find(|series| series.name == plan.worst).unwrap();
    assert!(worst.person_ratio.bias_log10 < -0.03, "{worst:?}");
}

#[test]
fn a_ratio_means_the_same_whatever_probability_the_staircases_aim_at() {
    for probability in [0.75, 0.9] {
        let mut protocol = Protocol::two_alternative();
        protocol.staircase.threshold_probability = probability;
        let plan = Plan::of(&simulation(protocol, 300), 5.0, || ()).unwrap();
        let worst = plan.series.iter().find(|series| series.name == plan.worst).unwrap();
        assert!((plan.worst_ratio / 3.47 - 1.0).abs() < 1e-12, "{}", plan.worst_ratio);
        assert!(worst.person_ratio.bias_log10.abs() < 0.02, "{probability}: {worst:?}");
    }
}

#[test]
fn a_study_whose_staircases_seldom_converge_is_refused_with_the_commonest_reason() {
    let mut protocol = Protocol::two_alternative();
    protocol.schedule.trials_max = 10;
    protocol.convergence.interval_width_log10 = 0.1;
    let message = refusal(&simulation(protocol, 20));
    for part in ["0 of 240 simulated staircases converge within 10 trials", "interval too wide", "allowed is half"] {
        assert!(message.contains(part), "{part}: {message}");
    }
}

#[test]
fn the_interval_is_that_of_the_first_kernel_which_a_fit_writes() {
    let mut protocol = Protocol::two_alternative();
    protocol.conditions.kernels = vec![Kernel::Box, Kernel::Disc];
    let plan = Plan::of(&simulation(protocol, 20), 5.0, || ()).unwrap();
    assert!(plan.worst.ends_with("box"), "{}", plan.worst);
}

#[test]
fn a_pool_too_small_for_a_cohort_leaves_its_row_out_and_too_small_for_a_coverage_says_so() {
    let plan = Plan::of(&simulation(Protocol::two_alternative(), 60), 5.0, || ()).unwrap();
    let people: Vec<usize> = plan.intervals.iter().map(|interval| interval.people).collect();
    assert_eq!(people, [10, 20]);
    assert!(plan.intervals.iter().all(|interval| interval.coverage.is_none()));
    assert!(plan.text().contains("too few sessions to tell"));
}

#[test]
fn the_forecast_is_the_same_for_the_same_seed() {
    let plan = || Plan::of(&simulation(Protocol::two_alternative(), 24), 5.0, || ()).unwrap();
    assert_eq!(plan(), plan());
}

#[test]
fn impossible_tables_and_priors_are_refused_before_a_trial() {
    let mut narrow = Protocol::two_alternative();
    narrow.staircase.table_width_log10 = 0.6;
    assert!(refusal(&simulation(narrow, 1000)).contains("table_width_log10"));
    let far = Simulation {
        median: ObserverModel::default().with_ratio(9.0).unwrap(),
        ..simulation(Protocol::two_alternative(), 1000)
    };
    assert!(refusal(&far).contains("larger pictures"));
}

/// The program's exit status and what it says of a protocol file.
fn program(protocol: &Path, more: &[&str]) -> (Option<i32>, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_scumble-analysis"));
    let output = command.args(["plan", "--protocol", protocol.to_str().unwrap()]).args(more).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

#[test]
fn kreuzers_prior_is_refused_with_the_reason_in_both_readings() {
    let folder = tempfile::tempdir().unwrap();
    for (name, sd) in [("log-units.toml", 0.03), ("linear.toml", std::f64::consts::LOG10_E)] {
        let mut protocol = Protocol::named("published").unwrap();
        protocol.staircase.prior_ratios = vec![0.03];
        protocol.staircase.prior_sd_log10 = sd;
        let file = folder.path().join(name);
        fs::write(&file, protocol.to_toml().unwrap()).unwrap();
        let (code, printed, message) = program(&file, &[]);
        assert_eq!((code, printed.as_str(), message.lines().count()), (Some(1), "", 1), "{message}");
        for part in [name, "cannot measure the answer", "the prior of 0.030 texels", "reaches", "allowed is"] {
            assert!(message.contains(part), "{part}: {message}");
        }
    }
}

#[test]
fn the_program_prints_tables_and_writes_json() {
    let folder = tempfile::tempdir().unwrap();
    let json = folder.path().join("plan.json");
    let more = ["--sessions", "40", "--json", json.to_str().unwrap()];
    let (code, printed, message) = program(Path::new("yes-no"), &more);
    assert_eq!((code, message.as_str()), (Some(0), ""));
    for part in ["40 simulated sessions", "minutes a person", "converge", "step, 100 % contrast", "95 % interval"] {
        assert!(printed.contains(part), "{part}: {printed}");
    }
    let plan: serde_json::Value = serde_json::from_str(&fs::read_to_string(&json).unwrap()).unwrap();
    assert_eq!(plan["sessions"], 40);
    assert!(plan["intervals"][0]["median_width"].is_f64());

    let (code, _, message) = program(Path::new("no-such.toml"), &[]);
    assert_eq!((code, message.lines().count()), (Some(1), 1));
    assert!(message.contains("no-such.toml"));
}
