//! The forecast as text for a terminal.

use std::fmt::Write;

use crate::plan::{Accuracy, IntervalForecast, Plan};

impl Plan {
    /// Tables and sentences, each line with its line break.
    pub fn text(&self) -> String {
        let mut text = String::new();
        _ = writeln!(
            text,
            "{}: {} simulated sessions, {:.0} trials a person (5 to 95 %: {:.0} to {:.0}), practice included",
            self.protocol, self.sessions, self.trials.mean, self.trials.q05, self.trials.q95
        );
        _ = writeln!(
            text,
            "{:.0} minutes a person ({:.0} to {:.0}) without rests, if a trial takes {} s (an assumption)",
            self.minutes.mean, self.minutes.q05, self.minutes.q95, self.secs_per_trial
        );
        text += &self.staircases_text();
        text += &self.accuracy_text();
        text += &self.intervals_text();
        text
    }

    fn staircases_text(&self) -> String {
        let ends = &self.staircases;
        let percent = |count: usize| 100.0 * count as f64 / ends.count as f64;
        let mut text = format!("\nStaircases: {:.1} % of {} converge\n", percent(ends.converged), ends.count);
        let reasons = [
            ("interval too wide", ends.wide),
            ("too few answers of a kind", ends.one_sided),
            ("at an end of table or radii", ends.at_edge),
            ("halves differ", ends.halves_differ),
        ];
        for (reason, count) in reasons.into_iter().filter(|(_, count)| *count > 0) {
            _ = writeln!(text, "  {reason:<28}{:>5.1} %", percent(count));
        }
        text
    }

    fn accuracy_text(&self) -> String {
        let mut text = "\nError of a threshold of one texel size, and of a person's ratio from all sizes\n".to_owned();
        let width = self.series.iter().map(|series| series.name.chars().count()).max().unwrap_or(0).max(9);
        _ = writeln!(
            text,
            "{:<width$}  {:>5}  {:^36}  {:^36}",
            "condition", "true", "one size: bias, SD (log10, %), none", "all sizes: bias, SD (log10, %), none"
        );
        for series in &self.series {
            let cells = [series.threshold, series.person_ratio].map(|accuracy| accuracy_cell(&accuracy));
            _ = writeln!(text, "{:<width$}  {:>5.2}  {}  {}", series.name, series.ratio, cells[0], cells[1]);
        }
        text
    }

    fn intervals_text(&self) -> String {
        let mut text = format!("\nThe median person's ratio c, true {:.2}, in {}\n", self.worst_ratio, self.worst);
        _ = writeln!(text, "people   95 % interval (median)   width   bias      holds the truth");
        for interval in &self.intervals {
            _ = writeln!(text, "{}", interval_row(interval));
        }
        text
    }
}

/// Bias and SD in log10 and percent, and the share of people without an estimate.
fn accuracy_cell(accuracy: &Accuracy) -> String {
    let percent = |log10: f64| 100.0 * (10_f64.powf(log10) - 1.0);
    let all = accuracy.count + accuracy.missing;
    format!(
        "{:>+6.3} {:>+5.1} %  {:>5.3} {:>4.0} %  {:>4.1} %",
        accuracy.bias_log10,
        percent(accuracy.bias_log10),
        accuracy.sd_log10,
        percent(accuracy.sd_log10),
        100.0 * accuracy.missing as f64 / all as f64
    )
}

fn interval_row(interval: &IntervalForecast) -> String {
    let range = format!("{:.2} to {:.2}", interval.median_low, interval.median_high);
    let coverage = match (interval.coverage, interval.coverage_standard_error) {
        (Some(share), Some(error)) => format!("{:.1} % (standard error {:.1})", 100.0 * share, 100.0 * error),
        _ => "too few sessions to tell".to_owned(),
    };
    let bias_percent = 100.0 * (10_f64.powf(interval.bias_log10) - 1.0);
    format!(
        "{:>6}   {range:<22}   {:>5.2}   {bias_percent:>+5.1} %   {coverage}",
        interval.people, interval.median_width
    )
}
