//! Wavefront OBJ with its MTL: one mesh per object and material, polygons cut by ears, colour from `Kd`.
//!
//! `Kd` has no colour space in the format; the authoring tools show it as an sRGB code value, so it is converted
//! to linear here. Not read: textures, smoothing groups (a crease angle decides), curves, lines and points.

use crate::oddities::Oddities;
use crate::polygon::{has_area, triangulate};
use crate::shading::{Indexed, Loose, index};
use crate::{Error, Mesh, obj_lines};
use glam::Vec3;
use std::io::BufReader;
use std::path::Path;

/// Reflectance of faces without a material: a light grey, linear.
const NO_MATERIAL: Vec3 = Vec3::splat(0.5);

const LOAD_OPTIONS: tobj::LoadOptions =
    tobj::LoadOptions { single_index: false, triangulate: false, ignore_points: true, ignore_lines: true };

/// Loads an OBJ file in the file's own units.
///
/// A missing material library is a warning and leaves the faces grey: it changes no shadow.
pub fn load_obj(file: &Path) -> Result<Vec<Mesh>, Error> {
    let text = read_text(file)?;
    obj_lines::check(&text).map_err(|found| Error::Content {
        file: file.to_owned(),
        place: format!("line {}", found.line),
        problem: found.problem,
        allowed: found.allowed,
    })?;

    let (models, materials) =
        tobj::load_obj_buf(&mut text.as_bytes(), &LOAD_OPTIONS, |library| load_library(file, library)).map_err(
            |problem| Error::Content {
                file: file.to_owned(),
                place: "as a whole".to_owned(),
                problem: problem.to_string(),
                allowed: "allowed is Wavefront OBJ",
            },
        )?;
    let materials = materials.unwrap_or_default();

    let mut oddities = Oddities::default();
    let meshes: Vec<Mesh> = models
        .iter()
        .map(|model| mesh_of(model, &materials, &mut oddities))
        .filter(|mesh| !mesh.triangles.is_empty())
        .collect();
    if meshes.is_empty() {
        return Err(Error::Content {
            file: file.to_owned(),
            place: "as a whole".to_owned(),
            problem: "no triangles".to_owned(),
            allowed: "allowed is Wavefront OBJ with at least one face that has an area",
        });
    }
    oddities.warn(file);
    Ok(meshes)
}

fn read_text(file: &Path) -> Result<String, Error> {
    let bytes = std::fs::read(file).map_err(|reason| Error::Read { file: file.to_owned(), reason })?;
    String::from_utf8(bytes).map_err(|problem| Error::Content {
        file: file.to_owned(),
        place: format!("byte {}", problem.utf8_error().valid_up_to()),
        problem: "not UTF-8 text".to_owned(),
        allowed: "allowed is Wavefront OBJ, a text format",
    })
}

fn load_library(obj: &Path, library: &Path) -> tobj::MTLLoadResult {
    let path = obj.with_file_name(library);
    let loaded = std::fs::File::open(&path)
        .map_err(|_| tobj::LoadError::OpenFileFailed)
        .and_then(|file| tobj::load_mtl_buf(&mut BufReader::new(file)));
    if let Err(problem) = &loaded {
        tracing::warn!("{}: material library cannot be read ({problem}); faces are grey", path.display());
    }
    loaded
}

fn mesh_of(model: &tobj::Model, materials: &[tobj::Material], oddities: &mut Oddities) -> Mesh {
    let material = model.mesh.material_id.and_then(|id| materials.get(id));
    let (loose, flat) = loose_triangles(&model.mesh);
    oddities.add(&model.name, flat, &loose);
    let Indexed { positions, normals, triangles, .. } = index(&loose);
    Mesh {
        name: match material {
            Some(material) => format!("{}/{}", model.name, material.name),
            None => model.name.clone(),
        },
        positions,
        normals,
        triangles,
        linear_color: material
            .and_then(|m| m.diffuse)
            .map_or(NO_MATERIAL, |srgb| Vec3::from_array(srgb.map(linear_from_srgb))),
        mask: None,
    }
}

/// The triangles of a mesh, and how many of its polygons' n - 2 had no area.
fn loose_triangles(mesh: &tobj::Mesh) -> (Loose, usize) {
    let vector = |values: &[f32], i: usize| Vec3::from_slice(&values[3 * i..]);
    let (mut loose, mut flat) = (Loose::default(), 0);
    let mut first = 0;
    for arity in arities(mesh) {
        let face = first..first + arity;
        first += arity;

        let corners: Vec<Vec3> =
            mesh.indices[face.clone()].iter().map(|&i| vector(&mesh.positions, i as usize)).collect();
        let normals: Vec<Vec3> = match mesh.normal_indices.get(face) {
            Some(indices) if !indices.is_empty() => {
                indices.iter().map(|&i| vector(&mesh.normals, i as usize)).collect()
            }
            _ => vec![Vec3::ZERO; arity],
        };
        let cut = triangulate(&corners);
        flat += arity.saturating_sub(2).saturating_sub(cut.len());
        for triangle in cut {
            loose.corners.push(triangle.map(|i| corners[i]));
            loose.normals.push(triangle.map(|i| normals[i]));
        }
    }
    debug_assert!(loose.corners.iter().all(|&t| has_area(t)));
    (loose, flat)
}

/// Corners per face; an empty list means triangles throughout.
fn arities(mesh: &tobj::Mesh) -> Vec<usize> {
    if mesh.face_arities.is_empty() {
        vec![3; mesh.indices.len() / 3]
    } else {
        mesh.face_arities.iter().map(|&n| n as usize).collect()
    }
}

/// IEC 61966-2-1 decoding, on 0..=1; values outside are clamped.
pub(crate) fn linear_from_srgb(code: f32) -> f32 {
    let code = code.clamp(0.0, 1.0);
    if code <= 0.04045 { code / 12.92 } else { ((code + 0.055) / 1.055).powf(2.4) }
}
