//! The command line of the analysis: each command reads its input, calls the library, prints.

use std::{
    io::stdout,
    path::{Path, PathBuf},
    process::ExitCode,
    time::Duration,
};

use anyhow::Context;
use clap::{Args, Parser, Subcommand};
use indicatif::{ProgressBar, ProgressStyle};
use scumble_analysis::{
    Export, Parameter, Plan, Resampling, Simulation, Study, ThresholdReport, fit_study, hashed_pictures,
    read_count_table, read_quest_config, read_responses, replay_session, session_directories, with_false_alarms,
    with_slope, write_summaries,
};
use scumble_psychophysics::{ObserverModel, Protocol, Session, read_session};

/// From the sessions of a study to relation.json, the file that a renderer reads.
#[derive(Parser)]
#[command(name = "scumble-analysis", version, arg_required_else_help = true)]
#[command(after_help = "Example, a whole study without people:
  scumble-analysis simulate --out target/sessions --observers 12 --seed 1
  scumble-analysis fit target/sessions --out target/fit
  then open target/fit/report.html

Exit status 0 only when the work was done; 1 with one line that names the reason; 2 for a wrong
command line.")]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Fits the relation to sessions and writes relation.json, report.html, tables and figures.
    #[command(after_help = "Examples:
  scumble-analysis fit data --out fit              every session in the folder data
  scumble-analysis fit data/p01 data/p02 --out fit two sessions

Writes into OUT: relation.json, report.html, trials.csv (its columns are described in trials.json), thresholds.csv, and the
figures as SVG.
Running it again replaces these files; a file of another kind under one of the names is refused.

The largest ratio under the protocol's first kernel goes into relation.json: a ratio holds for one kernel.
At least two people and two texel sizes are needed; of a pilot with less, report.html and the tables are
written without a relation, and the exit status is 1. Lines alone and catch trials check the people; thresholds do not use them.")]
    Fit {
        /// A session, or a folder with sessions directly in it.
        #[arg(required = true, value_name = "DIR")]
        sessions: Vec<PathBuf>,
        /// Folder for the results; made where it does not exist.
        #[arg(long)]
        out: PathBuf,
    },
    /// Lets simulated observers run the real experiment and writes their sessions.
    #[command(after_help = "Examples:
  scumble-analysis simulate --out sessions --observers 12 --seed 1
  scumble-analysis simulate --out sessions --observers 40 --seed 2 --ratio 2.5 --between-sd 0.15
  scumble-analysis simulate --out sessions --observers 12 --seed 3 --protocol yes-no --observer signal-detection
  scumble-analysis simulate --out sessions --observers 12 --seed 4 --protocol my-study.toml --slope 2.5

Equal arguments give equal files. A session that exists is never overwritten.")]
    Simulate {
        /// Folder in which each observer's session gets a folder.
        #[arg(long)]
        out: PathBuf,
        /// Number of observers, 1 to 99999.
        #[arg(long)]
        observers: u32,
        /// Everything random follows from it.
        #[arg(long)]
        seed: u64,
        /// What the observers are asked: a protocol's name, or a file that ends in .toml.
        #[arg(long, default_value = "two-alternative")]
        protocol: String,
        #[command(flatten)]
        people: People,
    },
    /// Foretells what a study as configured will give, from simulated sessions; refuses an impossible one.
    #[command(after_help = "Examples:
  scumble-analysis plan --protocol two-alternative
  scumble-analysis plan --protocol my-study.toml --between-sd 0.15 --observer signal-detection
  scumble-analysis plan --protocol yes-no --sessions 4000 --json plan.json

Prints the bias and the standard deviation of a threshold, the share of staircases that converge and why
the others do not, trials and minutes a person, and the 95 % interval of c for 10, 20 and 40 people.
Exit status 1 with the reason for a protocol that cannot measure the answer: thresholds of the median
person and two standard deviations to either side must lie on the table of every staircase, among the
radii that the pictures can show, and within reach of the prior: not further from it than
sqrt(trials_max x k) of its standard deviations, k the nats by which an answer contradicts the
staircase's expectation; half of the trials then go into leaving the prior. So is one most of whose
simulated staircases do not converge.

