//! The pages before the session, by the keyboard alone.

use crate::pixels::Pixels;
use crate::programs::wait_for;
use crate::screen::Screen;
use crate::sitting::{Sitting, short};

/// More pixels than a typed word and a cursor that blinks, and fewer than the ring around what has the keyboard.
const RING_PX: usize = 400;
/// Looks in a row without a change after which a screen is still: half a second, several frames of a slow machine, so
/// that what comes next finds the keyboard where it belongs.
const STILL_LOOKS: u32 = 10;
/// Height of the strip that has a page's name and number.
const HEADING_PX: u32 = 90;

/// Presses keys that change something on a page, and waits until the screen is still again.
fn press(screen: &Screen, words: &str) {
    press_and_look(screen, words, RING_PX, |pixels| pixels);
}

/// Presses the key that leads to another page, and waits until that is there.
fn turn(screen: &Screen) {
    press_and_look(screen, "key Return", 0, |pixels| pixels.part([0, 0], [pixels.size_px[0], HEADING_PX]));
}

fn press_and_look(screen: &Screen, words: &str, but_px: usize, part: fn(Pixels) -> Pixels) {
    let mut last = part(screen.pixels());
    screen.input(words);
    let (mut has_changed, mut still) = (false, 0);
    wait_for(&format!("another screen after {words}"), || {
        let now = part(screen.pixels());
        let changes = now.differing(&last) > but_px;
        has_changed |= changes;
        still = if changes { 0 } else { still + 1 };
        last = now;
        (has_changed && still >= STILL_LOOKS).then_some(())
    });
}

#[test]
fn the_set_up_is_done_by_keys_and_what_was_typed_is_in_the_record() {
    let folder = tempfile::tempdir().unwrap();
    let screen = Screen::start([1280, 800]);
    let study = folder.path().join("study");
    std::fs::create_dir(&study).unwrap();
    std::fs::write(study.join("consent.en.txt"), "I take part of my own will.\n").unwrap();
    let mut sitting = Sitting::set_up(&screen, folder.path(), short("two-alternative"), 71);
    sitting.first_page();
    turn(&screen);
    // The screen: the distance, then the outline of a card.
    screen.input("type 60");
    press(&screen, "key Return");
    press(&screen, "key Right Right Right Right");
    press(&screen, "key Return");
    turn(&screen);
    // The brightness.
    press(&screen, "key Left");
    press(&screen, "key Return");
    turn(&screen);
    // The room.
    screen.input("type dim");
    press(&screen, "key Tab");
    turn(&screen);
    // Consent, about the participant, summary.
    turn(&screen);
    screen.input("type 33");
    turn(&screen);
    turn(&screen);
    while sitting.next().is_some() {
        sitting.answer_left(true);
    }
    let header = sitting.finish().header;
    let display = header.display.unwrap();
    assert_eq!(display.viewing_distance_mm, Some(600.0));
    assert!(display.px_per_mm.is_some() && display.gamma_check_level.is_some());
    assert_eq!(header.room.as_deref(), Some("dim"));
    assert!(header.consent.is_some());
    assert_eq!(header.demographics.unwrap().age_years, Some(33));
}
