//! Whole studies: simulated observers run the real experiment, the fit finds what they were made with,
//! and what cannot be fitted is refused with a reason.

#![allow(clippy::unwrap_used, reason = "a test stops at what it did not expect, in helpers too")]

use std::{fs, path::Path};

use scumble_analysis::{
    Analysis, Error, Person, RELATION, REPORT, Run, Series, Simulation, Study, fit_study, trials_csv,
};
use scumble_core::{Relation, RelationFile};
use scumble_psychophysics::{
    EVENTS_FILE, Event, Experiment, HEADER_FILE, Moment, Observer, ObserverModel, Protocol, Reason, Round,
    SessionWriter, WeibullObserver, rehearse,
};
use scumble_stimuli::{Kernel, Pattern};

fn simulation(observers: u32, seed: u64) -> Simulation {
    Simulation {
        protocol: Protocol::two_alternative(),
        observers,
        seed,
        median: ObserverModel::default(),
        between_sd_log10: 0.1,
    }
}

/// Three observers on disk, in a folder that vanishes with the test.
fn sessions() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    simulation(3, 7).write(folder.path(), || ()).unwrap();
    folder
}

/// Every staircase of everyone.
fn runs(people: &mut [Person]) -> impl Iterator<Item = &mut Run> {
    people.iter_mut().flat_map(|person| &mut person.tracks).flat_map(|track| &mut track.runs)
}

fn read(folder: &Path) -> Result<Study, Error> {
    Study::read(&[folder.to_path_buf()])
}

/// The step at full contrast.
fn step(study: &Study) -> Series {
    let is_step = |round: &Round| round.pattern == Pattern::Step && round.contrast == 1.0;
    let round = study.protocol.rounds().into_iter().find(is_step).unwrap();
    Series::of(round, &study.people, &study.protocol).unwrap()
}

/// Changes a session file.
fn edit(folder: &Path, name: &str, change: impl Fn(&str) -> String) {
    let path = folder.join("sim-0002").join(name);
    let changed = change(&fs::read_to_string(&path).unwrap());
    fs::write(path, changed).unwrap();
}

fn refusal(folder: &Path) -> String {
    let message = read(folder).unwrap_err().to_string();
    assert!(!message.contains('\n'), "one line: {message}");
    message
}

#[test]
fn twelve_observers_give_back_their_ratio_within_three_standard_errors() {
    // SD between people 0.1 log10, of a measurement 0.045: sqrt(0.1^2 + 0.045^2) / sqrt(12) = 0.032.
    let is_near = |ratio: f64, truth: f64| (ratio / truth).log10().abs() < 3.0 * 0.032;
    for seed in 1..=5 {
        let analysis = Analysis::of(&simulation(12, seed).study().unwrap()).unwrap();
        let ratio = analysis.worst().ratio();
        assert!(is_near(ratio, 3.47), "seed {seed}: {ratio}");
        let stair = analysis.series.iter().find(|s| s.name == "stair, 100 % contrast").unwrap();
        assert!(is_near(stair.ratio(), 2.5), "seed {seed}: {}", stair.ratio());
    }
}

#[test]
fn memory_and_disk_give_the_same_people() {
    let folder = sessions();
    let on_disk = read(folder.path()).unwrap();
    let in_memory = simulation(3, 7).study().unwrap();
    assert_eq!(on_disk.people, in_memory.people);
    assert!(on_disk.is_simulated() && on_disk.notices.is_empty());
}

#[test]
fn equal_seeds_write_equal_files_and_others_do_not() {
    let [first, second, other] = [7, 7, 8].map(|seed| {
        let folder = tempfile::tempdir().unwrap();
        simulation(2, seed).write(folder.path(), || ()).unwrap();
        fs::read(folder.path().join("sim-0002").join(EVENTS_FILE)).unwrap()
    });
    assert_eq!(first, second);
    assert_ne!(first, other);
}

#[test]
fn a_session_that_exists_is_not_overwritten() {
    let folder = sessions();
    let before = fs::read(folder.path().join("sim-0001").join(EVENTS_FILE)).unwrap();
    let message = simulation(4, 9).write(folder.path(), || ()).unwrap_err().to_string();
    assert!(message.contains("sim-0001: exists"), "{message}");
    assert_eq!(fs::read(folder.path().join("sim-0001").join(EVENTS_FILE)).unwrap(), before);
    assert!(!folder.path().join("sim-0004").exists());
}

