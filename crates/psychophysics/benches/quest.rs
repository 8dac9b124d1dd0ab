//! What one trial costs: QUEST on its table of 501 points, QUEST+ on its default grid, and the
//! convergence rule on either.

#![allow(clippy::unwrap_used, reason = "a benchmark that cannot start stops")]
#![allow(missing_docs, reason = "criterion's macro makes public functions")]

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use scumble_psychophysics::{Convergence, Staircase, StaircaseConfig};

/// Responses in a session before the one that is measured.
const TRIALS: usize = 24;

/// A staircase after [`TRIALS`] responses at its placements, every fifth one wrong, and the responses.
fn under_way(config: &StaircaseConfig) -> (Staircase, Vec<(f64, bool)>) {
    let mut staircase = config.staircase(-0.477).unwrap();
    let responses = (0..TRIALS).map(|trial| {
        let response = (staircase.placement(), trial % 5 != 4);
        staircase.update(response.0, response.1).unwrap();
        response
    });
    let responses = responses.collect();
    (staircase, responses)
}

fn trial(criterion: &mut Criterion) {
    for (name, config) in [("quest", StaircaseConfig::quest()), ("quest_plus", StaircaseConfig::quest_plus())] {
        let (staircase, responses) = under_way(&config);
        let rule = Convergence::default();
        let mut group = criterion.benchmark_group(name);
        group.bench_function("new", |bencher| bencher.iter(|| config.staircase(-0.477).unwrap()));
        group.bench_function("update", |bencher| {
            let update = |staircase: &mut Staircase| staircase.update(-0.52, true).unwrap();
            bencher.iter_batched_ref(|| staircase.clone(), update, BatchSize::SmallInput);
        });
        group.bench_function("update_and_placement", |bencher| {
            let update_and_place = |staircase: &mut Staircase| {
                staircase.update(-0.52, true).unwrap();
                staircase.placement()
            };
            bencher.iter_batched_ref(|| staircase.clone(), update_and_place, BatchSize::SmallInput);
        });
        group.bench_function("judge", |bencher| {
            bencher.iter(|| rule.judge(&staircase, &responses, (-1.04, 0.3)).unwrap());
        });
        group.finish();
    }
}

criterion_group!(benches, trial);
criterion_main!(benches);
