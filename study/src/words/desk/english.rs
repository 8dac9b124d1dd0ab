//! English.

use scumble_psychophysics::{Answer, Condition, Reason};
use scumble_stimuli::{Kernel, Pattern};

use super::{DeskWords, apart};
use crate::desk::{Activity, Barrier, Chart, MinutesLeft, Point, RoundState, Status};

pub(in crate::words) const ENGLISH: DeskWords = DeskWords {
    title: "Scumble study: administrator",
    in_charge: "For the person in charge",
    in_charge_text: "The session is paused. What follows shows how it goes, and is not for the person who takes part: \
                     it could change how they answer.",
    in_charge_on: "Show it   Enter",
    in_charge_back: "Back   Esc",
    activity: |activity| match activity {
        Activity::Instructions => "Reads the instructions".to_owned(),
        Activity::Practice => "Practises".to_owned(),
        Activity::Trial(number) => format!("Looks at trial {number}"),
        Activity::RestBefore(round) => format!("Rests before round {round}"),
        Activity::RestWithin(round) => format!("Rests in round {round}"),
        Activity::Paused => "Paused".to_owned(),
        Activity::Complete => "Complete".to_owned(),
        Activity::EndedEarly => "Ended early".to_owned(),
        Activity::Stopped => "Stopped".to_owned(),
    },
    elapsed: |minutes| format!("minute {minutes}"),
    saved: "All answers are on disk",
    waiting: |problem| format!("Not saved, the session waits: {problem}"),
    stopped: |problem| {
        format!(
            "The session cannot go on: {problem}. Close the participant's window; the answers so far are kept, and when \
                 the cause is removed the session goes on from there."
        )
    },
    other_display: |name| {
        format!(
            "The session began on another display than it is shown on now: {name}. What was measured of the first one \
             does not hold here. Move it back, or end the session and set another one up."
        )
    },
    dark: "Dark",
    light: "Light",
    round: |round| format!("Round {}", round.number),
    condition,
    round_state: |round| match round.state {
        RoundState::Done => format!("done, {}", trials(round.trials())),
        RoundState::UnderWay => format!("{} of at most {}", round.trials(), trials(round.trials_at_most())),
        RoundState::Ahead => "ahead".to_owned(),
    },
    trials: |status: &Status| {
        let progress = &status.progress;
        match status.is_over {
            true => format!("{} measured", trials(progress.trials)),
            false => format!(
                "{} measured, {} to {} in all",
                trials(progress.trials),
                progress.trials_at_least,
                progress.trials_at_most
            ),
        }
    },
    minutes_left: |left| match left {
        Some(MinutesLeft { at_least, at_most }) => {
            format!("{:.0} to {:.0} minutes left, without rests", at_least.ceil(), at_most.ceil())
        }
        None => "time left not known yet".to_owned(),
    },
    lines: |tally| format!("{} of {} lines taken for steps", tally.wrong, tally.trials),
    catch_trials: |tally| format!("{} of {} catch trials missed", tally.wrong, tally.trials),
    missed_frames: |count| match count {
        0 => "no frame missed".to_owned(),
        1 => "1 frame missed".to_owned(),
        _ => format!("{count} frames missed"),
    },
    texel: |texel_px| format!("Texel {texel_px} px"),
    x_axis: "Trial of this staircase",
    y_axis: "Blur radius in px (log)",
    estimate: |chart: &Chart| {
        let (estimate, texel_px) = (&chart.estimate, chart.texel_px);
        let (low, high) = estimate.ratio_interval90;
        let name = if chart.points.is_empty() { "Prior" } else { "Estimate" };
        format!("{name} {:.1} px = {:.2} texels, 90 % {low:.2} to {high:.2}", estimate.ratio * texel_px, estimate.ratio)
    },
    point: |point: &Point| {
        let answer = match point.answer {
            Answer::Left => "left",
            Answer::Right => "right",
            Answer::Yes => "yes",
            Answer::No => "no",
        };
        let verdict = if point.is_right { "right" } else { "wrong" };
        format!(
            "Trial {}: {:.1} px = {:.2} texels, \u{201c}{answer}\u{201d}, which is {verdict}",
            point.trial_number, point.radius_px, point.ratio
        )
    },
    verdict: |chart: &Chart| {
        let (given, least, most) = (chart.trials(), chart.trials_min, chart.trials_max);
        match (chart.verdict.is_converged(), chart.is_done) {
            _ if given == 0 => "No trials so far".to_owned(),
            (true, true) => format!("Converged after {}", trials(given)),
            (true, false) => format!("Would be converged, but {given} of at least {}", trials(least)),
            (false, true) => format!("Not converged, and no more than {} allowed", trials(most)),
            (false, false) => format!("Not converged after {}", trials(given)),
        }
    },
    reason: |reason| match *reason {
        Reason::Wide { width_log10, limit_log10 } => {
            let [width, limit] = apart(width_log10, limit_log10, 2);
            format!("90 % interval {width} log units wide, at most {limit}")
        }
        Reason::OneSided { fewest, limit } => {
            format!("rarer of right and wrong answers: {fewest}, at least {limit}")
        }
        Reason::AtEdge { distance_log10, limit_log10 } => {
            let [distance, limit] = apart(distance_log10, limit_log10, 2);
            format!("estimate {distance} log units from the edge, at least {limit}")
        }
        Reason::HalvesDiffer { difference_sds, limit_sds } => {
            let [difference, limit] = apart(difference_sds, limit_sds, 1);
            format!("first and second half {difference} SD apart, at most {limit}")
        }
    },
    legend_two: "Triangles point to the picture that was named the line; filled: right, hollow: wrong. Band: 90 % \
                 interval after each trial. Dashes: estimate.",
    legend_one: "Filled circles: \u{201c}no\u{201d}, right; hollow squares: \u{201c}yes\u{201d}, wrong. Band: 90 % \
                 interval after each trial. Dashes: estimate.",
    pause: "Pause",
    resume: "Go on",
    repeat_practice: "Repeat practice",
    repeat_round: "Repeat round",
    stop: "End session early",
    round_was_over: |round| {
        format!("Round {round} was over before it could be repeated; its answers stand, and nothing was changed.")
    },
    barrier: |barrier| match barrier {
        Barrier::NotBegun => "Possible once the participant has begun.",
        Barrier::Over => "The session is over.",
        Barrier::Stopped => "The session has stopped.",
        Barrier::AlreadyPaused => "The session is paused.",
        Barrier::NotPaused => "The session is not paused.",
        Barrier::BetweenTrials => "Possible in practice and in rests.",
        Barrier::NoPractice => "The protocol has no practice.",
        Barrier::RoundUnanswered => "This round has no answers.",
        Barrier::RoundOver => "That round is over.",
    },
    ask_repeat_round: |round, answers| {
        format!("Repeat round {round}? Its {} so far stay in the record but do not count.", answers_of(answers))
    },
    ask_stop: |status: &Status| {
        format!(
            "End the session now? {} stay in the record; the session remains incomplete and cannot be continued.",
            capitalised(&answers_of(status.progress.answered))
        )
    },
    yes_repeat_round: "Repeat the round",
    yes_stop: "End the session",
    cancel: "Cancel",
    note: "Note",
    note_hint: "For the record, such as a noise outside",
    add_note: "Add",
    noted: |secs, text| format!("minute {:.0}: {text}", (secs / 60.0).floor()),
    no_notes: "No notes so far.",
};

fn condition(condition: &Condition) -> String {
    let pattern = match condition.pattern {
        Pattern::Stair => "stair",
        Pattern::Step => "step",
        Pattern::DoubleStep => "double step",
    };
    // Nearly every study has the disc.
    let kernel = match condition.kernel {
        Kernel::Disc => "",
        Kernel::Box => ", box",
        Kernel::GaussianHalf => ", Gaussian r/2",
        Kernel::GaussianThird => ", Gaussian r/3",
        Kernel::Poisson25 => ", 25 Poisson taps",
        Kernel::Poisson25Rotated => ", 25 Poisson taps, rotated",
    };
    format!("{pattern}, contrast {:.0} %{kernel}", condition.contrast * 100.0)
}

fn trials(count: u32) -> String {
    if count == 1 { "1 trial".to_owned() } else { format!("{count} trials") }
}

fn answers_of(count: u32) -> String {
    match count {
        0 => "no answers".to_owned(),
        1 => "one answer".to_owned(),
        _ => format!("{count} answers"),
    }
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}
