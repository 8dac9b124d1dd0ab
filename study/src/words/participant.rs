//! The texts of the participant's screen, from the instructions on.

/// See [`super::Words::participant`].
///
/// A function takes numbers and gives whole sentences, since languages count in different ways.
pub(crate) struct ParticipantWords {
    pub(crate) question_two: &'static str,
    pub(crate) question_one: &'static str,

    // Instructions.
    pub(crate) what_two: &'static str,
    pub(crate) what_one: &'static str,
    /// Behind `what_one`, where lines stand among the measured trials.
    pub(crate) lines_among: &'static str,
    pub(crate) how_two: &'static str,
    pub(crate) how_one: &'static str,
    pub(crate) keys_two: &'static str,
    pub(crate) keys_one: &'static str,
    pub(crate) example_line: &'static str,
    pub(crate) example_steps: &'static str,
    pub(crate) practice_follows: fn(usize) -> String,
    pub(crate) start: &'static str,

    // Trials.
    pub(crate) left: &'static str,
    pub(crate) right: &'static str,
    pub(crate) yes: &'static str,
    pub(crate) no: &'static str,
    pub(crate) left_keys: &'static str,
    pub(crate) right_keys: &'static str,
    pub(crate) yes_keys: &'static str,
    pub(crate) no_keys: &'static str,
    /// Number of a practice trial and of them all.
    pub(crate) practice_of: fn(u32, usize) -> String,
    pub(crate) round_of: fn(u32, u32) -> String,

    // Feedback.
    pub(crate) correct: &'static str,
    pub(crate) wrong: &'static str,
    pub(crate) that_was_the_line: &'static str,
    pub(crate) the_other_was: &'static str,
    pub(crate) was_line: &'static str,
    pub(crate) was_steps: &'static str,
    pub(crate) next: &'static str,

    // Rests and pauses.
    pub(crate) rest_in_round: fn(u32, u32) -> String,
    pub(crate) it_counts_two: &'static str,
    pub(crate) it_counts_one: &'static str,
    pub(crate) rest: &'static str,
    pub(crate) paused: &'static str,
    /// Answers saved so far.
    pub(crate) saved: fn(u32) -> String,
    pub(crate) can_go_on: &'static str,
    pub(crate) go_on: &'static str,
    pub(crate) or_space: &'static str,
    pub(crate) close_window: &'static str,

    // Ends.
    pub(crate) thanks: &'static str,
    pub(crate) all_saved: &'static str,
    pub(crate) close: &'static str,
    pub(crate) stopped: &'static str,
    pub(crate) call_someone: &'static str,
    /// Where the answers are.
    pub(crate) answers_are_in: fn(&str) -> String,

    pub(crate) refused: &'static str,

    // What keeps the program from going on for a while.
    pub(crate) cannot_save: &'static str,
    pub(crate) kept_in_memory: &'static str,
    pub(crate) tries_again: &'static str,
    pub(crate) try_again: &'static str,
    pub(crate) too_small: &'static str,
    /// Needed and given size in physical pixels.
    pub(crate) pixels_needed: fn([f32; 2], [f32; 2]) -> String,
}

