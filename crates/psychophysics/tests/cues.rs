//! What could tell the answer but the artifact, and does not: side, phase, mirroring, polarity, tilt,
//! size, radius, order, and what came before.

mod support;

use scumble_psychophysics::{Answered, Pictures, Protocol, Role, Trial};
use scumble_stimuli::{Pattern, Shape, Stimulus};
use support::{NAMES, answers, named};

/// Sessions of each protocol: some 20,000 trials of two alternatives, standard error of a share 0.4 %.
const SESSIONS: u64 = 80;

/// Shares that are compared at 4 standard errors are exceeded by chance in 6 of 100,000 comparisons.
const STANDARD_ERRORS: f64 = 4.0;

/// Among cases `(cue, right)`, the share of right ones with the cue less that without, in standard errors.
///
/// The difference of two shares has the variance `p (1 - p) (1 / n_with + 1 / n_without)`.
fn difference_in_errors(cases: &[(bool, bool)]) -> f64 {
    let count = |cue: bool| cases.iter().filter(|case| case.0 == cue).count() as f64;
    let right = |cue: bool| cases.iter().filter(|case| **case == (cue, true)).count() as f64;
    let (with, without) = (count(true), count(false));
    assert!(with > 200.0 && without > 200.0, "{with} {without}: too few to tell");
    let pooled = (right(true) + right(false)) / (with + without);
    let variance = pooled * (1.0 - pooled) * (1.0 / with + 1.0 / without);
    (right(true) / with - right(false) / without) / variance.sqrt()
}

/// What a person could see of a trial without seeing the artifact, or remember of the trials before.
fn cues(before: &[Answered], trial: &Trial) -> Vec<(&'static str, bool)> {
    let all = trial.pictures.all();
    let (first, other) = (all[0], all[all.len() - 1]);
    let last = before.last();
    let last_of_track = before.iter().rev().find(|answered| answered.trial.track == trial.track);
    let same_size_before = |back: usize| {
        let earlier = before.len().checked_sub(back).map(|index| &before[index].trial);
        earlier.is_some_and(|earlier| earlier.condition.texel_px == trial.condition.texel_px)
    };
    let phase_before = last.is_some_and(|a| a.trial.pictures.all()[0].phase < 0.5);
    vec![
        ("mirrored", first.mirrored),
        ("inverted", first.inverted),
        ("mirrored and inverted alike", first.mirrored == first.inverted),
        ("phase", first.phase < 0.5),
        ("phase in the middle", (first.phase - 0.5).abs() < 0.25),
        ("noise", first.dither_seed.unwrap_or(0) % 2 == 0),
        ("noise of the last picture", other.dither_seed.unwrap_or(0) < 1 << 31),
        ("first turned left", first.tilt_rad > 0.0),
        ("last turned left", other.tilt_rad > 0.0),
        ("first turned further", first.tilt_rad.abs() > other.tilt_rad.abs()),
        ("turned far", first.tilt_rad.abs() > 0.05),
        ("smallest texel", trial.condition.texel_px == 5.0),
        ("largest texel", trial.condition.texel_px == 20.0),
        ("stair", trial.condition.pattern == Pattern::Stair),
        ("full contrast", trial.condition.contrast == 1.0),
        ("wide filter", trial.ratio() > 3.0),
        ("odd number", trial.number % 2 == 1),
        ("size as one trial ago", same_size_before(1)),
        ("size as two trials ago", same_size_before(2)),
        ("size as three trials ago", same_size_before(3)),
        (
            "radius as last time",
            last_of_track.is_some_and(|a| a.trial.placement_radius_px == trial.placement_radius_px),
        ),
        ("wider than last time", last_of_track.is_some_and(|a| a.trial.radius_px > trial.radius_px)),
        ("same phase as before", phase_before == (first.phase < 0.5)),
        ("last answer right", last.is_some_and(|a| a.correct)),
        ("last answer", last.is_some_and(|a| a.answer == a.trial.pictures.answers()[0])),
        ("last right answer", last.is_some_and(|a| a.trial.pictures.right_answer() == a.trial.pictures.answers()[0])),
        ("last was a line", last.is_some_and(|a| a.trial.role == Role::Line)),
    ]
}

