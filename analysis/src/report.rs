//! `report.html`: what the study found, for a reader who was not there. One file without references to
//! others.

mod goodness;
mod method;
mod people;
pub(crate) mod pilot;
mod relation;
mod viewers;

use crate::{
    Error,
    analysis::Analysis,
    assumptions::DETECTION_AT_THRESHOLD,
    fit_figure::fit_figure,
    people::{Person, Study},
    population_figure::population_figure,
    psychometric_figure::psychometric_figure,
    residual_figure::residual_figure,
    staircase_figure::staircase_figure,
    thresholds::ConditionThreshold,
};

/// File name of the report.
pub const REPORT: &str = "report.html";
/// By this a re-run knows its own report.
pub const REPORT_MARK: &str = "<meta name=\"generator\" content=\"scumble-analysis\">";

/// Head and style of the page.
const HEAD: &str = include_str!("report.html");

/// What the study asks.
const QUESTION: &str = "How large must a filter's radius be, in texels of the shadow map, until the texels under a shadow's edge are hidden?";

/// Most people whose tracks are drawn: the page stays one that a browser opens at once.
const DRAWN_MOST: usize = 40;

/// Figures as SVG.
#[derive(Debug, Clone, PartialEq)]
pub struct Figures {
    /// Thresholds and lines.
    pub fit: String,
    /// Psychometric functions.
    pub psychometric: String,
    /// What the relation leaves.
    pub residuals: String,
    /// Viewers and ratios.
    pub population: String,
    /// Tracks, person by person: of the first forty people.
    pub staircases: Vec<(String, String)>,
}

impl Figures {
    /// Draws all of them.
    ///
    /// # Errors
    /// Only the plotting library's own.
    pub fn of(study: &Study, analysis: &Analysis) -> Result<Self, Error> {
        Ok(Self {
            fit: fit_figure(analysis)?,
            psychometric: psychometric_figure(analysis)?,
            residuals: residual_figure(analysis)?,
            population: population_figure(analysis)?,
            staircases: staircases(study, &analysis.thresholds)?,
        })
    }
}

/// Code and tracks of the first people.
pub(crate) fn staircases(study: &Study, thresholds: &[ConditionThreshold]) -> Result<Vec<(String, String)>, Error> {
    let of_person = |person: &Person| {
        let own: Vec<_> = thresholds.iter().filter(|entry| entry.person == person.code).cloned().collect();
        Ok((person.code.clone(), staircase_figure(person, &study.protocol, &own)?))
    };
    study.people.iter().take(DRAWN_MOST).map(of_person).collect()
}

/// The whole page.
pub fn report_html(study: &Study, analysis: &Analysis, figures: &Figures) -> String {
    let worst = analysis.worst();
    let sections = [
        HEAD.to_owned(),
        result(study, analysis),
        method::in_words(study, analysis),
        format!("<h2>Thresholds against texel size</h2>\n{}\n", figures.fit),
        relation::conditions(analysis),
        relation::form(worst),
        figures.residuals.clone(),
        goodness::goodness(analysis),
        relation::effects(analysis),
        viewers::population(analysis),
        figures.population.clone(),
        format!("<h2>Psychometric functions</h2>\n{}\n", figures.psychometric),
        relation::people_of_each(analysis),
        people::people(study, analysis),
        people::detection(study),
        people::tracks(study, &figures.staircases),
        relation::under_priors(analysis),
        method::left_out(study, &analysis.exclusions),
        method::method(study, analysis),
        method::sources(study),
        "</body>\n</html>\n".to_owned(),
    ];
    sections.concat()
}

/// The number, who it is about, and how sure it is.
fn result(study: &Study, analysis: &Analysis) -> String {
    let worst = analysis.worst();
    let [low, high] = worst.ratio_ci95();
    let who = if study.is_simulated() { "simulated people" } else { "people" };
    let truth = study.true_ratio(worst.round).map_or(String::new(), |ratio| {
        format!(" The geometric mean of these people's true thresholds in the worst condition is {ratio:.2} texels.")
    });
    let simulated = simulated(study, &truth);
    format!(
        "<h1>Radius to texel</h1>\n<p>{QUESTION}</p>\n{simulated}<div \
         class=\"result\"><b>{:.2} texels</b>95 % interval {low:.2} to {high:.2}. The median \
         person's threshold in the worst condition, <strong>{}</strong>: {}; {} {who} of {}, \
         {} trials.</div>\n{}",
        worst.ratio(),
        worst.name,
        threshold_in_words(),
        worst.fit.people(),
        study.people.len(),
        study.trial_count(),
        goodness::warning(analysis),
    )
}

/// A notice where the answers are those of simulated observers; nothing elsewhere.
fn simulated(study: &Study, truth: &str) -> String {
    match study.is_simulated() {
        true => format!(
            "<p class=\"notice\">Every answer comes from a <strong>simulated</strong> observer. \
             This page shows that the method works, not what people see.{truth}</p>\n"
        ),
        false => String::new(),
    }
}

/// What the threshold stands for, in terms of any task.
fn threshold_in_words() -> String {
    format!(
        "the artifact is seen on {:.0} % of the trials, as at 82 % correct with two alternatives",
        100.0 * DETECTION_AT_THRESHOLD,
    )
}

fn none() -> String {
    "none".to_owned()
}

/// A p value as a reader wants it.
fn p_in_words(p: f64) -> String {
    if p < 0.001 { "&lt; 0.001".to_owned() } else { format!("{p:.3}") }
}

/// Text as HTML.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
