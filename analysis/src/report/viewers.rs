//! The ratio for shares of viewers.

use std::fmt::Write;

use crate::{
    analysis::Analysis,
    mixed_model::{Profiled, SLOPE_PRIOR_SD_LN},
    population::{DETECTIONS, VIEWERS},
};

pub(super) fn population(analysis: &Analysis) -> String {
    let population = &analysis.population;
    let mut rows = String::new();
    for viewers in VIEWERS {
        _ = write!(rows, "<tr><td>{:.0} % of viewers</td>", viewers * 100.0);
        for point in DETECTIONS.iter().filter_map(|&detection| population.point(viewers, detection)) {
            let [low, high] = point.ci95;
            _ = write!(rows, "<td>{:.1}</td><td>{low:.1} to {high:.1}</td>", point.ratio);
        }
        rows += "</tr>\n";
    }
    let header: String =
        DETECTIONS.map(|d| format!("<th>texels, seen on at most {:.0} %</th><th>95 % CI</th>", d * 100.0)).concat();
    let between = interval_of_log10(&population.log10_between_sd, "0");
    let slope = interval_of_log10(&population.log10_slope, "open");
    let prior = SLOPE_PRIOR_SD_LN.exp();
    format!(
        "<h2>Hidden from whom?</h2>\n<p>The ratio that hides the texels from a share of the viewers, \
         when they look as hard as in the study. Standard deviation between people without \
         measurement noise: {between} log10. Slope of the psychometric function: {slope} per decade.</p>\n<div \
         class=\"wide\"><table>\n<tr><th></th>{header}</tr>\n{rows}</table></div>\n<p \
         class=\"note\">Assumes log-normal thresholds; shares beyond 95 % lean on the normal distribution, not on data. The \
         slope is estimated, with the protocol's as a weak prior (a factor of {prior:.0} is one standard deviation): \
         staircases hardly measure it, and rare detection leans on it.</p>\n"
    )
}

/// A quantity that was estimated as a logarithm, with its interval; `lowest` stands for a lower end that is not there.
fn interval_of_log10(profiled: &Profiled, lowest: &str) -> String {
    let end = |end: Option<f64>, none: &str| end.map_or(none.to_owned(), |log10| format!("{:.3}", 10_f64.powf(log10)));
    let [low, high] = profiled.ends;
    format!("{:.3} (95 % {} to {})", 10_f64.powf(profiled.value), end(low, lowest), end(high, "open"))
}
