//! How large a shadow map must be so that nobody sees its texels: the method without a GPU.
//!
//! A filter of radius r hides texels up to a = r / c (Kreuzer 2017: c = 3.47, measured with people). So the softness
//! that a light asks for decides how many texels its map needs, and a soft shadow needs few. One frame:
//!
//! 1. [`fit`] limits the light's view to what the observer sees: [`Fit`], with its extent L in x and y. [`cascades`] makes
//!    one for each of the slices into which [`Splits`] cuts the view, or for each [`Face`] of a point light; all that
//!    follows is done for each.
//! 2. The screen's demand is its smallest filter radius r, [`Demand`], or a low quantile, [`Statistic`]: the filter's own
//!    radius for percentage closer filtering, measured from the last map for soft shadows.
//! 3. [`Relation`] turns that into texels of r / c, and N = c L / r of them, x and y apart.
//! 4. [`TexelPolicy`] makes that a texel which changes rarely, within the caps, and coarse while [`Rest`] says that nothing is in shadow; [`Fit::on_lattice`] takes the box to whole
//!    texels of a lattice that stands still in the world; [`Size`] says what is achieved.
//! 5. The renderer draws a map of that size with [`Fit::clip_from_world`] and filters it as [`filter`] does: radius in
//!    world units, taps of [`poisson_disc`], bias of [`ReceiverPlane`].
//!
//! ```
//! use glam::{DVec3, dvec3};
//! use scumble_core::{Aabb, Camera, Demand, Light, Settings, TexelPolicy, fit, size_achieved};
//!
//! let scene = Aabb { min: dvec3(-20.0, 0.0, -20.0), max: dvec3(20.0, 6.0, 20.0) };
//! let sun = Light::Directional { direction: dvec3(0.3, -1.0, 0.2), half_angle: 0.0047 };
//! let camera = Camera {
//!     eye: dvec3(0.0, 1.7, 8.0),
//!     target: dvec3(0.0, 1.0, 0.0),
//!     up: DVec3::Y,
//!     vertical_fov: 0.9,
//!     aspect: 16.0 / 9.0,
//!     near: 0.1,
//!     far: f64::INFINITY,
//! };
//! let settings = Settings::default();
//! let mut policy = TexelPolicy::new(&settings)?;
//! let radius_world = 0.25;
//! if let Some(fit) = fit(&camera, &scene, &sun, true)? {
//!     let fit = fit.with_border(radius_world);
//!     let texel_world = policy.next(fit.extent_world, Demand::Radius(radius_world))?;
//!     let (fit, texels) = fit.on_lattice(texel_world, settings.floor);
//!     let size = size_achieved(texels, fit.extent_world, Some(radius_world), &settings.relation);
//!     assert!(size.texels[0] < 1024 && size.c_effective >= 3.47);
//! }
//! # Ok::<(), scumble_core::Error>(())
//! ```
//!
//! Lengths are metres, angles radians. Matrices are named `to_from_from`: `light_from_world` takes world coordinates to
//! light space. World space is right-handed; clip space is wgpu's. This crate knows no GPU, file, clock or window.

mod aabb;
mod bias;
mod budget;
mod camera;
mod cascade;
mod error;
mod face;
pub mod filter;
mod fit;
mod kernel;
mod light;
pub mod moments;
mod policy;
mod polyhedron;
mod presets;
mod relation;
mod relation_file;
mod rest;
mod seen;
mod settings;
mod split;
mod statistic;

pub use aabb::Aabb;
pub use bias::{Bias, ReceiverPlane};
pub use budget::{Budget, given_way, texels_at_most};
pub use camera::Camera;
pub use cascade::{Cascade, cascades, slices_of};
pub use error::Error;
pub use face::Face;
pub use filter::Taps;
pub use fit::{Fit, fit, fit_face};
pub use kernel::{half_plane_under_disc, pixel_hash, poisson_disc, rotation_angle, square_taps};
pub use light::Light;
pub use moments::VarianceBound;
pub use policy::{Demand, Size, TexelPolicy, size_achieved};
pub use relation::{RATIO_MAX, ROUNDING_SLACK, Relation, whole_texels};
pub use relation_file::{
    ConditionEstimate, Estimate, FormTests, GoodnessOfFit, ModelParameters, NullTest, OtherEstimator, PopulationPoint,
    RelationFile, SCHEMA, SessionHash,
};
pub use rest::Rest;
pub use seen::{Seen, SeenBand, SeenCascades, SeenLately, seen_cascades};
pub use settings::{AtCap, Filter, Settings, pixel_footprint_world};
pub use split::Splits;
pub use statistic::{RadiusHistogram, Statistic};
