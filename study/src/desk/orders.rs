//! The orders and the notes, at the foot of the panel. Every order has a key; what cannot be ordered says why.

use eframe::egui;
use egui::{Align, Button, Key, Layout, Modifiers, RichText, ScrollArea, TextEdit, Ui, Vec2};

use super::look::Look;
use super::{DeskState, Order, Status};
use crate::words::desk::DeskWords;

/// Height of the list of notes: three of them.
const NOTES_HEIGHT: f32 = 56.0;

/// Keys of the orders. Function keys, so that they work while a note is written.
const PAUSE_KEY: Key = Key::F5;
const NOTE_KEY: Key = Key::F6;
const PRACTICE_KEY: Key = Key::F7;
const ROUND_KEY: Key = Key::F8;
const STOP_KEY: Key = Key::F9;

/// An order that loses something, and is asked about once more.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ask {
    /// Of this number.
    RepeatRound(u32),
    Stop,
}

impl Ask {
    fn order(self) -> Order {
        match self {
            Self::RepeatRound(round) => Order::RepeatRound(round),
            Self::Stop => Order::Stop,
        }
    }
}

/// Draws the foot and gives the order that was given.
pub(super) fn orders(
    ui: &mut Ui,
    status: &Status,
    desk: &mut DeskState,
    look: Look,
    words: &DeskWords,
) -> Option<Order> {
    // The session may have moved on while the question stood.
    desk.ask = desk.ask.filter(|ask| status.barrier(&ask.order()).is_none());
    if let Some(round) = status.refused_round {
        ui.label(RichText::new((words.round_was_over)(round)).strong().color(look.palette.wrong));
    }
    let order = match desk.ask {
        Some(ask) => question(ui, status, desk, ask, look, words),
        None => buttons(ui, status, desk, look, words),
    };
    ui.add_space(4.0 * look.scale);
    let note = notes(ui, status, desk, look, words);
    order.or(note)
}

fn buttons(ui: &mut Ui, status: &Status, desk: &mut DeskState, look: Look, words: &DeskWords) -> Option<Order> {
    let pause = if status.is_paused { (Order::Resume, words.resume) } else { (Order::Pause, words.pause) };
    let offered = [
        (pause.0, pause.1, PAUSE_KEY),
        (Order::RepeatPractice, words.repeat_practice, PRACTICE_KEY),
        (Order::RepeatRound(status.progress.round), words.repeat_round, ROUND_KEY),
        (Order::Stop, words.stop, STOP_KEY),
    ];
    let mut given = None;
    ui.columns(offered.len(), |columns| {
        for (ui, (order, name, key)) in columns.iter_mut().zip(offered) {
            let barrier = status.barrier(&order);
            let size = Vec2::new(ui.available_width(), 32.0 * look.scale);
            let text = egui::WidgetText::from(format!("{name}   {}", key.name()));
            let button = |ui: &mut Ui| ui.add_sized(size, Button::new(text));
            let response = ui.add_enabled_ui(barrier.is_none(), button).inner;
            if barrier.is_none() && (response.clicked() || is_pressed(ui, key)) {
                given = Some(order);
            }
            let why = barrier.map_or("", words.barrier);
            let why = RichText::new(why).small().color(look.palette.faint_ink);
            ui.with_layout(Layout::top_down(Align::Min), |ui| ui.label(why));
        }
    });
    match given? {
        Order::RepeatRound(round) => desk.ask = Some(Ask::RepeatRound(round)),
        Order::Stop => desk.ask = Some(Ask::Stop),
        order => return Some(order),
    }
    ui.request_repaint();
    None
}

/// The question in the buttons' place. The keyboard is on "Cancel", and Escape is the same.
fn question(
    ui: &mut Ui,
    status: &Status,
    desk: &mut DeskState,
    ask: Ask,
    look: Look,
    words: &DeskWords,
) -> Option<Order> {
    let (text, yes) = match ask {
        Ask::RepeatRound(round) => ((words.ask_repeat_round)(round, status.answers_of_round), words.yes_repeat_round),
        Ask::Stop => ((words.ask_stop)(status), words.yes_stop),
    };
    ui.label(RichText::new(text).strong().color(look.palette.wrong));
    let (is_confirmed, is_cancelled) = ui
        .horizontal(|ui| {
            let size = Vec2::new(180.0, 32.0) * look.scale;
            let cancel = ui.add(Button::new(format!("{}   Esc", words.cancel)).min_size(size));
            let confirm = ui.add(Button::new(yes).min_size(size));
            if !cancel.has_focus() && !confirm.has_focus() {
                cancel.request_focus();
            }
            (confirm.clicked(), cancel.clicked() || is_pressed(ui, Key::Escape))
        })
        .inner;
    if is_confirmed || is_cancelled {
        desk.ask = None;
        ui.request_repaint();
    }
    is_confirmed.then(|| ask.order())
}

fn notes(ui: &mut Ui, status: &Status, desk: &mut DeskState, look: Look, words: &DeskWords) -> Option<Order> {
    let barrier = status.barrier(&Order::Note(String::new()));
    let text = desk.note.trim().to_owned();
    let row = |ui: &mut Ui| {
        let name = ui.label(format!("{}   {}", words.note, NOTE_KEY.name()));
        let add_width = 110.0 * look.scale;
        let width = ui.available_width() - add_width - ui.spacing().item_spacing.x;
        let hint = barrier.map_or(words.note_hint, words.barrier);
        let edit = TextEdit::singleline(&mut desk.note).hint_text(hint).desired_width(width);
        let edit = ui.add_enabled(barrier.is_none(), edit.margin(6.0 * look.scale)).labelled_by(name.id);
        if barrier.is_none() && is_pressed(ui, NOTE_KEY) {
            edit.request_focus();
        }
        let is_entered = edit.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        let can_add = barrier.is_none() && !text.is_empty();
        let add = ui.add_enabled(can_add, Button::new(words.add_note).min_size(Vec2::new(add_width, 0.0)));
        let is_added = can_add && (is_entered || add.clicked());
        if is_added && is_entered {
            edit.request_focus();
        }
        is_added
    };
    let is_added = ui.horizontal(row).inner;
    ScrollArea::vertical().max_height(NOTES_HEIGHT * look.scale).auto_shrink([false, true]).show(ui, |ui| {
        let line = |text: String| RichText::new(text).small().color(look.palette.faint_ink);
        if status.notes.is_empty() {
            ui.label(line(words.no_notes.to_owned()));
        }
        for note in status.notes.iter().rev() {
            ui.label(line((words.noted)(note.at_secs, &note.text)));
        }
    });
    is_added.then(|| {
        desk.note.clear();
        Order::Note(text)
    })
}

fn is_pressed(ui: &Ui, key: Key) -> bool {
    ui.input_mut(|input| input.consume_key(Modifiers::NONE, key))
}
