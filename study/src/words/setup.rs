//! The texts of the pages before the instructions.

mod english;
mod german;

use scumble_psychophysics::{Consent, Demographics, Display, Task};

use crate::setup::{Effort, FolderProblem, MeasuredDisplay, Page, Problem};

pub(super) use english::ENGLISH;
pub(super) use german::GERMAN;

/// See [`super::Words::setup`].
///
/// A function takes what is to be said and gives whole sentences, since languages build them differently.
pub(crate) struct SetupWords {
    // Every page.
    pub(crate) title: fn(Page) -> &'static str,
    /// Number of the page and of all pages.
    pub(crate) progress: fn(usize, usize) -> String,
    pub(crate) keys: fn(Page) -> &'static str,
    pub(crate) back: &'static str,
    pub(crate) next: &'static str,
    pub(crate) problem: fn(&Problem<'_>) -> String,
    /// Why a folder cannot be the folder of a study, and what is allowed.
    pub(crate) folder_problem: fn(&FolderProblem) -> String,

    // Study.
    pub(crate) folder: &'static str,
    pub(crate) folder_hint: &'static str,
    pub(crate) recent: &'static str,
    pub(crate) protocol: &'static str,
    pub(crate) task: fn(Task) -> &'static str,
    pub(crate) effort: fn(&Effort) -> String,
    /// While no folder is named.
    pub(crate) protocol_first: &'static str,
    pub(crate) protocol_new: &'static str,
    pub(crate) protocol_kept: &'static str,
    pub(crate) language: &'static str,
    pub(crate) participant: &'static str,
    pub(crate) participant_hint: &'static str,
    pub(crate) participant_note: &'static str,
    /// Code and number, where the number decides anything.
    pub(crate) participant_value: fn(&str, Option<u32>) -> String,
    pub(crate) number: &'static str,
    pub(crate) monitor: &'static str,
    pub(crate) monitor_named: fn(&Display) -> String,
    /// Where the window is, which is not the monitor that was chosen.
    pub(crate) elsewhere: &'static str,
    pub(crate) elsewhere_value: fn(&Display) -> String,
    pub(crate) interrupted: &'static str,
    pub(crate) resume: &'static str,
    pub(crate) repeat_round: &'static str,
    pub(crate) discard: &'static str,

    // Screen.
    pub(crate) distance: &'static str,
    pub(crate) distance_text: &'static str,
    pub(crate) card: &'static str,
    pub(crate) card_text: &'static str,
    pub(crate) card_matches: &'static str,
    pub(crate) not_measured: &'static str,
    pub(crate) pixel_size: &'static str,
    pub(crate) pixel_angle: &'static str,
    pub(crate) texels: &'static str,
    /// Millimetres.
    pub(crate) distance_value: fn(Option<f64>) -> String,
    /// Pixels per millimetre.
    pub(crate) pixel_size_value: fn(Option<f64>) -> String,
    /// Pixels per degree.
    pub(crate) pixel_angle_value: fn(Option<f64>) -> String,
    /// Texels in pixels and in arc minutes.
    pub(crate) texels_value: fn(&[(f64, f64)]) -> String,

    // Brightness.
    pub(crate) brightness: &'static str,
    pub(crate) gamma_text: &'static str,
    pub(crate) grey: &'static str,
    pub(crate) gamma_alike: &'static str,
    pub(crate) not_checked: &'static str,
    /// The level that was matched.
    pub(crate) gamma_result: fn(Option<u8>) -> String,
    pub(crate) table_text: fn(&[(u8, f64)]) -> String,
    /// Candela per square metre.
    pub(crate) luminance: fn(f64) -> String,
    pub(crate) brightness_value: fn(&MeasuredDisplay) -> String,

    // Room.
    pub(crate) room: &'static str,
    pub(crate) room_text: &'static str,
    pub(crate) room_hint: &'static str,
    pub(crate) room_note: &'static str,
    pub(crate) room_next: &'static str,
    pub(crate) room_value: fn(Option<&str>) -> String,
    pub(crate) hand_over: &'static str,

    // Consent.
    pub(crate) consent: &'static str,
    pub(crate) consent_text: &'static str,
    pub(crate) has_agreed: &'static str,
    pub(crate) agree: &'static str,
    pub(crate) disagree: &'static str,
    pub(crate) consent_value: fn(Option<&Consent>) -> String,
    pub(crate) declined: &'static str,
    pub(crate) close: &'static str,

    // About you.
    pub(crate) about: &'static str,
    pub(crate) about_text: &'static str,
    pub(crate) age: &'static str,
    pub(crate) gender: &'static str,
    /// Female, male, another one.
    pub(crate) genders: [&'static str; 3],
    pub(crate) hand: &'static str,
    /// Left, right, either.
    pub(crate) hands: [&'static str; 3],
    pub(crate) vision: &'static str,
    /// Normal, corrected, below normal.
    pub(crate) visions: [&'static str; 3],
    pub(crate) experience: &'static str,
    /// None, some, an expert's.
    pub(crate) experiences: [&'static str; 3],
    pub(crate) no_answer: &'static str,
    pub(crate) about_value: fn(Option<&Demographics>) -> String,

    // Summary.
    pub(crate) summary_text: &'static str,
    pub(crate) summary_each_trial: &'static str,
    pub(crate) unfinished: fn(Page) -> String,
    pub(crate) start: &'static str,
}

/// The name that the list of a question holds for an answer, in the order of the header's enumeration.
fn told(names: [&'static str; 3], answer: Option<usize>) -> Option<&'static str> {
    answer.and_then(|index| names.get(index).copied())
}

#[cfg(test)]
mod tests {
    use scumble_psychophysics::{Error, Experience, Gender};

    use super::*;
    use crate::session_folder::{Found, Interrupted};
    use crate::setup::ConsentProblem;

    const BOTH: [&SetupWords; 2] = [&ENGLISH, &GERMAN];

    #[test]
    fn every_problem_holds_what_was_found() {
        let folder = FolderProblem::NotAFolder("found".into());
        let other = ConsentProblem::OtherLanguage { found: "found".into(), missing: "consent.en.txt" };
        let unreadable = ConsentProblem::Unreadable { file: "found".into(), reason: "empty".into() };
        let damaged = Error::SessionInUse("found".into());
        let problems = [
            Problem::Folder(&folder),
            Problem::Consent(&other),
            Problem::Consent(&unreadable),
            Problem::Luminance("found"),
            Problem::NotACode("found"),
            Problem::NotANumber("found"),
            Problem::Damaged(&damaged),
            Problem::NotADistance("found".into()),
            Problem::NotAnAge("found".into()),
        ];
        for (problem, words) in problems.iter().flat_map(|problem| BOTH.map(|words| (problem, words))) {
            let sentence = (words.problem)(problem);
            assert!(sentence.contains("found"), "{sentence}");
        }
    }

    #[test]
    fn what_a_reader_of_files_says_in_english_comes_after_what_to_do_in_german() {
        let unreadable = ConsentProblem::Unreadable { file: "found".into(), reason: "empty".into() };
        let protocol = FolderProblem::Protocol(Error::SessionInUse("found".into()));
        for problem in [Problem::Consent(&unreadable), Problem::Luminance("found"), Problem::Folder(&protocol)] {
            let sentence = (GERMAN.problem)(&problem);
            let (to_do, message) = sentence.split_once(" Meldung: ").unwrap();
            assert!(to_do.ends_with('.') && message.contains("found"), "{sentence}");
        }
    }

    #[test]
    fn an_interruption_is_told_in_the_largest_unit_that_says_something() {
        let told = |age_secs: f64| {
            let session = Interrupted { directory: "p07".into(), age_secs, trials: 83, trials_at_most: 240 };
            BOTH.map(|words| (words.problem)(&Problem::Session(&Found::Interrupted(session.clone()))))
        };
        for (age_secs, english, german) in [
            (30.0, "a moment ago", "vor einem Moment"),
            (725.0, "12 minutes ago", "vor 12 Minuten"),
            (5400.0, "90 minutes ago", "vor 90 Minuten"),
            (129_600.0, "36 hours ago", "vor 36 Stunden"),
            (604_800.0, "7 days ago", "vor 7 Tagen"),
        ] {
            let [in_english, in_german] = told(age_secs);
            assert!(in_english.contains(english) && in_english.contains("83 of at most 240"), "{in_english}");
            assert!(in_german.contains(german) && in_german.contains("83 von höchstens 240"), "{in_german}");
        }
    }

    #[test]
    fn numbers_are_written_as_the_language_writes_them() {
        let sizes = [(5.0, 7.56)];
        assert_eq!(BOTH.map(|words| (words.distance_value)(Some(625.0))), ["62.5 cm", "62,5 cm"]);
        assert_eq!(BOTH.map(|words| (words.pixel_size_value)(Some(3.789))), ["3.79", "3,79"]);
        assert!((ENGLISH.texels_value)(&sizes).contains("7.6'") && (GERMAN.texels_value)(&sizes).contains("7,6'"));
        assert!((GERMAN.gamma_result)(Some(186)).starts_with("Stufe 186: ein Gamma von 2,20. Das liegt nahe"));
        assert!((ENGLISH.gamma_result)(Some(174)).contains("not sRGB"));
    }

    #[test]
    fn answers_are_told_by_the_names_that_were_picked() {
        let about = Demographics {
            age_years: Some(27),
            gender: Some(Gender::Other),
            graphics_experience: Some(Experience::Expert),
            ..Demographics::default()
        };
        assert_eq!((ENGLISH.about_value)(Some(&about)), "27 years, other, graphics: expert");
        assert_eq!((GERMAN.about_value)(Some(&about)), "27 Jahre, divers, Grafik: vom Fach");
    }
}
