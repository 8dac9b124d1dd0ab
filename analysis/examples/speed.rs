//! How long simulated sessions take: the whole state machine with its staircases, answers and convergence
//! rule, without disk and without a fit, on all cores.
//!
//! A session is 12 staircases of 24 trials each and 8 practice trials, as in the two-alternative protocol.
//!
//! ```sh
//! cargo run --release -p scumble-analysis --example speed -- SESSIONS
//! ```

use std::time::Instant;

use rayon::prelude::*;
use scumble_analysis::{Error, Simulation};
use scumble_psychophysics::{ObserverModel, Protocol};

fn main() -> Result<(), Error> {
    let sessions = std::env::args().nth(1).and_then(|count| count.parse().ok()).unwrap_or(10_000);
    let mut protocol = Protocol::two_alternative();
    (protocol.schedule.trials_min, protocol.schedule.trials_max) = (24, 24);
    let median = ObserverModel::default();
    let simulation = Simulation { protocol, observers: sessions, seed: 1, median, between_sd_log10: 0.1 };
    simulation.check()?;

    let start = Instant::now();
    let trials = (0..sessions)
        .into_par_iter()
        .map(|index| Ok(simulation.run(index)?.1.iter().filter(|event| event.measured().is_some()).count()))
        .sum::<Result<usize, Error>>()?;
    let secs = start.elapsed().as_secs_f64();
    let threads = rayon::current_num_threads();
    println!("{sessions} sessions, {trials} measured trials on {threads} threads: {secs:.1} s");
    println!(
        "{:.2} ms a session, {:.1} us a trial and thread",
        1e3 * secs / f64::from(sessions),
        1e6 * secs * threads as f64 / trials as f64
    );
    Ok(())
}
