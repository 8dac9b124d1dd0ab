//! What the protocol's exclusions leave out of a fit, and that nothing vanishes without a word.

#![allow(clippy::unwrap_used, reason = "a test stops at what it did not expect, in helpers too")]

use std::{fs, path::Path};

use scumble_analysis::{Simulation, Study, fit_study, trials_csv};
use scumble_psychophysics::{EVENTS_FILE, Exclusions, HEADER_FILE, ObserverModel, Protocol, WeibullObserver};

fn simulation(name: &str, exclusions: Exclusions) -> Simulation {
    let protocol = Protocol { exclusions: Some(exclusions), ..Protocol::named(name).unwrap() };
    Simulation { protocol, observers: 3, seed: 7, median: ObserverModel::default(), between_sd_log10: 0.1 }
}

fn study(simulation: &Simulation, folder: &Path) -> Study {
    simulation.write(folder, || ()).unwrap();
    Study::read(&[folder.to_path_buf()]).unwrap()
}

/// Cells of a column of `trials.csv`.
fn column(study: &Study, name: &str) -> Vec<String> {
    let table = trials_csv(study).unwrap();
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let index = reader.headers().unwrap().iter().position(|header| header == name).unwrap();
    reader.records().map(|record| record.unwrap()[index].to_owned()).collect()
}

#[test]
fn answers_outside_of_the_times_are_counted_named_and_marked_and_every_other_one_enters() {
    let folder = tempfile::tempdir().unwrap();
    let rules =
        Exclusions { response_time_min_secs: Some(1.2), response_time_max_secs: Some(4.0), ..Exclusions::default() };
    let study = study(&simulation("two-alternative", rules), folder.path());
    let marks = column(&study, "excluded");
    let times = column(&study, "response_time_secs");
    let (mut fast, mut slow) = (0, 0);
    for (mark, time) in marks.iter().zip(&times) {
        let secs: f64 = time.parse().unwrap();
        let expected = match secs {
            _ if secs < 1.2 => "answered too fast",
            _ if secs > 4.0 => "answered too slowly",
            _ => "",
        };
        assert_eq!(mark, expected, "{secs} s");
        fast += u32::from(secs < 1.2);
        slow += u32::from(secs > 4.0);
    }
    assert!(fast > 10 && slow > 5, "{fast}, {slow}: the test would show nothing");
    assert_eq!(study.trial_count() as u32 + fast + slow, marks.len() as u32, "what is not left out enters");
    let counted: u32 = study.people.iter().flat_map(|person| person.excluded.values()).sum();
    assert_eq!(counted, fast + slow);
    for person in &study.people {
        let notice =
            format!("{}: answers left out: {} answered too fast", person.code, person.excluded["answered too fast"]);
        assert!(study.notices.contains(&notice), "{:?}", study.notices);
    }
}

#[test]
fn who_answers_blindly_or_says_yes_by_habit_is_left_out_by_name_and_stays_in_the_table() {
    for (person, rules, words) in [
        (
            WeibullObserver { false_alarm_probability: 0.45, ..WeibullObserver::default() },
            Exclusions { false_alarms_max: Some(0.47), ..Exclusions::default() },
            "lines artifacts; the protocol allows a share of 0.47",
        ),
        (
            WeibullObserver { lapse_probability: 0.35, ..WeibullObserver::default() },
            Exclusions { catch_misses_max: Some(0.4), ..Exclusions::default() },
            "catch trials; the protocol allows a share of 0.4",
        ),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let simulation =
            Simulation { median: ObserverModel::Weibull(person), observers: 8, ..simulation("yes-no", rules) };
        let study = study(&simulation, folder.path());
        assert_eq!(study.people.len() + study.excluded_people.len(), 8);
        assert!((1..8).contains(&study.excluded_people.len()), "{:?}", study.notices);
        for code in &study.excluded_people {
            let named = |notice: &&String| notice.starts_with(&format!("{code}: left out: ")) && notice.contains(words);
            assert!(study.notices.iter().any(|notice| named(&notice)), "{code}: {:?}", study.notices);
        }
        let rows = column(&study, "person").into_iter().zip(column(&study, "excluded"));
        for (person, mark) in rows {
            assert_eq!(mark == "person", study.excluded_people.contains(&person));
        }
        let out = tempfile::tempdir().unwrap();
        fit_study(&study, out.path()).unwrap();
        let page = fs::read_to_string(out.path().join("report.html")).unwrap();
        assert!(page.contains(words), "the report says who was left out, and why");
    }
}

#[test]
fn a_session_without_an_answer_is_left_out_and_the_others_are_fitted() {
    let folder = tempfile::tempdir().unwrap();
    simulation("two-alternative", Exclusions::default()).write(folder.path(), || ()).unwrap();
    fs::remove_file(folder.path().join("sim-0001").join(EVENTS_FILE)).unwrap();
    fs::remove_file(folder.path().join("sim-0002").join(EVENTS_FILE)).unwrap();
    let header = folder.path().join("sim-0002").join(HEADER_FILE);
    let text = fs::read_to_string(&header).unwrap();
    fs::write(&header, &text[..text.len() / 2]).unwrap();

    let study = Study::read(&[folder.path().to_path_buf()]).unwrap();
    assert_eq!(study.people.iter().map(|person| person.code.as_str()).collect::<Vec<_>>(), ["sim-0003"]);
    let says = |words: &str| study.notices.iter().any(|notice| notice.contains(words));
    assert!(says("sim-0001: left out: the session has no measured trial"), "{:?}", study.notices);
    assert!(says("sim-0002: left out: the session ended before its header was whole"), "{:?}", study.notices);
}

#[test]
fn people_of_several_laboratories_enter_one_fit_and_two_sessions_of_one_code_are_one_person() {
    let folder = tempfile::tempdir().unwrap();
    let one = simulation("two-alternative", Exclusions::default());
    let mut other = Simulation { seed: 8, observers: 4, ..one.clone() };
    other.protocol.name = "the same in another room".to_owned();
    other.protocol.schedule.trials_max = 30;
    let paths = ["one", "other"].map(|name| folder.path().join(name));
    one.write(&paths[0], || ()).unwrap();
    other.write(&paths[1], || ()).unwrap();
    let study = Study::read(&paths).unwrap();
    assert_eq!((study.people.len(), study.sessions.len()), (4, 7));
    assert!(study.notices.contains(&"sim-0001: 2 sessions of this code are taken for one person's".to_owned()));
    let mut shuffled = paths.clone();
    shuffled.reverse();
    assert_eq!(Study::read(&shuffled).unwrap().people, study.people, "whatever the order of the folders");
}
