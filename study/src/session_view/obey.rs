//! What the administrator orders, done to the session.

use super::SessionView;
use crate::desk::Order;

impl SessionView {
    /// Does what the administrator ordered.
    pub(super) fn obey(&mut self, order: Order) {
        let mut refused_round = None;
        match order {
            Order::Pause => self.hide_pictures(),
            Order::Resume => {
                self.administrator.uncover_screen();
                self.sitting.go_on();
            }
            Order::Note(note) => self.sitting.note(note),
            Order::RepeatPractice => self.sitting.repeat_practice(),
            Order::RepeatRound(round) => match self.sitting.repeat_round(round) {
                true => self.presentation = None,
                false => refused_round = Some(round),
            },
            Order::Stop => self.sitting.stop(),
        }
        self.administrator.answer_order(refused_round);
    }

    /// Pauses; the trial under way is shown anew afterwards.
    pub(super) fn hide_pictures(&mut self) {
        self.presentation = None;
        self.sitting.pause();
    }
}
