//! Everything that the command `fit` writes, from one study.

use std::path::Path;

use scumble_core::Relation;
use scumble_psychophysics::HEADER_FILE;

use crate::{
    Error,
    analysis::Analysis,
    figure::FIGURE_MARK,
    fit_figure::FIT_FIGURE,
    outputs::{Output, write_outputs},
    people::Study,
    pilot::write_pilot,
    population_figure::POPULATION_FIGURE,
    psychometric_figure::PSYCHOMETRIC_FIGURE,
    report::{Figures, REPORT, REPORT_MARK, report_html},
    residual_figure::RESIDUAL_FIGURE,
    staircase_figure::STAIRCASE_FIGURE,
    study_tables::{THRESHOLDS_MARK, THRESHOLDS_TABLE, thresholds_csv},
    threshold_intervals::threshold_intervals,
    trial_table::{TRIALS_COLUMNS, TRIALS_COLUMNS_MARK, TRIALS_MARK, TRIALS_TABLE, trials_columns, trials_csv},
};

/// File name of the relation.
pub const RELATION: &str = "relation.json";

/// Analyses a study and writes relation, report, tables and figures into `folder`; earlier outputs
/// are replaced, other files are not.
///
/// # Errors
/// [`Error::Pilot`] of data that carry no relation, after what they do carry was written; a file in the way; a
/// relation that a renderer would refuse to read.
pub fn fit_study(study: &Study, folder: &Path) -> Result<Analysis, Error> {
    if folder.join(HEADER_FILE).exists() {
        let reason = "is a session; allowed is a folder for results".to_owned();
        return Err(Error::File { path: folder.to_path_buf(), reason });
    }
    let analysis = match Analysis::of(study) {
        Err(Error::CannotFit(reason)) => return Err(write_pilot(study, reason, folder)?),
        other => other?,
    };
    let relation = analysis.relation_file(study)?.to_json()? + "\n";
    let fitted =
        |round| analysis.series.iter().find(|series| series.round == round).map(|series| series.fit.parameters());
    let intervals = threshold_intervals(study, fitted)?;
    let figures = Figures::of(study, &analysis)?;
    let report = report_html(study, &analysis, &figures);
    let Some((_, staircases)) = figures.staircases.into_iter().next() else {
        return Err(Error::CannotFit("the study has no person".to_owned()));
    };
    let output = |name, content, mark| Output { name, content, mark };
    write_outputs(
        folder,
        &[
            output(RELATION, relation, scumble_core::SCHEMA),
            output(REPORT, report, REPORT_MARK),
            output(TRIALS_TABLE, trials_csv(study)?, TRIALS_MARK),
            output(TRIALS_COLUMNS, trials_columns()?, TRIALS_COLUMNS_MARK),
            output(THRESHOLDS_TABLE, thresholds_csv(&analysis.thresholds, &intervals)?, THRESHOLDS_MARK),
            output(FIT_FIGURE, figures.fit, FIGURE_MARK),
            output(PSYCHOMETRIC_FIGURE, figures.psychometric, FIGURE_MARK),
            output(RESIDUAL_FIGURE, figures.residuals, FIGURE_MARK),
            output(POPULATION_FIGURE, figures.population, FIGURE_MARK),
            output(STAIRCASE_FIGURE, staircases, FIGURE_MARK),
        ],
    )?;

    // What is on disk is what a renderer reads.
    let path = folder.join(RELATION);
    let written = std::fs::read_to_string(&path).map_err(Error::io(&path))?;
    Relation::from_json(&written)?;
    Ok(analysis)
}
