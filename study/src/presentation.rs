//! One trial in time: a fixation cross, then the pictures until the answer.
//!
//! The fixation interval lets the eye forget the former pictures and hides the time that drawing takes.
//! The response time runs from the frame that first holds the pictures to the frame that takes the
//! key; both ends lag by the display's and the keyboard's delay, a few hundredths of a second.

use std::time::{Duration, Instant};

use eframe::egui;
use scumble_psychophysics::{Answer, Reply, Timing, Trial};
use scumble_stimuli::Transfer;

use crate::clock::Clock;
use crate::pixels::{Picture, draw};

/// Length of the fixation interval for a person.
pub(crate) const FIXATION: Duration = Duration::from_millis(500);
/// What a display that does not tell is taken for; most are.
const USUAL_REFRESH_HZ: f64 = 60.0;

/// What the pictures of a session are shown on.
#[derive(Clone, Debug)]
pub(crate) struct Screen {
    /// Size of a picture in physical pixels.
    pub(crate) size_px: [u32; 2],
    pub(crate) transfer: Transfer,
    pub(crate) refresh_hz: Option<f64>,
}

/// A trial on its way to the screen.
pub(crate) struct Presentation {
    trial: Trial,
    fixation: Duration,
    opened_at: Instant,
    cross_is_on_screen: bool,
    /// From left to right.
    pictures: Option<Vec<Picture>>,
    shown: Option<Shown>,
}

#[derive(Clone, Copy)]
struct Shown {
    at: Instant,
    missed_frames: u32,
}

impl Presentation {
    /// A trial whose fixation interval begins now.
    pub(crate) fn new(trial: Trial, fixation: Duration) -> Self {
        let opened_at = Instant::now();
        Self { trial, fixation, opened_at, cross_is_on_screen: fixation.is_zero(), pictures: None, shown: None }
    }

    /// The trial that this presents.
    pub(crate) fn trial(&self) -> &Trial {
        &self.trial
    }

    /// Takes the step that this frame asks for: nothing in the first, so that the cross appears, then the
    /// drawing of the pictures, then their appearance.
    pub(crate) fn advance(&mut self, context: &egui::Context, screen: &Screen) -> Result<(), scumble_stimuli::Error> {
        if self.shown.is_some() {
            return Ok(());
        }
        if self.cross_is_on_screen && self.pictures.is_none() {
            let images = draw(&self.trial.pictures.all(), screen.size_px, &screen.transfer)?;
            self.pictures = Some(images.iter().map(|image| Picture::new(context, image)).collect());
        }
        self.cross_is_on_screen = true;
        let elapsed = self.opened_at.elapsed();
        match (&self.pictures, self.fixation.saturating_sub(elapsed)) {
            (Some(_), Duration::ZERO) => {
                let late = elapsed.saturating_sub(self.fixation);
                self.shown = Some(Shown { at: Instant::now(), missed_frames: missed_frames(late, screen.refresh_hz) });
            }
            (Some(_), rest) => context.request_repaint_after(rest),
            (None, _) => context.request_repaint(),
        }
        Ok(())
    }

    /// The pictures from left to right, once the interval is over.
    pub(crate) fn pictures(&self) -> Option<&[Picture]> {
        self.shown.and(self.pictures.as_deref())
    }

    /// When the pictures appeared.
    pub(crate) fn shown_at(&self) -> Option<Instant> {
        self.shown.map(|shown| shown.at)
    }

    /// What `answer`, given now, tells the experiment; `None` before the pictures appeared.
    pub(crate) fn reply(&self, answer: Answer, clock: &Clock) -> Option<Reply> {
        let Shown { at, missed_frames } = self.shown?;
        Some(Reply {
            answer,
            response_time_secs: at.elapsed().as_secs_f64(),
            pictures_sha256: self.pictures()?.iter().map(|picture| picture.sha256.clone()).collect(),
            timing: Some(Timing { onset_secs: clock.at(at), missed_frames }),
        })
    }
}

/// Refreshes of the display that went by after the pictures were due, but for the one in which a picture
/// that is in time appears.
fn missed_frames(late: Duration, refresh_hz: Option<f64>) -> u32 {
    (late.as_secs_f64() * refresh_hz.unwrap_or(USUAL_REFRESH_HZ)) as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_within_one_refresh_is_in_time() {
        let missed = |milliseconds, hz| missed_frames(Duration::from_millis(milliseconds), hz);
        assert_eq!([0, 16, 17, 33, 34].map(|late| missed(late, None)), [0, 0, 1, 1, 2]);
        assert_eq!([6, 7, 14].map(|late| missed(late, Some(144.0))), [0, 1, 2]);
    }
}
