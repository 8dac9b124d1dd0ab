//! Set-ups and a window for the tests of the pages.

use std::path::{Path, PathBuf};

use eframe::egui::{self, Vec2};
use egui_kittest::Harness;
use scumble_psychophysics::{Display, Language};

use crate::session_folder::{Found, Interrupted};
use crate::setup::{Given, RecentFolders, Setup, SetupAction};
use crate::theme;

/// A set-up on show and what it asked for.
pub(super) type Shown = (Setup, Vec<SetupAction>);

pub(super) fn given(folder: &Path) -> Given {
    let monitor = |name: &str, [width_px, height_px]: [u32; 2], scale_factor| Display {
        monitor: Some(name.to_owned()),
        width_px,
        height_px,
        scale_factor,
        refresh_hz: Some(60.0),
        ..Display::default()
    };
    Given {
        folder: folder.display().to_string(),
        protocol: None,
        participant: "p07".to_owned(),
        participant_number: None,
        language: Language::English,
        monitors: vec![monitor("EIZO CG2700S", [2560, 1440], 1.0), monitor("Built-in", [1920, 1200], 1.25)],
        monitor: 0,
        px_per_degree: None,
        recent: RecentFolders::default(),
        find: Box::new(|study, code| Ok(Found::Free(study.join(code)))),
    }
}

pub(super) fn harness(setup: Setup, size: Vec2, pixels_per_point: f32) -> Harness<'static, Shown> {
    let show = |ui: &mut egui::Ui, (setup, asked): &mut Shown| {
        theme::dress_screen(ui);
        asked.extend(super::setup(ui, setup));
    };
    Harness::builder()
        .with_size(size)
        .with_pixels_per_point(pixels_per_point)
        .with_context_setup(theme::apply)
        .build_ui_state(show, (setup, Vec::new()))
}

pub(super) fn at_720(setup: Setup) -> Harness<'static, Shown> {
    harness(setup, Vec2::new(1280.0, 720.0), 1.0)
}

/// A study folder with consent texts and a measured display. Paths are relative, so that the pages show the
/// same ones on every machine.
pub(super) const MEASURED: &str = "tests/setup/measured";
/// A study that is not there yet.
pub(super) const NEW: &str = "study1";
/// One with a whole path, which the first page then does not have to tell.
pub(super) const NEW_WHOLE: &str = "/studies/study1";

pub(super) fn new_study() -> Setup {
    Setup::new(given(Path::new(NEW)))
}

/// A set-up after this many pages.
pub(super) fn after(mut setup: Setup, pages: usize) -> Setup {
    (0..pages).for_each(|_| setup.next());
    setup
}

/// A page after its first frames, in which the keyboard finds its place.
pub(super) fn settled(setup: Setup) -> Harness<'static, Shown> {
    let mut harness = at_720(setup);
    harness.run_steps(3);
    harness
}

/// A session of 83 of at most 240 trials that was interrupted 12 minutes ago.
pub(super) fn interrupted(directory: PathBuf) -> Interrupted {
    Interrupted { directory, age_secs: 725.0, trials: 83, trials_at_most: 240 }
}
