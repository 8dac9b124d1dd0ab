//! The keyboard on the pages: which widget has it, and what its keys do there.

use eframe::egui;
use egui::{Event, EventFilter, Id, Key, Response, Stroke, StrokeKind, Ui};

use crate::setup::Page;
use crate::theme;

/// Between a widget and the ring around it, and the ring's width, in points.
const RING: [f32; 2] = [3.0, 2.0];

/// Whether the frame before this one showed another page.
pub(super) fn is_new_page(ui: &Ui, page: Page) -> bool {
    let id = Id::unique("page of the set-up");
    ui.data_mut(|data| data.get_temp_mut_or_default::<Option<Page>>(id).replace(page) != Some(page))
}

/// A ring around the widget that has the keyboard.
pub(super) fn ring(ui: &Ui) {
    let focused = ui.memory(|memory| memory.focused()).and_then(|id| ui.ctx().read_response(id));
    if let Some(response) = focused {
        let rect = response.interact_rect.expand(RING[0]);
        ui.painter().rect_stroke(rect, 8.0, Stroke::new(RING[1], theme::INK), StrokeKind::Outside);
    }
}

/// Whether this key went down in this frame; one that is held down counts once.
pub(super) fn pressed(ui: &Ui, key: Key) -> bool {
    let down =
        |event: &Event| matches!(event, Event::Key { key: down, pressed: true, repeat: false, .. } if *down == key);
    ui.input(|input| input.events.iter().any(down))
}

/// Steps by which the arrow keys change what has the keyboard: `coarse` a key, and 1 with Shift; right and
/// up count forwards. A key that is held down goes on. The arrows then move no focus.
pub(super) fn arrow_steps(ui: &Ui, response: &Response, coarse: i32) -> i32 {
    if !response.has_focus() {
        return 0;
    }
    let arrows = EventFilter { horizontal_arrows: true, vertical_arrows: true, ..EventFilter::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, arrows));
    let step = |event: &Event| match event {
        Event::Key { key, pressed: true, modifiers, .. } => {
            let size = if modifiers.shift { 1 } else { coarse };
            match key {
                Key::ArrowRight | Key::ArrowUp => size,
                Key::ArrowLeft | Key::ArrowDown => -size,
                _ => 0,
            }
        }
        _ => 0,
    };
    ui.input(|input| input.events.iter().map(step).sum())
}

/// Whether what has the keyboard was confirmed by the return key, which then is free to go on.
pub(super) fn confirmed(ui: &Ui, response: &Response) -> bool {
    let confirmed = response.has_focus() && !response.gained_focus() && pressed(ui, Key::Enter);
    if confirmed {
        response.surrender_focus();
    }
    confirmed
}
