//! Whether the model fits, and where to look if it does not.

use std::fmt::Write;

use super::p_in_words;
use crate::{
    analysis::Analysis,
    goodness_of_fit::{Band, GoodnessOfFit},
    series::Series,
};

/// Largest p of a fit that is called doubtful: the level of the report's intervals.
const DOUBTFUL: f64 = 0.05;

/// Standard deviations from the expected number from which a band is called off.
const OFF_SDS: f64 = 2.0;

/// Most people who are named.
const NAMED_MOST: usize = 3;

/// A sentence for the first screen where the model fits the renderer's number badly; nothing elsewhere.
pub(super) fn warning(analysis: &Analysis) -> String {
    let Some(fit) = analysis.goodness.get(analysis.worst).filter(|fit| is_bad(fit)) else {
        return String::new();
    };
    format!(
        "<p class=\"notice\">The model fits these answers badly (p {}): read <a href=\"#fit\">Does the model fit?</a> \
         before you use the number.</p>\n",
        p_with_sign(smaller_p(fit))
    )
}

/// Whether the smaller of a condition's two p is doubtful though it is the smaller of two (Bonferroni), or is as small as
/// so few cohorts can show.
fn is_bad(fit: &GoodnessOfFit) -> bool {
    let least = 1.0 / (1.0 + f64::from(fit.cohorts));
    smaller_p(fit) <= (DOUBTFUL / 2.0).max(least)
}

fn smaller_p(fit: &GoodnessOfFit) -> f64 {
    fit.p_value.min(fit.drift_p_value)
}

pub(super) fn goodness(analysis: &Analysis) -> String {
    let tested = || analysis.series.iter().zip(&analysis.goodness);
    let mut rows = String::new();
    for (series, fit) in tested() {
        let bands: String =
            fit.bands.iter().map(|band| format!("<td>{:.0} ({:.0})</td>", band.right, band.expected)).collect();
        _ = writeln!(
            rows,
            "<tr><td>{}</td><td>{:.1}</td><td>{:.1}</td><td>{}</td>{bands}<td>{:+.1}</td><td>{}</td></tr>",
            series.name,
            fit.chi_square,
            fit.expected,
            p_in_words(fit.p_value),
            fit.drift,
            p_in_words(fit.drift_p_value),
        );
    }
    let doubtful: Vec<String> =
        tested().flat_map(|(series, fit)| [scatter(series, fit), drift(series, fit)]).flatten().collect();
    let verdict = match doubtful.len() {
        0 => "<p>No condition speaks against the model. With few answers only a large misfit would.</p>\n".to_owned(),
        _ => format!(
            "<ul>\n{}</ul>\n<p>Of {} tests, each is at {DOUBTFUL} or below once in twenty studies though the model is \
             right.</p>\n",
            doubtful.concat(),
            2 * analysis.series.len()
        ),
    };
    let cohorts = analysis.goodness.first().map_or(0, |fit| fit.cohorts);
    format!(
        "<h2 id=\"fit\">Does the model fit?</h2>\n{verdict}<div class=\"wide\"><table>\n<tr><th>condition</th><th>X&sup2;</th><th>expected \
         X&sup2;</th><th>p</th><th>hidden: right (expected)</th><th>near the threshold</th><th>plain</th>\
         <th>drift, SD</th><th>p</th></tr>\n{rows}</table></div>\n<p \
         class=\"note\">Right answers of each person to artifacts that the model has detected on less than 50 %, on 50 to \
         80 % and on more of the trials, against what such cohorts give. Drift: late halves of the staircases against early ones, above 0 where people get better. p: share of {cohorts} simulated \
         cohorts that obey the model and fit as badly, their staircases run anew, their thresholds and parameters estimated anew. A slope or share of blind trials other than the \
         protocol's is no misfit, because both are estimated; people who differ in them are.</p>\n"
    )
}

fn is_doubtful(p: f64) -> bool {
    p <= DOUBTFUL
}

fn p_with_sign(p: f64) -> String {
    if p < 0.001 { p_in_words(p) } else { format!("= {}", p_in_words(p)) }
}

/// What a reader should look at where people get better or worse; `None` where they do not.
fn drift(series: &Series, fit: &GoodnessOfFit) -> Option<String> {
    let kind = match fit.drift > 0.0 {
        true => "late answers are right more often than early ones: people learned, so give them more practice",
        false => "late answers are wrong more often than early ones: people tired, so plan pauses or fewer trials",
    };
    is_doubtful(fit.drift_p_value).then(|| {
        format!(
            "<li><strong>{}</strong>, time (p {}): {kind}. The ratio is an average over the session.</li>\n",
            series.name,
            p_with_sign(fit.drift_p_value)
        )
    })
}

/// What a reader should look at where people scatter; `None` where they do not.
fn scatter(series: &Series, fit: &GoodnessOfFit) -> Option<String> {
    if !is_doubtful(fit.p_value) {
        return None;
    }
    let mut parts: Vec<&(String, f64)> = fit.parts.iter().collect();
    parts.sort_by(|a, b| b.1.total_cmp(&a.1));
    let named: Vec<String> = parts
        .iter()
        .take(NAMED_MOST)
        .map(|(code, part)| format!("{} ({:.0} %)", super::escaped(code), 100.0 * part / fit.chi_square))
        .collect();
    let [hidden, near, plain] = fit.bands.map(|band| sds(&band));
    let kind = if plain < -OFF_SDS {
        "plain artifacts were missed more often than its share of blind trials explains: lapses of some people, or keys \
         mixed up. The ratios for rare detection are doubtful"
    } else if hidden > OFF_SDS {
        "hidden artifacts were told more often than guessing explains: the pictures may differ in more than the artifact, or the \
         guess rate is higher"
    } else if hidden < -OFF_SDS {
        "hidden artifacts were told less often than guessing explains: a lower guess rate, or a preference for one answer"
    } else if near.abs() > OFF_SDS {
        "the answers near the threshold are off over all people: the psychometric function has another form"
    } else {
        "no band is off over all people: they differ in slope or lapses, which the model has them share. The median person's \
         ratio hardly notices; the ratios for shares of viewers do"
    };
    Some(format!(
        "<li><strong>{}</strong>, people (p {}): the answers scatter more than the model's; {kind}. Largest parts of X&sup2;: {}. Look at \
         their tracks below.</li>\n",
        series.name,
        p_with_sign(fit.p_value),
        named.join(", ")
    ))
}

/// How far a band is from what is expected, in its standard deviations.
fn sds(band: &Band) -> f64 {
    (band.right - band.expected) / band.variance.max(f64::MIN_POSITIVE).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_of_two_tests_just_below_a_twentieth_does_not_spoil_the_first_screen() {
        let band = Band { answers: 2.0, right: 1.0, expected: 1.0, variance: 1.0 };
        let with = |p_value, cohorts| GoodnessOfFit {
            chi_square: 1.0,
            expected: 1.0,
            p_value,
            drift: 0.0,
            drift_p_value: 0.5,
            cohorts,
            bands: [band; 3],
            parts: Vec::new(),
        };
        assert!(!is_bad(&with(0.035, 199)));
        assert!(is_bad(&with(0.025, 199)));
        assert!(is_bad(&with(0.05, 19)), "no smaller p can be shown");
    }
}
