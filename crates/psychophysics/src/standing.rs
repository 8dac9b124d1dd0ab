//! Which answers stand: those of a round that was repeated do not.

use crate::event::{Answered, Event};
use crate::read::Session;

/// The answers of a record that stand, in order: those of practice, and those whose round was not repeated
/// after them.
pub fn standing(events: &[Event]) -> Vec<&Answered> {
    let mut standing: Vec<&Answered> = Vec::new();
    for event in events {
        if let Event::RepeatRound(_) = event {
            // Rounds come in order, so the round under way is the highest one.
            let round = standing.iter().map(|answered| answered.trial.round).max();
            standing.retain(|answered| answered.trial.round == 0 || Some(answered.trial.round) != round);
        }
        standing.extend(event.answered());
    }
    standing
}

impl Session {
    /// Its answers that stand, as by [`standing`].
    pub fn standing(&self) -> Vec<&Answered> {
        standing(&self.events)
    }
}
