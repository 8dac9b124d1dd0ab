//! The panel: header, rounds, charts, orders and notes, from top to bottom.

use eframe::egui;
use egui::{Button, Frame, Layout, Margin, Panel, Rect, RichText, ScrollArea, Ui, Vec2};

use scumble_psychophysics::{Reason, Task};

use super::look::{Look, dress};
use super::orders::{self, Ask};
use super::plot::{Axes, plot};
use super::{Activity, Chart, Disk, Order, Round, RoundState, Status};
use crate::words::desk::DeskWords;

/// Narrowest chart beside others; narrower windows stack them.
const CHART_WIDTH: f32 = 280.0;
/// Lowest plot; lower windows scroll.
const PLOT_HEIGHT: f32 = 150.0;
/// Below a plot: what is read there and the verdict, and each of its reasons.
const VERDICT_HEIGHT: f32 = 46.0;
const REASON_HEIGHT: f32 = 18.0;

/// What the panel remembers from frame to frame.
#[derive(Clone, Debug)]
pub(crate) struct DeskState {
    pub(crate) is_dark: bool,
    /// Round on show; the one under way where none was chosen.
    pub(crate) chosen_round: Option<u32>,
    /// Order that waits to be confirmed.
    pub(super) ask: Option<Ask>,
    /// Note being written.
    pub(super) note: String,
}

impl Default for DeskState {
    /// Dark, for a room whose light must not change.
    fn default() -> Self {
        Self { is_dark: true, chosen_round: None, ask: None, note: String::new() }
    }
}

/// Draws the panel over the whole of `ui` and gives the order that was given in this frame.
pub(crate) fn show(ui: &mut Ui, status: &Status, desk: &mut DeskState, words: &DeskWords) -> Option<Order> {
    let look = dress(ui, desk.is_dark);
    let margin = Margin::symmetric((18.0 * look.scale) as i8, (10.0 * look.scale) as i8);
    let frame = Frame::new().inner_margin(margin);
    Panel::top("head of the desk").frame(frame).resizable(false).show_separator_line(false).show(ui, |ui| {
        header(ui, status, desk, look, words);
        ui.add_space(4.0 * look.scale);
        rounds(ui, status, desk, look, words);
        facts(ui, status, look, words);
    });
    let foot = Panel::bottom("foot of the desk").frame(frame).resizable(false).show_separator_line(true);
    let order = foot.show(ui, |ui| orders::orders(ui, status, desk, look, words)).inner;
    let shown = desk.chosen_round.unwrap_or(status.progress.round);
    if let Some(round) = status.rounds.iter().find(|round| round.number == shown) {
        let rect = ui.available_rect_before_wrap().shrink2(Vec2::new(18.0, 0.0) * look.scale);
        ui.scope_builder(egui::UiBuilder::new().max_rect(rect), |ui| charts(ui, status.task, round, look, words));
    }
    look.ring(ui);
    order
}

/// Who and what on the left; time, disk and looks on the right.
fn header(ui: &mut Ui, status: &Status, desk: &mut DeskState, look: Look, words: &DeskWords) {
    ui.horizontal(|ui| {
        ui.label(RichText::new(&status.participant).heading().strong());
        ui.label(RichText::new(&status.protocol).color(look.palette.faint_ink));
        let (text, color) = match status.activity() {
            activity @ (Activity::Paused | Activity::Stopped) => ((words.activity)(activity), look.palette.wrong),
            activity => ((words.activity)(activity), look.palette.ink),
        };
        ui.label(RichText::new(text).strong().color(color));
        ui.with_layout(Layout::right_to_left(egui::Align::Center), |ui| {
            let other = if desk.is_dark { words.light } else { words.dark };
            if ui.button(other).clicked() {
                desk.is_dark = !desk.is_dark;
            }
            ui.label((words.elapsed)(status.elapsed_minutes));
            if status.disk == Disk::Saved && status.has_begun {
                ui.label(RichText::new(words.saved).color(look.palette.faint_ink));
            }
        });
    });
    if let Some(problem) = &status.stopped {
        alarm(ui, (words.stopped)(problem), look);
    }
    if let Some(name) = &status.other_display {
        alarm(ui, (words.other_display)(name), look);
    }
    if let Disk::Waiting { problem } = &status.disk {
        alarm(ui, (words.waiting)(problem), look);
    }
}

/// What somebody has to see to.
fn alarm(ui: &mut Ui, text: String, look: Look) {
    let frame = Frame::new().fill(look.palette.wrong).corner_radius(5.0).inner_margin(8.0 * look.scale);
    frame.show(ui, |ui| {
        ui.set_width(ui.available_width());
        let text = RichText::new(text).strong().color(look.palette.ground);
        ui.add(egui::Label::new(text).wrap());
    });
}

/// The strip of rounds; those that have begun can be looked at.
fn rounds(ui: &mut Ui, status: &Status, desk: &mut DeskState, look: Look, words: &DeskWords) {
    let count = status.rounds.len();
    let gap = ui.spacing().item_spacing.x;
    let width = (ui.available_width() - gap * (count as f32 - 1.0)) / count as f32;
    let shown = desk.chosen_round.unwrap_or(status.progress.round);
    ui.horizontal(|ui| {
        for round in &status.rounds {
            let size = Vec2::new(width, 52.0 * look.scale);
            let has_begun = round.state != RoundState::Ahead;
            let button = Button::new("").min_size(size).selected(round.number == shown);
            let response = ui.add_enabled(has_begun, button);
            response.widget_info(|| {
                let name = format!("{}, {}", (words.round)(round), (words.round_state)(round));
                egui::WidgetInfo::selected(egui::Role::Button, has_begun, round.number == shown, name)
            });
            if response.clicked() {
                desk.chosen_round = (round.number != status.progress.round).then_some(round.number);
            }
            segment(ui, round, response.rect, look, words);
        }
    });
}

