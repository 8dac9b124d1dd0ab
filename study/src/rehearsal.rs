//! A simulated person at the keyboard, for demonstrations, dry runs and tests.
//!
//! It looks at what is on the screen and decides which key to press and when; the key then goes the way
//! of every other one.

use std::time::{Duration, Instant};

use eframe::egui::Key;
use scumble_psychophysics::{Answer, Error, Observer, PictureRules, Trial};

/// How long a page without a question is read, at a person's speed.
const READING: Duration = Duration::from_secs(3);

/// What the person sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Scene<'a> {
    /// Nothing that asks for a key.
    Waiting,
    /// A page that the space bar turns, by its name.
    Page(&'static str),
    /// The pictures of a trial, since then.
    Pictures { trial: &'a Trial, shown_at: Instant },
}

/// The person.
pub(crate) struct Rehearsal {
    observer: Observer,
    /// Times as fast as a person.
    speed: f64,
    /// The page being read and since when.
    page: Option<(&'static str, Instant)>,
}

/// What the person does now.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Move {
    Press(Key),
    /// Look again after this time.
    Wait(Duration),
    /// Nothing until something else is shown.
    Nothing,
}

impl Rehearsal {
    pub(crate) fn new(observer: Observer, speed: f64) -> Self {
        Self { observer, speed, page: None }
    }

    /// An interval that a person takes, at this person's speed.
    pub(crate) fn scaled(&self, duration: Duration) -> Duration {
        duration.div_f64(self.speed)
    }

    /// What to do in front of `scene`; errors are those of the simulated person looking at pictures.
    pub(crate) fn act(&mut self, scene: Scene<'_>, rules: &PictureRules, now: Instant) -> Result<Move, Error> {
        let (key, due) = match scene {
            Scene::Waiting => {
                self.page = None;
                return Ok(Move::Nothing);
            }
            Scene::Page(name) => {
                let since = match self.page {
                    Some((known, since)) if known == name => since,
                    _ => now,
                };
                self.page = Some((name, since));
                (Key::Space, since + self.scaled(READING))
            }
            Scene::Pictures { trial, shown_at } => {
                self.page = None;
                let response_time = Duration::from_secs_f64(self.observer.response_time_secs(trial));
                (key_of(self.observer.answer(trial, rules)?), shown_at + self.scaled(response_time))
            }
        };
        let wait = due.saturating_duration_since(now);
        if !wait.is_zero() {
            return Ok(Move::Wait(wait));
        }
        // Should the page stay, it is read once more.
        self.page = None;
        Ok(Move::Press(key))
    }
}

/// The key that gives an answer.
fn key_of(answer: Answer) -> Key {
    match answer {
        Answer::Left => Key::ArrowLeft,
        Answer::Right => Key::ArrowRight,
        Answer::Yes => Key::Y,
        Answer::No => Key::N,
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test fails by panicking")]
mod tests {
    use super::*;
    use scumble_psychophysics::{Experiment, ObserverModel, Protocol};

    #[test]
    fn pages_are_read_and_pictures_looked_at_before_a_key_is_pressed() {
        let protocol = Protocol::two_alternative();
        let rules = protocol.pictures;
        let observer = Observer::new(ObserverModel::default(), 7).unwrap();
        let mut person = Rehearsal::new(observer, 10.0);
        let start = Instant::now();
        let after = |secs: f64| start + Duration::from_secs_f64(secs);
        let mut act = |scene, secs| person.act(scene, &rules, after(secs)).unwrap();

        assert_eq!(act(Scene::Page("rest"), 0.0), Move::Wait(Duration::from_millis(300)));
        assert_eq!(act(Scene::Page("rest"), 0.31), Move::Press(Key::Space));
        assert_eq!(act(Scene::Page("rest"), 0.32), Move::Wait(Duration::from_millis(300)), "it was not turned");
        assert_eq!(act(Scene::Waiting, 5.0), Move::Nothing);

        let mut experiment = Experiment::new(protocol, 1, 1).unwrap();
        experiment.proceed().unwrap();
        let trial = *experiment.stage().trial().unwrap();
        let secs = observer.response_time_secs(&trial) / 10.0;
        let scene = Scene::Pictures { trial: &trial, shown_at: after(6.0) };
        assert!(matches!(act(scene, 6.0 + 0.5 * secs), Move::Wait(_)));
        let key = key_of(observer.answer(&trial, &rules).unwrap());
        assert_eq!(act(scene, 6.0 + 1.01 * secs), Move::Press(key));
    }
}
