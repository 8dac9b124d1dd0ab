//! Sessions for the tests: a simulated person answers up to a point.

use eframe::egui::{self, Vec2};
use egui_kittest::Harness;
use scumble_psychophysics::{
    Event, Experiment, Language, Moment, Observer, ObserverModel, Protocol, Reply, SessionHeader, Software, Stage,
    Timing,
};

use super::{Bands, DeskState, Disk, Given, Order, Status};
use crate::theme;
use crate::words::words;

/// A session of a simulated person, as far as it went.
pub(super) struct Rehearsed {
    pub(super) experiment: Experiment,
    pub(super) header: SessionHeader,
    pub(super) events: Vec<Event>,
    pub(super) now_secs: f64,
    observer: Observer,
}

impl Rehearsed {
    /// Before its instructions.
    pub(super) fn new(protocol: &str) -> Self {
        let protocol = Protocol::named(protocol).unwrap();
        let started_at = "2026-03-01T09:00:00Z".parse().unwrap();
        let software = Software::of("scumble-study", "0.1.0");
        let header = SessionHeader::new("p07", protocol.clone(), 2, started_at, software);
        let experiment = Experiment::new(protocol, 2, 0).unwrap();
        let observer = Observer::new(ObserverModel::default(), 1).unwrap();
        Self { experiment, header, events: Vec::new(), now_secs: 0.0, observer }
    }

    /// Goes on until the stage is one that `is_reached` accepts, or the end.
    pub(super) fn until(mut self, is_reached: impl Fn(&Experiment) -> bool) -> Self {
        while !is_reached(&self.experiment) && *self.experiment.stage() != Stage::Finished {
            let Some(trial) = self.experiment.stage().trial().copied() else {
                self.experiment.proceed().unwrap();
                continue;
            };
            // Three seconds from pictures to pictures.
            self.now_secs += 3.0;
            let answer = self.observer.answer(&trial, &self.experiment.protocol().pictures).unwrap();
            let timing = Some(Timing { onset_secs: self.now_secs, missed_frames: u32::from(trial.number == 4) });
            let reply = Reply { answer, response_time_secs: 2.5, pictures_sha256: Vec::new(), timing };
            self.events.push(self.experiment.answer(reply).unwrap());
        }
        self
    }

    /// Until trial `number` is on show.
    pub(super) fn at_trial(self, number: u32) -> Self {
        self.until(|experiment| matches!(experiment.stage(), Stage::Trial(trial) if trial.number == number))
    }

    /// What happened now, with a note.
    pub(super) fn moment(&self, note: &str) -> Moment {
        let since = jiff::SignedDuration::try_from_secs_f64(self.now_secs).unwrap();
        let at = self.header.started_at.checked_add(since).unwrap();
        Moment { at, notes: vec![note.to_owned()], interrupted_secs: None }
    }

    /// The status of now.
    pub(super) fn status(&self) -> Status {
        self.status_of(false, Disk::Saved)
    }

    pub(super) fn status_of(&self, is_paused: bool, disk: Disk) -> Status {
        Status::of(self.given(is_paused, disk), &mut Bands::default()).unwrap()
    }

    /// What the status of now is made from.
    pub(super) fn given(&self, is_paused: bool, disk: Disk) -> Given<'_> {
        Given {
            experiment: &self.experiment,
            header: &self.header,
            events: &self.events,
            elapsed_secs: self.now_secs,
            has_begun: *self.experiment.stage() != Stage::Instructions,
            is_paused,
            stopped: None,
            refused_round: None,
            other_display: None,
            disk,
        }
    }
}

/// A panel on show and what it ordered.
pub(super) struct Shown {
    pub(super) status: Status,
    pub(super) desk: DeskState,
    pub(super) orders: Vec<Order>,
}

pub(super) fn harness(
    status: Status,
    desk: DeskState,
    language: Language,
    size: Vec2,
    pixels_per_point: f32,
) -> Harness<'static, Shown> {
    let words = &words(language).desk;
    let draw = |ui: &mut egui::Ui, shown: &mut Shown| {
        // The whole window, as in the program; the harness keeps a margin.
        let window = egui::UiBuilder::new().max_rect(ui.ctx().content_rect());
        let order = ui.scope_builder(window, |ui| super::show(ui, &shown.status, &mut shown.desk, words)).inner;
        shown.orders.extend(order);
    };
    Harness::builder()
        .with_size(size)
        .with_pixels_per_point(pixels_per_point)
        .with_context_setup(theme::apply)
        .build_ui_state(draw, Shown { status, desk, orders: Vec::new() })
}
