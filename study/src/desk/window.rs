//! The panel in a window of its own, on another monitor than the participant's.
//!
//! The window repaints when a status is published and when somebody does something in it, and an order wakes the
//! participant's window. In between it costs nothing. Closing it ends nothing: it can be opened again.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use eframe::egui;
use egui::{Context, Pos2, ViewportBuilder, ViewportCommand, ViewportId};

use super::{DeskState, Order, Status, show};
use crate::words::desk::DeskWords;

/// Before the window is maximised, in points: what every display has.
const SIZE: [f32; 2] = [1280.0, 720.0];

/// After this a window manager has given a new window the keyboard, if it does, and the window knows: those of X11 do
/// so unasked, and a busy computer without a graphics card took 1.9 s. Later it is somebody's click that gives it.
const SETTLING: Duration = Duration::from_secs(5);

/// The administrator's window as the participant's window holds it.
pub(crate) struct DeskWindow {
    shared: Arc<Mutex<Shared>>,
    place: Option<Place>,
}

/// Where on another monitor the window opens.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Place {
    /// Maximised, with its upper left corner there, in points.
    At(Pos2),
    /// Over the whole of the monitor with this number, from 0 in the system's order: Wayland takes no positions, and
    /// a window without one could open over the participant's pictures.
    FullScreen(usize),
}

/// What both windows see.
struct Shared {
    words: &'static DeskWords,
    status: Option<Status>,
    desk: DeskState,
    orders: Vec<Order>,
    is_open: bool,
    /// When it was opened, until it has handed the keyboard back.
    opened_at: Option<Instant>,
}

impl DeskWindow {
    /// A window, open from the first [`DeskWindow::show`] on; where the system likes without a place.
    pub(crate) fn new(words: &'static DeskWords, place: Option<Place>) -> Self {
        let (desk, orders, opened_at) = (DeskState::default(), Vec::new(), Some(Instant::now()));
        let shared = Shared { words, status: None, desk, orders, is_open: true, opened_at };
        Self { shared: Arc::new(Mutex::new(shared)), place }
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
        // The keyboard stays with the participant, who has to answer. X11 knows no such wish: see `draw`.
        let builder = ViewportBuilder::default().with_title(title).with_inner_size(SIZE).with_active(false);
        let builder = match self.place {
            Some(Place::At(corner)) => builder.with_maximized(true).with_position(corner),
            Some(Place::FullScreen(monitor)) => builder.with_monitor(monitor),
            None => builder.with_maximized(true),
        };
        let shared = Arc::clone(&self.shared);
        context.show_viewport_deferred(id(), builder, move |ui, _| draw(ui, &mut lock(&shared)));
    }

    /// Opens the window again after it was closed, or closes it; the keyboard goes to the participant's window.
    pub(crate) fn toggle(&self, context: &Context) {
        let mut shared = lock(&self.shared);
        shared.is_open = !shared.is_open;
        shared.opened_at = shared.is_open.then(Instant::now);
        context.request_repaint_of(ViewportId::ROOT);
        context.send_viewport_cmd_to(ViewportId::ROOT, ViewportCommand::Focus);
    }

    /// The orders that were given since the last call, in order.
    pub(crate) fn take_orders(&self) -> Vec<Order> {
        std::mem::take(&mut lock(&self.shared).orders)
    }
}

/// A place on a monitor that the participant's window is not on; `None` where there is none or the system tells no
/// positions. A monitor at the same position shows the same picture, the participant's.
pub(crate) fn other_monitor(frame: &eframe::Frame) -> Option<Place> {
    let window = frame.winit_window()?;
    let current = window.current_monitor()?;
    let mut monitors = window.available_monitors().enumerate();
    let (index, other) =
        monitors.find(|(_, monitor)| *monitor != current && monitor.position() != current.position())?;
    // A system that tells no window's position takes none either.
    if window.outer_position().is_err() {
        return Some(Place::FullScreen(index));
    }
    let position = other.position().to_logical::<f32>(window.scale_factor());
    Some(Place::At(Pos2::new(position.x, position.y)))
}

fn draw(ui: &mut egui::Ui, shared: &mut Shared) {
    if ui.input(|input| input.viewport().close_requested()) {
        shared.is_open = false;
        ui.ctx().request_repaint_of(ViewportId::ROOT);
    }
    // A window manager may give a new window the keyboard, which the participant needs.
    if ui.input(|input| input.viewport().focused == Some(true))
        && shared.opened_at.take().is_some_and(|opened_at| opened_at.elapsed() < SETTLING)
    {
        ui.ctx().send_viewport_cmd_to(ViewportId::ROOT, ViewportCommand::Focus);
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
