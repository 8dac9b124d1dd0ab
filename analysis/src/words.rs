//! The words of records and tables, and what each means: for the descriptions of columns.

use crate::column::Levels;

/// How the silhouette lies on the texels.
pub(crate) const PATTERNS: Levels = &[
    ("stair", "a silhouette at 45 degrees: one step per texel"),
    ("step", "an almost axis-aligned silhouette: a single step across the picture"),
    ("double_step", "a silhouette at nearly 45 degrees: a stair with one tread two texels wide"),
];

/// What blurs the silhouette.
pub(crate) const KERNELS: Levels = &[
    ("disc", "uniform over a disc of the radius"),
    ("box", "uniform over a square whose half side is the radius"),
    ("gauss2", "Gaussian whose standard deviation is half the radius"),
    ("gauss3", "Gaussian whose standard deviation is a third of the radius"),
    ("poisson25", "25 points of a Poisson disc of the radius"),
    ("poisson25_rotated", "25 points of a Poisson disc of the radius, turned by an angle of each pixel's own"),
];

/// Answers of a participant.
pub(crate) const ANSWERS: Levels = &[
    ("left", "the left picture was the line"),
    ("right", "the right picture was the line"),
    ("yes", "the original image was a line"),
    ("no", "the original image was not a line"),
];

#[cfg(test)]
mod tests {
    use scumble_psychophysics::Answer;
    use scumble_stimuli::{Kernel, Pattern};

    use super::*;
    use crate::column::{Cell, word};

    #[test]
    fn every_word_of_a_condition_and_an_answer_is_described() {
        let described = |levels: Levels, found: Cell| levels.iter().any(|(word, _)| Some((*word).to_owned()) == found);
        assert!(Kernel::NAMED.iter().all(|(_, kernel)| described(KERNELS, word(kernel))));
        let patterns = [Pattern::Stair, Pattern::Step, Pattern::DoubleStep];
        assert!(patterns.iter().all(|pattern| described(PATTERNS, word(pattern))));
        let answers = [Answer::Left, Answer::Right, Answer::Yes, Answer::No];
        assert!(answers.iter().all(|answer| described(ANSWERS, word(answer))));
    }
}