pub(super) const ENGLISH: ParticipantWords = ParticipantWords {
    question_two: "Which one was the line?",
    question_one: "Was the original image a line?",
    what_two: "You will see two pictures of a shadow's edge, both blurred by the same amount. \
               Before the blur, one edge was a straight line. The other was made of steps.",
    what_one: "You will see one picture of a shadow's edge at a time, and it is blurred. Was the edge \
               a straight line before the blur, or was it made of steps?",
    lines_among: " Some of the pictures are lines, others are not.",
    how_two: "Say each time which one was the line. Take the time you need. Many pairs are too \
              blurred to be sure; then guess, a guess helps as much as any other answer.",
    how_one: "Say each time whether it was a line. Take the time you need. Many pictures are too \
              blurred to be sure; then say what seems more likely, that helps as much as any other answer.",
    keys_two: "Left: left arrow key or F.   Right: right arrow key or J.   Pause: Escape.",
    keys_one: "Yes: left arrow key or Y.   No: right arrow key or N.   Pause: Escape.",
    example_line: "A line",
    example_steps: "Not a line: steps",
    practice_follows: |count| match count {
        0 => "There are no trials to practise with.".to_owned(),
        1 => "The first trial is for practice: you will be told whether you were right.".to_owned(),
        _ => format!("The first {count} trials are for practice: you will be told whether you were right."),
    },
    start: "Start",
    left: "Left",
    right: "Right",
    yes: "Yes, a line",
    no: "No",
    left_keys: "left arrow or F",
    right_keys: "right arrow or J",
    yes_keys: "left arrow or Y",
    no_keys: "right arrow or N",
    practice_of: |number, count| format!("Practice {number} of {count}"),
    round_of: |round, rounds| format!("Round {round} of {rounds}"),
    correct: "Correct",
    wrong: "Not this time",
    that_was_the_line: "That was the line.",
    the_other_was: "The line was the other one.",
    was_line: "It was a line.",
    was_steps: "It was not a line: it was made of steps.",
    next: "Next",
    rest_in_round: |round, rounds| format!("A rest in round {round} of {rounds}"),
    it_counts_two: "From here on your answers count, and you are not told whether they were right. \
                    Pairs that look alike are part of it: guess.",
    it_counts_one: "From here on your answers count, and you are not told whether they were right. \
                    Pictures that leave you in doubt are part of it: say what seems more likely.",
    rest: "Rest your eyes for a moment: look up and into the distance. Go on when you are ready.",
    paused: "Paused",
    saved: |answers| match answers {
        0 => "Your answers are saved.".to_owned(),
        1 => "One trial is answered and saved.".to_owned(),
        _ => format!("{answers} trials are answered and saved."),
    },
    can_go_on: "You can go on, or close the window and continue on another day.",
    go_on: "Go on",
    or_space: "or press the space bar",
    close_window: "Close the window",
    thanks: "Thank you",
    all_saved: "The session is over. Your answers are saved.",
    close: "Close",
    stopped: "The session has stopped",
    call_someone: "Please call the person who runs the study.",
    answers_are_in: |folder| {
        format!("The answers given so far are in {folder}. When the cause is removed, --resume goes on from there.")
    },
    refused: "The session cannot begin",
    cannot_save: "Your last answer could not be saved yet",
    kept_in_memory: "It is not lost: the program keeps it and waits. Please call the person who runs the study.",
    tries_again: "The program tries again every two seconds and goes on by itself when it can.",
    try_again: "Try again now",
    too_small: "The window is too small",
    pixels_needed: |needed, given| {
        let [needed, given] = [needed, given].map(|[width, height]| format!("{width:.0} x {height:.0}"));
        format!(
            "The pictures need {needed} physical pixels, the window has {given}. Make it larger, or choose a \
             display with more pixels."
        )
    },
};

