//! Time of one 600 x 600 picture of the experiment: every pattern and shape at the published ratio,
//! dithered; the other kernels; and what a tilt costs.
//!
//! `cargo bench -p scumble-stimuli`

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use scumble_stimuli::{Encoding, Kernel, Pattern, Shape, Stimulus, Transfer};

const SIDE_PX: u32 = 600;
/// Kreuzer 2017.
const RATIO: f64 = 3.47;
/// Two degrees.
const TILT_RAD: f64 = 0.035;

fn stimulus(pattern: Pattern, shape: Shape, texel_px: f64) -> Stimulus {
    Stimulus {
        pattern,
        shape,
        kernel: Kernel::Disc,
        texel_px,
        radius_px: RATIO * texel_px,
        contrast: 1.0,
        encoding: Encoding::LinearLight,
        phase: 0.3,
        mirrored: false,
        inverted: false,
        tilt_rad: 0.0,
        dither_seed: Some(1),
    }
}

fn render(criterion: &mut Criterion) {
    let transfer = Transfer::srgb();
    let mut time = |name: String, what: Stimulus| {
        criterion.bench_function(&name, |bencher| bencher.iter(|| black_box(what).render(SIDE_PX, SIDE_PX, &transfer)));
    };
    for pattern in [Pattern::Stair, Pattern::Step, Pattern::DoubleStep] {
        for shape in [Shape::Artifact, Shape::Line] {
            for texel_px in [10.0, 20.0] {
                let upright = stimulus(pattern, shape, texel_px);
                time(format!("{pattern:?} {shape:?} {texel_px}"), upright);
                time(format!("{pattern:?} {shape:?} {texel_px} tilted"), Stimulus { tilt_rad: TILT_RAD, ..upright });
            }
        }
    }
    for (name, kernel) in Kernel::NAMED {
        time(
            format!("Stair Artifact 20 {name}"),
            Stimulus { kernel, ..stimulus(Pattern::Stair, Shape::Artifact, 20.0) },
        );
    }
    let half = Stimulus { contrast: 0.5, ..stimulus(Pattern::Stair, Shape::Artifact, 20.0) };
    time("Stair Artifact 20 half contrast".to_owned(), half);
}

criterion_group!(benches, render);
criterion_main!(benches);
