//! What the administrator can order, and what stands in the way of it.

use super::Status;

/// What the session is to do. The session carries it out; the panel only asks for it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Order {
    /// Hide the pictures.
    Pause,
    /// Go on after a pause.
    Resume,
    /// Put a note into the record.
    Note(String),
    /// Practice once more.
    RepeatPractice,
    /// The round of this number once more; its answers do not stand. Another round that has begun since is not meant.
    RepeatRound(u32),
    /// End the session early.
    Stop,
}

/// Why an order cannot be given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Barrier {
    /// The participant is at the instructions: there is no record yet.
    NotBegun,
    /// The session is over.
    Over,
    /// The program could not go on; a note is still taken.
    Stopped,
    AlreadyPaused,
    NotPaused,
    /// Practice comes before a round or in a rest, not between trials.
    BetweenTrials,
    /// The protocol has no practice.
    NoPractice,
    /// The round under way has no answers that could be replaced.
    RoundUnanswered,
    /// The round is not under way any more.
    RoundOver,
}

impl Status {
    /// What stands in the way of an order; `None` where it can be given.
    pub(crate) fn barrier(&self, order: &Order) -> Option<Barrier> {
        if self.is_over {
            return Some(Barrier::Over);
        }
        // Before the record begins an order would leave no trace.
        if !self.has_begun {
            return Some(Barrier::NotBegun);
        }
        if self.stopped.is_some() && !matches!(order, Order::Note(_)) {
            return Some(Barrier::Stopped);
        }
        match order {
            Order::Note(_) | Order::Stop => None,
            Order::Pause => self.is_paused.then_some(Barrier::AlreadyPaused),
            Order::Resume => (!self.is_paused).then_some(Barrier::NotPaused),
            Order::RepeatPractice if !self.has_practice => Some(Barrier::NoPractice),
            Order::RepeatPractice => (!self.can_repeat_practice).then_some(Barrier::BetweenTrials),
            Order::RepeatRound(round) if *round != self.progress.round => Some(Barrier::RoundOver),
            Order::RepeatRound(_) => (!self.can_repeat_round).then_some(Barrier::RoundUnanswered),
        }
    }
}
