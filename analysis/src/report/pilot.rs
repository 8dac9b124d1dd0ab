//! The page of a pilot: that there is no relation and why, and what the answers carry all the same.

use std::fmt::Write;

use super::{HEAD, QUESTION, escaped, method, people, simulated, threshold_in_words};
use crate::{
    people::Study,
    series::{round_of, series_name},
    threshold_intervals::{Ends, ThresholdIntervals},
    thresholds::ConditionThreshold,
};

/// What the page shows.
pub(crate) struct Page<'a> {
    /// Why there is no relation.
    pub reason: &'a str,
    /// What to do next.
    pub next: &'a str,
    /// One a person and condition.
    pub thresholds: &'a [ConditionThreshold],
    /// 95 % intervals of each.
    pub intervals: &'a [ThresholdIntervals],
    /// A sentence for each that is missing.
    pub left_out: &'a [String],
    /// Figure of psychometric functions.
    pub psychometric: &'a str,
    /// Code and tracks, person by person.
    pub staircases: &'a [(String, String)],
}

impl Page<'_> {
    /// The whole page.
    pub fn html(&self, study: &Study) -> String {
        let sections = [
            HEAD.to_owned(),
            self.result(study),
            self.table(study),
            format!("<h2>Psychometric functions</h2>\n{}\n", self.psychometric),
            people::detection(study),
            people::tracks(study, self.staircases),
            method::left_out(study, self.left_out),
            method::sources(study),
            "</body>\n</html>\n".to_owned(),
        ];
        sections.concat()
    }

    fn result(&self, study: &Study) -> String {
        let people = match study.people.len() {
            1 => "1 person".to_owned(),
            count => format!("{count} people"),
        };
        let measured = self.thresholds.iter().filter(|entry| entry.threshold.is_ok()).count();
        format!(
            "<h1>Radius to texel: a pilot</h1>\n<p>{QUESTION}</p>\n{}<div class=\"result\"><b>No relation</b>{}.<br>Next: {}.</div>\n\
             <p>This page has what the answers do carry: {people}, {} trials, a threshold in {measured} of {} conditions. It \
             is a check of the set-up, and no number for a renderer; no relation.json was written.</p>\n",
            simulated(study, ""),
            escaped(self.reason),
            escaped(self.next),
            study.trial_count(),
            self.thresholds.len(),
        )
    }

    fn table(&self, study: &Study) -> String {
        let mut rows = String::new();
        for (entry, intervals) in self.thresholds.iter().zip(self.intervals) {
            let cells = match &entry.threshold {
                Ok(threshold) => format!(
                    "<td>{:.2}</td><td>{}</td><td>{:.1}</td>",
                    threshold.ratio(),
                    interval_in_words(&intervals.profile),
                    threshold.ratio() * entry.condition.texel_px,
                ),
                Err(_) => "<td>none</td><td></td><td></td>".to_owned(),
            };
            _ = writeln!(
                rows,
                "<tr><td>{}</td><td>{}</td><td>{}</td><td>{} of {}</td><td>{} of {}</td>{cells}</tr>",
                escaped(&entry.person),
                series_name(round_of(&entry.condition), &study.protocol),
                entry.condition.texel_px,
                entry.correct,
                entry.trials,
                entry.converged,
                entry.staircases,
            );
        }
        format!(
            "<h2>Thresholds</h2>\n<div class=\"wide\"><table>\n<tr><th>person</th><th>condition</th><th>texel, px</th><th>right \
             answers</th><th>converged</th><th>ratio, texels</th><th>95 % CI</th><th>radius, px</th></tr>\n{rows}</table></div>\n<p \
             class=\"note\">At the threshold {}. Each is fitted alone, with the slope and lapses that the protocol \
             assumes; intervals by profile likelihood; those by bootstrap are in thresholds.csv.</p>\n",
            threshold_in_words(),
        )
    }
}

/// Ends of an interval as ratios; an end that the answers leave open is said to be.
fn interval_in_words(ends: &Ends) -> String {
    let [low, high] = ends.map(|end| end.map_or("open".to_owned(), |log10| format!("{:.2}", 10_f64.powf(log10))));
    format!("{low} to {high}")
}
