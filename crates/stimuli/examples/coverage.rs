//! Exact coverage of filtered edges at given points.
//!
//! `cargo run --release -p scumble-stimuli --example coverage -- KERNEL R_OVER_A < points.csv`
//! reads `px,py` (with that header, in texels) and writes `px,py,F_stair,F_line45,F_step`.

use std::io;
use std::process::ExitCode;

use scumble_stimuli::{Kernel, Silhouette};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match run(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("coverage: {message}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &[String]) -> Result<(), String> {
    let [kernel, radius] = arguments else {
        return Err("two arguments are needed, KERNEL (disc, box, gauss2, gauss3, poisson25) and R_OVER_A".to_owned());
    };
    // A point has no pixel by which the rotated taps could turn.
    let kernel = Kernel::from_name(kernel)
        .filter(|&kernel| kernel != Kernel::Poisson25Rotated)
        .ok_or_else(|| format!("kernel {kernel:?}; allowed are disc, box, gauss2, gauss3, poisson25"))?;
    let radius: f64 = match radius.parse() {
        Ok(radius) if (0.0..=1e6).contains(&radius) => radius,
        _ => {
            return Err(format!("R_OVER_A is {radius:?}; allowed is a number from 0 to 1e6"));
        }
    };

    let mut points = csv::Reader::from_reader(io::stdin().lock());
    let header = points.headers().map_err(|error| error.to_string())?;
    if header.iter().map(str::trim).ne(["px", "py"]) {
        return Err(format!("standard input, line 1: the header is {header:?}; allowed is px,py"));
    }
    let mut table = csv::Writer::from_writer(io::stdout().lock());
    let write = |error: csv::Error| format!("standard output: {error}");
    table.write_record(["px", "py", "F_stair", "F_line45", "F_step"]).map_err(write)?;
    for record in points.records() {
        let record = record.map_err(|error| format!("standard input: {error}"))?;
        let line = record.position().map_or(0, csv::Position::line);
        let [x, y] = [coordinate(&record, 0, line)?, coordinate(&record, 1, line)?];
        let edges = [Silhouette::Stair, Silhouette::Line { slope: 1.0 }, Silhouette::Step];
        let covered = edges.map(|edge| seventeen_digits(edge.coverage(kernel, radius, x, y)));
        table
            .write_record([record[0].trim(), record[1].trim()].into_iter().chain(covered.iter().map(String::as_str)))
            .map_err(write)?;
    }
    table.flush().map_err(|error| error.to_string())
}

/// A coordinate of a record, in texels.
fn coordinate(record: &csv::StringRecord, column: usize, line: u64) -> Result<f64, String> {
    let text = record.get(column).unwrap_or("").trim();
    match text.parse::<f64>() {
        Ok(value) if value.abs() <= 1e9 => Ok(value),
        _ => Err(format!("standard input, line {line}: {text:?}; allowed is a number from -1e9 to 1e9")),
    }
}

/// Seventeen significant digits, which carry every f64 exactly.
fn seventeen_digits(value: f64) -> String {
    format!("{value:.16e}")
}
