//! The pages before the instructions, one a file. A page shows a [`Setup`] and passes on what was done.

mod about;
mod brightness;
mod consent;
mod focus;
mod frame;
mod room;
mod screen;
mod study;
mod summary;
mod widgets;

#[cfg(test)]
mod hands;
#[cfg(test)]
mod sizes;
#[cfg(test)]
mod snapshots;
#[cfg(test)]
mod testing;

use eframe::egui::Ui;
use jiff::Timestamp;

use crate::setup::{Page, Setup, SetupAction};
use crate::words;
use frame::Press;

/// The page on show; to be called every frame until it asks for what the set-up cannot do.
pub(crate) fn setup(ui: &mut Ui, setup: &mut Setup) -> Option<SetupAction> {
    let words = &words::words(setup.language()).setup;
    let page = setup.page();
    let is_new = focus::is_new_page(ui, page);
    let mut asked = None;
    let pressed = frame::frame(ui, setup, words, |ui, setup| match page {
        Page::Study => asked = study::study(ui, setup, words, is_new),
        Page::Screen => screen::screen(ui, setup, words, is_new),
        Page::Brightness => brightness::brightness(ui, setup, words, is_new),
        Page::Room => room::room(ui, setup, words, is_new),
        Page::Consent => consent::consent(ui, setup, words),
        Page::Declined => _ = ui.label(words.declined),
        Page::About => about::about(ui, &mut setup.about, words, is_new),
        Page::Summary => summary::summary(ui, setup, words),
    });
    focus::ring(ui);
    match (pressed, page) {
        (Some(Press::Back), _) => setup.back(),
        (Some(Press::Decline), _) => setup.decline(),
        (Some(Press::Next), Page::Consent) => setup.agree(Timestamp::now()),
        (Some(Press::Next), Page::Declined) => return Some(SetupAction::Quit),
        (Some(Press::Next), Page::Summary) => {
            return setup.finish().ok().map(|ready| SetupAction::Done(Box::new(ready)));
        }
        (Some(Press::Next), _) => setup.next(),
        (None, _) => return asked,
    }
    ui.request_repaint();
    asked
}
