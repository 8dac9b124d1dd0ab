//! Every page in both languages on the smallest screens: nothing runs out of the window or over something else.

use std::path::Path;

use eframe::egui::{Rect, Vec2};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use scumble_psychophysics::Language;

use super::testing::*;
use crate::session_folder::Found;
use crate::setup::{Given, RecentFolders, Setup};

/// XGA, which is too small for two pictures, and the smallest that is not.
const SIZES: [Vec2; 2] = [Vec2::new(1024.0, 768.0), Vec2::new(1280.0, 720.0)];

/// A setup for every page, and for each state of the first one.
fn pages(language: Language) -> Vec<(&'static str, Setup)> {
    let of = |folder: &str| Given { language, ..given(Path::new(folder)) };
    let at = |page: usize| {
        let mut setup = after(Setup::new(of(MEASURED)), page.min(4));
        if page > 4 {
            setup.agree(jiff::Timestamp::UNIX_EPOCH);
            setup = after(setup, page - 5);
        }
        setup
    };
    let mut recent = RecentFolders::default();
    ["src", MEASURED].iter().for_each(|folder| recent.remember_as(Path::new(folder)));
    let find = Box::new(|study: &Path, code: &str| Ok(Found::Interrupted(interrupted(study.join(code)))));
    let protocol = Some("yes-no".to_owned());
    let mut room = after(Setup::new(of(NEW)), 3);
    room.room = "Ceiling lamps off, blinds closed, desk lamp behind the display on. ".repeat(4);
    vec![
        ("empty", Setup::new(of(""))),
        ("recent", Setup::new(Given { recent, ..of("") })),
        ("study", Setup::new(of(NEW_WHOLE))),
        ("numbered", Setup::new(Given { protocol, ..of(NEW_WHOLE) })),
        ("interrupted", Setup::new(Given { find, ..of(NEW_WHOLE) })),
        ("problem", Setup::new(Given { participant: "Erika Mustermann".to_owned(), ..of(NEW_WHOLE) })),
        ("screen", after(Setup::new(of(NEW)), 1)),
        ("brightness", after(Setup::new(of(NEW)), 2)),
        ("measured", at(2)),
        ("room", after(Setup::new(of(NEW)), 3)),
        ("consent", at(4)),
        ("about", at(5)),
        ("summary", after(room, 2)),
    ]
}

#[test]
fn nothing_runs_out_of_a_small_window_and_no_button_stands_on_the_keys() {
    for (size, language) in SIZES.into_iter().flat_map(|size| [Language::English, Language::German].map(|l| (size, l)))
    {
        for (name, setup) in pages(language) {
            let mut harness = harness(setup, size, 1.0);
            harness.run_steps(3);
            let window = Rect::from_min_size(Default::default(), size);
            let mut in_foot: Vec<(String, Rect)> = Vec::new();
            for node in harness.query_all_by(|node| node.label().is_some() || node.value().is_some()) {
                let (rect, access) = (node.rect(), node.accesskit_node());
                let text = access.label().or(access.value()).unwrap_or_default();
                let fits = rect.left() >= 0.0 && rect.right() <= window.right();
                assert!(fits, "{name}, {language:?}, {size}: {text:?} lies at {rect}");
                // The buttons and the keys are in the last line.
                if rect.top() > window.bottom() - 84.0 {
                    in_foot.push((text, rect));
                }
            }
            for (index, (text, rect)) in in_foot.iter().enumerate() {
                let beside = in_foot[..index].iter().find(|(_, other)| other.shrink(1.0).intersects(rect.shrink(1.0)));
                assert!(beside.is_none(), "{name}, {language:?}, {size}: {text:?} on {beside:?}");
            }
        }
    }
}

#[test]
fn a_screen_that_is_too_small_for_the_pictures_is_said_on_the_first_page() {
    let says = |size: Vec2, folder: &str| {
        let mut harness = harness(Setup::new(given(Path::new(folder))), size, 1.0);
        harness.run_steps(2);
        let says = harness.query_by_label_contains("1232 x 716").is_some();
        assert_eq!(says, harness.query_by_label_contains("1024 x 768").is_some());
        says
    };
    assert!(says(SIZES[0], NEW));
    assert!(!says(SIZES[0], ""), "the protocol is not known yet");
    assert!(!says(SIZES[1], NEW));
}

#[test]
#[ignore = "writes pictures to look at into the temporary folder"]
fn every_page_of_a_small_window() {
    for (size, language) in SIZES.into_iter().flat_map(|size| [Language::English, Language::German].map(|l| (size, l)))
    {
        for (name, setup) in pages(language) {
            let mut harness = harness(setup, size, 1.0);
            harness.run_steps(3);
            let file = format!("setup_{name}_{language:?}_{}.png", size.y);
            harness.render().unwrap().save(std::env::temp_dir().join(file)).unwrap();
        }
    }
}