#[test]
fn fit_writes_a_relation_that_the_renderer_reads_and_replaces_its_own_files() {
    let (folder, out) = (sessions(), tempfile::tempdir().unwrap());
    let study = read(folder.path()).unwrap();
    for _ in 0..2 {
        let analysis = fit_study(&study, out.path()).unwrap();
        let json = fs::read_to_string(out.path().join(RELATION)).unwrap();
        let relation = Relation::from_json(&json).unwrap();
        assert!((relation.ratio() - analysis.worst().ratio()).abs() < 1e-12);
        let file = RelationFile::from_json(&json).unwrap();
        assert_eq!((file.people, file.conditions.len(), file.sessions.len()), (Some(3), 4, 3));
        let median = file.relation_for(0.5, 0.64).unwrap();
        assert!((median.ratio() - relation.ratio()).abs() < 1e-9, "82 % correct is seen on 64 %");
        assert!(file.relation_for(0.95, 0.1).unwrap().ratio() > relation.ratio());
    }
    let mut names: Vec<_> = fs::read_dir(out.path()).unwrap().map(|e| e.unwrap().file_name()).collect();
    names.sort();
    let expected = [
        "fit.svg",
        "population.svg",
        "psychometric.svg",
        "relation.json",
        "report.html",
        "residuals.svg",
        "staircases.svg",
        "thresholds.csv",
        "trials.csv",
        "trials.json",
    ];
    assert_eq!(names, expected);
}

#[test]
fn the_report_is_one_file_without_references_and_says_that_people_are_simulated() {
    let (folder, out) = (sessions(), tempfile::tempdir().unwrap());
    fit_study(&read(folder.path()).unwrap(), out.path()).unwrap();
    let page = fs::read_to_string(out.path().join(REPORT)).unwrap();
    assert!(page.contains("The geometric mean of these people's true thresholds"), "a reader can compare");
    for reference in ["src=", "href=", "@import", "url("] {
        assert!(!page.contains(reference), "{reference}");
    }
    assert!(page.contains("simulated") && page.contains("<svg") && !page.contains("NaN"));
}

#[test]
fn the_table_of_trials_has_a_row_for_every_measured_trial() {
    let (folder, out) = (sessions(), tempfile::tempdir().unwrap());
    let study = read(folder.path()).unwrap();
    fit_study(&study, out.path()).unwrap();
    let rows =
        |name: &str| csv::Reader::from_path(out.path().join(name)).unwrap().records().map(Result::unwrap).count();
    assert_eq!(rows("trials.csv"), study.trial_count());
    assert_eq!(rows("thresholds.csv"), 3 * 12);
}

#[test]
fn a_foreign_file_under_a_name_of_ours_stops_the_fit() {
    let (folder, out) = (sessions(), tempfile::tempdir().unwrap());
    fs::write(out.path().join(REPORT), "a letter").unwrap();
    let message = fit_study(&read(folder.path()).unwrap(), out.path()).unwrap_err().to_string();
    assert!(message.contains("report.html: exists"), "{message}");
    assert!(!out.path().join(RELATION).exists());
    let into_session = folder.path().join("sim-0001");
    assert!(fit_study(&read(folder.path()).unwrap(), &into_session).is_err());
}

#[test]
fn one_person_is_refused_because_no_interval_follows() {
    let study = simulation(1, 3).study().unwrap();
    let message = Analysis::of(&study).unwrap_err().to_string();
    assert!(message.contains("at least 2 people") && message.contains("found 1"), "{message}");
}

#[test]
fn people_who_always_guess_or_never_err_carry_no_fit() {
    for answer in [Some(true), Some(false), None] {
        let mut study = simulation(3, 5).study().unwrap();
        for run in runs(&mut study.people) {
            let responses = run.responses.iter_mut().enumerate();
            responses.for_each(|(i, (_, correct))| *correct = answer.unwrap_or(i % 2 == 0));
        }
        let message = Analysis::of(&study).unwrap_err().to_string();
        assert!(message.contains("cannot carry a fit"), "{answer:?}: {message}");
    }
}

