//! Surfaces that are cut out by a texture, as leaves and grilles are: glTF's alpha mode MASK.
//!
//! ```text
//! u, v in texels:  (u w - 1/2, v h - 1/2)
//! alpha there:     bilinear between the four texels around, at full size, whatever the distance
//! ```
//! A point is there where its alpha is not below the cutoff. Renderer and rays use this definition, so that a mask is the
//! same in a picture, in a shadow map and in the ground truth; a renderer of games would take a coarser mip level far away,
//! where its mask is another.

use std::sync::Arc;

use glam::{IVec2, UVec2, Vec2};

/// What a texture does beyond its ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Wrap {
    /// It begins anew.
    Repeat,
    /// It goes on with its mirror image.
    Mirror,
    /// It goes on with its last texel.
    Clamp,
}

/// The alpha of a texture, and below which it is a hole.
#[derive(Debug, Clone, PartialEq)]
pub struct AlphaTexture {
    /// Texels across and down, 1 or more each.
    pub size: UVec2,
    /// 255 for opaque; rows from v = 0 on.
    pub alphas: Arc<[u8]>,
    /// Beyond the ends in u and in v.
    pub wrap: [Wrap; 2],
    /// From this alpha on a point is there, 0 to 1; above 1 none is.
    pub cutoff: f32,
}

/// The mask of a mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct AlphaMask {
    /// Texture coordinates, one for each position of the mesh.
    pub uvs: Vec<Vec2>,
    /// What they look up.
    pub texture: Arc<AlphaTexture>,
}

impl Wrap {
    /// The texel, 0 to below `size`, that stands at `texel`.
    fn apply(self, texel: i32, size: i32) -> i32 {
        match self {
            Self::Repeat => texel.rem_euclid(size),
            Self::Mirror => {
                let place = texel.rem_euclid(2 * size);
                place.min(2 * size - 1 - place)
            }
            Self::Clamp => texel.clamp(0, size - 1),
        }
    }
}

impl AlphaTexture {
    /// Whether there is no hole, whatever the texture coordinates.
    #[must_use]
    pub fn is_solid(&self) -> bool {
        self.alphas.iter().all(|&alpha| f32::from(alpha) / 255.0 >= self.cutoff)
    }

    /// Whether the surface is there at a texture coordinate; a coordinate that is not finite finds a hole.
    #[must_use]
    pub fn is_there(&self, uv: Vec2) -> bool {
        self.alpha(uv) >= self.cutoff
    }

    /// Bilinear alpha, 0 to 1. GPU twin: `alpha_at` of the viewer's shader.
    fn alpha(&self, uv: Vec2) -> f32 {
        let place = uv * self.size.as_vec2() - 0.5;
        let corner = place.floor();
        let share = place - corner;
        let corner = corner.as_ivec2();
        let row = |y: i32| {
            let [left, right] = [0, 1].map(|x| self.texel(corner + IVec2::new(x, y)));
            left + (right - left) * share.x
        };
        let [above, below] = [0, 1].map(row);
        above + (below - above) * share.y
    }

    fn texel(&self, at: IVec2) -> f32 {
        let size = self.size.as_ivec2();
        let (x, y) = (self.wrap[0].apply(at.x, size.x), self.wrap[1].apply(at.y, size.y));
        f32::from(self.alphas[(y * size.x + x) as usize]) / 255.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two texels across, a hole and a surface.
    fn halves(wrap: Wrap) -> AlphaTexture {
        AlphaTexture { size: UVec2::new(2, 1), alphas: [0, 255].into(), wrap: [wrap; 2], cutoff: 0.5 }
    }

    #[test]
    fn a_point_is_there_from_the_middle_between_a_hole_and_a_surface_on() {
        let texture = halves(Wrap::Clamp);
        for (u, there) in [(0.0, false), (0.25, false), (0.499, false), (0.501, true), (0.75, true), (1.0, true)] {
            assert_eq!(texture.is_there(Vec2::new(u, 0.3)), there, "{u}");
        }
        assert!(!texture.is_there(Vec2::NAN));
    }

    #[test]
    fn beyond_its_ends_a_texture_goes_on_as_its_wrap_says() {
        for (wrap, u, there) in [
            (Wrap::Clamp, 5.0, true),
            (Wrap::Clamp, -5.0, false),
            (Wrap::Repeat, 1.25, false),
            (Wrap::Repeat, -0.25, true),
            (Wrap::Mirror, 1.25, true),
            (Wrap::Mirror, -0.25, false),
            (Wrap::Mirror, 2.25, false),
        ] {
            assert_eq!(halves(wrap).is_there(Vec2::new(u, 0.5)), there, "{wrap:?} {u}");
        }
    }

    #[test]
    fn rows_begin_at_v_of_zero() {
        let texture = AlphaTexture { size: UVec2::new(1, 2), ..halves(Wrap::Clamp) };
        assert!(!texture.is_there(Vec2::new(0.5, 0.2)) && texture.is_there(Vec2::new(0.5, 0.8)));
    }

    #[test]
    fn a_mask_without_a_hole_is_solid() {
        assert!(!halves(Wrap::Repeat).is_solid());
        assert!(AlphaTexture { cutoff: 0.0, ..halves(Wrap::Repeat) }.is_solid());
        assert!(AlphaTexture { alphas: [128, 255].into(), ..halves(Wrap::Repeat) }.is_solid());
    }
}
