//! The first page: folder, protocol, language, participant, monitor.

use eframe::egui;
use egui::{Key, Ui};
use scumble_psychophysics::Language;

use super::{focus, widgets};
use crate::arguments::ResumePolicy;
use crate::screen::pixels_missing;
use crate::session_folder::Found;
use crate::setup::{OFFERED_PROTOCOLS, Setup, SetupAction};
use crate::words::setup::SetupWords;
use crate::words::words;

/// Widths of the lines for a path, a code and a number.
const PATH: f32 = 780.0;
const CODE: f32 = 220.0;
const NUMBER: f32 = 90.0;

/// Keys of the recent folders, newest first.
const KEYS: [Key; 8] = [Key::Num1, Key::Num2, Key::Num3, Key::Num4, Key::Num5, Key::Num6, Key::Num7, Key::Num8];

/// See the module.
pub(super) fn study(ui: &mut Ui, setup: &mut Setup, words: &SetupWords, is_new: bool) -> Option<SetupAction> {
    ui.spacing_mut().item_spacing.y *= 0.75;
    let asks_for_code = is_new && setup.study().opened().is_some();
    // Where folders are offered the keyboard is on the newest, so that Return or a number opens a study.
    let is_empty = is_new && setup.study().opened().is_none();
    let offers_recent = !setup.recent().is_empty();
    let mut has_folder = widgets::named(ui, words.folder, |ui| folder(ui, setup, words, is_empty && !offers_recent));
    if setup.study().opened().is_none() {
        has_folder |= recent(ui, setup, words, is_empty);
    }
    widgets::named(ui, words.protocol, |ui| protocol(ui, setup, words));
    widgets::named(ui, words.language, |ui| {
        let offered = [(Language::English, "English"), (Language::German, "Deutsch")];
        if let Some(language) = widgets::choice(ui, setup.language(), &offered) {
            setup.set_language(language);
        }
    });
    widgets::named(ui, words.participant, |ui| participant(ui, setup, words, asks_for_code || has_folder));
    let moved = monitor(ui, setup, words);
    interrupted(ui, setup, words).or(moved.map(SetupAction::Monitor))
}

/// That the pictures do not fit on this screen, as soon as it is known what they are; `None` where they do.
pub(super) fn too_small(ui: &Ui, setup: &Setup) -> Option<String> {
    let protocol = setup.study().opened()?.study.protocol();
    let [needed, given] = pixels_missing(ui.ctx().content_rect(), ui.pixels_per_point(), protocol)?;
    let words = &words(setup.language()).participant;
    Some(format!("{}. {}", words.too_small, (words.pixels_needed)(needed, given)))
}

/// Whether a folder was entered in this frame, so that the keyboard is needed elsewhere.
fn folder(ui: &mut Ui, setup: &mut Setup, words: &SetupWords, takes_keyboard: bool) -> bool {
    let typed = widgets::line(ui, words.folder, setup.study().folder(), words.folder_hint, PATH, takes_keyboard);
    if let Some(folder) = typed.text {
        setup.set_folder(folder);
    }
    let dropped = ui.input(|input| input.raw.dropped_files.first().map(|file| file.path().to_owned()));
    if let Some(dropped) = dropped {
        setup.pick_folder(&dropped);
    }
    if let Some(path) = setup.study().whole_path() {
        widgets::small(ui, path);
    }
    typed.entered && setup.study().opened().is_some()
}

