//! In English.

use scumble_psychophysics::{Consent, Demographics, Display, Task};

use super::{SetupWords, told};
use crate::session_folder::Found;
use crate::setup::{ConsentProblem, Effort, FolderProblem, MeasuredDisplay, Page, Problem, SRGB_LEVEL};
use crate::setup::{gamma, is_near_srgb};

pub(in crate::words) const ENGLISH: SetupWords = SetupWords {
    title,
    progress: |number, count| format!("{number} of {count}"),
    keys,
    back: "Back",
    next: "Next",
    problem,
    folder_problem,

    folder: "Study folder",
    folder_hint: "type a path, or drop the folder here",
    recent: "Recent studies",
    protocol: "Protocol",
    task: |task| match task {
        Task::TwoAlternative => "Two pictures at a time: which one was the line?",
        Task::YesNo => "One picture at a time: was the original image a line?",
    },
    effort,
    protocol_first: "Name the study's folder first: it may hold a protocol already.",
    protocol_new: "No study is in this folder yet: a new one begins, with a copy of this protocol for every \
                   participant after.",
    protocol_kept: "From protocol.toml in the study's folder, the same for every participant.",
    language: "Language",
    participant: "Participant's code",
    participant_hint: "for example p07",
    participant_note: "A code, never a name: 1 to 16 letters, digits, - and _.",
    participant_value: |code, number| match number {
        Some(number) => format!("{code}, number {number}"),
        None => code.to_owned(),
    },
    number: "number for the order of rounds",
    monitor: "Monitor",
    monitor_named,
    elsewhere: "Window",
    elsewhere_value: |found| {
        format!("is on another monitor: {}. Go back to the first page and choose again.", monitor_named(found))
    },
    interrupted: "That session",
    resume: "Go on with it",
    repeat_round: "Repeat its round",
    discard: "Discard it",

    distance: "Viewing distance",
    distance_text: "Distance from the participant's eyes to the screen:",
    card: "Outline of a card",
    card_text: "Hold a bank card, or any card of that size (85.6 x 54 mm), flat against the screen with its left \
                edge on the outline's. Make the outline as wide as the card: with the arrow keys, finely with \
                Shift, or by dragging; then press Enter. If it is as wide from the start, choose \
                \u{201c}It matches\u{201d}.",
    card_matches: "It matches",
    not_measured: "Not measured",
    pixel_size: "Pixels per mm",
    pixel_angle: "Pixels per degree",
    texels: "Texels",
    distance_value: |mm| match mm {
        Some(mm) => format!("{:.1} cm", mm / 10.0),
        None => "not measured".to_owned(),
    },
    pixel_size_value: |px_per_mm| px_per_mm.map_or_else(|| "not measured".to_owned(), |value| format!("{value:.2}")),
    pixel_angle_value: |value| match value {
        Some(value) => format!("{value:.1}"),
        None => "unknown, without distance and pixel size".to_owned(),
    },
    texels_value: |sizes| {
        let of = |(px, arcmin): &(f64, f64)| format!("{px}\u{a0}px\u{a0}=\u{a0}{arcmin:.1}'");
        format!("{} (minutes of arc)", sizes.iter().map(of).collect::<Vec<_>>().join(",  "))
    },

    brightness: "Brightness",
    gamma_text: "Step back two metres, or narrow your eyes, until the rows on the left become one grey. Change the \
                 grey on the right with the arrow keys, finely with Shift, until both fields look alike; then press Enter.",
    grey: "Grey",
    gamma_alike: "They look alike",
    not_checked: "Not checked",
    gamma_result,
    table_text: |rows| {
        format!(
            "The display was measured: luminance.csv in the study's folder has {}. The pictures are drawn for this \
             curve, so there is nothing to adjust here.\n\nThe line is the light of each level, a dot is a \
             measurement. The broad line is sRGB, for comparison.",
            range(rows)
        )
    },
    luminance: |value| format!("{value} cd/m\u{b2}"),
    brightness_value,

    room: "Room",
    room_text: "Describe the light in the room, so that somebody else could set it up again.",
    room_hint: "For example: ceiling lamps off, desk lamp behind the display on, blinds closed; no reflections on the \
                screen from where the participant sits; display warmed up for half an hour.",
    room_note: "Kept with the session. Leave it empty if there is nothing to say.",
    room_next: "The next pages are for the participant: please hand over the keyboard.",
    room_value: |note| note.map_or_else(|| "no note".to_owned(), |note| note.replace('\n', " ")),
    hand_over: "Hand over to the participant",

    consent: "Consent",
    consent_text: "Please read this text, and ask whatever you want to know.",
    has_agreed: "You have agreed to this text.",
    agree: "I agree",
    disagree: "I do not agree",
    consent_value: |consent| match consent {
        Some(Consent { text_sha256, agreed_at }) => {
            let fingerprint: String = text_sha256.chars().take(12).collect();
            format!("agreed on {}, text {fingerprint}...", agreed_at.strftime("%Y-%m-%d at %H:%M UTC"))
        }
        None => "not asked: the study has no consent text".to_owned(),
    },
    declined: "That is all right. Nothing was recorded, and nothing will be. Thank you for coming.",
    close: "Close the program",

    about: "About you",
    about_text: "You may leave any of these questions unanswered.",
    age: "Age in years",
    gender: "Gender",
    genders: ["female", "male", "other"],
    hand: "Writing hand",
    hands: ["left", "right", "both"],
    vision: "Eyesight today",
    visions: ["normal", "with glasses or lenses", "impaired"],
    experience: "Computer graphics",
    experiences: ["no experience", "some", "expert"],
    no_answer: "no answer",
    about_value,

    summary_text: "This will be recorded when you start:",
    summary_each_trial: "And of every trial: the pictures, the answer, and the time that it took.",
    unfinished: |page| format!("Something is missing on the page \"{}\".", title(page)),
    start: "Start",
};

