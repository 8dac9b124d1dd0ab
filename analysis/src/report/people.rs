//! What each person did.

use std::fmt::Write;

use scumble_psychophysics::YesNoCounts;

use super::escaped;
use crate::{
    analysis::Analysis,
    checks::Checks,
    people::{Study, Track},
    threshold_intervals::RESAMPLED_MOST,
};

pub(super) fn people(study: &Study, analysis: &Analysis) -> String {
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
    let bootstrap = match study.people.len() > RESAMPLED_MOST {
        true => format!("those by bootstrap are left out for more than {RESAMPLED_MOST} people"),
        false => "and by bootstrap".to_owned(),
    };
    format!(
        "<h2>People</h2>\n<div class=\"wide\"><table>\n<tr><th>person</th><th>trials</th>\
         <th>converged</th>{header}</tr>\n{rows}</table></div>\n<p class=\"note\">Ratio at \
         threshold with the factor of one standard error. 95 % intervals of each threshold by profile likelihood are in thresholds.csv, {bootstrap}.</p>\n"
    )
}

/// What lines alone and catch trials say of each person; nothing where the protocol has neither.
pub(super) fn detection(study: &Study) -> String {
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

/// Everyone's staircases, the first person's open.
pub(super) fn tracks(study: &Study, figures: &[(String, String)]) -> String {
    let mut page = "<h2>Tracks</h2>\n".to_owned();
    for (index, (code, figure)) in figures.iter().enumerate() {
        let open = if index == 0 { " open" } else { "" };
        _ = write!(page, "<details{open}><summary>{}</summary>\n{figure}\n</details>\n", escaped(code));
    }
    let others = study.people.len() - figures.len();
    if others > 0 {
        _ = writeln!(page, "<p class=\"note\">The tracks of {others} more people are in trials.csv.</p>");
    }
    page
}