#[test]
fn a_study_in_which_nothing_converged_is_refused() {
    let mut study = simulation(3, 5).study().unwrap();
    runs(&mut study.people).for_each(|run| run.unconverged = vec![Reason::OneSided { fewest: 0, limit: 3 }]);
    let message = Analysis::of(&study).unwrap_err().to_string();
    assert!(message.contains("none of 36 staircases converged in any of 3 people"), "{message}");
}

#[test]
fn a_condition_without_a_threshold_is_left_out_with_its_reason() {
    let mut study = simulation(4, 5).study().unwrap();
    study.people[0].tracks[0].runs[0].responses.iter_mut().for_each(|(_, correct)| *correct = true);
    let analysis = Analysis::of(&study).unwrap();
    let named = |s: &&String| s.starts_with("sim-0001, stair, 100 %") && s.contains("were correct");
    assert_eq!(analysis.exclusions.iter().filter(named).count(), 1, "{:?}", analysis.exclusions);
    assert_eq!(analysis.series.len(), 4);
}

#[test]
fn every_damage_to_a_session_is_named_with_file_and_line() {
    let folder = sessions();
    let without_line_5 = |text: &str| {
        let lines: Vec<&str> = text.lines().enumerate().filter(|(i, _)| *i != 4).map(|l| l.1).collect();
        lines.join("\n") + "\n"
    };
    edit(folder.path(), EVENTS_FILE, without_line_5);
    let message = refusal(folder.path());
    assert!(message.contains("events.jsonl:5"), "{message}");

    let folder = sessions();
    edit(folder.path(), EVENTS_FILE, |text| text.replacen("\"radius_px\":", "\"radius_px\":NaN,\"x\":", 1));
    let message = refusal(folder.path());
    assert!(message.contains("events.jsonl:1"), "{message}");

    let folder = sessions();
    edit(folder.path(), HEADER_FILE, |text| text[..text.len() / 2].to_owned());
    let message = refusal(folder.path());
    assert!(message.contains("session.json"), "{message}");
}

#[test]
fn a_cut_last_line_is_dropped_with_a_notice() {
    let folder = sessions();
    edit(folder.path(), EVENTS_FILE, |text| text[..text.len() - 20].to_owned());
    let study = read(folder.path()).unwrap();
    assert!(study.notices.iter().any(|notice| notice.contains("cut off")), "{:?}", study.notices);
    assert!(study.notices.iter().any(|notice| notice.contains("not finished")));
}

#[test]
fn an_empty_folder_and_a_missing_one_are_named() {
    let empty = tempfile::tempdir().unwrap();
    assert!(refusal(empty.path()).contains("no session"));
    assert!(refusal(Path::new("no/such/folder")).contains("no/such/folder"));
}

#[test]
fn a_copy_of_a_session_and_another_protocol_are_refused() {
    let folder = sessions();
    let copy = folder.path().join("copy");
    fs::create_dir(&copy).unwrap();
    for name in [HEADER_FILE, EVENTS_FILE] {
        fs::copy(folder.path().join("sim-0001").join(name), copy.join(name)).unwrap();
    }
    let message = refusal(folder.path());
    assert!(message.contains("a copy of the session"), "{message}");

    let folder = sessions();
    let mut other = simulation(1, 11);
    other.protocol.pictures.dithered = false;
    other.write(&folder.path().join("sub"), || ()).unwrap();
    let paths = [folder.path().to_path_buf(), folder.path().join("sub")];
    let message = Study::read(&paths).unwrap_err().to_string();
    assert!(
        message.contains("protocol differs") && message.contains("pictures.dithered is true and false"),
        "{message}"
    );
}

#[test]
fn a_folder_given_twice_counts_once() {
    let folder = sessions();
    let paths = [folder.path().to_path_buf(), folder.path().join("sim-0001")];
    assert_eq!(Study::read(&paths).unwrap().people.len(), 3);
}

