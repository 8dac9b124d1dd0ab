//! What one psychometric function costs: the fit of a table, its whole report, a fit to single answers.

#![allow(clippy::unwrap_used, reason = "a benchmark that cannot start stops")]
#![allow(missing_docs, reason = "criterion's macro makes public functions")]

use std::{hint::black_box, path::Path};

use criterion::{Criterion, criterion_group, criterion_main};
use scumble_analysis::{Count, Model, Parameter, Resampling, ThresholdReport, fit, fit_count_table, read_count_table};

fn threshold(criterion: &mut Criterion) {
    let table = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/weibull_fit_data.csv");
    let counts = read_count_table(&table).unwrap();
    let lapse = Parameter::Fixed(0.01);
    for (name, lapse) in [("fit", lapse), ("fit_free_lapse", Parameter::Free)] {
        criterion
            .bench_function(name, |bencher| bencher.iter(|| fit_count_table(black_box(&counts), 0.5, lapse).unwrap()));
    }
    let report = || ThresholdReport::of(black_box(&counts), 0.5, lapse, &Resampling::default(), || ()).unwrap();
    criterion.bench_function("report_2000_resamples", |bencher| bencher.iter(report));

    // 72 answers, each at a level of its own, as staircases give them.
    let answer = |index: u32| Count {
        x: 0.004 * f64::from(index) - 0.144,
        correct: f64::from(u8::from(!index.is_multiple_of(5) || index > 50)),
        total: 1.0,
    };
    let answers: Vec<Count> = (0..72).map(answer).collect();
    let model = Model { guess: 0.5, lapse: Parameter::Fixed(0.005), slope: Parameter::Fixed(3.5) };
    criterion.bench_function("fit_72_answers", |bencher| bencher.iter(|| fit(black_box(&answers), &model).unwrap()));
}

criterion_group!(benches, threshold);
criterion_main!(benches);
