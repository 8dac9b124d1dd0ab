//! The set-up by value.

use std::path::PathBuf;

use scumble_psychophysics::{Protocol, Vision};

use super::*;
use crate::session_folder::{Found, Interrupted};
use crate::setup::study_folder::{FolderProblem, PROTOCOL_FILE};

/// A set-up for a folder and a code in which `find` says what lies under every code.
fn setup(folder: &Path, participant: &str, find: FindSession) -> Setup {
    Setup::new(Given {
        folder: folder.display().to_string(),
        protocol: None,
        participant: participant.to_owned(),
        participant_number: None,
        language: Language::English,
        monitors: Vec::new(),
        monitor: 0,
        px_per_degree: None,
        recent: RecentFolders::default(),
        find,
    })
}

fn fresh(folder: &Path, participant: &str) -> Setup {
    setup(folder, participant, Box::new(|study, code| Ok(Found::Free(study.join(code)))))
}

#[test]
fn a_session_for_which_nothing_was_measured_is_ready_and_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let mut setup = fresh(folder.path(), "p07");
    assert_eq!(setup.progress(), (1, 6), "a study without a consent text has no page for it");
    let pages: Vec<Page> = (0..9)
        .map(|_| {
            setup.next();
            setup.page()
        })
        .collect();
    assert_eq!(pages[..5], [Page::Screen, Page::Brightness, Page::Room, Page::About, Page::Summary]);
    assert_eq!(pages[5..], [Page::Summary; 4]);

    let ready = setup.finish().unwrap();
    assert_eq!((ready.participant.as_str(), ready.participant_number), ("p07", 7));
    assert_eq!(ready.study.protocol(), &Protocol::two_alternative());
    assert_eq!(ready.measured, MeasuredDisplay::default());
    assert_eq!((ready.consent, ready.demographics, ready.room, ready.monitor), (None, None, None, None));
}

#[test]
fn what_was_entered_reaches_the_header() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("consent.txt"), "abc").unwrap();
    let mut setup = fresh(folder.path(), "ab");
    setup.set_number("3".to_owned());
    setup.set_language(Language::German);
    setup.calibration.distance_cm = "60".to_owned();
    setup.calibration.set_matched(true, 1.0);
    setup.gamma.matched = true;
    setup.room = " blinds closed \n".to_owned();
    (0..4).for_each(|_| setup.next());
    let at = Timestamp::from_second(1_800_000_000).unwrap();
    setup.agree(at);
    setup.about.vision = Some(Vision::Corrected);

    let ready = setup.finish().unwrap();
    let header = ready.header(5, at, scumble_psychophysics::Software::of("test", "1"));
    header.check().unwrap();
    assert_eq!((header.participant.as_str(), header.participant_number, header.seed), ("ab", 3, 5));
    assert_eq!(header.language, Some(Language::German));
    assert_eq!(header.room.as_deref(), Some("blinds closed"));
    let consent = header.consent.unwrap();
    assert!(consent.text_sha256.starts_with("ba7816bf") && consent.agreed_at == at);
    assert_eq!(header.demographics.unwrap().vision, Some(Vision::Corrected));
    assert_eq!(ready.measured.px_per_mm, Some(324.0 / 85.6));
    assert_eq!(ready.measured.viewing_distance_mm, Some(600.0));
    assert_eq!(ready.measured.gamma_check_level, Some(setup.gamma.level()));
}

#[test]
fn nobody_passes_the_consent_text_without_agreeing_and_a_changed_text_is_asked_for_anew() {
    let folder = tempfile::tempdir().unwrap();
    let text = folder.path().join("consent.txt");
    std::fs::write(&text, "one").unwrap();
    let mut setup = fresh(folder.path(), "p01");
    (0..9).for_each(|_| setup.next());
    assert_eq!((setup.page(), setup.progress()), (Page::Consent, (5, 7)));
    assert_eq!(setup.finish(), Err(Page::Consent));

    setup.decline();
    assert_eq!((setup.page(), setup.progress()), (Page::Declined, (5, 7)));
    setup.next();
    assert_eq!(setup.page(), Page::Declined);
    setup.back();
    assert_eq!(setup.page(), Page::Consent);

    setup.agree(Timestamp::UNIX_EPOCH);
    assert_eq!(setup.page(), Page::About);
    std::fs::write(&text, "two").unwrap();
    setup.look_again();
    assert!(!setup.has_agreed());
    assert_eq!(setup.finish(), Err(Page::Consent));
}

