//! Before the panel on the participant's own screen: whoever pressed its key by chance, or out of curiosity, sees
//! none of the charts.

use eframe::egui::Ui;

use super::page;
use crate::keys::{self, Passage};
use crate::words::desk::DeskWords;

/// The page that says for whom the panel is. The space bar, which goes on everywhere else, does nothing here.
pub(crate) fn in_charge(ui: &mut Ui, words: &DeskWords) -> Option<Passage> {
    page::page(ui, 220.0, words.in_charge, |ui| {
        ui.label(words.in_charge_text);
        ui.add_space(10.0);
        let clicked = ui.horizontal(|ui| {
            let on = ui.button(words.in_charge_on).clicked().then_some(Passage::On);
            let back = ui.button(words.in_charge_back).clicked().then_some(Passage::Back);
            on.or(back)
        });
        clicked.inner.or_else(|| keys::passage(ui.ctx()))
    })
}
