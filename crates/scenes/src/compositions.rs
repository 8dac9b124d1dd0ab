//! The compositions of the catalogue. Each file sets one stage: models, floor, camera, light.

mod contact;
mod harbour;
mod recital;
mod room;
mod scaled;
mod slats;
mod stairwell;
mod street;
mod wedge;
mod yard;

pub use contact::contact;
pub use harbour::{FILE as HARBOUR_FILE, harbour};
pub use recital::recital;
pub use room::room;
pub use scaled::{giant, speck};
pub use slats::slats;
pub use stairwell::stairwell;
pub use street::{FILE as STREET_FILE, street};
pub use wedge::wedge;
pub use yard::yard;

/// Pictures are composed for 16:9; a program with another window sets its own aspect.
const ASPECT: f64 = 16.0 / 9.0;
