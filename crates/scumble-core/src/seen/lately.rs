//! What the last pictures showed together, so that a fit grows at once and shrinks late.
//!
//! One picture looks at some of its pixels, and what shows in few of them is found in one picture and missed in the next. A
//! fit to each picture alone would hand such receivers from a fine map to the net and back. So a band's box is that of all
//! pictures of late under the camera of the newest: what the box holds too much is clipped to the view of today like any.

use std::collections::VecDeque;

use super::{Seen, SeenBand};

/// The last pictures of one light.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SeenLately {
    pictures: VecDeque<Seen>,
    together: Option<Seen>,
}

impl SeenLately {
    /// What they showed together; `None` before the first.
    #[must_use]
    pub fn together(&self) -> Option<&Seen> {
        self.together.as_ref()
    }

    /// Adds a picture, and forgets all but the last `pictures`, 1 at least. Where the light has another direction, boxes have
    /// other axes: all before are forgotten.
    pub fn add(&mut self, picture: Seen, pictures: u32) {
        if self.pictures.back().is_some_and(|last| last.light.direction() != picture.light.direction()) {
            self.pictures.clear();
        }
        self.pictures.push_back(picture.clone());
        while self.pictures.len() > pictures.max(1) as usize {
            self.pictures.pop_front();
        }
        let mut boxes = [None; Seen::BANDS as usize];
        for &seen in self.pictures.iter().flat_map(|picture| &picture.bands) {
            if let Some(found) = boxes.get_mut(seen.band as usize) {
                *found = Some(found.map_or(seen, |found| around(found, seen)));
            }
        }
        self.together = Some(Seen { bands: boxes.into_iter().flatten().collect(), ..picture });
    }
}

/// The box around two of one band.
fn around(a: SeenBand, b: SeenBand) -> SeenBand {
    SeenBand { min: a.min.min(b.min), max: a.max.max(b.max), ..a }
}
