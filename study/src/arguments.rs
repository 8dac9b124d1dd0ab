//! The command line: who takes part, with what protocol, where the session goes.

use std::path::PathBuf;

use clap::{Parser, ValueEnum};
use jiff::Timestamp;
use scumble_psychophysics::{Language, ObserverModel, Protocol, SessionHeader};

use crate::software::software;

/// Measure how much a shadow's edge must be blurred before its steps vanish
///
/// Pictures of blurred shadow edges and one question: "Which one was the line?" of two, or "Was the
/// original image a line?" of one. Set-up pages lead from the study's folder to the first trial; the
/// administrator's window opens on a second monitor, or by F10. A session takes about 25 minutes and
/// may be interrupted at any time.
#[derive(Parser, Debug)]
#[command(name = "scumble-study", version, after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// Folder of the study, with its protocol.toml; the session goes into DIR/CODE [default: asked for,
    /// and `sessions` where nothing is asked]
    #[arg(long, value_name = "DIR")]
    pub(crate) data: Option<PathBuf>,

    /// Code of the participant, never a name: 1 to 16 letters, digits, - and _ [default: asked for, and
    /// the time where nothing is asked]
    #[arg(long, value_name = "CODE")]
    pub(crate) participant: Option<String>,

    /// Number of the participant, which a protocol with `order = "latin_square"` takes the order of
    /// the rounds from [default: the number at the end of the code, or 0]
    #[arg(long, value_name = "N", conflicts_with = "resume")]
    pub(crate) participant_number: Option<u32>,

    /// `published`, `two-alternative`, `yes-no`, or a file that ends in .toml [default: the study's
    /// protocol.toml, and `two-alternative` for a new study]
    #[arg(long, value_name = "NAME|FILE.toml")]
    pub(crate) protocol: Option<String>,

    /// Number from which every draw of the session follows [default: the time]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(..=SEED_MAX))]
    pub(crate) seed: Option<u64>,

    /// Continue the participant's interrupted session with its own protocol and seed; or repeat the
    /// round that was under way; or discard the session and begin another
    #[arg(long, value_name = "POLICY", num_args = 0..=1, default_missing_value = "continue")]
    #[arg(requires = "participant", conflicts_with_all = ["seed", "protocol"])]
    pub(crate) resume: Option<ResumePolicy>,

    /// Language of the participant's screen: en, de
    #[arg(long, value_name = "LANGUAGE", value_parser = language, default_value = "en")]
    pub(crate) language: Language,

    /// Skip the set-up pages; what they ask stays unknown
    #[arg(long)]
    pub(crate) quick_start: bool,

    /// Let a simulated person press the keys, as fast as --speed says, from the instructions to the end
    #[arg(long, value_name = "OBSERVER", value_parser = observer)]
    pub(crate) rehearse: Option<ObserverModel>,

    /// Times as fast as a person, from 0.1 to 10000; the fixation interval shrinks alike
    #[arg(long, value_name = "N", value_parser = speed, default_value_t = 1.0, requires = "rehearse")]
    pub(crate) speed: f64,

    /// Physical pixels per degree of visual angle at the participant's distance, for the record
    #[arg(long, value_name = "N", value_parser = px_per_degree, conflicts_with = "resume")]
    pub(crate) px_per_degree: Option<f64>,

    /// The participant's monitor, counted from 1 [default: the one that the window opens on]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) monitor: Option<u32>,

    /// Open a window instead of filling the screen
    #[arg(long)]
    pub(crate) windowed: bool,

    /// When the program was started; names a participant without a code.
    #[arg(skip = Timestamp::now())]
    pub(crate) started_at: Timestamp,
}

/// What to do with an interrupted session.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ResumePolicy {
    /// Go on with the trial that was under way
    Continue,
    /// Go on with the round that was under way, from its beginning; its answers do not stand
    RepeatRound,
    /// Throw the session away, with its record kept, and begin another
    Discard,
}

/// Largest whole number that every reader of JSON keeps exactly: 2^53 - 1.
const SEED_MAX: u64 = (1 << 53) - 1;
/// Folder of a study that nobody named.
const USUAL_FOLDER: &str = "sessions";

