//! The administrator's window: what the session under way has measured so far, and what can be ordered.
//!
//! After Kreuzer 2017, Fig. 4.5: a chart of convergence for each staircase of the round. [`Status`] is a snapshot
//! without a reference to the session, so that another window can show it; [`show`] draws it and gives an
//! [`Order`] where one was given. Nothing here touches the session.

mod bands;
mod chart;
mod look;
mod minutes;
mod order;
mod orders;
mod panel;
mod plot;
mod status;
mod window;

#[cfg(test)]
mod hands;
#[cfg(test)]
mod snapshots;
#[cfg(test)]
mod testing;
#[cfg(test)]
mod tests;

pub(crate) use bands::Bands;
pub(crate) use chart::{Chart, Point};
pub(crate) use minutes::MinutesLeft;
pub(crate) use order::{Barrier, Order};
pub(crate) use panel::{DeskState, show};
pub(crate) use status::{Activity, Disk, Given, Round, RoundState, Status, Tally};
pub(crate) use window::{DeskWindow, other_monitor};
