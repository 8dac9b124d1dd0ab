//! Everything that will be recorded, and what will be missing.

use eframe::egui::Ui;
use scumble_psychophysics::Language;

use super::widgets;
use crate::setup::Setup;
use crate::words::setup::SetupWords;

/// See the module.
pub(super) fn summary(ui: &mut Ui, setup: &Setup, words: &SetupWords) {
    let ready = match setup.finish() {
        Ok(ready) => ready,
        Err(page) => {
            ui.label((words.unfinished)(page));
            return;
        }
    };
    let (monitors, _) = setup.monitors();
    let monitor = ready.monitor.and_then(|index| monitors.get(index)).map(words.monitor_named);
    let (protocol, measured) = (ready.study.protocol(), &ready.measured);
    let language = match ready.language {
        Language::English => "English",
        Language::German => "Deutsch",
    };
    ui.label(words.summary_text);
    ui.spacing_mut().item_spacing.y *= 0.75;
    // Name, value, and whether it is missing.
    let mut fact = |name, value: String, is_missing| widgets::fact(ui, name, &value, is_missing);
    fact(words.folder, setup.study().folder().to_owned(), false);
    fact(words.protocol, protocol.name.clone(), false);
    fact(words.language, language.to_owned(), false);
    let number = setup.study().number_matters().then_some(ready.participant_number);
    fact(words.participant, (words.participant_value)(&ready.participant, number), false);
    if let Some(monitor) = monitor {
        fact(words.monitor, monitor, false);
    }
    if let Some(found) = setup.elsewhere() {
        fact(words.elsewhere, (words.elsewhere_value)(found), true);
    }
    let distance = measured.viewing_distance_mm;
    fact(words.distance, (words.distance_value)(distance), distance.is_none());
    fact(words.pixel_size, (words.pixel_size_value)(measured.px_per_mm), measured.px_per_mm.is_none());
    fact(words.pixel_angle, (words.pixel_angle_value)(measured.px_per_degree), measured.px_per_degree.is_none());
    let is_checked = measured.luminance_table.is_some() || measured.gamma_check_level.is_some();
    fact(words.brightness, (words.brightness_value)(measured), !is_checked);
    fact(words.room, (words.room_value)(ready.room.as_deref()), ready.room.is_none());
    fact(words.consent, (words.consent_value)(ready.consent.as_ref()), ready.consent.is_none());
    fact(words.about, (words.about_value)(ready.demographics.as_ref()), ready.demographics.is_none());
    ui.add_space(6.0);
    ui.label(words.summary_each_trial);
}