fn title(page: Page) -> &'static str {
    match page {
        Page::Study => "Study",
        Page::Screen => "Screen",
        Page::Brightness => "Brightness",
        Page::Room => "Room",
        Page::Consent => "Consent",
        Page::Declined => "Thank you",
        Page::About => "About you",
        Page::Summary => "Summary",
    }
}

fn keys(page: Page) -> &'static str {
    match page {
        Page::Study => "Enter: go on      Tab: to the next field",
        Page::Room => "Tab: leave the text      Enter: new line      Escape: back",
        Page::Consent => "Page keys, arrows: move the text      Tab, Enter: choose      Escape: back",
        Page::Declined => "Tab, Enter: choose      Escape: back",
        Page::Summary => "Enter: start      Escape: back",
        _ => "Enter: go on      Tab: to the next field      Escape: back",
    }
}

fn problem(problem: &Problem<'_>) -> String {
    match problem {
        Problem::NoFolder => "Which study is it? A folder that does not exist yet becomes a new study.".to_owned(),
        Problem::Folder(problem) => folder_problem(problem),
        Problem::Consent(ConsentProblem::OtherLanguage { found, missing }) => format!(
            "There is a consent text in the other language alone, {}. Put {missing} beside it, or choose the other \
             language.",
            found.display()
        ),
        Problem::Consent(ConsentProblem::Unreadable { file, reason }) => {
            format!("{}: {reason}; allowed is a text in UTF-8", file.display())
        }
        Problem::Luminance(problem) => (*problem).to_owned(),
        Problem::NoCode => "Who takes part? Enter the participant's code.".to_owned(),
        Problem::NotACode(code) => {
            format!("{code:?} is not a code. Allowed are 1 to 16 letters (a to z), digits, - and _; never a name.")
        }
        Problem::NotANumber(number) => format!("{number:?} is not a number. Allowed is 0, 1, 2 and so on, or nothing."),
        Problem::Session(found) => session(found),
        Problem::Damaged(error) => format!("There is a session under this code that cannot be read: {error}"),
        Problem::NotADistance(typed) => format!("{typed:?} is not a distance. Allowed is 20 to 500 cm, or nothing."),
        Problem::NoConsent => "The participant has not agreed.".to_owned(),
        Problem::NotAnAge(typed) => format!("{typed:?} is not an age. Allowed is 5 to 120 years, or nothing."),
    }
}

fn session(found: &Found) -> String {
    match found {
        Found::Free(_) => String::new(),
        Found::Complete(_) => "There is a finished session under this code. Enter another code.".to_owned(),
        Found::Interrupted(session) => format!(
            "There is a session under this code, interrupted {} ago: {} of at most {} trials are answered.",
            age(session.age_secs),
            session.trials,
            session.trials_at_most
        ),
    }
}

