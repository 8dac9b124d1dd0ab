//! Level and power of the tests of fit, on simulated cohorts: of people whom the model describes, and of others.
//!
//! Each cell is 20 people x 20 trials of each of three texel sizes, if not said otherwise: step pattern at 100 % contrast,
//! the experiment's own state machine. Printed as a Markdown table: share of cohorts with p below 0.05, and the mean of p,
//! for the test of people and for that of time. In a true model they are 5 % and 0.5.
//!
//! ```sh
//! cargo run --release -p scumble-analysis --example goodness -- COHORTS [FIRST_SEED]
//! ```

use std::time::Instant;

use rayon::prelude::*;
use scumble_analysis::{Error, GoodnessOfFit, Series, Simulation, Study};
use scumble_psychophysics::{Fatigue, ObserverModel, Protocol, WeibullObserver};
use scumble_stimuli::Pattern;

/// Who is asked, and what.
struct Cell {
    name: &'static str,
    protocol: Protocol,
    kinds: Vec<(u32, WeibullObserver)>,
}

/// The step at full contrast; `trials` is the fewest and the most a staircase.
fn protocol(name: &str, trials: [u32; 2]) -> Result<Protocol, Error> {
    let mut protocol = Protocol::named(name)?;
    protocol.conditions.patterns = vec![Pattern::Step];
    protocol.conditions.contrasts = vec![1.0];
    [protocol.schedule.trials_min, protocol.schedule.trials_max] = trials;
    Ok(protocol)
}

fn cells() -> Result<Vec<Cell>, Error> {
    let person = WeibullObserver::default();
    let lapses = |lapse_probability| WeibullObserver { lapse_probability, ..person };
    let slope = |slope_per_log10| WeibullObserver { slope_per_log10, ..person };
    let tiring = |fatigue| WeibullObserver { fatigue, ..person };
    let falls = tiring(Fatigue { threshold_fall_log10_per_100_trials: 0.4, ..Fatigue::default() });
    let slips = tiring(Fatigue { lapse_growth_per_100_trials: 0.3, ..Fatigue::default() });
    let of = |name, protocol, kinds: &[(u32, WeibullObserver)]| Cell { name, protocol, kinds: kinds.to_vec() };
    let twenty = || protocol("two-alternative", [20; 2]);
    Ok(vec![
        of("as assumed, 10 x 10", protocol("two-alternative", [10; 2])?, &[(10, person)]),
        of("as assumed", twenty()?, &[(20, person)]),
        of(
            "as assumed, 10 to 36 trials by the rule of convergence",
            protocol("two-alternative", [10, 36])?,
            &[(20, person)],
        ),
        of("as assumed, yes-no with lines and catch trials", protocol("yes-no", [20; 2])?, &[(20, person)]),
        of("slope 2", twenty()?, &[(20, slope(2.0))]),
        of("lapses 15 %", twenty()?, &[(20, lapses(0.15))]),
        of("lapses 30 % in ten, none in ten", twenty()?, &[(10, lapses(0.3)), (10, lapses(0.0))]),
        of("slope 1.5 in ten, 8 in ten", twenty()?, &[(10, slope(1.5)), (10, slope(8.0))]),
        of(
            "slope 1.5 in ten, 8 in ten, 40 trials",
            protocol("two-alternative", [40; 2])?,
            &[(10, slope(1.5)), (10, slope(8.0))],
        ),
        of("ratio falls by 0.4 log10 in 100 trials", twenty()?, &[(20, falls)]),
        of("lapses grow by 30 % in 100 trials", twenty()?, &[(20, slips)]),
    ])
}

impl Cell {
    fn goodness(&self, seed: u64) -> Result<(GoodnessOfFit, f64), Error> {
        let mut people = Vec::new();
        for (index, (observers, person)) in self.kinds.iter().enumerate() {
            let median = ObserverModel::Weibull(*person);
            let (protocol, observers, seed) = (self.protocol.clone(), *observers, 10 * seed + index as u64);
            people.extend(Simulation { protocol, observers, seed, median, between_sd_log10: 0.1 }.study()?.people);
        }
        let study = Study::of(self.protocol.clone(), people)?;
        let Some(&round) = study.protocol.rounds().first() else {
            return Err(Error::CannotFit("a cell has one round".to_owned()));
        };
        let series = Series::of(round, &study.people, &study.protocol)?;
        let start = Instant::now();
        let found = GoodnessOfFit::of(&series, &study.people, &study.protocol)?;
        Ok((found, start.elapsed().as_secs_f64()))
    }

    fn row(&self, cohorts: u64, first_seed: u64) -> Result<String, Error> {
        let all: Vec<(GoodnessOfFit, f64)> = (0..cohorts)
            .into_par_iter()
            .map(|index| self.goodness(first_seed + index))
            .collect::<Result<_, Error>>()?;
        let mean =
            |value: &dyn Fn(&GoodnessOfFit) -> f64| all.iter().map(|(fit, _)| value(fit)).sum::<f64>() / cohorts as f64;
        let below = |p: f64| 100.0 * f64::from(u8::from(p < 0.05));
        let secs = all.iter().map(|(_, secs)| secs).sum::<f64>() / cohorts as f64;
        eprintln!("{}: {secs:.2} s a cohort", self.name);
        Ok(format!(
            "| {} | {:.1} % | {:.2} | {:.1} % | {:.2} |",
            self.name,
            mean(&|fit| below(fit.p_value)),
            mean(&|fit| fit.p_value),
            mean(&|fit| below(fit.drift_p_value)),
            mean(&|fit| fit.drift_p_value),
        ))
    }
}

fn main() -> Result<(), Error> {
    let mut arguments = std::env::args().skip(1).map(|argument| argument.parse().ok());
    let mut next = |default: u64| arguments.next().flatten().unwrap_or(default);
    let (cohorts, first_seed) = (next(200), next(1));
    println!("{cohorts} cohorts a cell, seeds from {first_seed}\n");
    println!("| people are | people: p below 0.05 | mean p | time: p below 0.05 | mean p |");
    println!("|---|---|---|---|---|");
    for cell in cells()? {
        println!("{}", cell.row(cohorts, first_seed)?);
    }
    Ok(())
}
