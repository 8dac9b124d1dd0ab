//! What cannot be written waits and is written later: full disks, read-only ones, folders that vanish.
//!
//! [`Sitting::finish`] sees to it each time that the record is in the end that of an undisturbed session.

use std::fs::File;
use std::io::Write;

use scumble_psychophysics::{EVENTS_FILE, Protocol};

use crate::disk::Disk;
use crate::programs::wait_for;
use crate::screen::Screen;
use crate::sitting::{Sitting, short};

/// Five answers of more than 900 bytes each, so that the record outgrows a block of the disk in mid-session.
fn five_answers() -> Protocol {
    let mut protocol = short("two-alternative");
    protocol.schedule.trials_min = 2;
    protocol.schedule.trials_max = 2;
    protocol
}

/// Answers until one cannot be written.
fn answer_until_refused(sitting: &mut Sitting) {
    loop {
        sitting.next().expect("the disk took every answer");
        if !sitting.try_answer_left(true) {
            return;
        }
    }
}

fn answer_the_rest(sitting: &mut Sitting) {
    while sitting.next().is_some() {
        sitting.answer_left(false);
    }
}

#[test]
fn an_answer_waits_for_room_on_a_full_disk_and_is_written_by_itself() {
    let (screen, disk) = (Screen::start([1280, 800]), Disk::new());
    let mut sitting = Sitting::start(&screen, disk.folder(), five_answers(), 41, &[]);
    sitting.next().unwrap();
    sitting.answer_left(true);
    // The rest of the record's block takes some more answers and the beginning of one.
    disk.fill();
    answer_until_refused(&mut sitting);
    // An answer to a page is none.
    screen.input("key Right");
    disk.empty();
    sitting.wait_until_saved();
    answer_the_rest(&mut sitting);
    sitting.finish();
}

#[test]
fn an_answer_waits_on_a_disk_that_is_full_and_then_read_only() {
    let (screen, disk) = (Screen::start([1280, 800]), Disk::new());
    let mut sitting = Sitting::start(&screen, disk.folder(), short("yes-no"), 42, &[]);
    sitting.next().unwrap();
    disk.fill();
    assert!(!sitting.try_answer_left(true), "an empty record has no block to write to");
    wait_for("a program that has no file open", || disk.set_read_only(true).then_some(()));
    screen.input("key space");
    assert!(disk.set_read_only(false));
    disk.empty();
    screen.input("key space");
    sitting.wait_until_saved();
    answer_the_rest(&mut sitting);
    sitting.finish();
}

#[test]
fn a_session_on_a_disk_that_is_read_only_begins_when_it_can_be_written() {
    let (screen, disk) = (Screen::start([1280, 800]), Disk::new());
    let mut sitting = Sitting::start(&screen, disk.folder(), short("published"), 43, &[]);
    let first_page = sitting.first_page();
    assert!(disk.set_read_only(true));
    screen.input("key space");
    wait_for("another page", || (screen.pixels() != first_page).then_some(()));
    assert!(!sitting.session().exists());
    assert!(disk.set_read_only(false));
    answer_the_rest(&mut sitting);
    sitting.finish();
}

#[test]
fn an_answer_waits_for_a_folder_that_is_away() {
    let folder = tempfile::tempdir().unwrap();
    let screen = Screen::start([1280, 800]);
    let mut sitting = Sitting::start(&screen, folder.path(), short("two-alternative"), 44, &[]);
    sitting.next().unwrap();
    sitting.answer_left(true);
    sitting.next().unwrap();
    let study = sitting.session().parent().unwrap().to_path_buf();
    let away = folder.path().join("away");
    std::fs::rename(&study, &away).unwrap();
    // Where a file stands no folder can be made anew.
    std::fs::write(&study, "").unwrap();
    assert!(!sitting.try_answer_left(true));
    std::fs::remove_file(&study).unwrap();
    std::fs::rename(&away, &study).unwrap();
    sitting.wait_until_saved();
    answer_the_rest(&mut sitting);
    sitting.finish();
}

#[test]
fn a_session_whose_folder_is_deleted_is_written_anew_in_whole() {
    let folder = tempfile::tempdir().unwrap();
    let screen = Screen::start([1280, 800]);
    let mut sitting = Sitting::start(&screen, folder.path(), short("two-alternative"), 45, &[]);
    sitting.next().unwrap();
    sitting.answer_left(true);
    sitting.next().unwrap();
    std::fs::remove_dir_all(sitting.session()).unwrap();
    sitting.answer_left(false);
    answer_the_rest(&mut sitting);
    sitting.finish();
}

#[test]
fn a_window_closed_while_an_answer_waits_says_which_lines_are_missing() {
    let (screen, disk) = (Screen::start([1280, 800]), Disk::new());
    let mut sitting = Sitting::start(&screen, disk.folder(), five_answers(), 46, &[]);
    sitting.next().unwrap();
    sitting.crash();
    sitting.resume_to_hear();
    sitting.next().unwrap();
    disk.fill();
    answer_until_refused(&mut sitting);
    sitting.close();
    disk.empty();
    let heard = sitting.heard();
    let mut record = File::options().append(true).open(sitting.session().join(EVENTS_FILE)).unwrap();
    heard.lines().filter(|line| line.starts_with('{')).for_each(|line| writeln!(record, "{line}").unwrap());
    sitting.resume();
    answer_the_rest(&mut sitting);
    sitting.finish();
}