Simulated people differ from condition to condition by assumption: the stair is hidden at 0.72 of the
step's ratio, half the contrast at 0.95 of the full one's, and the kernel changes nothing.")]
    Plan {
        /// A protocol's name, or a file that ends in .toml.
        #[arg(long)]
        protocol: String,
        #[command(flatten)]
        people: People,
        /// Number of simulated people, 1 to 99999; cohorts of 10 and more need as many.
        #[arg(long, default_value_t = 2000)]
        sessions: u32,
        /// Everything random follows from it.
        #[arg(long, default_value_t = 1)]
        seed: u64,
        /// Assumed duration of a trial.
        #[arg(long, default_value_t = 5.0)]
        seconds_per_trial: f64,
        /// Writes the forecast as JSON too.
        #[arg(long, value_name = "FILE")]
        json: Option<PathBuf>,
    },
    /// Recomputes every staircase and picture of recorded sessions and compares them with the record.
    #[command(after_help = "Examples:
  scumble-analysis replay data/p01        one session
  scumble-analysis replay data            every session in the folder data

Every placement, radius and draw must equal the recorded one bit for bit, and every picture whose hash
the record holds is drawn again. Prints one line a session; stops with exit status 1 at the first line
of a record that differs, which it names. A response time, or a last answer that is changed together with
its `correct`, leads to nothing that could differ.")]
    Replay {
        /// A session, or a folder with sessions directly in it.
        #[arg(required = true, value_name = "SESSION")]
        sessions: Vec<PathBuf>,
    },
    /// Writes a BIDS dataset: the layout in which other laboratories' programs read behavioural data.
    #[command(after_help = "Examples:
  scumble-analysis export study1 --bids study1-bids          every session in the folder study1
  scumble-analysis export study1/p01 study2 --bids both      one session, and a folder of sessions

Writes dataset_description.json, README.md, participants.tsv, and for each session
sub-CODE/beh/sub-CODE_task-PROTOCOL_events.tsv: a row a trial or other event, with onset, duration,
trial_type, response_time and every other fact of the record; a JSON file beside each table describes its
columns. Where one participant has several sessions, all folders are sub-CODE/ses-N, in the order of time.
The records themselves are copied into sourcedata, so that the dataset can be replayed and fitted:
  scumble-analysis fit study1-bids/sourcedata --out fit

Labels are letters and digits: the code p-07_a becomes sub-p07a; participants.tsv has the codes as they were.
Discarded sessions, and sessions without an answer, stay out; each is named. A session that was recorded
before onsets were is refused. DIR must not exist or be empty, and is complete or not made at all.

The dataset passes the BIDS validator, which asks for the authors: name them in dataset_description.json.")]
    Export {
        /// A session, or a folder with sessions directly in it.
        #[arg(required = true, value_name = "SESSION")]
        sessions: Vec<PathBuf>,
        /// Folder for the dataset; made by this command.
        #[arg(long, value_name = "DIR")]
        bids: PathBuf,
    },
    /// Runs QUEST over a table of answers and prints its summaries as CSV.
    #[command(after_help = "Example:
  echo '{\"tGuess\": -0.5, \"tGuessSd\": 0.6, \"pThreshold\": 0.82, \"beta\": 3.5, \"delta\": 0.01, \"gamma\": 0.5}' > config.json
  printf 'intensity,response\\n-0.4,1\\n-0.5,0\\n' > answers.csv
  scumble-analysis quest --config config.json --responses answers.csv

Row 0 is the prior, row i the posterior after answer i. The columns config and sequence are the
names of the files.")]
    Quest {
        /// JSON with tGuess, tGuessSd, pThreshold, beta, delta, gamma; grain and range are optional.
        #[arg(long)]
        config: PathBuf,
        /// CSV with the columns intensity,response; a response is 0 or 1.
        #[arg(long)]
        responses: PathBuf,
    },
    /// Fits a Weibull function to a table of correct answers and prints JSON: threshold, slope, intervals, fit.
    #[command(after_help = "Example:
  printf 'level,n_correct,n_total\\n0.5,26,50\\n1,33,50\\n2,45,50\\n4,49,50\\n' > counts.csv
  scumble-analysis threshold --data counts.csv --guess 0.5 --lapse 0.01

The function is p(x) = guess + (1 - guess - lapse)(1 - exp(-10^(slope_beta (x - threshold_t)))) with
x = log10(level). Rows of one level count as one.

  threshold_t, slope_beta, lapse   the most likely values, with standard errors se_t, se_beta, se_lapse
  x82                              the x of 82 % correct
  nll, deviance                    negative log likelihood; its doubled distance from a perfect fit
  deviance_p                       probability of such a deviance if the function is right: below 0.05 it
                                   is doubtful (a wrong guess rate, lapses, learning). By bootstrap
  ci95_profile, ci95_bootstrap     95 % intervals by profile likelihood and by parametric bootstrap.
                                   Report the profile's, which need no draws; where the two differ much,
                                   the answers are few
  levels                           p of the fit and deviance residual of each level: beyond +-2 a level
                                   does not fit
  notes                            a sentence for each end that the data do not bound, which is null

