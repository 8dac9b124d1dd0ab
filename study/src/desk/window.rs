//! The panel in a window of its own, on another monitor than the participant's.
//!
//! The window repaints when a status is published and when somebody does something in it, and an order wakes the
//! participant's window. In between it costs nothing. Closing it ends nothing: it can be opened again.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use eframe::egui;
use egui::{Context, Pos2, ViewportBuilder, ViewportId};

use super::{DeskState, Order, Status, show};
use crate::words::desk::DeskWords;

/// Before the window is maximised, in points: what every display has.
const SIZE: [f32; 2] = [1280.0, 720.0];

/// The administrator's window as the participant's window holds it.
pub(crate) struct DeskWindow {
    shared: Arc<Mutex<Shared>>,
    position: Option<Pos2>,
}

/// What both windows see.
struct Shared {
    words: &'static DeskWords,
    status: Option<Status>,
    desk: DeskState,
    orders: Vec<Order>,
    is_open: bool,
}

impl DeskWindow {
    /// A window, open from the first [`DeskWindow::show`] on, at the upper left corner of a monitor, in points; where
    /// the system likes without one. Wayland places windows itself.
    pub(crate) fn new(words: &'static DeskWords, position: Option<Pos2>) -> Self {
        let shared = Shared { words, status: None, desk: DeskState::default(), orders: Vec::new(), is_open: true };
        Self { shared: Arc::new(Mutex::new(shared)), position }
    }

    /// What is to be shown from here on; repaints the window where it differs from before.
    pub(crate) fn publish(&self, context: &Context, status: Status) {
        let mut shared = lock(&self.shared);
        if shared.status.as_ref() != Some(&status) {
            shared.status = Some(status);
            context.request_repaint_of(id());
        }
    }

    /// Keeps the window there; to be called in every frame of the participant's window.
    pub(crate) fn show(&self, context: &Context) {
        let (is_open, title) = {
            let shared = lock(&self.shared);
            (shared.is_open, shared.words.title)
        };
        if !is_open {
            return;
        }
        let mut builder = ViewportBuilder::default().with_title(title).with_inner_size(SIZE).with_maximized(true);
        if let Some(position) = self.position {
            builder = builder.with_position(position);
        }
        let shared = Arc::clone(&self.shared);
        context.show_viewport_deferred(id(), builder, move |ui, _| draw(ui, &mut lock(&shared)));
    }

    /// Opens the window again after it was closed, or closes it.
    pub(crate) fn toggle(&self, context: &Context) {
        let mut shared = lock(&self.shared);
        shared.is_open = !shared.is_open;
        context.request_repaint_of(ViewportId::ROOT);
    }

    /// The orders that were given since the last call, in order.
    pub(crate) fn take_orders(&self) -> Vec<Order> {
        std::mem::take(&mut lock(&self.shared).orders)
    }
}

/// The upper left corner, in points, of a monitor that the participant's window is not on; `None` where there is
/// none or the system tells no positions.
pub(crate) fn other_monitor(frame: &eframe::Frame) -> Option<Pos2> {
    let window = frame.winit_window()?;
    let current = window.current_monitor()?;
    let other = window.available_monitors().find(|monitor| *monitor != current)?;
    let position = other.position().to_logical::<f32>(window.scale_factor());
    Some(Pos2::new(position.x, position.y))
}

fn draw(ui: &mut egui::Ui, shared: &mut Shared) {
    if ui.input(|input| input.viewport().close_requested()) {
        shared.is_open = false;
        ui.ctx().request_repaint_of(ViewportId::ROOT);
    }
    let Shared { words, status: Some(status), desk, orders, .. } = shared else {
        return;
    };
    if let Some(order) = show(ui, status, desk, words) {
        orders.push(order);
        ui.ctx().request_repaint_of(ViewportId::ROOT);
    }
}

fn id() -> ViewportId {
    ViewportId::from_hash_of("administrator")
}

/// A status is replaced as a whole, so that one left by a panic is as good as any.
fn lock(shared: &Mutex<Shared>) -> MutexGuard<'_, Shared> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use std::rc::Rc;

    use eframe::egui::{self, Key, Vec2};
    use egui_kittest::Harness;
    use egui_kittest::kittest::Queryable as _;
    use scumble_psychophysics::Language;

    use super::super::testing::Rehearsed;
    use super::*;
    use crate::words::words;

    /// The participant's window with the administrator's inside, as egui does it where there is one window alone.
    fn harness(window: &Rc<DeskWindow>) -> Harness<'static> {
        let window = Rc::clone(window);
        let size = Vec2::new(1400.0, 900.0);
        Harness::builder().with_size(size).build_ui(move |ui: &mut egui::Ui| window.show(ui.ctx()))
    }

    #[test]
    fn the_window_shows_what_is_published_and_keeps_orders_until_they_are_taken() {
        let window = Rc::new(DeskWindow::new(&words(Language::English).desk, None));
        let mut harness = harness(&window);
        harness.run_steps(2);
        assert!(harness.query_by_label("p07").is_none(), "before anything is published");
        window.publish(&harness.ctx, Rehearsed::new("two-alternative").at_trial(9).status());
        harness.run_steps(3);
        assert!(harness.query_by_label("p07").is_some());
        harness.key_press(Key::F5);
        harness.run_steps(2);
        assert_eq!(window.take_orders(), [Order::Pause]);
        assert_eq!(window.take_orders(), []);
    }

    #[test]
    fn a_closed_window_is_gone_until_it_is_opened_again() {
        let window = Rc::new(DeskWindow::new(&words(Language::English).desk, None));
        let mut harness = harness(&window);
        window.publish(&harness.ctx, Rehearsed::new("two-alternative").at_trial(9).status());
        for is_open in [true, false, true] {
            harness.run_steps(3);
            assert_eq!(harness.query_by_label("p07").is_some(), is_open);
            window.toggle(&harness.ctx);
        }
    }
}