#[test]
fn each_problem_of_the_first_page_holds_the_page_and_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let problem_is = |setup: &mut Setup, expected: fn(&Problem<'_>) -> bool| {
        setup.next();
        assert_eq!(setup.page(), Page::Study);
        let problem = setup.problem().unwrap();
        assert!(expected(&problem), "{problem:?}");
    };
    let mut entered = fresh(Path::new(""), "");
    problem_is(&mut entered, |problem| matches!(problem, Problem::NoFolder));
    std::fs::write(folder.path().join("file"), "").unwrap();
    entered.pick_folder(&folder.path().join("file"));
    problem_is(&mut entered, |problem| matches!(problem, Problem::Folder(FolderProblem::NotAFolder(_))));
    entered.pick_folder(&folder.path().join("file/study"));
    problem_is(&mut entered, |problem| matches!(problem, Problem::Folder(_)));
    entered.pick_folder(folder.path());
    problem_is(&mut entered, |problem| matches!(problem, Problem::NoCode));
    for code in ["Erika Mustermann", "a.b", "12345678901234567", "ä"] {
        entered.set_participant(code.to_owned());
        problem_is(&mut entered, |problem| matches!(problem, Problem::NotACode(_)));
    }
    entered.set_participant("p01".to_owned());
    entered.set_number("-1".to_owned());
    problem_is(&mut entered, |problem| matches!(problem, Problem::NotANumber("-1")));
    entered.set_number(String::new());
    std::fs::write(folder.path().join("luminance.csv"), "").unwrap();
    problem_is(&mut entered, |problem| matches!(problem, Problem::Luminance(_)));
    std::fs::write(folder.path().join("consent.de.txt"), "ja").unwrap();
    problem_is(&mut entered, |problem| matches!(problem, Problem::Consent(_)));
    std::fs::write(folder.path().join(PROTOCOL_FILE), "name = 1").unwrap();
    problem_is(&mut entered, |problem| matches!(problem, Problem::Folder(FolderProblem::Protocol(_))));

    for name in [PROTOCOL_FILE, "luminance.csv", "consent.de.txt"] {
        std::fs::remove_file(folder.path().join(name)).unwrap();
    }
    entered.next();
    assert_eq!(entered.page(), Page::Screen);
}

#[test]
fn a_session_under_the_code_holds_the_page_until_there_is_another_code() {
    let folder = tempfile::tempdir().unwrap();
    let find = |study: &Path, code: &str| {
        let directory = study.join(code);
        match code {
            "p01" => Ok(Found::Complete(directory)),
            "p02" => {
                Ok(Found::Interrupted(Interrupted { directory, age_secs: 720.0, trials: 83, trials_at_most: 240 }))
            }
            "p03" => Err(scumble_psychophysics::Error::SessionInUse(directory)),
            _ => Ok(Found::Free(directory)),
        }
    };
    let mut setup = setup(folder.path(), "p01", Box::new(find));
    setup.next();
    assert!(setup.page() == Page::Study && matches!(setup.problem(), Some(Problem::Session(Found::Complete(_)))));
    setup.set_participant("p02".to_owned());
    setup.next();
    assert!(setup.page() == Page::Study && matches!(setup.study().found(), Some(Found::Interrupted(_))));
    setup.set_participant("p03".to_owned());
    assert!(matches!(setup.problem(), Some(Problem::Damaged(_))));
    setup.set_participant("p04".to_owned());
    setup.next();
    assert_eq!(setup.page(), Page::Screen);
}