/// Folders to pick by their buttons, or by their numbers while nothing is typed into; whether one was.
fn recent(ui: &mut Ui, setup: &mut Setup, words: &SetupWords, takes_keyboard: bool) -> bool {
    let mut picked = None;
    if !setup.recent().is_empty() {
        widgets::named(ui, words.recent, |ui| {
            ui.spacing_mut().item_spacing.y *= 0.5;
            ui.spacing_mut().button_padding.y *= 0.5;
            for (index, (folder, key)) in setup.recent().iter().zip(KEYS).enumerate() {
                let button = ui.button(format!("{}   {}", index + 1, folder.display()));
                if takes_keyboard && index == 0 {
                    button.request_focus();
                }
                if button.clicked() || (focus::pressed(ui, key) && !ui.ctx().text_edit_focused()) {
                    picked = Some(folder.clone());
                }
            }
        });
    }
    if let Some(folder) = &picked {
        setup.pick_folder(folder);
    }
    picked.is_some() && setup.study().opened().is_some()
}

fn protocol(ui: &mut Ui, setup: &mut Setup, words: &SetupWords) {
    let offered = OFFERED_PROTOCOLS.map(|name| (name, name));
    if setup.study().opened().is_none() {
        match setup.study().asked_protocol() {
            Some(asked) => _ = ui.horizontal(|ui| ui.label(asked)),
            None => _ = ui.add_enabled_ui(false, |ui| widgets::choice(ui, setup.study().chosen_protocol(), &offered)),
        }
        widgets::small(ui, words.protocol_first);
        return;
    }
    if setup.study().offers_protocols() {
        if let Some(name) = widgets::choice(ui, setup.study().chosen_protocol(), &offered) {
            setup.choose_protocol(name);
        }
    } else if let Some(opened) = setup.study().opened() {
        ui.horizontal(|ui| ui.label(&opened.study.protocol().name));
    }
    let Some(opened) = setup.study().opened() else { return };
    ui.label((words.task)(opened.study.protocol().task));
    if let Some(effort) = &opened.effort {
        ui.label((words.effort)(effort));
    }
    widgets::small(ui, if opened.study.is_new() { words.protocol_new } else { words.protocol_kept });
}

fn participant(ui: &mut Ui, setup: &mut Setup, words: &SetupWords, takes_keyboard: bool) {
    ui.horizontal(|ui| {
        let code = setup.study().participant();
        let typed = widgets::line(ui, words.participant, code, words.participant_hint, CODE, takes_keyboard);
        if let Some(code) = typed.text {
            setup.set_participant(code);
        }
        if setup.study().number_matters() {
            ui.label(words.number);
            let number = setup.study().number();
            let hint = setup.study().number_of_code().map_or_else(String::new, |number| number.to_string());
            if let Some(number) = widgets::line(ui, words.number, number, &hint, NUMBER, false).text {
                setup.set_number(number);
            }
        }
    });
    widgets::small(ui, words.participant_note);
}

fn monitor(ui: &mut Ui, setup: &mut Setup, words: &SetupWords) -> Option<usize> {
    let (monitors, chosen) = setup.monitors();
    if monitors.len() < 2 {
        return None;
    }
    let names: Vec<String> = monitors.iter().map(words.monitor_named).collect();
    let picked = widgets::named(ui, words.monitor, |ui| {
        let radio = |(index, name): (usize, &String)| widgets::radio(ui, index == chosen, name).then_some(index);
        names.iter().enumerate().filter_map(radio).last()
    });
    if let Some(index) = picked {
        setup.set_monitor(index);
    }
    picked
}

fn interrupted(ui: &mut Ui, setup: &Setup, words: &SetupWords) -> Option<SetupAction> {
    let Some(Found::Interrupted(session)) = setup.study().found() else { return None };
    let offered = [
        (ResumePolicy::Continue, words.resume),
        (ResumePolicy::RepeatRound, words.repeat_round),
        (ResumePolicy::Discard, words.discard),
    ];
    let chosen = widgets::named(ui, words.interrupted, |ui| {
        ui.horizontal_wrapped(|ui| {
            let button = |(policy, name)| ui.button(name).clicked().then_some(policy);
            offered.into_iter().filter_map(button).last()
        })
        .inner
    });
    chosen.map(|policy| SetupAction::Interrupted(session.directory.clone(), policy))
}