/// Name, condition and state of a round, and how much of it is done.
fn segment(ui: &mut Ui, round: &Round, rect: Rect, look: Look, words: &DeskWords) {
    let is_ahead = round.state == RoundState::Ahead;
    let (name, rest) = match is_ahead {
        true => (look.palette.faint_ink, look.palette.faint_ink),
        false => (look.palette.ink, look.palette.ink),
    };
    let bar_height = 4.0 * look.scale;
    let inside = rect.shrink2(Vec2::new(10.0, 5.0) * look.scale);
    let layout = Layout::top_down(egui::Align::Min);
    let ui = &mut ui.new_child(egui::UiBuilder::new().max_rect(inside).layout(layout));
    ui.spacing_mut().item_spacing.y = look.scale;
    let heading = format!("{}: {}", (words.round)(round), (words.condition)(&round.condition));
    ui.add(egui::Label::new(RichText::new(heading).color(name)).truncate());
    let state = RichText::new((words.round_state)(round)).small().color(rest);
    ui.add(egui::Label::new(state).truncate());
    let share = match round.state {
        RoundState::Done => 1.0,
        RoundState::Ahead => 0.0,
        RoundState::UnderWay => round.trials() as f32 / round.trials_at_most().max(1) as f32,
    };
    let track = Rect::from_min_max(rect.left_bottom() - Vec2::new(0.0, bar_height), rect.right_bottom());
    let filled = track.with_max_x(track.left() + track.width() * share);
    ui.painter().rect_filled(track, 2.0, look.palette.line);
    ui.painter().rect_filled(filled, 2.0, look.palette.right);
}

/// What is known of the session as a whole, on one line.
fn facts(ui: &mut Ui, status: &Status, look: Look, words: &DeskWords) {
    let mut facts = vec![(words.trials)(status)];
    if !status.is_over {
        facts.push((words.minutes_left)(status.minutes_left));
    }
    facts.extend(status.lines.map(words.lines));
    facts.extend(status.catch_trials.map(words.catch_trials));
    facts.push((words.missed_frames)(status.missed_frames));
    let text = RichText::new(facts.join("   \u{b7}   ")).small().color(look.palette.faint_ink);
    ui.add(egui::Label::new(text).wrap());
}

/// The charts of a round, side by side as far as there is width.
fn charts(ui: &mut Ui, task: Task, round: &Round, look: Look, words: &DeskWords) {
    let gap = 16.0 * look.scale;
    let count = round.charts.len();
    let fitting = ((ui.available_width() + gap) / (CHART_WIDTH * look.scale + gap)).floor() as usize;
    let columns = fitting.clamp(1, count.clamp(1, 3));
    let rows = count.div_ceil(columns);
    let reasons = round.charts.iter().map(|chart| reasons(chart).len()).max().unwrap_or(0);
    let below = (VERDICT_HEIGHT + REASON_HEIGHT * reasons as f32) * look.scale;
    // Above a plot is its title.
    let around = below + 30.0 * look.scale;
    let height = ((ui.available_height() - 26.0 * look.scale) / rows as f32 - around).max(PLOT_HEIGHT * look.scale);
    let axes = Axes::of(&round.charts);
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        for (row, charts) in round.charts.chunks(columns).enumerate() {
            ui.spacing_mut().item_spacing.x = gap;
            ui.columns(columns, |column| {
                for (index, (ui, one)) in column.iter_mut().zip(charts).enumerate() {
                    chart(ui, one, row * columns + index, axes, [height, below], look, words);
                }
            });
        }
        let legend = match task {
            Task::TwoAlternative => words.legend_two,
            Task::YesNo => words.legend_one,
        };
        ui.label(RichText::new(legend).small().color(look.palette.faint_ink));
    });
}

/// One chart with its texel above it, and its estimate and verdict below.
fn chart(
    ui: &mut Ui,
    chart: &Chart,
    index: usize,
    axes: Axes,
    [height, below]: [f32; 2],
    look: Look,
    words: &DeskWords,
) {
    ui.label(RichText::new((words.texel)(chart.texel_px)).strong());
    let pointed = ui.scope(|ui| plot(ui, chart, index, axes, height, look, words)).inner;
    let below = Vec2::new(ui.available_width(), below);
    ui.allocate_ui(below, |ui| {
        ui.set_min_size(below);
        ui.spacing_mut().item_spacing.y = 2.0 * look.scale;
        let read = pointed.as_ref().map_or_else(|| (words.estimate)(chart), words.point);
        ui.label(RichText::new(read).small());
        let color = match chart.verdict.is_converged() && chart.is_done {
            true => look.palette.right,
            false if chart.points.is_empty() => look.palette.faint_ink,
            false => look.palette.wrong,
        };
        ui.label(RichText::new((words.verdict)(chart)).color(color));
        for reason in reasons(chart) {
            let text = format!("\u{2022} {}", (words.reason)(&reason));
            ui.label(RichText::new(text).small().color(look.palette.faint_ink));
        }
    });
}

/// Why a staircase is not converged; before its first trial nobody expects it to be.
fn reasons(chart: &Chart) -> Vec<Reason> {
    if chart.points.is_empty() { Vec::new() } else { chart.verdict.reasons() }
}
