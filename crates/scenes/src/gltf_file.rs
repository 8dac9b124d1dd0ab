//! glTF 2.0: `.gltf` with embedded or external buffers and `.glb`; the default scene with its node transforms.
//!
//! Lengths are metres and y is up, as the format says. Colour is the base colour factor, which is linear, times the
//! texture's mean where the texture can be read; alpha counts where the material says that it cuts out. Not read:
//! texture transforms, skins, morph targets, cameras, lights, compressed meshes. Only triangle lists, strips and fans count.

use crate::gltf_images::{self, Image};
use crate::oddities::Oddities;
use crate::polygon::has_area;
use crate::shading::{Indexed, Loose, index};
use crate::{AlphaMask, AlphaTexture, Error, Mesh};
use glam::{DAffine3, DMat4, Mat4, Vec2, Vec3};
use gltf::accessor::{DataType, Dimensions};
use gltf::mesh::Mode;
use std::path::Path;
use std::sync::Arc;

/// The file's parts that every step below needs.
struct Source<'a> {
    file: &'a Path,
    buffers: &'a [gltf::buffer::Data],
    images: &'a [Image],
    /// By material: what cuts it out, and its set of texture coordinates.
    masks: &'a [Option<(Arc<AlphaTexture>, u32)>],
}

/// Loads a glTF file, in metres and world space.
pub fn load_gltf(file: &Path) -> Result<Vec<Mesh>, Error> {
    // Decode the document and its buffers.
    let bytes = std::fs::read(file).map_err(|reason| Error::Read { file: file.to_owned(), reason })?;
    let (document, blob) = document_of(file, &bytes)?;
    let buffers = gltf::import_buffers(&document, file.parent(), blob).map_err(|problem| bad_buffer(file, &problem))?;
    let images = gltf_images::images(&document, file, &buffers);
    let mask_of =
        |material| gltf_images::alpha_texture(&material, &images).map(|(texture, set)| (Arc::new(texture), set));
    let masks: Vec<_> = document.materials().map(mask_of).collect();
    let source = Source { file, buffers: &buffers, images: &images, masks: &masks };

    // Walk the default scene, or the first, or all root nodes of a file without scenes.
    let (mut meshes, mut oddities) = (Vec::new(), Oddities::default());
    match document.default_scene().or_else(|| document.scenes().next()) {
        Some(scene) => {
            for node in scene.nodes() {
                source.add_node(&node, DMat4::IDENTITY, &mut meshes, &mut oddities)?;
            }
        }
        None => {
            for node in document.nodes() {
                source.add_node(&node, DMat4::IDENTITY, &mut meshes, &mut oddities)?;
            }
        }
    }

    if meshes.is_empty() {
        return Err(source.content(
            "as a whole",
            "no triangles",
            "allowed is glTF 2.0 with at least one triangle that has an area",
        ));
    }
    oddities.warn(file);
    Ok(meshes)
}

/// The checked document and the binary chunk. The library's check looks up the positions of a primitive before it knows
/// that they are there.
fn document_of(file: &Path, bytes: &[u8]) -> Result<(gltf::Document, Option<Vec<u8>>), Error> {
    let refuse = |problem: gltf::Error| not_gltf(file, &problem);
    let gltf::Gltf { document, blob } = gltf::Gltf::from_slice_without_validation(bytes).map_err(refuse)?;
    let json = document.into_json();
    let primitives =
        json.meshes.iter().enumerate().flat_map(|(mesh, of)| of.primitives.iter().map(move |it| (mesh, it)));
    for (mesh, primitive) in primitives {
        if let Some(index) = primitive.attributes.values().find(|index| index.value() >= json.accessors.len()) {
            return Err(Error::Content {
                file: file.to_owned(),
                place: format!("mesh {mesh}"),
                problem: format!("accessor {} where there are {}", index.value(), json.accessors.len()),
                allowed: "allowed are accessors that the file has",
            });
        }
    }
    Ok((gltf::Document::from_json(json).map_err(refuse)?, blob))
}