/// Cuts a session of the folder off behind its first `kept` events, and goes on with `act`.
fn interrupt(folder: &Path, kept: usize, act: impl FnOnce(&mut SessionWriter, &mut Experiment)) {
    let directory = folder.join("sim-0002");
    edit(folder, EVENTS_FILE, |text| text.split_inclusive('\n').take(kept).collect());
    let (mut writer, session) = SessionWriter::reopen(&directory).unwrap();
    act(&mut writer, &mut session.replay().unwrap());
}

fn moment() -> Moment {
    Moment { at: jiff::Timestamp::UNIX_EPOCH, notes: Vec::new(), interrupted_secs: None }
}

#[test]
fn answers_of_a_repeated_round_count_nowhere() {
    let folder = tempfile::tempdir().unwrap();
    let with_lines = changed("yes-no", 3, |_| ());
    with_lines.write(folder.path(), || ()).unwrap();
    let mut progress = None;
    interrupt(folder.path(), 40, |writer, experiment| {
        experiment.repeat_round().unwrap();
        writer.append(&Event::RepeatRound(moment())).unwrap();
        let person = Observer::new(ObserverModel::default(), 99).unwrap();
        rehearse(experiment, &person).unwrap().iter().for_each(|event| writer.append(event).unwrap());
        writer.append(&Event::End(moment())).unwrap();
        progress = Some(experiment.progress());
    });
    let (study, progress) = (read(folder.path()).unwrap(), progress.unwrap());
    assert!(study.notices.is_empty());
    let person = &study.people[1];
    let measured: usize = person.tracks.iter().map(|track| track.responses().count()).sum();
    assert_eq!(measured, progress.trials as usize);
    let checked = person.checks.lines + person.checks.catches;
    assert_eq!(checked + progress.trials, progress.answered, "no line and no catch trial of the repeated round");
    let table = trials_csv(&study).unwrap();
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let stands = reader.headers().unwrap().iter().position(|name| name == "stands").unwrap();
    let rows: Vec<_> = reader.records().map(Result::unwrap).filter(|row| &row[0] == "sim-0002").collect();
    let standing = rows.iter().filter(|row| &row[stands] == "1").count();
    assert_eq!(standing, progress.answered as usize);
    assert!(rows.len() > standing, "the answers of the repeated round are in the table, and do not stand");
}

#[test]
fn a_discarded_session_is_left_out_and_one_that_was_ended_early_is_told() {
    let folder = sessions();
    interrupt(folder.path(), 60, |writer, experiment| {
        experiment.stop().unwrap();
        writer.append(&Event::Stop(moment())).unwrap();
    });
    let study = read(folder.path()).unwrap();
    assert_eq!(study.people.len(), 3);
    let [notice] = &study.notices[..] else { panic!("{:?}", study.notices) };
    assert!(notice.contains("sim-0002: the session was ended early: round 1 of 4, 52 trials"), "{notice}");

    let discard = |writer: &mut SessionWriter, _: &mut Experiment| {
        writer.append(&Event::Discard(moment())).unwrap();
    };
    interrupt(folder.path(), 30, discard);
    let study = read(folder.path()).unwrap();
    assert_eq!((study.people.len(), study.sessions.len()), (2, 2));
    let [notice] = &study.notices[..] else { panic!("{:?}", study.notices) };
    assert!(notice.ends_with("sim-0002: left out: the administrator discarded the session"), "{notice}");
    let message = read(&folder.path().join("sim-0002")).unwrap_err().to_string();
    assert!(message.contains("the administrator discarded the session"), "{message}");
}

#[test]
fn options_out_of_range_are_refused_by_name() {
    let study = simulation(3, 1);
    let cases = [
        (Simulation { observers: 0, ..study.clone() }, "--observers"),
        (Simulation { between_sd_log10: f64::NAN, ..study.clone() }, "--between-sd"),
        (Simulation { between_sd_log10: -0.1, ..study.clone() }, "--between-sd"),
        (Simulation { median: study.median.with_thresholds_times(0.0), ..study.clone() }, "ratio"),
    ];
    for (case, name) in cases {
        let message = case.check().unwrap_err().to_string();
        assert!(message.contains(name) && message.contains("allowed"), "{message}");
    }
}

