//! The pictures of whole sessions: what they follow from, and in what they differ.

#![allow(clippy::unwrap_used, reason = "a helper of a test fails the test")]

mod support;

use scumble_psychophysics::{Answer, Pictures, Protocol};
use scumble_stimuli::{Kernel, Pattern, Shape, Stimulus, Transfer};
use support::{NAMES, answers, measured, named, session, small};

#[test]
fn the_same_seed_gives_the_same_session_image_for_image() {
    for name in NAMES {
        let (first, second) = (session(&named(name), 7, 1).1, session(&named(name), 7, 1).1);
        assert_eq!(first, second);
        for (a, b) in measured(&first).iter().zip(&measured(&second)).take(6) {
            let pixels = |stimulus: &Stimulus| stimulus.render(96, 72, &Transfer::srgb()).unwrap().into_raw();
            for (a, b) in a.pictures.all().into_iter().zip(b.pictures.all()) {
                assert_eq!(pixels(a), pixels(b));
            }
        }
    }
}

#[test]
fn another_seed_gives_another_session() {
    let (a, b) = (
        measured(&session(&Protocol::two_alternative(), 1, 0).1),
        measured(&session(&Protocol::two_alternative(), 2, 0).1),
    );
    assert!(a.iter().zip(&b).all(|(a, b)| a.pictures.all()[0].phase != b.pictures.all()[0].phase));
}

#[test]
fn the_two_pictures_differ_in_shape_dithering_and_tilt_alone() {
    let (_, events) = session(&Protocol::two_alternative(), 4, 0);
    for trial in measured(&events) {
        let Pictures::Pair { left, right } = trial.pictures else { panic!("{:?}", trial.pictures) };
        let (line, artifact) = if trial.is_correct(Answer::Left) { (left, right) } else { (right, left) };
        assert_eq!((line.shape, artifact.shape), (Shape::Line, Shape::Artifact));
        assert_ne!(line.dither_seed, artifact.dither_seed);
        let twin = Stimulus { shape: Shape::Line, dither_seed: line.dither_seed, tilt_rad: line.tilt_rad, ..artifact };
        assert_eq!(line, twin);
        assert_eq!(line.radius_px, trial.radius_px);
    }
}

#[test]
fn every_pattern_under_every_kernel_makes_a_round_that_can_be_drawn() {
    for name in NAMES {
        let mut protocol = small(name);
        protocol.conditions.patterns = vec![Pattern::Stair, Pattern::Step, Pattern::DoubleStep];
        protocol.conditions.kernels = Kernel::NAMED.iter().map(|(_, kernel)| *kernel).collect();
        let (experiment, events) = session(&protocol, 8, 0);
        assert_eq!(experiment.progress().rounds, 18);
        let mut seen: Vec<(Pattern, Kernel)> = vec![];
        for trial in measured(&events) {
            let condition = (trial.condition.pattern, trial.condition.kernel);
            if !seen.contains(&condition) {
                seen.push(condition);
                for picture in trial.pictures.all() {
                    assert_eq!((picture.pattern, picture.kernel), condition);
                    picture.render(40, 30, &Transfer::srgb()).unwrap();
                }
            }
        }
        assert_eq!(seen.len(), 18);
    }
}

#[test]
fn a_protocol_without_dithering_has_no_seeds_and_one_with_it_a_seed_a_picture() {
    for dithered in [false, true] {
        let mut protocol = named("two-alternative");
        protocol.pictures.dithered = dithered;
        let mut seeds: Vec<u64> = vec![];
        for answered in answers(&protocol, 1).concat() {
            let of_trial = answered.trial.pictures.all().into_iter().filter_map(|picture| picture.dither_seed);
            seeds.extend(of_trial);
        }
        assert_eq!(seeds.is_empty(), !dithered);
        let count = seeds.len();
        seeds.sort_unstable();
        seeds.dedup();
        assert_eq!(seeds.len(), count, "no two pictures share their noise");
    }
}
