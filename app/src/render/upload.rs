//! A scene in the memory of the GPU.

use glam::DVec3;

use super::RenderError;
use super::pipelines::Pipelines;
use crate::annotate::{ArrowSet, Tint};
use crate::scene::{Corner, Part, Scene, Sphere, Style};

/// Data is handed over in pieces of this many bytes, which bounds what the driver must keep beside it.
const PIECE: usize = 64 << 20;

/// A scene in the memory of the GPU; good for any number of pictures.
#[derive(Debug)]
pub struct Uploaded {
    pub(super) origin: DVec3,
    pub(super) unit: f64,
    pub(super) faces: Option<FaceBuffers>,
    pub(super) mesh: Option<PartBuffers>,
    pub(super) control: Option<PartBuffers>,
    pub(super) lowest: DVec3,
    bounds: [Sphere; 2],
}

/// The words of a tint in the memory of the GPU; for the scene it was made for.
#[derive(Debug)]
pub struct UploadedTint {
    pub(super) words: wgpu::Buffer,
}

impl UploadedTint {
    pub(super) fn new(device: &wgpu::Device, queue: &wgpu::Queue, tint: &Tint) -> Self {
        let upload = Upload { device, queue };
        Self { words: upload.buffer("tint", wgpu::BufferUsages::VERTEX, bytemuck::cast_slice(&tint.words)) }
    }
}

/// Arrows in the memory of the GPU; for the scene they were made for.
#[derive(Debug)]
pub struct UploadedArrows {
    pub(super) bindings: wgpu::BindGroup,
    pub(super) count: u32,
    /// Mean length of the edges in scene units.
    pub(super) mean_edge: f32,
}

impl UploadedArrows {
    pub(super) fn new(device: &wgpu::Device, queue: &wgpu::Queue, pipelines: &Pipelines, set: &ArrowSet) -> Self {
        let upload = Upload { device, queue };
        let arrows = upload.buffer("arrows", wgpu::BufferUsages::STORAGE, bytemuck::cast_slice(&set.arrows));
        let bindings = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("arrows"),
            layout: &pipelines.part_layout,
            entries: &[0, 1].map(|binding| wgpu::BindGroupEntry { binding, resource: arrows.as_entire_binding() }),
        });
        Self { bindings, count: set.arrows.len() as u32, mean_edge: set.mean_edge }
    }
}

#[derive(Debug)]
pub(super) struct FaceBuffers {
    pub corners: wgpu::Buffer,
    pub colors: Option<wgpu::Buffer>,
    pub indices: wgpu::Buffer,
    pub index_count: u32,
}

/// Lines and points of one mesh.
#[derive(Debug)]
pub(super) struct PartBuffers {
    pub bindings: wgpu::BindGroup,
    pub vertex_count: u32,
    pub lonely_count: u32,
    pub edge_count: u32,
    pub inner_edge_count: u32,
    pub mean_edge: f32,
    pub longest_inner_edge: f32,
}

impl Uploaded {
    /// Whether the driver takes a scene of this size.
    pub(super) fn check(scene: &Scene, limits: &wgpu::Limits) -> Result<(), RenderError> {
        for part in [&scene.mesh, &scene.control] {
            let storage = limits.max_storage_buffer_binding_size;
            check("corners", part.corners.len(), size_of::<Corner>(), limits.max_buffer_size)?;
            check("vertices", part.vertex_count as usize, size_of::<Corner>(), storage)?;
            check("triangles", part.triangles.len(), size_of::<[u32; 3]>(), limits.max_buffer_size)?;
            check("edges", part.edges.len(), size_of::<[u32; 2]>(), storage.min(limits.max_buffer_size))?;
            // Indices and the vertices of lines are counted in 32 bits.
            check("triangles", part.triangles.len(), 3, u64::from(u32::MAX))?;
            check("edges", part.edges.len(), 6, u64::from(u32::MAX))?;
            check("vertices", part.vertex_count as usize, 6, u64::from(u32::MAX))?;
        }
        Ok(())
    }