/// For every cue its cases over all trials that `choose` keeps: whether the cue is there, and whether the
/// first of the two answers is right.
fn cases(protocol: &Protocol, choose: impl Fn(&Trial) -> bool) -> Vec<(&'static str, Vec<(bool, bool)>)> {
    let mut all: Vec<(&'static str, Vec<(bool, bool)>)> = vec![];
    for session in answers(protocol, SESSIONS) {
        for (index, answered) in session.iter().enumerate().filter(|(_, answered)| choose(&answered.trial)) {
            let trial = &answered.trial;
            let first_is_right = trial.pictures.right_answer() == trial.pictures.answers()[0];
            for (place, (name, cue)) in cues(&session[..index], trial).into_iter().enumerate() {
                if place == all.len() {
                    all.push((name, vec![]));
                }
                all[place].1.push((cue, first_is_right));
            }
        }
    }
    all
}

/// Fails on a cue that tells the answer; cues that every trial has, or none, tell nothing.
fn assert_nothing_tells(protocol: &Protocol, choose: impl Fn(&Trial) -> bool) {
    for (name, cases) in cases(protocol, choose) {
        if cases.iter().any(|case| case.0) && cases.iter().any(|case| !case.0) {
            let errors = difference_in_errors(&cases);
            assert!(errors.abs() < STANDARD_ERRORS, "{name}: {errors} standard errors in {}", cases.len());
        }
    }
}

#[test]
fn nothing_tells_the_side_of_the_line() {
    assert_nothing_tells(&named("two-alternative"), |_| true);
    let sides: Vec<bool> = answers(&named("two-alternative"), SESSIONS)
        .concat()
        .iter()
        .map(|answered| answered.trial.pictures.right_answer() == answered.trial.pictures.answers()[0])
        .collect();
    let (count, left) = (sides.len() as f64, sides.iter().filter(|left| **left).count() as f64);
    assert!((left / count - 0.5).abs() < STANDARD_ERRORS * (0.25 / count).sqrt());
}

#[test]
fn nothing_tells_a_line_from_an_artifact_in_the_yes_no_task() {
    // A catch trial is plain to see, and always an artifact.
    assert_nothing_tells(&named("yes-no"), |trial| trial.role != Role::Catch);
}

#[test]
fn a_cue_that_tells_is_found() {
    let cases: Vec<(bool, bool)> = (0..4000).map(|i| (i % 2 == 0, i % 2 == 0 || i % 7 == 0)).collect();
    assert!(difference_in_errors(&cases) > STANDARD_ERRORS);
    // One trial in twenty betrayed: right in 52.5 % with the cue and in 47.5 % without.
    let cases: Vec<(bool, bool)> =
        (0..20_000).map(|i| (i % 2 == 0, if i % 40 < 2 { i % 2 == 0 } else { i % 4 < 2 })).collect();
    assert!(difference_in_errors(&cases) > STANDARD_ERRORS);
    let fair: Vec<(bool, bool)> = (0..20_000).map(|i| (i % 2 == 0, i % 4 < 2)).collect();
    assert!(difference_in_errors(&fair).abs() < 0.01);
}

/// Every picture of the answers' trials with its trial.
fn pictures(answers: &[Answered]) -> Vec<(&Trial, &Stimulus)> {
    answers.iter().flat_map(|a| a.trial.pictures.all().into_iter().map(|picture| (&a.trial, picture))).collect()
}

#[test]
fn tilts_fill_their_range_evenly_and_a_stair_is_never_turned() {
    for name in NAMES {
        let protocol = named(name);
        let range_rad = protocol.pictures.tilt_range_rad;
        let all = answers(&protocol, 20).concat();
        let turned: Vec<f64> = pictures(&all)
            .into_iter()
            .filter(|(_, picture)| {
                let is_stair = picture.pattern == Pattern::Stair;
                assert!(!is_stair || picture.tilt_rad == 0.0);
                !is_stair
            })
            .map(|(_, picture)| picture.tilt_rad)
            .collect();
        assert!(turned.iter().all(|tilt_rad| tilt_rad.abs() <= range_rad));
        if range_rad > 0.0 {
            // A uniform variable on -R to R has mean 0 and variance R^2 / 3, whose estimate has the variance
            // (1/5 - 1/9) R^4 / n.
            let count = turned.len() as f64;
            let mean = turned.iter().sum::<f64>() / count / range_rad;
            let variance = turned.iter().map(|tilt| (tilt / range_rad).powi(2)).sum::<f64>() / count;
            assert!(mean.abs() < STANDARD_ERRORS * (1.0 / 3.0 / count).sqrt(), "{name}: {mean}");
            assert!((variance - 1.0 / 3.0).abs() < STANDARD_ERRORS * (4.0 / 45.0 / count).sqrt(), "{name}: {variance}");
        } else {
            assert_eq!(name, "published", "which shows the tilt of the line as printed");
        }
    }
}

#[test]
fn who_judges_tilt_alone_finds_the_line_hardly_more_often_than_a_coin() {
    // Far from its riser a step is level, its line has the slope s = texel / width. Turned at random within
    // R, the line is the more tilted picture in 1/2 + (s / R)^2 / 4 of the trials: 52.8 % at 20 px.
    let protocol = named("two-alternative");
    let all = answers(&protocol, SESSIONS).concat();
    for texel_px in [5.0, 10.0, 20.0] {
        let steps = all
            .iter()
            .map(|answered| answered.trial)
            .filter(|trial| trial.condition.pattern == Pattern::Step && trial.condition.texel_px == texel_px);
        let slope_rad = f64::atan(texel_px / f64::from(protocol.pictures.width_px));
        let line_is_more_tilted = |trial: Trial| {
            let Pictures::Pair { left, right } = trial.pictures else { panic!("{:?}", trial.pictures) };
            let (line, artifact) = if left.shape == Shape::Line { (left, right) } else { (right, left) };
            // A mirrored line falls where the other one rises.
            let own_rad = if line.mirrored { -slope_rad } else { slope_rad };
            (own_rad + line.tilt_rad).abs() > artifact.tilt_rad.abs()
        };
        let found: Vec<bool> = steps.map(line_is_more_tilted).collect();
        let (count, share) =
            (found.len() as f64, found.iter().filter(|more| **more).count() as f64 / found.len() as f64);
        let expected = 0.5 + (slope_rad / protocol.pictures.tilt_range_rad).powi(2) / 4.0;
        assert!((share - expected).abs() < STANDARD_ERRORS * (0.25 / count).sqrt(), "{texel_px}: {share} {expected}");
        assert!(expected < 0.53);
    }
}
