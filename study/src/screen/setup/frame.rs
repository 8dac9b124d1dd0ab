//! What every page has: its heading, how far the set-up is, what is wrong, and the way back and on.
//! Sizes are in points of a screen of usual height; see [`widgets::scale`].

use eframe::egui;
use egui::text_edit::TextEditState;
use egui::{Align, Id, Key, Layout, Rect, RichText, ScrollArea, Ui, UiBuilder, Vec2};

use super::{focus, study, widgets};
use crate::setup::{Page, Problem, Setup};
use crate::theme;
use crate::words::setup::SetupWords;

/// Size of a page, where the screen has so much.
const PAGE: Vec2 = Vec2::new(1040.0, 720.0);
/// Between a page and the edges of the screen.
const MARGIN: Vec2 = Vec2::new(36.0, 24.0);
/// Height of the heading and of the row of buttons.
const HEADING: f32 = 56.0;
const BUTTONS: f32 = 48.0;

/// Where somebody wants to go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Press {
    Back,
    Next,
    /// Not on: the participant does not agree.
    Decline,
}

/// A page around its content, which scrolls where the screen is too small for it.
pub(super) fn frame(
    ui: &mut Ui,
    setup: &mut Setup,
    words: &SetupWords,
    content: impl FnOnce(&mut Ui, &mut Setup),
) -> Option<Press> {
    let screen = ui.max_rect();
    ui.painter().rect_filled(screen, 0.0, theme::GROUND);
    let page = setup.page();
    let had_keyboard = ui.memory(|memory| memory.focused());
    let scale = widgets::scale(ui);
    let column = Rect::from_center_size(screen.center(), (PAGE * scale).min(screen.size() - 2.0 * MARGIN * scale));

    let problem = setup.problem().filter(|problem| !matches!(problem, Problem::NoConsent));
    let problem = problem.map(|problem| (words.problem)(&problem));
    let too_small = (page == Page::Study).then(|| study::too_small(ui, setup)).flatten();
    let notices: Vec<String> = [too_small, problem].into_iter().flatten().collect();
    let text = (!notices.is_empty()).then(|| notices.join("\n"));
    let notice_height = text.as_deref().map_or(0.0, |text| widgets::notice_height(ui, text, column.width()));
    let (heading, below) = column.split_top_bottom_at_y(column.top() + HEADING * scale);
    let (above, buttons) = below.split_top_bottom_at_y(below.bottom() - BUTTONS * scale);
    let (middle, notice) = above.split_top_bottom_at_y(above.bottom() - notice_height);

    let (number, count) = setup.progress();
    in_rect(ui, heading, "heading", Layout::left_to_right(Align::Min), |ui| {
        ui.heading((words.title)(page));
        ui.with_layout(Layout::right_to_left(Align::Min), |ui| {
            ui.label(RichText::new((words.progress)(number, count)).color(theme::FAINT_INK));
        });
    });
    // Its own identity a page: a widget must not look for a frame like another page's in its place.
    in_rect(ui, middle.shrink2(Vec2::new(0.0, 6.0)), page, Layout::top_down(Align::Min), |ui| {
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| content(ui, setup));
    });
    if let Some(text) = text {
        in_rect(ui, notice, "notice", Layout::top_down(Align::Min), |ui| widgets::notice(ui, &text));
    }
    // The keyboard comes to the way on first.
    let (on, on_left) = in_rect(ui, buttons, "on", Layout::right_to_left(Align::Center), |ui| {
        let on = way_on(ui, page, words);
        (on, ui.min_rect().left())
    });
    let beside = buttons.with_max_x(on_left - ui.spacing().item_spacing.x);
    let back = in_rect(ui, beside, "back", Layout::left_to_right(Align::Center), |ui| way_back(ui, page, words));
    let clicked = on.or(back);
    clicked.or_else(|| key(ui, page, had_keyboard))
}

/// The buttons that go on, from right to left.
fn way_on(ui: &mut Ui, page: Page, words: &SetupWords) -> Option<Press> {
    let name = match page {
        Page::Room => words.hand_over,
        Page::Consent => words.agree,
        Page::Declined => words.close,
        Page::Summary => words.start,
        _ => words.next,
    };
    let next = ui.button(name).clicked().then_some(Press::Next);
    let decline = page == Page::Consent && ui.button(words.disagree).clicked();
    next.or(decline.then_some(Press::Decline))
}

/// The button that goes back, and what keys do.
fn way_back(ui: &mut Ui, page: Page, words: &SetupWords) -> Option<Press> {
    let back = page != Page::Study && ui.button(words.back).clicked();
    widgets::small(ui, (words.keys)(page));
    back.then_some(Press::Back)
}

/// Escape goes back. Return goes on where nothing else takes it: from the last line of text, or where no widget
/// has the keyboard. Nobody agrees to a text by a key that means something else everywhere else.
fn key(ui: &Ui, page: Page, had_keyboard: Option<Id>) -> Option<Press> {
    if focus::pressed(ui, Key::Escape) {
        return Some(Press::Back);
    }
    let has_keyboard = ui.memory(|memory| memory.focused());
    let left_line = had_keyboard.is_some_and(|id| TextEditState::load(ui.ctx(), id).is_some());
    let is_free = has_keyboard.is_none() && (had_keyboard.is_none() || left_line);
    let goes_on = is_free && !matches!(page, Page::Consent | Page::Declined) && focus::pressed(ui, Key::Enter);
    goes_on.then_some(Press::Next)
}

fn in_rect<R>(
    ui: &mut Ui,
    rect: Rect,
    salt: impl egui::AsIdSalt,
    layout: Layout,
    content: impl FnOnce(&mut Ui) -> R,
) -> R {
    ui.scope_builder(UiBuilder::new().id_salt(salt).max_rect(rect).layout(layout), content).inner
}