Exit status 1 with the reason where the table holds no estimate at all: one level, all answers correct,
a jump from guessing to certainty. Equal tables, options and seeds give equal numbers on every machine.")]
    Threshold {
        /// CSV with the columns level,n_correct,n_total.
        #[arg(long)]
        data: PathBuf,
        /// Probability of a correct answer by guessing.
        #[arg(long, default_value_t = 0.5)]
        guess: f64,
        /// Lapse rate, or the word free.
        #[arg(long, default_value = "0.01", value_parser = lapse)]
        lapse: Parameter,
        /// Tables that the bootstrap draws and fits, 100 to 1000000.
        #[arg(long, default_value_t = Resampling::default().resamples)]
        resamples: u32,
        /// Every draw of the bootstrap follows from it.
        #[arg(long, default_value_t = Resampling::default().seed)]
        seed: u64,
    },
}

/// The simulated people.
#[derive(Args)]
struct People {
    /// Kind of observer: weibull sees the artifact or not, signal-detection has noisy traces and a
    /// criterion, image sees the pictures alone (slow, and not for plan, which must know the thresholds).
    #[arg(long, default_value = "weibull")]
    observer: String,
    /// The median observer's threshold for the step at 100 % contrast, radius in texels.
    #[arg(long, default_value_t = 3.47)]
    ratio: f64,
    /// Standard deviation between observers, log10 of the ratio.
    #[arg(long, default_value_t = 0.1)]
    between_sd: f64,
    /// Share of trials answered blindly.
    #[arg(long, default_value_t = 0.01)]
    lapse: f64,
    /// Slope of the psychometric function per log10 unit; not for the observer image.
    #[arg(long)]
    slope: Option<f64>,
    /// Probability that a line alone is called an artifact; not for the observer image.
    #[arg(long)]
    false_alarms: Option<f64>,
}

impl People {
    /// `observers` of them in a study.
    fn study(&self, protocol: &str, observers: u32, seed: u64) -> anyhow::Result<Simulation> {
        let mut median =
            ObserverModel::named(&self.observer)?.with_ratio(self.ratio)?.with_lapse_probability(self.lapse);
        if let Some(slope) = self.slope {
            median = with_slope(median, slope)?;
        }
        if let Some(probability) = self.false_alarms {
            median = with_false_alarms(median, probability)?;
        }
        let protocol = Protocol::open(protocol)?;
        Ok(Simulation { protocol, observers, seed, median, between_sd_log10: self.between_sd })
    }
}

fn lapse(text: &str) -> Result<Parameter, String> {
    if text == "free" {
        return Ok(Parameter::Free);
    }
    let value = text.parse().map_err(|_| "allowed is a number or the word free".to_owned())?;
    Ok(Parameter::Fixed(value))
}

fn main() -> ExitCode {
    match run(Arguments::parse().command) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}

fn run(command: Command) -> anyhow::Result<()> {
    match command {
        Command::Fit { sessions, out } => fit(&sessions, &out),
        Command::Simulate { out, observers, seed, protocol, people } => {
            simulate(&people.study(&protocol, observers, seed)?, &out)
        }
        Command::Plan { protocol, people, sessions, seed, seconds_per_trial, json } => {
            let simulation = people.study(&protocol, sessions, seed)?;
            plan(&simulation, seconds_per_trial, json.as_deref()).context(protocol)
        }
        Command::Replay { sessions } => replay(&sessions),
        Command::Export { sessions, bids } => export(&sessions, &bids),
        Command::Quest { config, responses } => {
            let (parameters, answers) = (read_quest_config(&config)?, read_responses(&responses)?);
            Ok(write_summaries(&parameters, &answers, [&config, &responses], stdout().lock())?)
        }
        Command::Threshold { data, guess, lapse, resamples, seed } => {
            threshold(&data, guess, lapse, &Resampling { resamples, seed })
        }
    }
}

/// Fits a table behind a progress bar of the bootstrap and prints the report.
fn threshold(data: &Path, guess: f64, lapse: Parameter, resampling: &Resampling) -> anyhow::Result<()> {
    let counts = read_count_table(data)?;
    let bar = progress_bar(resampling.resamples.into(), "tables")?;
    let report = ThresholdReport::of(&counts, guess, lapse, resampling, || bar.inc(1));
    bar.finish_and_clear();
    let report = report.with_context(|| data.display().to_string())?;
    println!("{}", serde_json::to_string_pretty(&report)?);
    Ok(())
}

/// Time between two pictures of a spinner: ten a second look alive.
const SPIN: Duration = Duration::from_millis(100);