/// A time in the largest unit of which it holds two, so that "1 day" is "36 hours".
fn age(secs: f64) -> String {
    let units = [(86_400.0, "days"), (3600.0, "hours"), (60.0, "minutes")];
    let unit = units.into_iter().find(|(length, _)| secs >= 2.0 * length);
    unit.map_or_else(|| "a moment".to_owned(), |(length, name)| format!("{:.0} {name}", secs / length))
}

fn folder_problem(problem: &FolderProblem) -> String {
    match problem {
        FolderProblem::NotAFolder(path) => format!("{} is a file; allowed is a folder", path.display()),
        FolderProblem::NotWritable { path, reason } => {
            format!("{}: cannot be written: {reason}; allowed is a folder that can", path.display())
        }
        FolderProblem::Protocol(error) => error.to_string(),
        FolderProblem::Differs { file, name, asked, asked_name } => format!(
            "the study has the protocol {name:?} ({}), and --protocol {asked} is {asked_name:?} with other parameters; \
             leave --protocol out to go on with the study's, or give another folder for a new study",
            file.display()
        ),
    }
}

fn effort(effort: &Effort) -> String {
    let Effort { rounds, staircases, trials, minutes } = effort;
    format!("{rounds} rounds of {staircases} staircases: about {trials} trials, {minutes:.0} minutes and the rests.")
}

fn monitor_named(display: &Display) -> String {
    let Display { width_px, height_px, .. } = display;
    let name = display.monitor.as_deref().unwrap_or("unnamed");
    let refresh = display.refresh_hz.map_or_else(String::new, |hz| format!(", {hz:.0} Hz"));
    format!("{name}: {width_px} x {height_px}, scale {}{refresh}", display.scale_factor)
}

fn gamma_result(level: Option<u8>) -> String {
    let Some(level) = level else {
        return "While nobody has checked, the display is taken to be sRGB.".to_owned();
    };
    let found = format!("Level {level}: a gamma of {:.2}.", gamma(level));
    if is_near_srgb(level) {
        return format!("{found} That is near sRGB (level {SRGB_LEVEL}), which the pictures assume.");
    }
    format!(
        "{found} That is not sRGB (level {SRGB_LEVEL}), which the pictures assume. Set the display's gamma to 2.2 or its \
         picture mode to sRGB, switch off night colours and dynamic contrast, use its own resolution, and check \
         again; or measure it with a photometer and put luminance.csv into the study's folder."
    )
}

fn range(rows: &[(u8, f64)]) -> String {
    let [black, white] = [rows.first(), rows.last()].map(|row| row.map_or(0.0, |row| row.1));
    format!("{} levels from {black} to {white} cd/m\u{b2}", rows.len())
}

fn brightness_value(measured: &MeasuredDisplay) -> String {
    match (&measured.luminance_table, measured.gamma_check_level) {
        (Some(rows), _) => format!("measured: {}", range(rows)),
        (None, Some(level)) if is_near_srgb(level) => format!("near sRGB: gamma {:.2} (level {level})", gamma(level)),
        (None, Some(level)) => format!("not sRGB: gamma {:.2} (level {level})", gamma(level)),
        (None, None) => "not checked; taken to be sRGB".to_owned(),
    }
}

fn about_value(told_about: Option<&Demographics>) -> String {
    let Some(Demographics { age_years, gender, handedness, vision, graphics_experience }) = told_about else {
        return "no answers".to_owned();
    };
    let answers = [
        age_years.map(|years| format!("{years} years")),
        told(ENGLISH.genders, gender.map(|gender| gender as usize)).map(str::to_owned),
        told(ENGLISH.hands, handedness.map(|hand| hand as usize)).map(|hand| format!("writes with: {hand}")),
        told(ENGLISH.visions, vision.map(|vision| vision as usize)).map(|vision| format!("eyesight: {vision}")),
        told(ENGLISH.experiences, graphics_experience.map(|experience| experience as usize))
            .map(|experience| format!("graphics: {experience}")),
    ];
    answers.into_iter().flatten().collect::<Vec<_>>().join(", ")
}
