//! One trial in time: an empty screen, then the pictures until the answer.
//!
//! The empty interval lets the eye forget the former pictures and hides the time that drawing takes.
//! The response time runs from the frame that first holds the pictures to the frame that takes the
//! key; both ends lag by the display's and the keyboard's delay, a few hundredths of a second.

use std::time::{Duration, Instant};

use eframe::egui;
use scumble_psychophysics::{Answer, Reply, Trial};

use crate::pixels::Picture;

/// Length of the empty interval.
const BLANK: Duration = Duration::from_millis(500);

/// A trial on its way to the screen.
pub(crate) struct Presentation {
    trial: Trial,
    opened_at: Instant,
    blank_is_on_screen: bool,
    /// From left to right.
    pictures: Option<Vec<Picture>>,
    shown_at: Option<Instant>,
}

impl Presentation {
    /// A trial whose empty interval begins now.
    pub(crate) fn new(trial: Trial) -> Self {
        Self { trial, opened_at: Instant::now(), blank_is_on_screen: false, pictures: None, shown_at: None }
    }

    /// The trial that this presents.
    pub(crate) fn trial(&self) -> &Trial {
        &self.trial
    }

    /// Takes the step that this frame asks for: nothing in the first, so that the empty screen
    /// appears, then the drawing of the pictures, then their appearance.
    pub(crate) fn advance(&mut self, context: &egui::Context, size_px: [u32; 2]) -> Result<(), scumble_stimuli::Error> {
        if self.shown_at.is_some() {
            return Ok(());
        }
        if self.blank_is_on_screen && self.pictures.is_none() {
            let stimuli = self.trial.pictures.all().into_iter();
            let pictures = stimuli.map(|stimulus| Picture::new(context, stimulus, size_px));
            self.pictures = Some(pictures.collect::<Result<_, _>>()?);
        }
        self.blank_is_on_screen = true;
        let rest = BLANK.saturating_sub(self.opened_at.elapsed());
        match (&self.pictures, rest) {
            (Some(_), Duration::ZERO) => self.shown_at = Some(Instant::now()),
            (Some(_), rest) => context.request_repaint_after(rest),
            (None, _) => context.request_repaint(),
        }
        Ok(())
    }

    /// The pictures from left to right, once the interval is over.
    pub(crate) fn pictures(&self) -> Option<&[Picture]> {
        self.shown_at.and(self.pictures.as_deref())
    }

    /// What `answer`, given now, tells the experiment; `None` before the pictures appeared.
    pub(crate) fn reply(&self, answer: Answer) -> Option<Reply> {
        let response_time_secs = self.shown_at?.elapsed().as_secs_f64();
        let pictures_sha256 = self.pictures()?.iter().map(|picture| picture.sha256.clone()).collect();
        Some(Reply { answer, response_time_secs, pictures_sha256 })
    }
}
