//! The command line: who takes part, with what protocol, where the session goes.

use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::Parser;
use jiff::Timestamp;
use scumble_psychophysics::{Protocol, SessionHeader, Software};

/// Measure how much a shadow's edge must be blurred before its steps vanish
///
/// Two pictures, one question: "Which one was the line?" The arrow keys, F and J, or the buttons
/// answer; Escape pauses. A session takes about 25 minutes and may be interrupted at any time.
#[derive(Parser, Debug)]
#[command(name = "scumble-study", version, after_help = EXAMPLES)]
pub(crate) struct Arguments {
    /// Folder of the study; the session goes into the folder DIR/CODE
    #[arg(long, value_name = "DIR", default_value = "sessions")]
    pub(crate) data: PathBuf,

    /// Code of the participant, never a name: 1 to 16 letters, digits, - and _ [default: the time]
    #[arg(long, value_name = "CODE", required_if_eq("resume", "true"))]
    pub(crate) participant: Option<String>,

    /// `two-alternative`, or a file ending in .json with the `protocol` of a session.json
    #[arg(long, value_name = "NAME|FILE.json", default_value = "two-alternative")]
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
  scumble-analysis fit study1 --out study1-result
      fits the relation to every session of the study

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
        let protocol = read_protocol(&self.protocol)?;
        let code = self.participant_code();
        let header = SessionHeader::new(&code, protocol, seed, self.started_at, software);
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

/// The protocol of a name or of a file.
fn read_protocol(name: &str) -> anyhow::Result<Protocol> {
    if !name.ends_with(".json") {
        return Protocol::named(name).context("--protocol also takes a file that ends in .json");
    }
    let text = std::fs::read_to_string(Path::new(name)).with_context(|| name.to_owned())?;
    let protocol: Protocol = serde_json::from_str(&text).with_context(|| name.to_owned())?;
    protocol.check().with_context(|| name.to_owned())?;
    Ok(protocol)
}
