//! One person's answers in a series, with their place in time.

use scumble_psychophysics::{Protocol, Round};

use crate::{
    assumptions::Assumptions,
    mixed_model::PersonAnswers,
    people::Person,
    series::{catch_answers, round_of},
};

/// Half of a staircase.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Half {
    Early,
    Late,
}

impl Half {
    /// The half of trial `index` of `trials`; the middle one is late.
    pub fn of(index: usize, trials: usize) -> Self {
        if 2 * index + 1 < trials { Self::Early } else { Self::Late }
    }
}

/// Intensity and whether the answer was right; catch trials are in no half.
pub(super) type Answer = (f64, bool, Option<Half>);

/// One person's answers.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Answered {
    /// Probability of a right answer to what is not seen.
    pub guess: f64,
    /// Staircase after staircase, then the catch trials.
    pub answers: Vec<Answer>,
}

impl Answered {
    /// Those of a round.
    pub fn of(round: Round, person: &Person, protocol: &Protocol) -> Self {
        let here = person.tracks.iter().filter(|track| round_of(&track.condition) == round);
        let of_run = |responses: &[(f64, bool)]| {
            let half = |index| Some(Half::of(index, responses.len()));
            responses.iter().enumerate().map(|(index, &(x, correct))| (x, correct, half(index))).collect::<Vec<_>>()
        };
        let measured = here.flat_map(|track| &track.runs).flat_map(|run| of_run(&run.responses));
        let catches = catch_answers(person, protocol).map(|(x, correct)| (x, correct, None));
        Self { guess: Assumptions::of_person(person, protocol).guess, answers: measured.chain(catches).collect() }
    }

    /// As the model takes them.
    pub fn gathered(&self) -> PersonAnswers {
        PersonAnswers::new(self.guess, self.answers.iter().map(|&(x, correct, _)| (x, correct)))
    }
}