    pub(super) fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        pipelines: &Pipelines,
        scene: &Scene,
        opengl: bool,
    ) -> Self {
        let upload = Upload { device, queue };
        let (mesh_corners, mesh) = upload.part(pipelines, &scene.mesh).unzip();
        let (_, control) = upload.part(pipelines, &scene.control).unzip();
        let faces = mesh_corners.filter(|_| !scene.mesh.triangles.is_empty()).map(|corners| FaceBuffers {
            corners,
            colors: (!scene.mesh.colors.is_empty())
                .then(|| upload.buffer("colors", wgpu::BufferUsages::VERTEX, bytemuck::cast_slice(&scene.mesh.colors))),
            indices: if opengl {
                // Here the last corner of a triangle speaks for it.
                let turned: Vec<_> = scene.mesh.triangles.iter().map(|&[a, b, c]| [b, c, a]).collect();
                upload.buffer("triangles", wgpu::BufferUsages::INDEX, bytemuck::cast_slice(&turned))
            } else {
                upload.buffer("triangles", wgpu::BufferUsages::INDEX, bytemuck::cast_slice(&scene.mesh.triangles))
            },
            index_count: scene.mesh.triangles.len() as u32 * 3,
        });
        let bounds = [false, true].map(|control| scene.bounds(&Style { control, ..Style::default() }));
        Self { origin: scene.origin, unit: scene.unit, faces, mesh, control, lowest: scene.lowest, bounds }
    }

    /// A ball around what `style` shows.
    #[must_use]
    pub fn bounds(&self, style: &Style) -> Sphere {
        self.bounds[usize::from(style.control)]
    }
}

fn check(what: &str, count: usize, size: usize, most: u64) -> Result<(), RenderError> {
    if count as u64 * size as u64 <= most {
        return Ok(());
    }
    let most = most / size as u64;
    Err(RenderError::TooLarge(format!(
        "the mesh is too large to be drawn: {count} {what}, where this graphics driver takes {most}"
    )))
}

struct Upload<'a> {
    device: &'a wgpu::Device,
    queue: &'a wgpu::Queue,
}

impl Upload<'_> {
    /// The buffer of the corners, and all that lines and points need; `None` for an empty mesh.
    fn part(&self, pipelines: &Pipelines, part: &Part) -> Option<(wgpu::Buffer, PartBuffers)> {
        if part.vertex_count == 0 {
            return None;
        }
        let usage = wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::STORAGE;
        let corners = self.buffer("corners", usage, bytemuck::cast_slice(&part.corners));
        let edges = self.buffer("edges", wgpu::BufferUsages::STORAGE, bytemuck::cast_slice(&part.edges));
        let vertices = wgpu::BufferBinding {
            buffer: &corners,
            offset: 0, // the rest is for faces
            size: wgpu::BufferSize::new(u64::from(part.vertex_count) * size_of::<Corner>() as u64),
        };
        let bindings = self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("part"),
            layout: &pipelines.part_layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::Buffer(vertices) },
                wgpu::BindGroupEntry { binding: 1, resource: edges.as_entire_binding() },
            ],
        });
        let buffers = PartBuffers {
            bindings,
            vertex_count: part.vertex_count,
            lonely_count: part.lonely_count,
            edge_count: part.edges.len() as u32,
            inner_edge_count: part.inner_edge_count,
            mean_edge: part.mean_edge,
            longest_inner_edge: part.longest_inner_edge,
        };
        Some((corners, buffers))
    }

    fn buffer(&self, label: &str, usage: wgpu::BufferUsages, data: &[u8]) -> wgpu::Buffer {
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: data.len().max(16) as u64, // an empty buffer cannot be bound
            usage: usage | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        for (i, piece) in data.chunks(PIECE).enumerate() {
            self.queue.write_buffer(&buffer, (i * PIECE) as u64, piece);
            if piece.len() == PIECE {
                self.queue.submit([]); // let the driver have it before the next one comes
            }
        }
        buffer
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mesh_beyond_the_limits_is_refused_with_a_sentence() {
        let corner = Corner { position: [0.0; 3], normal: 0, face_normal: 0 };
        let mut scene = Scene::default();
        scene.mesh.corners = vec![corner; 100];
        scene.mesh.vertex_count = 50;
        scene.mesh.triangles = vec![[0; 3]; 90];
        let limits = |buffer, binding| wgpu::Limits {
            max_buffer_size: buffer,
            max_storage_buffer_binding_size: binding,
            ..wgpu::Limits::default()
        };
        assert_eq!(Uploaded::check(&scene, &limits(2000, 1000)), Ok(()));
        let refused = |limits| Uploaded::check(&scene, &limits).unwrap_err().to_string();
        assert_eq!(
            refused(limits(1999, 1000)),
            "the mesh is too large to be drawn: 100 corners, where this graphics driver takes 99"
        );
        assert_eq!(
            refused(limits(2000, 999)),
            "the mesh is too large to be drawn: 50 vertices, where this graphics driver takes 49"
        );
    }
}
