//! The real window on a virtual screen, with real keys and a real mouse: whole sessions of every
//! protocol, cut short, what is on the screen at each step, and what is on disk; then everything that
//! can happen in a lab: crashes, full disks, folders that vanish, clocks that are set back.
//!
//! A second state machine with the same seed runs beside the window and knows what it must show.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod clock;
mod clocks;
mod crashes;
mod disk;
mod disks;
mod monitors;
mod one_picture;
mod pixels;
mod programs;
mod rehearsals;
mod screen;
mod set_up;
mod sitting;
mod two_pictures;
