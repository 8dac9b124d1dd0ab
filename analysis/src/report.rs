//! `report.html`: what the study found, for a reader who was not there. One file without references to
//! others.

use std::fmt::Write;

use scumble_psychophysics::{Task, YesNoCounts};

use crate::{
    Error,
    analysis::{Analysis, SOFTWARE},
    assumptions::{Assumptions, DETECTION_AT_THRESHOLD},
    checks::Checks,
    estimate::MeanOverPeople,
    mixed_model::{MixedParameters, Profiled, SLOPE_PRIOR_SD_LN},
    people::{Study, Track},
    population::{DETECTIONS, VIEWERS},
    series::Series,
};

/// File name of the report.
pub const REPORT: &str = "report.html";
/// By this a re-run knows its own report.
pub const REPORT_MARK: &str = "<meta name=\"generator\" content=\"scumble-analysis\">";

/// Head and style of the page.
const HEAD: &str = include_str!("report.html");

/// The whole page. `fit` and `staircases` are figures as SVG.
///
/// # Errors
/// Those of the population curve.
pub fn report_html(study: &Study, analysis: &Analysis, fit: &str, staircases: &str) -> Result<String, Error> {
    let mut page = HEAD.to_owned();
    page += &result(study, analysis);
    page += &format!("<h2>Thresholds and the two lines</h2>\n{fit}\n");
    page += &conditions(analysis);
    page += &form(analysis.worst());
    page += &population(analysis);
    page += &people(analysis);
    page += &detection(study);
    page += &format!("<h2>One person's tracks</h2>\n{staircases}\n");
    page += &left_out(study, analysis);
    page += &method(study, analysis);
    page += &sources(study);
    page += "</body>\n</html>\n";
    Ok(page)
}

/// The number, who it is about, and how sure it is.
fn result(study: &Study, analysis: &Analysis) -> String {
    let worst = analysis.worst();
    let [low, high] = worst.ratio_ci95();
    let who = if study.is_simulated() { "simulated people" } else { "people" };
    let simulated = match study.is_simulated() {
        true => {
            "<p class=\"notice\">Every answer comes from a <strong>simulated</strong> observer. \
                 This page shows that the method works, not what people see.</p>\n"
        }
        false => "",
    };
    format!(
        "<h1>Radius to texel</h1>\n<p>How large must a filter's radius be, in texels of the shadow \
         map, until the texels under a shadow's edge are hidden?</p>\n{simulated}<div \
         class=\"result\"><b>{:.2} texels</b>95 % interval {low:.2} to {high:.2}. The median \
         person's threshold in the worst condition, <strong>{}</strong>: {}; {} {who} of {}, \
         {} trials.</div>\n",
        worst.ratio(),
        worst.name,
        threshold_in_words(),
        worst.fit.people(),
        study.people.len(),
        study.trial_count(),
    )
}

/// What the threshold stands for, in terms of any task.
fn threshold_in_words() -> String {
    format!(
        "the artifact is seen on {:.0} % of the trials, as at 82 % correct with two alternatives",
        100.0 * DETECTION_AT_THRESHOLD,
    )
}

fn conditions(analysis: &Analysis) -> String {
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
        let MixedParameters { between_sd, slope, .. } = series.fit.parameters();
        _ = writeln!(
            rows,
            "<tr{class}><td>{}</td><td>{}</td><td>{:.2}</td><td>{low:.2} to {high:.2}</td><td>{log_mean}</td>\
             <td>{log_mean_ends}</td><td>{line}</td><td>{line_ends}</td><td>{between_sd:.3}</td><td>{slope:.1}</td></tr>",
            series.name,
            series.fit.people(),
            series.ratio(),
        );
    }
    format!(
        "<div class=\"wide\"><table>\n<tr><th>condition</th><th>people</th><th>ratio</th><th>95 %</th>\
         <th>mean of logarithms</th><th>95 %</th><th>line through 0</th><th>95 %</th><th>SD of people, log10</th>\
         <th>slope per decade</th></tr>\n{rows}</table></div>\n<p class=\"note\">The ratio is the median person's in a \
         mixed model of every answer; ratio, spread and slope are estimated together. Mean of logarithms: over \
         thresholds fitted to one person at a time. Line: the published estimator (Kreuzer 2017, Eq. 5.1), through \
         the origin of the mean radii; its target is the mean person, and it inherits the bias of thresholds from few \
         trials, so it lies higher. The worst condition is chosen after seeing the data, which overstates it slightly \
         when two conditions are close.</p>\n"
    )
}

