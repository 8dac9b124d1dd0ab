//! German.

use scumble_psychophysics::{Answer, Condition, Reason};
use scumble_stimuli::{Kernel, Pattern};

use super::{DeskWords, apart};
use crate::desk::{Activity, Barrier, Chart, MinutesLeft, Point, RoundState, Status};

pub(in crate::words) const GERMAN: DeskWords = DeskWords {
    title: "Scumble-Studie: Versuchsleitung",
    in_charge: "Für die Versuchsleitung",
    in_charge_text: "Die Sitzung ist angehalten. Als Nächstes ist zu sehen, wie sie verläuft. Das ist nicht für die \
                     Versuchsperson bestimmt, denn es könnte ihre Antworten beeinflussen.",
    in_charge_on: "Anzeigen   Eingabe",
    in_charge_back: "Zurück   Esc",
    activity: |activity| match activity {
        Activity::Instructions => "Liest die Anleitung".to_owned(),
        Activity::Practice => "Übt".to_owned(),
        Activity::Trial(number) => format!("Bearbeitet Durchgang {number}"),
        Activity::RestBefore(round) => format!("Pause vor Runde {round}"),
        Activity::RestWithin(round) => format!("Pause in Runde {round}"),
        Activity::Paused => "Angehalten".to_owned(),
        Activity::Complete => "Vollständig".to_owned(),
        Activity::EndedEarly => "Vorzeitig beendet".to_owned(),
        Activity::Stopped => "Abgebrochen".to_owned(),
    },
    elapsed: |minutes| format!("Minute {minutes}"),
    saved: "Alle Antworten sind gespeichert",
    waiting: |problem| format!("Nicht gespeichert, die Sitzung wartet: {problem}"),
    stopped: |problem| {
        format!(
            "Die Sitzung kann nicht weitergehen. Schließen Sie das Fenster der Versuchsperson; die bisherigen Antworten \
                 bleiben erhalten, und ist die Ursache behoben, geht es dort weiter. Meldung: {problem}"
        )
    },
    other_display: |name| {
        format!(
            "Die Sitzung begann auf einem anderen Bildschirm als dem, auf dem sie jetzt zu sehen ist: {name}. Was für \
             den ersten gemessen wurde, gilt hier nicht. Bringen Sie sie dorthin zurück, oder beenden Sie sie und \
             richten Sie eine neue ein."
        )
    },
    dark: "Dunkel",
    light: "Hell",
    round: |round| format!("Runde {}", round.number),
    condition,
    round_state: |round| match round.state {
        RoundState::Done => format!("fertig, {}", trials(round.trials())),
        RoundState::UnderWay => format!("{} von höchstens {}", round.trials(), of_trials(round.trials_at_most())),
        RoundState::Ahead => "folgt noch".to_owned(),
    },
    trials: |status: &Status| {
        let progress = &status.progress;
        match status.is_over {
            true => format!("{} gemessen", trials(progress.trials)),
            false => format!(
                "{} gemessen, insgesamt {} bis {}",
                trials(progress.trials),
                progress.trials_at_least,
                progress.trials_at_most
            ),
        }
    },
    minutes_left: |left| match left {
        Some(MinutesLeft { at_least, at_most }) => {
            format!("noch {:.0} bis {:.0} Minuten ohne Pausen", at_least.ceil(), at_most.ceil())
        }
        None => "verbleibende Zeit noch unbekannt".to_owned(),
    },
    lines: |tally| format!("{} von {} Linien für Stufen gehalten", tally.wrong, tally.trials),
    catch_trials: |tally| format!("{} von {} Kontrolldurchgängen verfehlt", tally.wrong, tally.trials),
    missed_frames: |count| match count {
        0 => "kein Bild zu spät".to_owned(),
        1 => "Bilder um 1 Bildwiederholung zu spät".to_owned(),
        _ => format!("Bilder um {count} Bildwiederholungen zu spät"),
    },
    texel: |texel_px| format!("Texel {} px", decimal(texel_px)),
    x_axis: "Durchgang dieses Verfahrens",
    y_axis: "Radius der Unschärfe in px (log)",
    estimate: |chart: &Chart| {
        let (estimate, texel_px) = (&chart.estimate, chart.texel_px);
        let (low, high) = estimate.ratio_interval90;
        let name = if chart.points.is_empty() { "Vorwissen" } else { "Schätzung" };
        format!(
            "{name} {} px = {} Texel, 90 % {} bis {}",
            decimals(estimate.ratio * texel_px, 1),
            decimals(estimate.ratio, 2),
            decimals(low, 2),
            decimals(high, 2)
        )
    },
    point: |point: &Point| {
        let answer = match point.answer {
            Answer::Left => "links",
            Answer::Right => "rechts",
            Answer::Yes => "ja",
            Answer::No => "nein",
        };
        let verdict = if point.is_right { "richtig" } else { "falsch" };
        format!(
            "Durchgang {}: {} px = {} Texel, \u{201e}{answer}\u{201c} war {verdict}",
            point.trial_number,
            decimals(point.radius_px, 1),
            decimals(point.ratio, 2)
        )
    },
    verdict: |chart: &Chart| {
        let (given, least, most) = (chart.trials(), chart.trials_min, chart.trials_max);
        match (chart.verdict.is_converged(), chart.is_done) {
            _ if given == 0 => "Noch keine Durchgänge".to_owned(),
            (true, true) => format!("Konvergiert nach {}", of_trials(given)),
            (true, false) => format!("Wäre konvergiert, aber erst {given} von mindestens {}", of_trials(least)),
            (false, true) => format!("Nicht konvergiert, mehr als {} sind nicht vorgesehen", trials(most)),
            (false, false) => format!("Nicht konvergiert nach {}", of_trials(given)),
        }
    },
    reason: |reason| match *reason {
        Reason::Wide { width_log10, limit_log10 } => {
            let [width, limit] = apart(width_log10, limit_log10, 2).map(|text| text.replace('.', ","));
            format!("90-%-Intervall {width} log-Einheiten breit, höchstens {limit}")
        }
        Reason::OneSided { fewest, limit } => {
            format!("seltenere Antwort, richtig oder falsch: {fewest}, mindestens {limit}")
        }
        Reason::AtEdge { distance_log10, limit_log10 } => {
            let [distance, limit] = apart(distance_log10, limit_log10, 2).map(|text| text.replace('.', ","));
            format!("Schätzung {distance} log-Einheiten vom Rand, mindestens {limit}")
        }
        Reason::HalvesDiffer { difference_sds, limit_sds } => {
            let [difference, limit] = apart(difference_sds, limit_sds, 1).map(|text| text.replace('.', ","));
            format!("erste und zweite Hälfte {difference} SD auseinander, höchstens {limit}")
        }
    },
    legend_two: "Die Dreiecke zeigen auf das Bild, das als Linie benannt wurde; gefüllt: richtig, hohl: falsch. Band: \
                 90-%-Intervall nach jedem Durchgang. Gestrichelt: Schätzung.",
    legend_one: "Gefüllte Kreise: „Nein“, richtig; hohle Quadrate: „Ja“, falsch. Band: 90-%-Intervall nach jedem \
                 Durchgang. Gestrichelt: Schätzung.",
    pause: "Anhalten",
    resume: "Fortsetzen",
    repeat_practice: "Übung wiederholen",
    repeat_round: "Runde wiederholen",
    stop: "Vorzeitig beenden",
    round_was_over: |round| {
        format!(
            "Runde {round} war vorbei, bevor sie wiederholt werden konnte; ihre Antworten gelten, nichts wurde geändert."
        )
    },
    barrier: |barrier| match barrier {
        Barrier::NotBegun => "Möglich, sobald die Sitzung begonnen hat.",
        Barrier::Over => "Die Sitzung ist zu Ende.",
        Barrier::Stopped => "Die Sitzung wurde abgebrochen.",
        Barrier::AlreadyPaused => "Die Sitzung ist angehalten.",
        Barrier::NotPaused => "Die Sitzung ist nicht angehalten.",
        Barrier::BetweenTrials => "Möglich in der Übung und in Pausen.",
        Barrier::NoPractice => "Das Protokoll hat keine Übung.",
        Barrier::RoundUnanswered => "Diese Runde hat noch keine Antworten.",
        Barrier::RoundOver => "Diese Runde ist vorbei.",
    },
    ask_repeat_round: |round, answers| match answers {
        1 => format!("Runde {round} wiederholen? Die Antwort dieser Runde bleibt aufgezeichnet, zählt aber nicht."),
        _ => format!(
            "Runde {round} wiederholen? Die {answers} Antworten dieser Runde bleiben aufgezeichnet, zählen aber nicht."
        ),
    },
    ask_stop: |status: &Status| {
        let answers = match status.progress.answered {
            0 => "Es gibt noch keine Antworten".to_owned(),
            1 => "Eine Antwort bleibt aufgezeichnet".to_owned(),
            count => format!("{count} Antworten bleiben aufgezeichnet"),
        };
        format!("Sitzung jetzt beenden? {answers}; die Sitzung bleibt unvollständig und lässt sich nicht fortsetzen.")
    },
    yes_repeat_round: "Runde wiederholen",
    yes_stop: "Sitzung beenden",
    cancel: "Abbrechen",
    note: "Notiz",
    note_hint: "Für die Aufzeichnung, etwa ein Geräusch von draußen",
    add_note: "Hinzufügen",
    noted: |secs, text| format!("Minute {:.0}: {text}", (secs / 60.0).floor()),
    no_notes: "Noch keine Notizen.",
};

fn condition(condition: &Condition) -> String {
    let pattern = match condition.pattern {
        Pattern::Stair => "Treppe",
        Pattern::Step => "Stufe",
        Pattern::DoubleStep => "Doppelstufe",
    };
    // Nearly every study has the disc.
    let kernel = match condition.kernel {
        Kernel::Disc => "",
        Kernel::Box => ", Quadrat",
        Kernel::GaussianHalf => ", Gauß r/2",
        Kernel::GaussianThird => ", Gauß r/3",
        Kernel::Poisson25 => ", 25 Poisson-Proben",
        Kernel::Poisson25Rotated => ", 25 Poisson-Proben, gedreht",
    };
    format!("{pattern}, Kontrast {:.0} %{kernel}", condition.contrast * 100.0)
}

fn trials(count: u32) -> String {
    if count == 1 { "1 Durchgang".to_owned() } else { format!("{count} Durchgänge") }
}

fn of_trials(count: u32) -> String {
    if count == 1 { "1 Durchgang".to_owned() } else { format!("{count} Durchgängen") }
}

fn decimal(value: f64) -> String {
    value.to_string().replace('.', ",")
}

fn decimals(value: f64, places: usize) -> String {
    format!("{value:.places$}").replace('.', ",")
}
