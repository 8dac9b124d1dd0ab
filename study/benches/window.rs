//! How fast the real window is, on a virtual display: from the start of the program to its first screen, from
//! an answer to the next pictures, and how much memory it takes.
//!
//! `cargo bench -p scumble-study --bench window` prints a table. A simulated person answers at 10,000 times
//! a person's speed, so that what is left of the fixation interval, 0.05 ms, hides nothing: from answer to
//! pictures means judging the answer, synchronising it to the disk, one frame with the cross, drawing the
//! pictures, and handing them over in the next frame.

use std::path::Path;
use std::time::Duration;

use jiff::Timestamp;
use scumble_psychophysics::{Answered, Event, Protocol, Session, read_session};

#[path = "../tests/window/pixels.rs"]
#[allow(dead_code, reason = "the tests use all of it")]
mod pixels;
#[path = "../tests/window/programs.rs"]
#[allow(dead_code, reason = "the tests use all of it")]
#[allow(clippy::unwrap_used, reason = "a benchmark fails by panicking")]
mod programs;
#[path = "../tests/window/screen.rs"]
#[allow(dead_code, reason = "the tests use all of it")]
#[allow(clippy::unwrap_used, reason = "a benchmark fails by panicking")]
mod screen;

use programs::Running;
use screen::Screen;

/// Sessions a protocol; the first is not counted, because its pictures come from a cold machine.
const RUNS: u32 = 2;
/// Screen sizes: the smallest that holds two pictures, and a usual one.
const SIZES: [[u32; 2]; 2] = [[1280, 800], [1920, 1080]];

fn main() -> anyhow::Result<()> {
    println!(
        "| protocol | screen | start to first screen, s | answer to pictures, ms: median (quartiles) | 95 % | peak memory, MB |"
    );
    println!("|---|---|---|---|---|---|");
    for name in ["two-alternative", "yes-no", "published"] {
        for size_px in SIZES {
            let screen = Screen::start(size_px);
            let (mut starts, mut latencies, mut peak_mb) = (Vec::new(), Vec::new(), 0.0_f64);
            for run in 0..=RUNS {
                let folder = tempfile::tempdir()?;
                let (session, began, megabytes) = rehearse(&screen, folder.path(), name, run)?;
                if run > 0 {
                    starts.push(session.header.started_at.duration_since(began).as_secs_f64());
                    latencies.extend(latencies_ms(&session));
                    peak_mb = peak_mb.max(megabytes);
                }
            }
            let [start, median] = [quantile(&mut starts, 0.5), quantile(&mut latencies, 0.5)];
            let [low, high, slow] = [0.25, 0.75, 0.95].map(|share| quantile(&mut latencies, share));
            let [width, height] = size_px;
            println!(
                "| {name} | {width} x {height} | {start:.2} | {median:.0} ({low:.0} to {high:.0}) | {slow:.0} | {peak_mb:.0} |"
            );
        }
    }
    Ok(())
}

/// A shortened session of a simulated person: what is on disk, when the program was started, and the most
/// memory it took.
fn rehearse(screen: &Screen, folder: &Path, name: &str, run: u32) -> anyhow::Result<(Session, Timestamp, f64)> {
    let mut protocol = Protocol::named(name)?;
    protocol.schedule.trials_min = 5;
    protocol.schedule.trials_max = 5;
    let file = folder.join("short.toml");
    std::fs::write(&file, protocol.to_toml()?)?;
    let [data, file] = [folder.join("data"), file].map(|path| path.display().to_string());
    let seed = run.to_string();
    let arguments = ["--data", &data, "--participant", "sim", "--protocol", &file, "--seed", &seed];
    let rehearsal = ["--rehearse", "weibull", "--speed", "10000"];
    let arguments: Vec<String> = arguments.into_iter().chain(rehearsal).map(String::from).collect();

    let began = Timestamp::now();
    let mut study = Running(screen.study(&arguments, &[]).spawn()?);
    let status_file = format!("/proc/{}/status", study.0.id());
    let mut megabytes = 0.0;
    let status = loop {
        if let Ok(text) = std::fs::read_to_string(&status_file) {
            megabytes = peak_megabytes(&text).unwrap_or(megabytes);
        }
        if let Some(status) = study.0.try_wait()? {
            break status;
        }
        std::thread::sleep(Duration::from_millis(20));
    };
    anyhow::ensure!(status.success(), "the study ended with {status}");
    Ok((read_session(&folder.join("data/sim"))?, began, megabytes))
}

/// From each answer to the pictures of the next trial, where nothing but the cross was between.
fn latencies_ms(session: &Session) -> Vec<f64> {
    let answered: Vec<&Answered> = session.events.iter().filter_map(Event::answered).collect();
    let follows = |pair: &&[&Answered]| {
        let [first, second] = [pair[0], pair[1]].map(|answered| answered.trial);
        first.round > 0 && first.round == second.round
    };
    let between = |pair: &[&Answered]| {
        let [first, second] = [pair[0].timing?, pair[1].timing?];
        Some(1000.0 * (second.onset_secs - first.onset_secs - pair[0].response_time_secs))
    };
    answered.windows(2).filter(follows).filter_map(between).collect()
}

/// The high-water mark of the resident set in `/proc/PID/status`, in 10^6 bytes.
fn peak_megabytes(status: &str) -> Option<f64> {
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kibibytes: f64 = line.trim().trim_end_matches("kB").trim().parse().ok()?;
    Some(kibibytes * 1024.0 / 1e6)
}

/// The value below which a share of the values lies, by rank.
fn quantile(values: &mut [f64], share: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    values[((values.len() - 1) as f64 * share).round() as usize]
}
