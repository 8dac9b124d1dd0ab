//! What a session's header tells of the display and of the person: read back as it was, and checked.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

mod support;

use scumble_psychophysics::{
    Consent, Demographics, Display, Experience, Gender, Handedness, Language, SessionHeader, Vision,
};
use scumble_stimuli::Transfer;
use serde_json::{Value, json};
use support::{full_header, header, small};

fn tree(header: &SessionHeader) -> Value {
    serde_json::to_value(header).unwrap()
}

fn read(tree: &Value) -> SessionHeader {
    serde_json::from_value(tree.clone()).unwrap()
}

#[test]
fn every_key_is_written_and_read_back_as_it_was() {
    let header = full_header(small("two-alternative"));
    header.check().unwrap();
    let written = tree(&header);
    assert_eq!(read(&written), header);
    assert_eq!(written["schema"], "scumble/session/3");
    assert_eq!(written["language"], "de");
    assert_eq!(
        written["demographics"],
        json!({ "age_years": 34, "gender": "female", "handedness": "left", "vision": "corrected",
                "graphics_experience": "expert" })
    );
    assert_eq!(written["consent"]["agreed_at"], "2026-03-01T09:25:00Z");
    assert_eq!(written["display"]["luminance_table"][0], json!([0, 0.5]));
    assert_eq!(written["display"]["gamma_check_level"], 180);
}

#[test]
fn what_was_not_asked_or_measured_is_not_written() {
    let written = tree(&SessionHeader { display: Some(Display::default()), ..header(small("two-alternative")) });
    for key in ["language", "consent", "demographics", "room"] {
        assert_eq!(written.get(key), None, "{key}");
    }
    for key in ["refresh_hz", "window_px", "px_per_mm", "viewing_distance_mm", "luminance_table", "gamma_check_level"] {
        assert_eq!(written["display"].get(key), None, "{key}");
    }
    let nothing_told = SessionHeader { demographics: Some(Demographics::default()), ..header(small("yes-no")) };
    assert_eq!(tree(&nothing_told)["demographics"], json!({}));
    assert_eq!(read(&tree(&nothing_told)), nothing_told);
}

#[test]
fn every_word_of_the_demographics_is_read_back() {
    for demographics in [
        Demographics { gender: Some(Gender::Male), handedness: Some(Handedness::Right), ..Demographics::default() },
        Demographics { gender: Some(Gender::Other), handedness: Some(Handedness::Both), ..Demographics::default() },
        Demographics {
            vision: Some(Vision::Normal),
            graphics_experience: Some(Experience::None),
            age_years: Some(1),
            ..Demographics::default()
        },
        Demographics {
            vision: Some(Vision::Impaired),
            graphics_experience: Some(Experience::Some),
            age_years: Some(120),
            ..Demographics::default()
        },
    ] {
        let header = SessionHeader { demographics: Some(demographics), ..header(small("two-alternative")) };
        header.check().unwrap();
        assert_eq!(read(&tree(&header)), header);
    }
}

#[test]
fn a_value_out_of_its_range_is_refused_by_its_name() {
    type Spoil = fn(&mut SessionHeader);
    let cases: [(&str, Spoil); 11] = [
        ("display.refresh_hz", |header| display(header).refresh_hz = Some(0.0)),
        ("display.window_px", |header| display(header).window_px = Some([1920, 0])),
        ("display.px_per_degree", |header| display(header).px_per_degree = Some(f64::NAN)),
        ("display.px_per_mm", |header| display(header).px_per_mm = Some(-4.0)),
        ("display.viewing_distance_mm", |header| display(header).viewing_distance_mm = Some(f64::INFINITY)),
        ("display.luminance_table", |header| display(header).luminance_table = Some(vec![])),
        ("display.luminance_table", |header| display(header).luminance_table = Some(vec![(0, 9.0), (255, 1.0)])),
        ("display.luminance_table", |header| display(header).luminance_table = Some(vec![(0, 1.0), (200, 9.0)])),
        ("consent.text_sha256", |header| header.consent.as_mut().unwrap().text_sha256.truncate(63)),
        ("demographics.age_years", |header| header.demographics.as_mut().unwrap().age_years = Some(0)),
        ("demographics.age_years", |header| header.demographics.as_mut().unwrap().age_years = Some(121)),
    ];
    for (field, spoil) in cases {
        let mut header = full_header(small("two-alternative"));
        spoil(&mut header);
        let message = header.check().unwrap_err().to_string();
        assert!(message.starts_with(&format!("{field} is ")) && message.contains("; allowed is "), "{message}");
    }
}

fn display(header: &mut SessionHeader) -> &mut Display {
    header.display.as_mut().unwrap()
}

#[test]
fn pictures_are_drawn_for_the_measured_light_and_for_that_of_srgb_where_none_was_measured() {
    let measured = full_header(small("two-alternative"));
    let rows = measured.display.as_ref().unwrap().luminance_table.clone().unwrap();
    assert_eq!(measured.transfer().unwrap(), Transfer::from_table(&rows).unwrap());
    assert_ne!(measured.transfer().unwrap(), Transfer::srgb());
    for display in [None, Some(Display { luminance_table: None, ..measured.display.clone().unwrap() })] {
        let header = SessionHeader { display, ..measured.clone() };
        assert_eq!(header.transfer().unwrap(), Transfer::srgb());
    }
}

#[test]
fn a_language_that_the_program_does_not_speak_is_named() {
    let mut written = tree(&SessionHeader { language: Some(Language::English), ..header(small("yes-no")) });
    assert_eq!(written["language"], "en");
    written["language"] = json!("fr");
    let message = serde_json::from_value::<SessionHeader>(written).unwrap_err().to_string();
    assert!(message.contains("unknown variant `fr`, expected `en` or `de`"), "{message}");
    let consent = json!({ "text_sha256": "0".repeat(64) });
    assert!(serde_json::from_value::<Consent>(consent).is_err(), "a consent has its time");
}
