//! The columns of an events table: every fact of the record that is not the whole session's.
//!
//! `onset` and `duration` come first, as BIDS asks; `trial_type` and `response_time` have BIDS' meaning.

use scumble_psychophysics::{Answered, Pictures};
use scumble_stimuli::{Shape, Stimulus};

use super::event_row::EventRow;
use crate::column::{self, Cell, Levels, YES_NO, flag, number, word};
use crate::words::{ANSWERS, KERNELS, PATTERNS};

/// A column of events.
type Column<'a> = column::Column<EventRow<'a>>;

/// Roles of answered trials, and events without an answer.
const TRIAL_TYPES: Levels = &[
    ("measure", "trial whose answer a staircase learned from"),
    ("line", "a filtered line alone, to count false alarms; no staircase learned from it"),
    ("catch", "an artifact that everyone sees who looks; no staircase learned from it"),
    ("practice", "trial with feedback, before the measurement"),
    ("pause", "the session was interrupted"),
    ("resume", "the session was taken up again"),
    ("note", "the administrator wrote the note in the column notes"),
    ("repeat_practice", "the administrator let practice begin anew"),
    ("repeat_round", "the administrator let the round under way begin anew; its answers so far do not stand"),
    ("stop", "the administrator ended the session early"),
    ("end", "the session is complete"),
];

const SHOWN: Levels = &[
    ("line_left", "two pictures, the left one made from the line, the right one from the artifact"),
    ("line_right", "two pictures, the right one made from the line, the left one from the artifact"),
    ("line", "one picture, made from the line"),
    ("artifact", "one picture, made from the artifact"),
];

const ENCODINGS: Levels = &[
    ("linear_light", "coverage and contrast are proportional to the display's light above its black"),
    ("code_values", "coverage and contrast are proportional to the display's code value"),
];

/// Every column, in order.
pub(super) fn event_columns<'a>() -> Vec<Column<'a>> {
    let mut columns = when();
    columns.extend(what());
    columns.extend(pictures());
    columns.extend(answers());
    columns.extend(notes());
    columns
}

/// When it happened and what kind of event it is.
fn when<'a>() -> Vec<Column<'a>> {
    let onset = "Since the session began, interruptions included. Of a trial: the frame that first showed its \
                 pictures. Of any other event: by the clock, and no earlier than the answer before it in the \
                 record and no later than the pictures that follow.";
    vec![
        Column::new("onset", "Onset", onset, |row| number(row.onset_secs)).in_units("s"),
        Column::new("duration", "Duration", "Pictures stay until the answer; other events last 0 s.", |row| {
            number(row.answered().map_or(0.0, |answered| answered.response_time_secs))
        })
        .in_units("s"),
        Column::new(
            "trial_type",
            "Type of event",
            "Role of an answered trial, or another event.",
            EventRow::trial_type,
        )
        .of_levels(TRIAL_TYPES),
        Column::new("response_time", "Response time", "From the first frame of the pictures to the answer.", |row| {
            number(row.answered()?.response_time_secs)
        })
        .in_units("s"),
    ]
}

/// What was asked and why.
fn what<'a>() -> Vec<Column<'a>> {
    vec![
        Column::new(
            "trial_number",
            "Number of the trial",
            "From 1 through the session; practice trials count by themselves.",
            |row| Some(row.answered()?.trial.number.to_string()),
        ),
        Column::new("round", "Round", "From 1; 0 for practice.", |row| Some(row.answered()?.trial.round.to_string())),
        Column::new(
            "track",
            "Staircase",
            "The staircase that chose the radius, counted from 0 in the order of the session.",
            |row| Some(row.answered()?.trial.track?.to_string()),
        ),
        Column::new("pattern", "Pattern", "How the silhouette lies on the texels.", |row| {
            word(row.answered()?.trial.condition.pattern)
        })
        .of_levels(PATTERNS),
        Column::new("contrast", "Contrast", "Lit side relative to the brightest, in the encoding.", |row| {
            number(row.answered()?.trial.condition.contrast)
        }),
        Column::new("kernel", "Filter", "What blurs the silhouette.", |row| {
            word(row.answered()?.trial.condition.kernel)
        })
        .of_levels(KERNELS),
        Column::new("texel_px", "Texel", "Side of a shadow-map texel on the screen, in physical pixels.", |row| {
            number(row.answered()?.trial.condition.texel_px)
        })
        .in_units("px"),
        Column::new("placement_radius_px", "Radius asked for", "Radius that the staircase chose.", |row| {
            number(row.answered()?.trial.placement_radius_px)
        })
        .in_units("px"),
        Column::new("radius_px", "Radius", "Radius of the filter as shown: what pictures can hold.", |row| {
            number(row.answered()?.trial.radius_px)
        })
        .in_units("px"),
        Column::new("ratio", "Ratio", "Radius as shown, in texels.", |row| number(row.answered()?.trial.ratio()))
            .in_units("texel"),
    ]
}