/// Prints the result and where the files are; notices go to the error stream.
fn fit(sessions: &[PathBuf], out: &Path) -> anyhow::Result<()> {
    let study = Study::read(sessions)?;
    for notice in &study.notices {
        eprintln!("notice: {notice}");
    }
    let wait = ProgressBar::new_spinner().with_message("fitting, and testing the fit");
    wait.enable_steady_tick(SPIN);
    let analysis = fit_study(&study, out);
    wait.finish_and_clear();
    let analysis = analysis?;
    for exclusion in &analysis.exclusions {
        eprintln!("notice: {exclusion}");
    }
    println!("people     {}", study.people.len());
    println!("trials     {} measured", study.trial_count());
    for (index, series) in analysis.series.iter().enumerate() {
        let [low, high] = series.ratio_ci95();
        let mark = if index == analysis.worst { "  <- relation.json" } else { "" };
        let line =
            series.origin_line.map_or(String::new(), |line| format!("; line through the origin {:.2}", line.slope));
        println!("{:<22} {:.2} texels, 95 % {low:.2} to {high:.2}{line}{mark}", series.name, series.ratio());
    }
    println!("wrote      {}", out.join("report.html").display());
    Ok(())
}

/// Writes the sessions behind a progress bar.
fn simulate(simulation: &Simulation, out: &Path) -> anyhow::Result<()> {
    let bar = progress_bar(simulation.observers.into(), "observers")?;
    let directories = simulation.write(out, || bar.inc(1))?;
    bar.finish_and_clear();
    println!("wrote {} into {}", count_of(directories.len()), out.display());
    Ok(())
}

/// Simulates behind a progress bar and prints the forecast.
fn plan(simulation: &Simulation, secs_per_trial: f64, json: Option<&Path>) -> anyhow::Result<()> {
    let bar = progress_bar(simulation.observers.into(), "sessions")?;
    let plan = Plan::of(simulation, secs_per_trial, || bar.inc(1))?;
    bar.finish_and_clear();
    if let Some(path) = json {
        let text = serde_json::to_string_pretty(&plan)? + "\n";
        std::fs::write(path, text).with_context(|| path.display().to_string())?;
    }
    print!("{}", plan.text());
    Ok(())
}

/// Replays every session behind a progress bar of its pictures.
fn replay(paths: &[PathBuf]) -> anyhow::Result<()> {
    for path in paths {
        for directory in session_directories(path)? {
            let session = read_session(&directory)?;
            for notice in &session.notices {
                eprintln!("notice: {notice}");
            }
            let pictures = hashed_pictures(&session);
            let bar = progress_bar(pictures as u64, "pictures")?;
            let replayed = replay_session(&session, |drawn| bar.inc(drawn as u64))?;
            bar.finish_and_clear();
            let pictures = match replayed.pictures {
                0 => "the record has no hashes of pictures".to_owned(),
                count => format!("{count} pictures"),
            };
            println!(
                "{}: equal: {} trials, {} practice trials, {} staircases, {pictures}{}",
                directory.display(),
                replayed.trials,
                replayed.practice,
                replayed.staircases,
                how_it_ended(&session),
            );
        }
    }
    Ok(())
}

/// What is to be said of a session that is not complete.
fn how_it_ended(session: &Session) -> &'static str {
    match session {
        session if session.is_complete() => "",
        session if session.is_discarded() => "; discarded",
        session if session.is_closed() => "; ended early",
        _ => "; not finished",
    }
}

/// Writes the dataset and prints a line a session; notices go to the error stream.
fn export(sessions: &[PathBuf], bids: &Path) -> anyhow::Result<()> {
    let export = Export::read(sessions)?;
    for notice in export.sessions.iter().flat_map(|exported| &exported.session().notices) {
        eprintln!("notice: {notice}");
    }
    export.write(bids)?;
    for exported in &export.sessions {
        println!(
            "{}  from {}: {} answers, {} measured trials stand, {}",
            exported.name(),
            exported.session().directory.display(),
            exported.answers(),
            exported.standing_trials(),
            exported.status().name(),
        );
    }
    for (directory, reason) in &export.left_out {
        println!("left out  {}: {reason}", directory.display());
    }
    println!("wrote     {} into {}", count_of(export.sessions.len()), bids.display());
    Ok(())
}

/// A number of sessions, in words.
fn count_of(sessions: usize) -> String {
    if sessions == 1 { "1 session".to_owned() } else { format!("{sessions} sessions") }
}

/// A progress bar, which hides itself where nobody watches.
fn progress_bar(length: u64, what: &'static str) -> anyhow::Result<ProgressBar> {
    let style = ProgressStyle::with_template("{msg} {bar:40} {pos}/{len} {eta}")?;
    let bar = ProgressBar::new(length).with_style(style);
    bar.set_message(what);
    Ok(bar)
}