fn none() -> String {
    "none".to_owned()
}

fn form(worst: &Series) -> String {
    let row = |name: &str, mean: Option<MeanOverPeople>, null: f64, unit: &str| match mean {
        None => format!("<tr><td>{name}</td><td colspan=\"3\">needs two people with two sizes</td></tr>\n"),
        Some(mean) => format!(
            "<tr><td>{name}</td><td>{:.3}{unit}</td><td>{:.3} to {:.3}</td><td>{:.2}</td></tr>\n",
            mean.mean,
            mean.ci95[0],
            mean.ci95[1],
            mean.p_value(null)
        ),
    };
    format!(
        "<h2>Is it a line through the origin?</h2>\n<p>For {}. A small p speaks against the \
         relation <i>r = c a</i>; a large one does not prove it.</p>\n<table>\n<tr><th>quantity</th>\
         <th>estimate</th><th>95 %</th><th>p</th></tr>\n{}{}</table>\n",
        worst.name,
        row("exponent g of r = c a<sup>g</sup>, against 1", worst.exponent, 1.0, ""),
        row("intercept b of r = c a + b, against 0", worst.intercept_px, 0.0, " px"),
    )
}

fn population(analysis: &Analysis) -> String {
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
        DETECTIONS.map(|d| format!("<th>seen on at most {:.0} %</th><th>95 %</th>", d * 100.0)).concat();
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

fn people(analysis: &Analysis) -> String {
    let mut codes: Vec<&str> = analysis.thresholds.iter().map(|t| t.person.as_str()).collect();
    codes.dedup();
    let header: String = analysis.series.iter().map(|series| format!("<th>{}</th>", series.name)).collect();
    let mut rows = String::new();
    for code in codes {
        let own = analysis.thresholds.iter().filter(|entry| entry.person == code);
        let (trials, converged, all) = own.fold((0, 0, 0), |(trials, converged, all), entry| {
            (trials + entry.trials, converged + entry.converged, all + entry.staircases)
        });
        _ = write!(rows, "<tr><td>{code}</td><td>{trials}</td><td>{converged} of {all}</td>");
        for series in &analysis.series {
            let ratio = series.people.iter().find(|person| person.person == code);
            let cell = ratio.map_or("none".to_owned(), |person| {
                let error = person.measurement_variance.sqrt();
                let factor = 10_f64.powf(error);
                format!("{:.2} &times;/ {factor:.2}", 10_f64.powf(person.log10_ratio))
            });
            _ = write!(rows, "<td>{cell}</td>");
        }
        rows += "</tr>\n";
    }
    format!(
        "<h2>People</h2>\n<div class=\"wide\"><table>\n<tr><th>person</th><th>trials</th>\
         <th>converged</th>{header}</tr>\n{rows}</table></div>\n<p class=\"note\">Ratio at \
         threshold with the factor of one standard error.</p>\n"
    )
}

/// What lines alone and catch trials say of each person; nothing where the protocol has neither.
fn detection(study: &Study) -> String {
    let total = study.people.iter().fold(Checks::default(), |sum, person| sum + person.checks);
    if total.lines == 0 && total.catches == 0 {
        return String::new();
    }
    let share = |count: u32, of: u32| match of {
        0 => "none shown".to_owned(),
        _ => format!("{count} of {of} ({:.0} %)", 100.0 * f64::from(count) / f64::from(of)),
    };
    let mut rows = String::new();
    for person in &study.people {
        let Checks { lines, false_alarms, catches, catches_seen } = person.checks;
        let answers = || person.tracks.iter().flat_map(Track::responses);
        let artifacts = answers().count() as u32;
        let hits = answers().filter(|(_, correct)| *correct).count() as u32;
        let counts = YesNoCounts { artifacts, hits, lines, false_alarms };
        let (d_prime, criterion) = counts.statistics().map_or(("none".to_owned(), "none".to_owned()), |found| {
            let with_error = |value: f64, error: f64| format!("{value:.2} &plusmn; {error:.2}");
            (
                with_error(found.d_prime, found.d_prime_standard_error),
                with_error(found.criterion, found.criterion_standard_error),
            )
        });
        _ = writeln!(
            rows,
            "<tr><td>{}</td><td>{}</td><td>{}</td><td>{d_prime}</td><td>{criterion}</td><td>{}</td></tr>",
            person.code,
            share(hits, artifacts),
            share(false_alarms, lines),
            share(catches_seen, catches),
        );
    }
    format!(
        "<h2>Lines and artifacts told apart</h2>\n<div class=\"wide\"><table>\n<tr><th>person</th>\
         <th>hits: artifacts told</th><th>false alarms: lines called artifacts</th><th>d'</th><th>criterion</th>\
         <th>catch trials right</th></tr>\n{rows}</table></div>\n<p class=\"note\">d' and criterion with one \
         standard error, rates corrected by one half (log-linear). They are those of the radii that the \
         staircases chose and are no threshold; a criterion above 0 leans towards \"a line\". Who misses catch \
         trials, which everyone sees, did not attend: nobody is left out for it here.</p>\n"
    )
}

fn left_out(study: &Study, analysis: &Analysis) -> String {
    let sentences: Vec<&String> = study.notices.iter().chain(&analysis.exclusions).collect();
    if sentences.is_empty() {
        return "<h2>Left out</h2>\n<p>Nothing: every condition of every person has a \
                threshold.</p>\n"
            .to_owned();
    }
    let items: String = sentences.iter().map(|sentence| format!("<li>{}</li>\n", escaped(sentence))).collect();
    format!(
        "<h2>Left out</h2>\n<ul>\n{items}</ul>\n<p class=\"note\">A condition without a threshold \
         of its own still adds its answers to the person's ratio.</p>\n"
    )
}

fn method(study: &Study, analysis: &Analysis) -> String {
    let protocol = &study.protocol;
    let known = Assumptions::of_protocol(protocol);
    let counted = study.people.iter().filter(|person| person.checks.lines > 0).count();
    let guess = match counted {
        0 => format!("guess {}", known.guess),
        _ => format!(
            "guess rate of each person from the lines called artifacts, (false alarms + 1/2) / (lines + 1) \
             ({counted} of {} people; {} for the others)",
            study.people.len(),
            known.guess
        ),
    };
    let single_pictures = match protocol.task {
        Task::TwoAlternative => "",
        Task::YesNo => {
            "\n<li>Guesses are taken out as if an artifact were either seen or not (high threshold). Of people with \
             noisy traces and a strict criterion (signal detection, 10 % false alarms) the ratio then comes out 8 % \
             low, and 16 % low where a guess rate of one half is assumed; with two alternatives neither is.</li>"
        }
    };
    let (converged, staircases) = analysis
        .thresholds
        .iter()
        .fold((0, 0), |(converged, staircases), entry| (converged + entry.converged, staircases + entry.staircases));
    format!(
        "<h2>Method</h2>\n<ul>\n<li>Protocol <i>{}</i>: {guess}, lapses {}, slope {} per decade. \
         Threshold: {}. {converged} of {staircases} staircases converged by the experiment's rule; the \
         others enter too, because leaving them out would select answers.</li>\n<li>Per person and \
         condition: maximum-likelihood Weibull function, its location alone free. A threshold that the \
         answers do not bound on both sides (95 % likelihood ratio) is refused.</li>\n<li>Per \
         pattern, contrast and kernel: one mixed model of all answers at all texel sizes, thresholds log-normal over \
         people, Weibull function with a shared slope and share of blind trials; intervals are profile likelihoods, cut where \
         Student's t with people - 1 degrees of freedom is.</li>\n<li>Lines alone, catch trials and practice are \
         in no threshold.</li>{single_pictures}\n<li>Intervals do not cover a wrong slope, learning, or viewers unlike \
         these.</li>\n</ul>\n",
        escaped(&protocol.name),
        known.blind_share,
        known.slope,
        threshold_in_words(),
    )
}

fn sources(study: &Study) -> String {
    let rows: String = study
        .session_hashes()
        .iter()
        .map(|hash| format!("<tr><td>{}</td><td><code>{}</code></td></tr>\n", escaped(&hash.session), hash.sha256))
        .collect();
    format!(
        "<h2>Sessions</h2>\n<details><summary>{} sessions with their SHA-256</summary>\n<div \
         class=\"wide\"><table>\n{rows}</table></div></details>\n<p><small>Written by \
         {SOFTWARE}.</small></p>\n",
        study.sessions.len()
    )
}

/// Text as HTML.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
