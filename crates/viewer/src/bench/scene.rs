//! One scene of the benchmark: all variants timed in turns, then each compared with the truth of its method.

use anyhow::Result;
use indicatif::ProgressBar;
use scumble::Statistic;
use scumble_reference::{Rays, penumbra};

use crate::bench::comparison::{Screen, Truths, compare};
use crate::bench::demand::DemandHistogram;
use crate::bench::edges::EdgeTruth;
use crate::bench::partial::Partial;
use crate::bench::pictures::Pictures;
use crate::bench::row::{Key, Row, Timings};
use crate::bench::sweep::sweep;
use crate::bench::walk::walk;
use crate::cli::{Bench, Method, Motion};
use crate::gbuffer::GBuffer;
use crate::output::make_directory;
use crate::progress::{progress, say};
use crate::size::Size;
use crate::stage::Stage;
use crate::timer::Timer;
use crate::truth::{Samples, Source, Store};
use crate::variant::{Case, Variant, still_settings};

/// Samples per pixel along x and along y of the pictures.
const SAMPLES_PER_SIDE: u32 = 2;

/// A filter with its softness; its sizes are compared with one truth.
type Filtering = (Method, f64);

/// The filters of a run. Without a filter there is no softness.
fn filterings(options: &Bench) -> Vec<Filtering> {
    let of_method = |&method: &Method| {
        let count = if method == Method::None { 1 } else { options.softness.len() };
        options.softness[..count].iter().map(move |&softness| (method, softness)).collect::<Vec<_>>()
    };
    options.methods.iter().flat_map(of_method).collect()
}

/// Number of rows of a scene.
pub fn rows_of_scene(options: &Bench) -> usize {
    filterings(options).len() * options.sizes.len()
}

/// The ratio is swept at the first softness.
fn is_swept(options: &Bench, (_, softness): Filtering) -> bool {
    options.sweep_ratio && Some(&softness) == options.softness.first()
}

/// Whether the pictures of a filter in a scene leave nothing to do.
fn is_done(options: &Bench, partial: &Partial, scene: &str, (method, softness): Filtering) -> bool {
    let key = |&size: &Size| Key::of(scene, &Case { method, size, softness });
    options.sizes.iter().all(|size| partial.has_row(&key(size)) && partial.has_demand(&key(size)))
        && (!is_swept(options, (method, softness)) || partial.has_sweep(scene, method.name()))
}

/// The paths that a scene lacks, with the adaptive case that takes them.
fn walks_left(options: &Bench, partial: &Partial, scene: &str) -> Vec<(Case, Motion)> {
    let soft = options.methods.iter().filter(|&&method| method != Method::None);
    let cases = soft.flat_map(|&method| {
        options.softness.first().map(|&softness| Case { method, size: Size::Adaptive(Statistic::default()), softness })
    });
    let walks = cases.flat_map(|case| options.paths.iter().map(move |&motion| (case, motion)));
    walks.filter(|(case, motion)| !partial.has_walk(&Key::of(scene, case), motion.name())).collect()
}

/// Whether a former run has finished a scene.
pub fn is_finished(options: &Bench, partial: &Partial, scene: &str) -> bool {
    filterings(options).into_iter().all(|filtering| is_done(options, partial, scene, filtering))
        && walks_left(options, partial, scene).is_empty()
}

/// The paths that a scene lacks.
pub fn walk_scene(options: &Bench, size_px: [u32; 2], stage: &mut Stage, partial: &mut Partial) -> Result<()> {
    let name = stage.setup.scene.name.clone();
    for (case, motion) in walks_left(options, partial, &name) {
        partial.add_walk(walk(stage, size_px, case, Size::beside(&options.sizes), motion)?)?;
    }
    Ok(())
}

/// Adds to `partial` what it lacks of a scene; `rows` advances by one for each row.
pub fn bench_scene(
    options: &Bench,
    size_px: [u32; 2],
    stage: &Stage,
    store: &Store,
    partial: &mut Partial,
    rows: &ProgressBar,
) -> Result<()> {
    let name = stage.setup.scene.name.clone();
    let left: Vec<Filtering> =
        filterings(options).into_iter().filter(|&filtering| !is_done(options, partial, &name, filtering)).collect();
    let receivers = stage.receivers(size_px, 1)?;
    let mut timer = Timer::new(&stage.gpu);
    let mut variants = Vec::new();
    for &(method, softness) in &left {
        for &size in &options.sizes {
            let case = Case { method, size, softness };
            let mut variant = Variant::new(stage, &receivers, case, still_settings(&stage.setup))?;
            variant.settle(stage, &receivers, &mut timer)?;
            variants.push(variant);
        }
    }
    if !partial.has_times(&name) {
        time(options, stage, &receivers, &mut variants, &mut timer, partial)?;
    }

    let screen = Screen::new(&stage.setup.scene.light, receivers.read_surfaces(&stage.gpu)?, size_px);
    let rays = Rays::new(&stage.setup.scene);
    rays.skipped().iter().for_each(|skipped| eprintln!("warning: {name}: {skipped}"));
    let samples_per_side = if options.quick { 1 } else { SAMPLES_PER_SIDE };
    for &(method, softness) in &left {
        let is_of_filter = |variant: &Variant| (variant.case.method, variant.case.softness) == (method, softness);
        let truths = truths(stage, &rays, store, options.light_samples(), &screen, (method, softness))?;

        let directory = options.out.join(directory_name(&name)).join(directory_of_filter((method, softness)));
        make_directory(&directory)?;
        let pictures = Pictures::new(stage, &directory, size_px, samples_per_side)?;
        let truth_picture = pictures.truth(&truths.kernel, &screen.surfaces)?;
        for variant in variants.iter_mut().filter(|variant| is_of_filter(variant)) {
            let key = Key::of(&name, &variant.case);
            if partial.has_row(&key) {
                continue;
            }
            let visibility = variant.read_visibility(stage)?;
            let radii = variant.read_radii(stage, &receivers)?;
            let comparison = compare(stage, variant, &screen, &visibility, &truths, &radii)?;
            let label = label(variant.case.size, &options.sizes);
            let files =
                pictures.variant(variant, &label, &visibility, &truths.kernel, &screen.lit_facing, &truth_picture)?;
            let row = Row::new(stage, variant, partial.times(&key), comparison, files, &options.out)?;
            say(&row);
            partial.add_row(row)?;
            rows.inc(1);
        }
        let measuring =
            variants.iter().filter(|variant| is_of_filter(variant)).max_by_key(|variant| variant.case.size.texels());
        if let Some(variant) = measuring
            && !partial.has_demand(&Key::of(&name, &variant.case))
        {
            let radii = variant.read_radii(stage, &receivers)?;
            let penumbra = penumbra(&truths.kernel, &screen.lit_facing)?;
            partial.add_demand(DemandHistogram::of(stage, variant, &screen, &penumbra, &radii)?)?;
        }
        if is_swept(options, (method, softness)) && !partial.has_sweep(&name, method.name()) {
            partial.add_sweep(&name, method.name(), sweep(stage, &receivers, (method, softness), &screen, &truths)?)?;
        }
    }
    Ok(())
}