impl Source<'_> {
    fn content(&self, place: impl Into<String>, problem: impl Into<String>, allowed: &'static str) -> Error {
        Error::Content { file: self.file.to_owned(), place: place.into(), problem: problem.into(), allowed }
    }

    fn add_node(
        &self,
        node: &gltf::Node<'_>,
        world_from_parent: DMat4,
        meshes: &mut Vec<Mesh>,
        oddities: &mut Oddities,
    ) -> Result<(), Error> {
        let parent_from_node = Mat4::from_cols_array_2d(&node.transform().matrix()).as_dmat4();
        let world_from_node = world_from_parent * parent_from_node;
        if !world_from_node.is_finite() {
            return Err(self.content(
                format!("node {}", node.index()),
                "a transform that is not finite",
                "allowed are finite numbers",
            ));
        }

        if let Some(mesh) = node.mesh() {
            for primitive in mesh.primitives() {
                let place = format!("mesh {} primitive {}", mesh.index(), primitive.index());
                let (loose, flat) = self.loose_triangles(&primitive, &place)?;
                oddities.add(mesh.name().unwrap_or(&place), flat, &loose);
                if loose.corners.is_empty() {
                    continue;
                }
                let Indexed { positions, normals, uvs, triangles } = index(&loose);
                let mask = self.mask_of(&primitive).filter(|_| !uvs.is_empty());
                let named = Mesh {
                    name: mesh.name().map_or(place, str::to_owned),
                    positions,
                    normals,
                    triangles,
                    linear_color: gltf_images::linear_color(&primitive.material(), self.images),
                    mask: mask.map(|(texture, _)| AlphaMask { uvs, texture: texture.clone() }),
                };
                meshes.push(named.transformed(&DAffine3::from_mat4(world_from_node)));
            }
        }
        for child in node.children() {
            self.add_node(&child, world_from_node, meshes, oddities)?;
        }
        Ok(())
    }

    /// The triangles of a primitive in the node's space, and how many had no area; points and lines give none.
    fn loose_triangles(&self, primitive: &gltf::Primitive<'_>, place: &str) -> Result<(Loose, usize), Error> {
        if !matches!(primitive.mode(), Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
            return Ok(Default::default());
        }

        // Check every accessor before it is read: the reader trusts the types and lengths in the file.
        let Some(position_accessor) = primitive.get(&gltf::Semantic::Positions) else {
            return Ok(Default::default());
        };
        let normal_accessor = primitive.get(&gltf::Semantic::Normals);
        for accessor in [Some(position_accessor), normal_accessor].iter().flatten() {
            let is_vector = accessor.data_type() == DataType::F32 && accessor.dimensions() == Dimensions::Vec3;
            self.check_type(accessor, is_vector, "allowed are positions and normals of three 32-bit floats")?;
            self.check_range(accessor)?;
        }
        if let Some(accessor) = primitive.indices() {
            let is_whole = matches!(accessor.data_type(), DataType::U8 | DataType::U16 | DataType::U32);
            let is_index = is_whole && accessor.dimensions() == Dimensions::Scalar;
            self.check_type(&accessor, is_index, "allowed are indices of one unsigned integer")?;
            self.check_range(&accessor)?;
        }

        // Read.
        let reader = primitive.reader(|buffer| self.buffers.get(buffer.index()).map(|data| &data.0[..]));
        let vectors = |values: Option<Vec<[f32; 3]>>| {
            values.unwrap_or_default().into_iter().map(Vec3::from_array).collect::<Vec<_>>()
        };
        let positions = vectors(reader.read_positions().map(Iterator::collect));
        let normals = vectors(reader.read_normals().map(Iterator::collect));
        if let Some(vertex) = positions.iter().chain(&normals).position(|p| !p.is_finite()) {
            return Err(self.content(
                format!("{place} vertex {}", vertex % positions.len()),
                "a coordinate that is not finite",
                "allowed are finite numbers",
            ));
        }
        let indices: Vec<u32> = match reader.read_indices() {
            Some(indices) => indices.into_u32().collect(),
            None => (0..positions.len() as u32).collect(),
        };
        if let Some(&index) = indices.iter().find(|&&i| i as usize >= positions.len()) {
            return Err(self.content(
                place,
                format!("index {index} where {} vertices are given", positions.len()),
                "allowed are indices below the number of vertices",
            ));
        }

        let uvs = self.texture_coordinates(primitive, place, positions.len())?;
        let (mut loose, mut flat) = (Loose::default(), 0);
        for triangle in triangles_of(primitive.mode(), &indices) {
            let triangle = triangle.map(|i| i as usize);
            let corners = triangle.map(|i| positions[i]);
            if has_area(corners) {
                loose.corners.push(corners);
                loose.normals.push(triangle.map(|i| normals.get(i).copied().unwrap_or(Vec3::ZERO)));
                if !uvs.is_empty() {
                    loose.uvs.push(triangle.map(|i| uvs[i]));
                }
            } else {
                flat += 1;
            }
        }
        Ok((loose, flat))
    }

    /// What cuts a primitive out; `None` where nothing does.
    fn mask_of(&self, primitive: &gltf::Primitive<'_>) -> Option<&(Arc<AlphaTexture>, u32)> {
        self.masks.get(primitive.material().index()?)?.as_ref()
    }

    /// Those of the texture that cuts the primitive out, one a vertex; none where nothing does.
    fn texture_coordinates(
        &self,
        primitive: &gltf::Primitive<'_>,
        place: &str,
        vertices: usize,
    ) -> Result<Vec<Vec2>, Error> {
        let Some(&(_, set)) = self.mask_of(primitive) else {
            return Ok(Vec::new());
        };
        let Some(accessor) = primitive.get(&gltf::Semantic::TexCoords(set)) else {
            tracing::warn!("{}: {place} has no texture coordinates for its mask; it is opaque", self.file.display());
            return Ok(Vec::new());
        };
        let is_number = match accessor.data_type() {
            DataType::F32 => true,
            DataType::U8 | DataType::U16 => accessor.normalized(),
            _ => false,
        };
        let is_pair = is_number && accessor.dimensions() == Dimensions::Vec2;
        self.check_type(&accessor, is_pair, "allowed are texture coordinates of two floats or normalised integers")?;
        self.check_range(&accessor)?;
        let reader = primitive.reader(|buffer| self.buffers.get(buffer.index()).map(|data| &data.0[..]));
        let uvs: Vec<Vec2> =
            reader.read_tex_coords(set).map(|uvs| uvs.into_f32().map(Vec2::from_array).collect()).unwrap_or_default();
        if uvs.len() != vertices || !uvs.iter().all(|uv| uv.is_finite()) {
            return Err(self.content(
                place,
                format!("{} texture coordinates for {vertices} vertices, or one that is not finite", uvs.len()),
                "allowed are two finite numbers for each vertex",
            ));
        }
        Ok(uvs)
    }

    /// Refuses an accessor of a type that the reader does not take.
    fn check_type(&self, accessor: &gltf::Accessor<'_>, good: bool, allowed: &'static str) -> Result<(), Error> {
        if good {
            return Ok(());
        }
        let place = format!("accessor {}", accessor.index());
        Err(self.content(place, format!("{:?} of {:?}", accessor.dimensions(), accessor.data_type()), allowed))
    }

    /// Whether an accessor, its view and its buffer agree about their lengths.
    fn check_range(&self, accessor: &gltf::Accessor<'_>) -> Result<(), Error> {
        let place = format!("accessor {}", accessor.index());
        if accessor.sparse().is_some() {
            return Err(self.content(place, "sparse values", "allowed are plain accessors"));
        }
        let Some(view) = accessor.view() else {
            return Err(self.content(place, "no buffer view", "allowed are plain accessors"));
        };
        let available = self.buffers.get(view.buffer().index()).map_or(0, |data| data.0.len());
        let stride = view.stride().unwrap_or_else(|| accessor.size());
        let end_in_view = accessor
            .count()
            .checked_sub(1)
            .and_then(|last| last.checked_mul(stride))
            .and_then(|start| start.checked_add(accessor.size()))
            .and_then(|end| end.checked_add(accessor.offset()));
        let view_end = view.offset().checked_add(view.length());
        match (end_in_view, view_end) {
            (Some(end), Some(view_end)) if end <= view.length() && view_end <= available => Ok(()),
            _ => Err(self.content(
                place,
                format!(
                    "{} values of {} bytes do not lie in the {available} bytes of buffer {}",
                    accessor.count(),
                    accessor.size(),
                    view.buffer().index()
                ),
                "allowed are accessors inside their buffer view, with at least one value",
            )),
        }
    }
}

