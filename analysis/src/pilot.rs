//! What the data of a pilot carry: tracks, thresholds and psychometric functions of single people, and no relation.
//!
//! A threshold here has the protocol's slope and lapses: there is no mixed model to take everyone's from.

use std::path::Path;

use scumble_psychophysics::{Protocol, Round};

use crate::{
    Error,
    analysis::left_out,
    assumptions::Assumptions,
    figure::FIGURE_MARK,
    fit_outputs::RELATION,
    mixed_model::MixedParameters,
    outputs::{Output, write_outputs},
    people::{Person, Study, Track},
    psychometric_figure::{self, PSYCHOMETRIC_FIGURE, Panel},
    report::{REPORT, REPORT_MARK, pilot, staircases},
    series::{answers_of, round_of, series_name},
    staircase_figure::STAIRCASE_FIGURE,
    study_tables::{THRESHOLDS_MARK, THRESHOLDS_TABLE, thresholds_csv},
    threshold_intervals::threshold_intervals,
    thresholds::{ConditionThreshold, joint_threshold, thresholds_of},
    trial_table::{TRIALS_COLUMNS, TRIALS_COLUMNS_MARK, TRIALS_MARK, TRIALS_TABLE, trials_columns, trials_csv},
};

/// Writes report, tables and figures of a study that carries no relation for a `reason`; gives the refusal that says what to
/// do next.
///
/// # Errors
/// A file in the way, such as the relation of an earlier fit, which would contradict the report.
pub(crate) fn write_pilot(study: &Study, reason: String, folder: &Path) -> Result<Error, Error> {
    let relation = folder.join(RELATION);
    if relation.exists() {
        let reason =
            format!("is of an earlier fit, and these data cannot carry one: {reason}; allowed is another --out");
        return Err(Error::File { path: relation, reason });
    }
    let thresholds: Vec<ConditionThreshold> =
        study.people.iter().flat_map(|person| thresholds_of(person, &study.protocol, |_| None)).collect();
    let intervals = threshold_intervals(study, |_| None)?;
    let panels: Vec<Panel> = study.protocol.rounds().into_iter().map(|round| panel(round, study)).collect();
    let psychometric = psychometric_figure::draw(&panels, "the protocol's slope")?;
    let staircases = staircases(study, &thresholds)?;
    let next = next(study);
    let page = pilot::Page {
        reason: &reason,
        next,
        thresholds: &thresholds,
        intervals: &intervals,
        left_out: &left_out(&thresholds, &study.protocol),
        psychometric: &psychometric,
        staircases: &staircases,
    };
    let output = |name, content, mark| Output { name, content, mark };
    let mut outputs = vec![
        output(REPORT, page.html(study), REPORT_MARK),
        output(TRIALS_TABLE, trials_csv(study)?, TRIALS_MARK),
        output(TRIALS_COLUMNS, trials_columns()?, TRIALS_COLUMNS_MARK),
        output(THRESHOLDS_TABLE, thresholds_csv(&thresholds, &intervals)?, THRESHOLDS_MARK),
        output(PSYCHOMETRIC_FIGURE, psychometric.clone(), FIGURE_MARK),
    ];
    let first = staircases.first().map(|(_, figure)| output(STAIRCASE_FIGURE, figure.clone(), FIGURE_MARK));
    outputs.extend(first);
    write_outputs(folder, &outputs)?;
    Ok(Error::Pilot { reason, next, report: folder.join(REPORT) })
}

/// What the administrator does next.
fn next(study: &Study) -> &'static str {
    let tracks = || study.people.iter().flat_map(|person| &person.tracks);
    if !tracks().any(|track| track.converged() > 0) {
        return "see in the tracks whether the radii were far too easy or too hard, and plan the protocol anew";
    }
    match study.people.len() {
        1 => "run the study with more people, ten or more for an interval of use, and fit all their sessions together",
        _ if study.protocol.conditions.texels_px.len() < 2 => {
            "run the study with two or more sizes in conditions.texels_px"
        }
        _ => "see in the tracks what the answers lack, and run more sessions",
    }
}

/// Everyone's answers in a round at the person's own threshold; people without one are not in it.
fn panel(round: Round, study: &Study) -> Panel {
    let protocol: &Protocol = &study.protocol;
    let Assumptions { blind_share, slope, .. } = Assumptions::of_protocol(protocol);
    let of_person = |person: &Person| {
        let here = |track: &&Track| round_of(&track.condition) == round;
        let known = Assumptions::of_person(person, protocol);
        let threshold = joint_threshold(person.tracks.iter().filter(here), &known).ok()?;
        Some((answers_of(round, person, protocol)?, threshold.log10_ratio))
    };
    Panel {
        name: series_name(round, protocol),
        pattern: round.pattern,
        // The curve is drawn about each person's own threshold: it has no median and no spread.
        shared: MixedParameters { log10_ratio: 0.0, between_sd: 0.0, slope, blind_share },
        people: study.people.iter().filter_map(of_person).collect(),
    }
}