/// The truths of a filter on a screen. The light's is that of the hard shadow and of PCSS, which both stand for it.
fn truths(
    stage: &Stage,
    rays: &Rays,
    store: &Store,
    light_samples: u32,
    screen: &Screen,
    (method, softness): Filtering,
) -> Result<Truths> {
    let light = stage.setup.light(softness)?;
    let fit = stage.setup.fit(softness)?;
    let filter = stage.setup.filter(method, softness);
    let find = |what: &str, samples: Samples| {
        let source = Source::new(rays, &light, fit.as_ref(), filter, samples)?;
        let message = format!("{}: truth of {what}", stage.setup.scene.name);
        let found = store.find(&message, &source, &stage.setup.scene.meshes, &screen.surfaces, screen.size_px)?;
        anyhow::Ok(found.estimates)
    };
    let kernel: Vec<f32> =
        find(method.name(), Samples::of_method(method))?.iter().map(|found| found.visibility).collect();
    let is_of_light = filter.fixed_radius_world().is_none();
    let light = is_of_light.then(|| find("the light", Samples::Light(light_samples))).transpose()?;
    Ok(Truths { edges: EdgeTruth::new(screen, &kernel), kernel, light })
}

/// Times the frames of all variants of a scene, which take turns.
fn time(
    options: &Bench,
    stage: &Stage,
    receivers: &GBuffer,
    variants: &mut [Variant],
    timer: &mut Timer,
    partial: &mut Partial,
) -> Result<()> {
    let name = &stage.setup.scene.name;
    let bar = progress(&format!("{name}: frames"), u64::from(options.frames));
    let mut timings: Vec<Timings> = variants.iter().map(|_| Timings::default()).collect();
    let mut drawing = Timings::default();
    let unshadowed = stage.visibility_texture(receivers);
    for _ in 0..options.frames {
        for (variant, timing) in variants.iter_mut().zip(&mut timings) {
            timing.add(&variant.frame(stage, receivers, timer)?);
        }
        drawing.add(&stage.time_drawing(receivers, &unshadowed, timer)?);
        bar.inc(1);
    }
    bar.finish_and_clear();
    let drawing = drawing.spreads().remove("drawing");
    let of_variant = |(variant, timing): (&Variant, &Timings)| {
        let mut spreads = timing.spreads();
        spreads.extend(drawing.map(|spread| ("drawing".to_owned(), spread)));
        (Key::of(name, &variant.case), spreads)
    };
    partial.add_times(name, variants.iter().zip(&timings).map(of_variant).collect())
}

/// `adaptive`, `fixed` for the fixed size beside it, `fixed-512` for others.
fn label(size: Size, sizes: &[Size]) -> String {
    match size {
        Size::Adaptive(_) => size.to_string(),
        _ if Some(size) == Size::beside(sizes) => "fixed".into(),
        _ => format!("fixed-{size}"),
    }
}

/// The folder of a filter below the scene's.
fn directory_of_filter((method, softness): Filtering) -> String {
    if softness == 1.0 { method.name().into() } else { format!("{}-x{softness}", method.name()) }
}

/// A scene's name as a folder's, whatever its file was called.
fn directory_name(scene: &str) -> String {
    let safe = |character: char| if character.is_alphanumeric() || "-_".contains(character) { character } else { '-' };
    scene.chars().map(safe).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fixed_size_that_adaptive_ones_are_set_beside_is_the_fixed_one() {
        let sizes = [Size::Fixed([512, 512]), Size::Adaptive(Statistic::default()), Size::Fixed([1024, 2048])];
        assert_eq!(sizes.map(|size| label(size, &sizes)), ["fixed-512", "adaptive", "fixed"]);
        let usual = [Size::Fixed([4096; 2]), Size::Fixed([2048; 2]), Size::Blocks([2048; 2])];
        assert_eq!(usual.map(|size| label(size, &usual)), ["fixed-4096", "fixed", "fixed-2048+blocks"]);
    }

    #[test]
    fn a_scene_cannot_name_a_folder_elsewhere() {
        assert_eq!(directory_name("../my scene.v2"), "---my-scene-v2");
    }
}