/// A study of a shipped protocol, changed.
fn changed(name: &str, observers: u32, change: impl Fn(&mut Protocol)) -> Simulation {
    let mut simulation = simulation(observers, 3);
    simulation.protocol = Protocol::named(name).unwrap();
    change(&mut simulation.protocol);
    simulation
}

#[test]
fn two_staircases_of_one_condition_are_one_track_with_all_answers() {
    let two_priors = |protocol: &mut Protocol| protocol.staircase.prior_ratios = vec![1.5, 6.0];
    let study = changed("two-alternative", 3, two_priors).study().unwrap();
    let person = &study.people[0];
    assert_eq!(person.tracks.len(), 12);
    assert!(person.tracks.iter().all(|track| track.runs.len() == 2));
    let analysis = Analysis::of(&study).unwrap();
    let threshold = &analysis.thresholds[0];
    let answers: usize = person.tracks[0].runs.iter().map(|run| run.responses.len()).sum();
    assert_eq!((threshold.trials, threshold.staircases), (answers, 2));
}

#[test]
fn kernels_are_told_apart_and_the_relation_is_of_the_first() {
    let two_kernels = |protocol: &mut Protocol| {
        protocol.conditions.kernels = vec![Kernel::Box, Kernel::Disc];
        protocol.conditions.contrasts = vec![1.0];
    };
    let study = changed("two-alternative", 4, two_kernels).study().unwrap();
    let analysis = Analysis::of(&study).unwrap();
    let names: Vec<&str> = analysis.series.iter().map(|series| series.name.as_str()).collect();
    assert_eq!(names.len(), 4);
    assert!(names.contains(&"step, 100 % contrast, box") && names.contains(&"stair, 100 % contrast, disc"));
    let file = analysis.relation_file(&study).unwrap();
    assert_eq!(file.kernel.as_deref(), Some("box"));
    assert_eq!(analysis.worst().round.kernel, Kernel::Box);
}

#[test]
fn a_yes_no_study_counts_false_alarms_and_keeps_lines_and_catch_trials_out_of_the_thresholds() {
    let (folder, out) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    changed("yes-no", 3, |_| ()).write(folder.path(), || ()).unwrap();
    let study = read(folder.path()).unwrap();
    fit_study(&study, out.path()).unwrap();

    let table = fs::read_to_string(out.path().join("trials.csv")).unwrap();
    let with_role = |role: &str| table.lines().filter(|line| line.contains(&format!(",{role},"))).count();
    assert_eq!(with_role("measure"), study.trial_count());
    let sum = |of: fn(&Person) -> u32| study.people.iter().map(of).sum::<u32>() as usize;
    assert_eq!(with_role("line"), sum(|person| person.checks.lines));
    assert_eq!(with_role("catch"), sum(|person| person.checks.catches));
    assert!(with_role("line") > 100 && with_role("catch") > 0 && with_role("practice") == 0);

    let page = fs::read_to_string(out.path().join(REPORT)).unwrap();
    assert!(
        page.contains("Lines and artifacts told apart")
            && page.contains("&plusmn;")
            && page.contains("guess rate of each person")
    );
}

#[test]
fn people_who_often_call_a_line_an_artifact_have_the_threshold_of_those_who_do_not() {
    for rate in [0.03, 0.3] {
        let mut sum_log10 = 0.0;
        for seed in 0..6 {
            let mut simulation = changed("yes-no", 10, |_| ());
            simulation.seed = seed;
            let person = WeibullObserver { false_alarm_probability: rate, ..WeibullObserver::default() };
            simulation.median = ObserverModel::Weibull(person);
            let study = simulation.study().unwrap();
            let rates: Vec<f64> = study.people.iter().filter_map(|person| person.checks.false_alarm_rate()).collect();
            let counted = rates.iter().sum::<f64>() / 10.0;
            // Some 1300 lines: standard error 0.013 at most.
            assert!((counted - rate).abs() < 0.04, "{counted} is not {rate}");
            sum_log10 += step(&study).log10_ratio.value;
        }
        // The RMS error of a cohort is 0.04 log10, so the mean of six is known to 0.016: 3 of these.
        let bias_log10 = sum_log10 / 6.0 - 3.47_f64.log10();
        assert!(bias_log10.abs() < 0.05, "false alarms {rate}: {bias_log10}");
    }
}