const EXAMPLES: &str = "\
Examples:
  scumble-study
      the set-up pages ask for everything: folder, participant, screen, consent
  scumble-study --data study1 --participant p07
      a session of participant p07, written to study1/p07
  scumble-study --data study1 --participant p07 --resume
      goes on where it was interrupted; --resume repeat-round, --resume discard
  scumble-study --data study2 --participant p07 --protocol yes-no
      one picture at a time, half of them lines; p07 has the order of rounds of participant 7
  scumble-study --data study3 --participant ab --participant-number 3 --protocol short.toml
      a protocol of your own; begin with a copy of crates/psychophysics/protocols/yes-no.toml
  scumble-study --data rehearsal --participant sim1 --rehearse weibull --speed 20
      a simulated person runs a whole session before your eyes
  scumble-analysis fit study1 --out study1-result
      fits the relation to every session of the study

Protocols:
  two-alternative  two pictures, which one was the line? Use it for thresholds.
  yes-no           one picture, was it a line? Lines among them measure how readily a person says no.
  published        the yes-no task of Kreuzer 2017, without lines among the trials that count: for a
                   replication only, because a habit of saying no looks like good eyes.

Simulated people for --rehearse: weibull (the psychometric function that QUEST assumes),
signal-detection (noisy traces and a criterion), image (sees the pixels and nothing else).

Keys of the administrator: F10 opens the administrator's panel (a window, where there is a second monitor).

A study is a folder. What may lie in it: protocol.toml (written by the first session), consent.en.txt,
consent.de.txt, luminance.csv (a measured display: level,luminance_cd_m2). Each session is a folder with
two files: session.json says what was asked of whom on which display, events.jsonl holds one answer a
line, on disk before the next picture is drawn. An existing session is never overwritten. The exit status
is 0 when the session is complete, or was ended by the administrator.";

impl Arguments {
    /// Whether the set-up pages are left out.
    pub(crate) fn skips_setup(&self) -> bool {
        self.quick_start || self.rehearse.is_some() || self.resume.is_some()
    }

    /// The study's folder, as given.
    pub(crate) fn study_folder(&self) -> PathBuf {
        self.data.clone().unwrap_or_else(|| USUAL_FOLDER.into())
    }

    /// The header of a fresh session; the display is known once there is a window.
    pub(crate) fn header(&self, code: &str, protocol: Protocol) -> anyhow::Result<SessionHeader> {
        let mut header = SessionHeader::new(code, protocol, self.seed(), self.started_at, software());
        header.participant_number = self.participant_number.unwrap_or(header.participant_number);
        header.language = Some(self.language);
        header.simulated_observer = self.rehearse;
        header.check()?;
        Ok(header)
    }

    /// The seed, as given, or the time.
    pub(crate) fn seed(&self) -> u64 {
        self.seed.unwrap_or_else(|| self.started_at.as_microsecond().unsigned_abs())
    }

    /// The participant's code, as given, or the time.
    pub(crate) fn participant_code(&self) -> String {
        let of_time = || self.started_at.strftime("p%Y%m%d-%H%M%S").to_string();
        self.participant.clone().unwrap_or_else(of_time)
    }
}

/// A number of pixels per degree: finite and above 0.
fn px_per_degree(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() && value > 0.0 => Ok(value),
        _ => Err("allowed is a number above 0".to_owned()),
    }
}

/// From a tenth of a person's speed to one at which the program alone takes the time.
fn speed(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if (0.1..=10_000.0).contains(&value) => Ok(value),
        _ => Err("allowed is a number from 0.1 to 10000".to_owned()),
    }
}

fn language(text: &str) -> Result<Language, String> {
    match text {
        "en" => Ok(Language::English),
        "de" => Ok(Language::German),
        _ => Err("allowed is en or de".to_owned()),
    }
}

fn observer(text: &str) -> Result<ObserverModel, String> {
    ObserverModel::named(text).map_err(|error| error.to_string())
}
