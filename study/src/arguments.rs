//! The command line: who takes part, with what protocol, where the session goes.

use std::path::PathBuf;

use clap::Parser;
use jiff::Timestamp;
use scumble_psychophysics::{Protocol, SessionHeader, Software};

/// Measure how much a shadow's edge must be blurred before its steps vanish
///
/// Pictures of blurred shadow edges and one question: "Which one was the line?" of two, or "Was the
/// original image a line?" of one. The arrow keys, F and J, or the buttons answer, for one picture
/// also Y and N; Escape pauses. A session takes about 25 minutes and may be interrupted at any time.
#[derive(Parser, Debug)]
#[command(name = "scumble-study", version, after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// Folder of the study; the session goes into the folder DIR/CODE
    #[arg(long, value_name = "DIR", default_value = "sessions")]
    pub(crate) data: PathBuf,

    /// Code of the participant, never a name: 1 to 16 letters, digits, - and _ [default: the time]
    #[arg(long, value_name = "CODE", required_if_eq("resume", "true"))]
    pub(crate) participant: Option<String>,

    /// Number of the participant, which a protocol with `order = "latin_square"` takes the order of
    /// the rounds from [default: the number at the end of the code, or 0]
    #[arg(long, value_name = "N", conflicts_with = "resume")]
    pub(crate) participant_number: Option<u32>,

    /// `published`, `two-alternative`, `yes-no`, or a file that ends in .toml
    #[arg(long, value_name = "NAME|FILE.toml", default_value = "two-alternative")]
    pub(crate) protocol: String,

    /// Number from which every draw of the session follows [default: the time]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(..=SEED_MAX))]
    pub(crate) seed: Option<u64>,

    /// Continue the participant's interrupted session with its own protocol and seed
    #[arg(long, conflicts_with_all = ["seed", "protocol"])]
    pub(crate) resume: bool,

    /// Physical pixels per degree of visual angle at the participant's distance, for the record
    #[arg(long, value_name = "N", value_parser = px_per_degree, conflicts_with = "resume")]
    pub(crate) px_per_degree: Option<f64>,

    /// Open a window instead of filling the screen
    #[arg(long)]
    pub(crate) windowed: bool,

    /// When the program was started; names a participant without a code.
    #[arg(skip = Timestamp::now())]
    pub(crate) started_at: Timestamp,
}

/// Largest whole number that every reader of JSON keeps exactly: 2^53 - 1.
const SEED_MAX: u64 = (1 << 53) - 1;

const EXAMPLES: &str = "\
Examples:
  scumble-study --data study1 --participant p07
      a session of participant p07, written to study1/p07
  scumble-study --data study1 --participant p07 --resume
      goes on where it was interrupted
  scumble-study --data study2 --participant p07 --protocol yes-no
      one picture at a time, half of them lines; p07 has the order of rounds of participant 7
  scumble-study --data study3 --participant ab --participant-number 3 --protocol short.toml
      a protocol of your own; begin with a copy of crates/psychophysics/protocols/yes-no.toml
  scumble-analysis fit study1 --out study1-result
      fits the relation to every session of the study

Protocols:
  two-alternative  two pictures, which one was the line? Use it for thresholds.
  yes-no           one picture, was it a line? Lines among them measure how readily a person says no.
  published        the yes-no task of Kreuzer 2017, without lines among the trials that count: for a
                   replication only, because a habit of saying no looks like good eyes.

The session is two files: session.json says what was asked of whom on which display, events.jsonl
holds one answer a line, on disk before the next picture is drawn. An existing session is never
overwritten. The exit status is 0 when the session is complete.";

impl Arguments {
    /// Where the session lies.
    pub(crate) fn session_directory(&self) -> PathBuf {
        self.data.join(self.participant_code())
    }

    /// The header of a fresh session; the display is known once there is a window.
    pub(crate) fn header(&self) -> anyhow::Result<SessionHeader> {
        let software = Software::of("scumble-study", env!("CARGO_PKG_VERSION"));
        let seed = self.seed.unwrap_or_else(|| self.started_at.as_microsecond().unsigned_abs());
        let protocol = Protocol::open(&self.protocol)?;
        let code = self.participant_code();
        let mut header = SessionHeader::new(&code, protocol, seed, self.started_at, software);
        header.participant_number = self.participant_number.unwrap_or(header.participant_number);
        header.check()?;
        Ok(header)
    }

    /// What to call to go on with the session.
    pub(crate) fn how_to_resume(&self) -> String {
        let [data, code] = [self.data.display().to_string(), self.participant_code()];
        format!("continue with --data {data} --participant {code} --resume")
    }

    fn participant_code(&self) -> String {
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