pub(super) const GERMAN: ParticipantWords = ParticipantWords {
    question_two: "Welches war die Linie?",
    question_one: "War das ursprüngliche Bild eine Linie?",
    what_two: "Sie sehen jeweils zwei Bilder eines Schattenrands, beide gleich stark unscharf. Ohne die \
               Unschärfe war der eine Rand eine gerade Linie, der andere bestand aus Stufen.",
    what_one: "Sie sehen jeweils ein unscharfes Bild eines Schattenrands. War der Rand ohne die Unschärfe \
               eine gerade Linie, oder bestand er aus Stufen?",
    lines_among: " Manche der Bilder sind Linien, andere nicht.",
    how_two: "Sagen Sie jedes Mal, welches die Linie war. Nehmen Sie sich Zeit. Oft sind die Bilder so \
              unscharf, dass man nicht sicher sein kann; raten Sie dann, auch das hilft uns.",
    how_one: "Sagen Sie jedes Mal, ob es eine Linie war. Nehmen Sie sich Zeit. Oft ist das Bild so unscharf, \
              dass man nicht sicher sein kann; antworten Sie dann, was Ihnen wahrscheinlicher vorkommt.",
    keys_two: "Links: Pfeiltaste links oder F.   Rechts: Pfeiltaste rechts oder J.   Pause: Escape.",
    keys_one: "Ja: Pfeiltaste links oder J.   Nein: Pfeiltaste rechts oder N.   Pause: Escape.",
    example_line: "Eine Linie",
    example_steps: "Keine Linie: Stufen",
    practice_follows: |count| match count {
        0 => "Es gibt keine Übungsdurchgänge.".to_owned(),
        1 => "Der erste Durchgang ist eine Übung: Sie erfahren, ob Ihre Antwort richtig war.".to_owned(),
        _ => format!("Die ersten {count} Durchgänge sind Übung: Sie erfahren, ob Ihre Antwort richtig war."),
    },
    start: "Beginnen",
    left: "Links",
    right: "Rechts",
    yes: "Ja, eine Linie",
    no: "Nein",
    left_keys: "Pfeil links oder F",
    right_keys: "Pfeil rechts oder J",
    yes_keys: "Pfeil links oder J",
    no_keys: "Pfeil rechts oder N",
    practice_of: |number, count| format!("Übung {number} von {count}"),
    round_of: |round, rounds| format!("Runde {round} von {rounds}"),
    correct: "Richtig",
    wrong: "Diesmal nicht",
    that_was_the_line: "Das war die Linie.",
    the_other_was: "Die Linie war das andere Bild.",
    was_line: "Es war eine Linie.",
    was_steps: "Es war keine Linie: Der Rand bestand aus Stufen.",
    next: "Weiter",
    rest_in_round: |round, rounds| format!("Eine Pause in Runde {round} von {rounds}"),
    it_counts_two: "Ab hier zählen Ihre Antworten, und Sie erfahren nicht mehr, ob sie richtig waren. \
                    Manche Paare sehen gleich aus, das gehört dazu: Raten Sie.",
    it_counts_one: "Ab hier zählen Ihre Antworten, und Sie erfahren nicht mehr, ob sie richtig waren. Bei manchen \
                    Bildern werden Sie unsicher sein: Antworten Sie, was Ihnen wahrscheinlicher vorkommt.",
    rest: "Ruhen Sie Ihre Augen kurz aus: Blicken Sie auf und in die Ferne. Machen Sie weiter, wenn Sie bereit sind.",
    paused: "Pause",
    saved: |answers| match answers {
        0 => "Ihre Antworten sind gespeichert.".to_owned(),
        1 => "Ein Durchgang ist beantwortet und gespeichert.".to_owned(),
        _ => format!("{answers} Durchgänge sind beantwortet und gespeichert."),
    },
    can_go_on: "Sie können weitermachen, oder das Fenster schließen und an einem anderen Tag fortfahren.",
    go_on: "Weiter",
    or_space: "oder die Leertaste",
    close_window: "Fenster schließen",
    thanks: "Vielen Dank",
    all_saved: "Die Sitzung ist zu Ende. Ihre Antworten sind gespeichert.",
    close: "Schließen",
    stopped: "Die Sitzung wurde abgebrochen",
    call_someone: "Bitte rufen Sie die Versuchsleitung.",
    answers_are_in: |folder| {
        format!(
            "Die bisherigen Antworten liegen in {folder}. Ist die Ursache behoben, geht es mit --resume dort weiter."
        )
    },
    refused: "Die Sitzung kann nicht beginnen",
    cannot_save: "Ihre letzte Antwort konnte noch nicht gespeichert werden",
    kept_in_memory: "Sie ist nicht verloren: Das Programm behält sie und wartet. Bitte rufen Sie die Versuchsleitung.",
    tries_again: "Das Programm versucht es alle zwei Sekunden wieder und macht dann von selbst weiter.",
    try_again: "Jetzt versuchen",
    too_small: "Das Fenster ist zu klein",
    pixels_needed: |needed, given| {
        let [needed, given] = [needed, given].map(|[width, height]| format!("{width:.0} x {height:.0}"));
        format!(
            "Die Bilder brauchen {needed} Bildpunkte, das Fenster hat {given}. Vergrößern Sie es, oder wählen Sie \
             einen Bildschirm mit mehr Bildpunkten."
        )
    },
};
