//! What a file holds that casts no shadow of its own: triangles without an area, and triangles that are there twice. They
//! are counted and named, and the rest is used. Faces of opposite winding are two sides, and no oddity.

use crate::shading::Loose;
use glam::Vec3;
use std::collections::HashSet;
use std::path::Path;

/// Counts over the meshes of a file.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Oddities {
    flat: usize,
    doubled: usize,
    first: Option<String>,
}

impl Oddities {
    /// Adds a mesh: triangles that were left out because they have no area, and those that are kept.
    pub fn add(&mut self, mesh: &str, flat: usize, kept: &Loose) {
        let mut seen = HashSet::new();
        let doubled = kept.corners.iter().filter(|corners| !seen.insert(key(corners))).count();
        if flat + doubled > 0 {
            self.first.get_or_insert_with(|| mesh.to_owned());
        }
        self.flat += flat;
        self.doubled += doubled;
    }

    /// Names what was found, as a warning.
    pub fn warn(&self, file: &Path) {
        if let Some(first) = &self.first {
            tracing::warn!(
                "{}: {} triangles have no area and are left out, {} are there twice; the first in {first}",
                file.display(),
                self.flat,
                self.doubled
            );
        }
    }
}

/// The corners from the smallest on, so that a triangle has one key whichever corner it begins with.
fn key(corners: &[Vec3; 3]) -> [[u32; 3]; 3] {
    let bits = corners.map(|corner| corner.to_array().map(|x| (x + 0.0).to_bits()));
    let first = (0..3).min_by_key(|&i| bits[i]).unwrap_or(0);
    [0, 1, 2].map(|i| bits[(first + i) % 3])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn loose(corners: Vec<[Vec3; 3]>) -> Loose {
        let normals = vec![[Vec3::ZERO; 3]; corners.len()];
        Loose { corners, normals, uvs: Vec::new() }
    }

    #[test]
    fn a_triangle_that_is_there_again_from_another_corner_is_doubled_and_its_other_side_is_not() {
        let [a, b, c] = [Vec3::ZERO, Vec3::X, Vec3::Z];
        let mut found = Oddities::default();
        found.add("sail", 2, &loose(vec![[a, b, c], [b, c, a], [a, c, b]]));
        assert_eq!(found, Oddities { flat: 2, doubled: 1, first: Some("sail".into()) });
        found.add("hull", 0, &loose(vec![[a, b, c]]));
        assert_eq!(found.first.as_deref(), Some("sail"));
    }
}
