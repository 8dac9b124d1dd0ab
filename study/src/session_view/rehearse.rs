//! A simulated person at the session: what they see of it, and the keys that they press.

use std::time::Instant;

use eframe::egui;
use scumble_psychophysics::Stage;

use super::SessionView;
use crate::rehearsal::{Move, Scene};

impl SessionView {
    /// What a simulated person sees.
    pub(super) fn scene(&self) -> Scene<'_> {
        let sitting = &self.sitting;
        if self.fatal.is_some() || sitting.recorder().problem().is_some() || self.administrator.covers_screen() {
            return Scene::Waiting;
        }
        if sitting.is_paused() {
            return Scene::Page("paused");
        }
        match sitting.experiment().stage() {
            Stage::Practice(_) | Stage::Trial(_) => {
                let shown = self.presentation.as_ref().and_then(|shown| Some((shown.trial(), shown.shown_at()?)));
                shown.map_or(Scene::Waiting, |(trial, shown_at)| Scene::Pictures { trial, shown_at })
            }
            stage => Scene::Page(stage.name()),
        }
    }

    /// Lets the simulated person press a key.
    pub(crate) fn rehearse(&mut self, raw_input: &mut egui::RawInput) {
        if raw_input.viewport_id == egui::ViewportId::ROOT
            && let Err(error) = self.press(raw_input)
        {
            self.stop(&error);
        }
    }

    fn press(&mut self, raw_input: &mut egui::RawInput) -> anyhow::Result<()> {
        let Some(mut person) = self.rehearsal.take() else { return Ok(()) };
        let rules = self.sitting.experiment().protocol().pictures;
        let next = person.act(self.scene(), &rules, Instant::now());
        self.rehearsal = Some(person);
        match next? {
            Move::Press(key) => {
                for pressed in [true, false] {
                    let (physical_key, repeat, modifiers) = (None, false, egui::Modifiers::NONE);
                    raw_input.events.push(egui::Event::Key { key, physical_key, pressed, repeat, modifiers });
                }
            }
            Move::Wait(wait) => self.wake_after = Some(wait),
            Move::Nothing => {}
        }
        Ok(())
    }
}
