//! What to draw of a mesh: triangles, lines, points. No GPU; built on the worker's thread.

use vv::mesh::Mesh;
use vv::mesh::faces::Faces;

/// How a mesh is drawn. The same for window and headless pictures.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Style {
    /// Fill the faces.
    pub faces: bool,
    /// Shade with vertex normals instead of face normals.
    pub smooth: bool,
    /// Draw the edges.
    pub edges: bool,
    /// Draw the vertices.
    pub vertices: bool,
    /// Superimpose the control mesh's edges and vertices.
    pub control: bool,
}

impl Default for Style {
    fn default() -> Self {
        Self { faces: true, smooth: false, edges: true, vertices: false, control: false }
    }
}

/// Everything to draw, in arrays ready for the GPU. Immutable; what [`Style`] switches on and off is decided when
/// drawing, so a change of style needs no new scene.
#[derive(Debug, Clone, Default)]
pub struct Scene {}

impl Scene {
    /// Of a mesh and its faces, with the control mesh it came from.
    #[must_use]
    pub fn new(_mesh: &Mesh, _faces: &Faces, _control: Option<(&Mesh, &Faces)>) -> Self {
        Self {}
    }
}
