//! What the administrator orders, done to the session.

use super::SessionView;
use crate::desk::Order;

impl SessionView {
    /// Does what the administrator ordered.
    pub(super) fn obey(&mut self, order: Order) {
        match order {
            Order::Pause => self.hide_pictures(),
            Order::Resume => {
                self.administrator.uncover_screen();
                self.sitting.go_on();
            }
            Order::Note(note) => self.sitting.note(note),
            Order::RepeatPractice => self.sitting.repeat_practice(),
            Order::RepeatRound => {
                self.presentation = None;
                self.sitting.repeat_round();
            }
            Order::Stop => self.sitting.stop(),
        }
        self.administrator.note_news();
    }

    /// Pauses; the trial under way is shown anew afterwards.
    pub(super) fn hide_pictures(&mut self) {
        self.presentation = None;
        self.sitting.pause();
    }
}
