//! By what a truth is found again: SHA-256 of everything that it depends on.
//!
//! That is the triangles, the surface of every pixel (which stands for camera, size and the device that drew it), the
//! light, the filter with its taps or the number of samples, and the version of the computation. Colours, names and the
//! paths of files are no part of it.

use std::fmt;

use scumble_core::Taps;
use scumble_reference::Receiver;
use scumble_scenes::{AlphaMask, Mesh};
use sha2::{Digest, Sha256};

/// Of the computation: raised whenever a truth of `scumble-reference` comes out different from the same input.
const ALGORITHM: u32 = 1;

/// A hash.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Key([u8; 32]);

impl fmt::Display for Key {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|byte| write!(formatter, "{byte:02x}"))
    }
}

/// Collects what a truth depends on. Every list is preceded by its length, so that no two inputs run together alike.
pub struct KeyBuilder(Sha256);

impl KeyBuilder {
    /// Of this version of the computation.
    pub fn new() -> Self {
        Self(Sha256::new()).bytes(b"scumble truth").bytes(&ALGORITHM.to_le_bytes())
    }

    /// Bytes.
    #[must_use]
    pub fn bytes(mut self, bytes: &[u8]) -> Self {
        self.0.update((bytes.len() as u64).to_le_bytes());
        self.0.update(bytes);
        self
    }

    /// Text that tells one value from any other, such as its debug form.
    #[must_use]
    pub fn text(self, text: &str) -> Self {
        self.bytes(text.as_bytes())
    }

    /// What rays meet.
    #[must_use]
    pub fn meshes(self, meshes: &[Mesh]) -> Self {
        meshes.iter().fold(self.bytes(&meshes.len().to_le_bytes()), |key, mesh| {
            key.bytes(bytemuck::cast_slice(&mesh.positions))
                .bytes(bytemuck::cast_slice(&mesh.normals))
                .bytes(bytemuck::cast_slice(mesh.triangles.as_flattened()))
                .mask(mesh.mask.as_ref())
        })
    }

    /// What is cut out of a mesh; nothing for nothing.
    fn mask(self, mask: Option<&AlphaMask>) -> Self {
        let Some(AlphaMask { uvs, texture }) = mask else { return self };
        self.bytes(bytemuck::cast_slice(uvs))
            .bytes(&texture.alphas)
            .text(&format!("{:?} {:?} {}", texture.size, texture.wrap, texture.cutoff))
    }

    /// Points of whose visibility is asked, in order.
    #[must_use]
    pub fn receivers(mut self, receivers: &[Receiver]) -> Self {
        self = self.bytes(&receivers.len().to_le_bytes());
        for receiver in receivers {
            self.0.update(bytemuck::bytes_of(&receiver.position));
            self.0.update(bytemuck::bytes_of(&receiver.normal));
            self.0.update(bytemuck::bytes_of(&receiver.pixel));
        }
        self
    }

    /// The taps of a filter.
    #[must_use]
    pub fn taps(self, taps: &Taps) -> Self {
        self.bytes(bytemuck::cast_slice(&taps.blocker)).bytes(bytemuck::cast_slice(&taps.filter))
    }

    /// The hash of all.
    pub fn finish(self) -> Key {
        Key(self.0.finalize().into())
    }
}

#[cfg(test)]
impl Key {
    /// A key of a test.
    pub fn of_bytes(bytes: &[u8]) -> Self {
        KeyBuilder::new().bytes(bytes).finish()
    }
}

#[cfg(test)]
mod tests {
    use glam::{DVec3, UVec2, Vec2, Vec3};
    use scumble_scenes::{AlphaTexture, Wrap, cuboid, ground};

    use super::*;

    fn receiver(x: f32) -> Receiver {
        Receiver { position: Vec3::new(x, 0.0, 0.0), normal: Vec3::Y, pixel: [1, 2] }
    }

    #[test]
    fn equal_input_has_one_key_and_any_change_another() {
        let meshes = || vec![ground("a", DVec3::ZERO, 1.0, Vec3::ONE), cuboid("b", DVec3::ZERO, DVec3::ONE, Vec3::ONE)];
        let key = |meshes: &[Mesh], receivers: &[Receiver], taps: usize, light: &str| {
            KeyBuilder::new().meshes(meshes).receivers(receivers).taps(&Taps::new(4, taps)).text(light).finish()
        };
        let first = key(&meshes(), &[receiver(0.0)], 8, "sun");
        assert_eq!(key(&meshes(), &[receiver(0.0)], 8, "sun"), first);

        let mut moved = meshes();
        moved[1].positions[3].x += 1e-6;
        let mut turned = meshes();
        turned[1].triangles[0].swap(0, 1);
        let mut cut = meshes();
        let texture = AlphaTexture { size: UVec2::ONE, alphas: [0].into(), wrap: [Wrap::Clamp; 2], cutoff: 0.5 };
        cut[0].mask = Some(AlphaMask { uvs: vec![Vec2::ZERO; 4], texture: texture.into() });
        let mut other_turn = receiver(0.0);
        other_turn.pixel[0] += 1;
        let others = [
            key(&moved, &[receiver(0.0)], 8, "sun"),
            key(&turned, &[receiver(0.0)], 8, "sun"),
            key(&cut, &[receiver(0.0)], 8, "sun"),
            key(&meshes()[..1], &[receiver(0.0)], 8, "sun"),
            key(&meshes(), &[receiver(1e-7)], 8, "sun"),
            key(&meshes(), &[other_turn], 8, "sun"),
            key(&meshes(), &[receiver(0.0); 2], 8, "sun"),
            key(&meshes(), &[receiver(0.0)], 9, "sun"),
            key(&meshes(), &[receiver(0.0)], 8, "lamp"),
        ];
        assert!(others.iter().all(|other| *other != first));
    }

    #[test]
    fn names_and_colours_are_no_part_of_it() {
        let key = |name, color| KeyBuilder::new().meshes(&[ground(name, DVec3::ZERO, 1.0, color)]).finish();
        assert_eq!(key("a", Vec3::ONE), key("b", Vec3::ZERO));
        assert_eq!(key("a", Vec3::ONE).to_string().len(), 64);
    }

    #[test]
    fn lists_do_not_run_together() {
        let of = |parts: &[&[u8]]| parts.iter().fold(KeyBuilder::new(), |key, part| key.bytes(part)).finish();
        assert_ne!(of(&[b"ab", b"c"]), of(&[b"a", b"bc"]));
    }
}