#[test]
fn a_protocol_is_chosen_for_a_new_study_alone() {
    let folder = tempfile::tempdir().unwrap();
    let mut setup = fresh(folder.path(), "p04");
    assert!(setup.study().offers_protocols() && !setup.study().number_matters());
    setup.choose_protocol("yes-no");
    assert_eq!(setup.study().opened().unwrap().study.protocol().name, "yes-no");
    assert!(setup.study().number_matters(), "its rounds stand in a Latin square");

    let old = folder.path().join("old");
    std::fs::create_dir(&old).unwrap();
    std::fs::write(old.join(PROTOCOL_FILE), Protocol::two_alternative().to_toml().unwrap()).unwrap();
    setup.pick_folder(&old);
    assert!(!setup.study().offers_protocols());
    assert_eq!(setup.study().opened().unwrap().study.protocol().name, "two-alternative");
}

#[test]
fn a_measured_table_takes_the_place_of_the_eye_and_another_monitor_that_of_every_measurement() {
    let folder = tempfile::tempdir().unwrap();
    let monitor = Display { width_px: 1920, height_px: 1080, scale_factor: 1.0, ..Display::default() };
    let mut setup = fresh(folder.path(), "p01");
    setup.monitors = vec![monitor.clone(), monitor];
    setup.gamma.matched = true;
    setup.calibration.set_matched(true, 1.0);
    assert!(setup.finish().unwrap().measured.gamma_check_level.is_some());
    setup.set_monitor(0);
    assert!(setup.gamma.matched && setup.calibration.matched);
    setup.set_monitor(1);
    setup.set_monitor(2);
    let ready = setup.finish().unwrap();
    assert_eq!((ready.monitor, ready.measured), (Some(1), MeasuredDisplay::default()));

    std::fs::write(folder.path().join("luminance.csv"), "level,luminance_cd_m2\n0,0.2\n255,100\n").unwrap();
    setup.gamma.matched = true;
    setup.look_again();
    let measured = setup.finish().unwrap().measured;
    assert_eq!(measured.luminance_table, Some(vec![(0, 0.2), (255, 100.0)]));
    assert_eq!(measured.gamma_check_level, None);
}

#[test]
fn a_slip_of_the_fingers_holds_its_own_page() {
    let folder = tempfile::tempdir().unwrap();
    let mut setup = fresh(folder.path(), "p01");
    setup.next();
    setup.calibration.distance_cm = "6".to_owned();
    setup.next();
    assert!(setup.page() == Page::Screen && matches!(setup.problem(), Some(Problem::NotADistance(_))));
    assert_eq!(setup.finish(), Err(Page::Screen));
    setup.calibration.distance_cm.clear();
    (0..3).for_each(|_| setup.next());
    setup.about.age = "1987".to_owned();
    setup.next();
    assert!(setup.page() == Page::About && matches!(setup.problem(), Some(Problem::NotAnAge(_))));
    setup.back();
    assert_eq!(setup.page(), Page::Room);
}

#[test]
fn recent_folders_are_offered_and_the_newest_is_picked_by_its_place() {
    let home = tempfile::tempdir().unwrap();
    let mut recent = RecentFolders::of_file(home.path().join("list"));
    let folders: Vec<PathBuf> = ["one", "two"].map(|name| home.path().join(name)).into();
    for folder in &folders {
        std::fs::create_dir(folder).unwrap();
        recent.remember(folder);
    }
    let mut setup = fresh(Path::new(""), "p01");
    setup.recent = recent.offered();
    let newest = setup.recent()[0].clone();
    setup.pick_folder(&newest);
    assert_eq!(setup.study().opened().unwrap().study.directory(), folders[1]);
}

#[test]
fn who_begins_anew_after_a_discarded_session_keeps_its_number_and_nobody_else_gets_it() {
    let folder = tempfile::tempdir().unwrap();
    let mut setup = fresh(folder.path(), "p01");
    setup.discarded(5);
    assert_eq!(setup.finish().unwrap().participant_number, 5);
    setup.set_participant("p02".to_owned());
    assert_eq!(setup.finish().unwrap().participant_number, 2);
    setup.set_participant("p01".to_owned());
    assert_eq!(setup.finish().unwrap().participant_number, 5);
    setup.set_number("3".to_owned());
    assert_eq!(setup.finish().unwrap().participant_number, 3, "what somebody types stands");
    setup.set_number(String::new());
    setup.set_folder(folder.path().join("another").display().to_string());
    assert_eq!(setup.finish().unwrap().participant_number, 1);
}
