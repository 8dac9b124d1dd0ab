//! Psychometric functions with the answers they stand for, one panel a series: detection against the ratio shown, relative to
//! the person's own threshold.
//!
//! Answers of everyone are ordered by that relative ratio and cut into groups of equal number; a dot stands at a group's mean
//! with the binomial standard error. Guessing is taken out per person: `(share right - g) / (1 - g)`.

use plotters::prelude::*;
use scumble_stimuli::Pattern;

use crate::{
    Error,
    analysis::Analysis,
    figure::{DrawError, GREY, GRID, INK, pattern_color, svg, text},
    mixed_model::{MixedParameters, PersonAnswers},
    panels::{Area, draw_foot, page_px, split},
    series::Series,
};

/// File name of the figure.
pub const PSYCHOMETRIC_FIGURE: &str = "psychometric.svg";

/// Groups of answers in a panel.
const GROUPS: usize = 12;

/// Ends of the axis: ratios relative to the threshold.
const RELATIVE: [f64; 2] = [0.4, 2.5];

/// What a panel shows.
pub(crate) struct Panel {
    /// Its caption.
    pub name: String,
    /// Pattern whose colour the function has.
    pub pattern: Pattern,
    /// Everyone's function.
    pub shared: MixedParameters,
    /// Answers and log10 threshold of each person.
    pub people: Vec<(PersonAnswers, f64)>,
}

impl Panel {
    fn of(series: &Series) -> Self {
        Self {
            name: series.name.clone(),
            pattern: series.round.pattern,
            shared: series.fit.parameters(),
            people: series.fit.thresholds().map(|(answers, threshold)| (answers.clone(), threshold)).collect(),
        }
    }
}

/// Draws the figure of an analysis as SVG.
///
/// # Errors
/// Only the plotting library's own.
pub fn psychometric_figure(analysis: &Analysis) -> Result<String, Error> {
    let panels: Vec<Panel> = analysis.series.iter().map(Panel::of).collect();
    draw(&panels, "everyone's slope")
}

/// Draws panels as SVG; `slope` says whose slope the functions have.
///
/// # Errors
/// Only the plotting library's own.
pub(crate) fn draw(shown: &[Panel], slope: &str) -> Result<String, Error> {
    let count = shown.len();
    svg(PSYCHOMETRIC_FIGURE, "Psychometric functions", page_px(count), |page| {
        let (panels, foot) = split(page, count);
        for (panel, shown) in panels.iter().zip(shown) {
            draw_panel(panel, shown)?;
        }
        let lines = [
            &format!(
                "line: Weibull function with {slope} · dots: answers in groups of equal number, guesses taken out, one \
                 standard error"
            ),
            "ring: threshold, where the artifact is seen on 64 % of the trials",
        ];
        draw_foot(&foot, &lines)
    })
}

/// Answers that lie together.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Group {
    /// Geometric mean of the ratio shown over the person's threshold.
    pub relative: f64,
    /// Share detected, guesses taken out; below 0 where fewer are right than guessing gives.
    pub detected: f64,
    /// Its standard error.
    pub standard_error: f64,
}

/// Right answers at one distance from the threshold.
#[derive(Debug, Clone, Copy)]
struct Answers {
    /// log10 of the intensity over the person's threshold.
    x: f64,
    guess: f64,
    right: f64,
    total: f64,
}

/// The groups of a panel, by falling ratio.
fn groups(panel: &Panel) -> Vec<Group> {
    let mut all: Vec<Answers> = Vec::new();
    for (person, threshold) in &panel.people {
        let guess = person.guess();
        let counts = person.counts().iter();
        all.extend(counts.map(|c| Answers { x: c.x + threshold, guess, right: c.correct, total: c.total }));
    }
    all.sort_by(|a, b| a.x.total_cmp(&b.x));
    let count: f64 = all.iter().map(|answers| answers.total).sum();
    let mut cut: Vec<Vec<Answers>> = vec![Vec::new(); GROUPS];
    let mut before = 0.0;
    for answers in all {
        let index = ((before + answers.total / 2.0) / count * GROUPS as f64) as usize;
        cut[index.min(GROUPS - 1)].push(answers);
        before += answers.total;
    }
    cut.iter().filter(|group| !group.is_empty()).map(|group| Group::of(group)).collect()
}

impl Group {
    fn of(group: &[Answers]) -> Self {
        let total: f64 = group.iter().map(|answers| answers.total).sum();
        let mean = |value: fn(&Answers) -> f64| group.iter().map(value).sum::<f64>() / total;
        let x = mean(|answers| answers.x * answers.total);
        let guess = mean(|answers| answers.guess * answers.total);
        let right = mean(|answers| answers.right);
        // Agresti and Coull's share keeps the error of "all right" from being none.
        let share = (right * total + 2.0) / (total + 4.0);
        Self {
            relative: 10_f64.powf(-x),
            detected: (right - guess) / (1.0 - guess),
            standard_error: (share * (1.0 - share) / total).sqrt() / (1.0 - guess),
        }
    }
}

fn draw_panel(panel: &Area<'_>, shown: &Panel) -> Result<(), DrawError> {
    let color = pattern_color(shown.pattern);
    let [left, right] = RELATIVE;
    let mut chart = ChartBuilder::on(panel)
        .margin(12)
        .caption(&shown.name, text(17, INK))
        .x_label_area_size(42)
        .y_label_area_size(56)
        .build_cartesian_2d(
            (left..right).log_scale().with_key_points(vec![0.4, 0.5, 0.7, 1.0, 1.4, 2.0, 2.5]),
            -0.2..1.1,
        )?;
    chart
        .configure_mesh()
        .disable_x_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GRID)
        .axis_style(GREY)
        .x_desc("ratio shown / threshold of the person")
        .y_desc("artifacts detected")
        .y_labels(7)
        .x_label_formatter(&|x| format!("{x}"))
        .y_label_formatter(&|y| format!("{:.0} %", 100.0 * y))
        .label_style(text(14, INK))
        .axis_desc_style(text(15, INK))
        .draw()?;
    let curve = (0..=120).map(|step| {
        let relative = left * (right / left).powf(f64::from(step) / 120.0);
        (relative, shown.shared.detection(-relative.log10()))
    });
    chart.draw_series(LineSeries::new(curve, color.stroke_width(2)))?;
    for Group { relative, detected, standard_error } in groups(shown) {
        let x = relative.clamp(left, right);
        let end = |sign: f64| (x, (detected + sign * standard_error).clamp(-0.2, 1.1));
        chart.draw_series([PathElement::new([end(-1.0), end(1.0)], INK.stroke_width(1))])?;
        chart.draw_series([Circle::new((x, detected.clamp(-0.2, 1.1)), 4, INK.filled())])?;
    }
    let threshold = (1.0, shown.shared.detection(0.0));
    chart.draw_series([Circle::new(threshold, 7, color.stroke_width(2))])?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_group_takes_guesses_out_and_stands_at_its_mean() {
        let answers = |x, right| Answers { x, guess: 0.5, right, total: 10.0 };
        let group = Group::of(&[answers(-0.1, 9.0), answers(0.1, 6.0)]);
        assert!((group.relative - 1.0).abs() < 1e-12);
        assert!((group.detected - 0.5).abs() < 1e-12, "15 of 20 right is half detected");
        let share = 17.0_f64 / 24.0;
        assert!((group.standard_error - 2.0 * (share * (1.0 - share) / 20.0).sqrt()).abs() < 1e-12);
    }
}