/// The pictures, so that they can be drawn again.
fn pictures<'a>() -> Vec<Column<'a>> {
    vec![
        Column::new("shown", "Pictures", "What was shown and where the line was.", shown).of_levels(SHOWN),
        Column::new(
            "phase",
            "Phase",
            "Place of the steps along the line, 0 to 1 of the range it is drawn from.",
            |row| number(first(row)?.phase),
        ),
        Column::new("mirrored", "Mirrored", "Whether left and right are swapped.", |row| flag(first(row)?.mirrored))
            .of_levels(YES_NO),
        Column::new("inverted", "Inverted", "Whether the shadow lies above the edge.", |row| {
            flag(first(row)?.inverted)
        })
        .of_levels(YES_NO),
        Column::new("encoding", "Encoding", "What the filter averages and the contrast scales.", |row| {
            word(first(row)?.encoding)
        })
        .of_levels(ENCODINGS),
        Column::new("tilt_rad", "Tilt", "Turn of the left or only picture.", |row| number(first(row)?.tilt_rad))
            .in_units("rad"),
        Column::new("tilt_right_rad", "Tilt on the right", "Turn of the right one of two pictures.", |row| {
            number(second(row)?.tilt_rad)
        })
        .in_units("rad"),
        Column::new("dither_seed", "Seed of the dithering", "Of the left or only picture.", |row| {
            Some(first(row)?.dither_seed?.to_string())
        }),
        Column::new("dither_seed_right", "Seed of the dithering on the right", "Of the right one of two.", |row| {
            Some(second(row)?.dither_seed?.to_string())
        }),
        Column::new("picture_sha256", "Hash of the picture", "SHA-256 of the left or only picture as drawn.", |row| {
            row.answered()?.pictures_sha256.first().cloned()
        }),
        Column::new("picture_right_sha256", "Hash of the picture on the right", "Of the right one of two.", |row| {
            row.answered()?.pictures_sha256.get(1).cloned()
        }),
    ]
}

/// What was answered and whether it counts.
fn answers<'a>() -> Vec<Column<'a>> {
    let missed = "Display refreshes by which the pictures came later than due.";
    vec![
        Column::new("answer", "Answer", "To the question: which one was the line, or was it a line.", |row| {
            word(row.answered()?.answer)
        })
        .of_levels(ANSWERS),
        Column::new("right_answer", "Right answer", "What the pictures were made from.", |row| {
            word(row.answered()?.trial.pictures.right_answer())
        })
        .of_levels(ANSWERS),
        Column::new("correct", "Correct", "Whether the answer was right.", |row| flag(row.answered()?.correct))
            .of_levels(YES_NO),
        Column::new("missed_frames", "Missed frames", missed, |row| {
            Some(row.answered()?.timing?.missed_frames.to_string())
        }),
        Column::new("stands", "Stands", "Whether the answer counts.", |row| flag(row.stands?))
            .of_levels(&[("1", "yes"), ("0", "no: its round was repeated later")]),
    ]
}

/// What was written down, and where it stands in the record.
fn notes<'a>() -> Vec<Column<'a>> {
    let notes = "Notes of the administrator or the program. Tabs, line ends and backslashes are written \\t, \\n \
                 and \\\\; several notes are several lines.";
    vec![
        Column::new("time", "Time of day", "Of an event without answer, UTC, by the computer's clock.", |row| {
            Some(row.moment()?.at.to_string())
        }),
        Column::new(
            "interrupted_secs",
            "Interruption",
            "Age of the interruption when the session was resumed.",
            |row| number(row.moment()?.interrupted_secs?),
        )
        .in_units("s"),
        Column::new("notes", "Notes", notes, |row| {
            let notes = &row.moment()?.notes;
            (!notes.is_empty()).then(|| notes.join("\n"))
        }),
        Column::new("line", "Line", "Line of events.jsonl, the session's record, from 1.", |row| {
            Some(row.line.to_string())
        }),
    ]
}

fn shown(row: &EventRow) -> Cell {
    let words = match row.answered()?.trial.pictures {
        Pictures::Pair { left: Stimulus { shape: Shape::Line, .. }, .. } => "line_left",
        Pictures::Pair { .. } => "line_right",
        Pictures::Single { picture: Stimulus { shape: Shape::Line, .. } } => "line",
        Pictures::Single { .. } => "artifact",
    };
    Some(words.to_owned())
}

/// The left or only picture.
fn first<'a>(row: &'a EventRow) -> Option<&'a Stimulus> {
    picture(row.answered()?, 0)
}

/// The right one of two pictures.
fn second<'a>(row: &'a EventRow) -> Option<&'a Stimulus> {
    picture(row.answered()?, 1)
}

fn picture(answered: &Answered, place: usize) -> Option<&Stimulus> {
    answered.trial.pictures.all().into_iter().nth(place)
}

#[cfg(test)]
mod tests {
    use scumble_stimuli::Encoding;

    use super::*;

    #[test]
    fn every_encoding_is_described() {
        for encoding in [Encoding::LinearLight, Encoding::CodeValues] {
            assert!(ENCODINGS.iter().any(|(name, _)| Some((*name).to_owned()) == word(encoding)));
        }
    }
}