/// The triangles of a list, a strip (every second one turned) or a fan.
fn triangles_of(mode: Mode, indices: &[u32]) -> Vec<[u32; 3]> {
    match mode {
        Mode::TriangleStrip => indices
            .windows(3)
            .enumerate()
            .map(|(i, w)| if i % 2 == 0 { [w[0], w[1], w[2]] } else { [w[1], w[0], w[2]] })
            .collect(),
        Mode::TriangleFan => {
            indices.get(1..).unwrap_or_default().windows(2).map(|w| [w[0], w[1], indices[0]]).collect()
        }
        _ => indices.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect(),
    }
}

fn not_gltf(file: &Path, problem: &gltf::Error) -> Error {
    Error::Content {
        file: file.to_owned(),
        place: "as a whole".to_owned(),
        problem: one_line(problem),
        allowed: "allowed is glTF 2.0, as JSON (.gltf) or binary (.glb)",
    }
}

fn bad_buffer(file: &Path, problem: &gltf::Error) -> Error {
    let (place, problem) = match problem {
        gltf::Error::BufferLength { buffer, expected, actual } => {
            (format!("buffer {buffer}"), format!("{actual} bytes where {expected} are announced"))
        }
        other => ("buffers".to_owned(), one_line(other)),
    };
    Error::Content {
        file: file.to_owned(),
        place,
        problem,
        allowed: "allowed are whole buffers: embedded, in the binary chunk, or in a file beside this one",
    }
}

fn one_line(problem: &gltf::Error) -> String {
    problem.to_string().replace('\n', " ")
}
