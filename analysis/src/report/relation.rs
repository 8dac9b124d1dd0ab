//! Tables of the relation: ratios a condition, its form, what moves it.

use std::fmt::Write;

use super::{none, p_in_words};
use crate::{analysis::Analysis, estimate::MeanOverPeople, mixed_model::MixedParameters, series::Series};

pub(super) fn conditions(analysis: &Analysis) -> String {
    let mut rows = String::new();
    for (index, series) in analysis.series.iter().enumerate() {
        let class = if index == analysis.worst { " class=\"worst\"" } else { "" };
        let [low, high] = series.ratio_ci95();
        let interval = |ends: [f64; 2]| format!("{:.2} to {:.2}", ends[0], ends[1]);
        let (log_mean, log_mean_ends) = series.log_mean.map_or((none(), none()), |mean| {
            (format!("{:.2}", 10_f64.powf(mean.mean)), interval(mean.ci95.map(|limit| 10_f64.powf(limit))))
        });
        let (line, line_ends) = series.origin_line.map_or((none(), none()), |line| {
            let ends = line.over_people.map_or("a person lacks a size".to_owned(), |mean| interval(mean.ci95));
            (format!("{:.2}", line.slope), ends)
        });
        _ = writeln!(
            rows,
            "<tr{class}><td>{}</td><td>{}</td><td>{:.2}</td><td>{low:.2} to {high:.2}</td><td>{log_mean}</td>\
             <td>{log_mean_ends}</td><td>{line}</td><td>{line_ends}</td></tr>",
            series.name,
            series.fit.people(),
            series.ratio(),
        );
    }
    format!(
        "<div class=\"wide\"><table>\n<tr><th>condition</th><th>people</th><th>ratio, texels</th><th>95 % CI</th>\
         <th>mean of logarithms</th><th>95 % CI</th><th>line through 0</th><th>95 % CI</th></tr>\n{rows}</table></div>\n<p \
         class=\"note\">Cite the ratio: it is the median person's in a mixed model of every answer; ratio, spread and slope are estimated together. Mean of logarithms: over \
         thresholds fitted to one person at a time. Line: the published estimator (Kreuzer 2017, Eq. 5.1), through \
         the origin of the mean radii; its target is the mean person, and it inherits the bias of thresholds from few \
         trials, so it lies higher. The worst condition is chosen after seeing the data, which overstates it slightly \
         when two conditions are close.</p>\n"
    )
}

pub(super) fn form(worst: &Series) -> String {
    let row = |name: &str, mean: Option<MeanOverPeople>, null: f64, unit: &str| match mean {
        None => format!("<tr><td>{name}</td><td colspan=\"3\">needs two people with two sizes</td></tr>\n"),
        Some(mean) => format!(
            "<tr><td>{name}</td><td>{:.3}{unit}</td><td>{:.3} to {:.3}</td><td>{}</td></tr>\n",
            mean.mean,
            mean.ci95[0],
            mean.ci95[1],
            p_in_words(mean.p_value(null))
        ),
    };
    format!(
        "<h2>Is it a line through the origin?</h2>\n<p>For {}. A small p speaks against the \
         relation <i>r = c a</i>; a large one does not prove it.</p>\n<table>\n<tr><th>quantity</th>\
         <th>estimate</th><th>95 % CI</th><th>p</th></tr>\n{}{}</table>\n",
        worst.name,
        row("exponent g of r = c a<sup>g</sup>, against 1", worst.exponent, 1.0, ""),
        row("intercept b of r = c a + b, against 0", worst.intercept_px, 0.0, " px"),
    )
}

/// Spread, slope and blind trials of every series.
pub(super) fn people_of_each(analysis: &Analysis) -> String {
    let mut rows = String::new();
    for series in &analysis.series {
        let MixedParameters { between_sd, slope, blind_share, .. } = series.fit.parameters();
        let blind = 100.0 * blind_share;
        _ = writeln!(
            rows,
            "<tr><td>{}</td><td>{between_sd:.3}</td><td>{slope:.1}</td><td>{blind:.1} %</td></tr>",
            series.name
        );
    }
    format!(
        "<table>\n<tr><th>condition</th><th>SD between people, log10</th><th>slope per decade</th><th>blind \
         trials (lapses)</th></tr>\n{rows}</table>\n<p class=\"note\">A dot's threshold is its person's own, drawn to the median \
         where the person's answers say little. Dots right of 1 scatter: guesses are taken out there from answers that \
         are mostly guesses.</p>\n"
    )
}

/// What pattern, contrast and round do.
pub(super) fn effects(analysis: &Analysis) -> String {
    if analysis.effects.is_empty() {
        return String::new();
    }
    let mut rows = String::new();
    for effect in &analysis.effects {
        let [low, high] = effect.factor_ci95();
        _ = writeln!(
            rows,
            "<tr><td>{}</td><td>{:.3}</td><td>{low:.3} to {high:.3}</td><td>{}</td><td>{}</td></tr>",
            effect.name,
            effect.factor(),
            p_in_words(effect.p_value()),
            effect.log10_factor.people,
        );
    }
    format!(
        "<h2>What moves the ratio</h2>\n<table>\n<tr><th>effect</th><th>factor on the ratio</th><th>95 % CI</th><th>p</th>\
         <th>people</th></tr>\n{rows}</table>\n<p class=\"note\">Within people, from their own ratios in every condition; over \
         people by Student's t. p is not corrected for the number of effects.</p>\n"
    )
}

/// The staircases' own estimates.
pub(super) fn under_priors(analysis: &Analysis) -> String {
    let Some(own) = analysis.under_priors.first() else { return String::new() };
    let mut rows = String::new();
    for prior in &analysis.under_priors {
        let name = match (prior.centre_factor, prior.sd_factor) {
            (1.0, 1.0) => "as it was".to_owned(),
            (factor, 1.0) => format!("centre times {factor}"),
            (_, factor) => format!("standard deviation times {factor}"),
        };
        let change = 100.0 * (prior.ratio / own.ratio - 1.0);
        _ = writeln!(rows, "<tr><td>{name}</td><td>{:.2}</td><td>{change:+.1} %</td></tr>", prior.ratio);
    }
    format!(
        "<h2>The staircases' own estimates</h2>\n<table>\n<tr><th>prior</th><th>ratio</th><th>change</th></tr>\n{rows}\
         </table>\n<p class=\"note\">For {}: means of the staircases' posteriors, from the recorded answers under other priors \
         than the one that chose the radii. What moves with the prior was not measured; the fit above has no prior of the \
         threshold.</p>\n",
        analysis.worst().name,
    )
}
