//! Arrows at vertices and faces.

use glam::DVec3;
use vv::mesh::Values;
use vv::stop::{Stop, Stopped};

use super::Subject;
use super::field::NoField;
use crate::scene::{Scene, unpack};

/// What is drawn as arrows.
#[derive(Debug, Clone, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Arrows {
    /// Nothing.
    #[default]
    Nothing,
    /// The normals at vertices.
    VertexNormals,
    /// The normals of faces, at their middles.
    FaceNormals,
    /// A vertex property of type `vec`.
    Property(String),
}

impl Arrows {
    /// Those that every mesh has.
    pub const NAMED: [Self; 3] = [Self::Nothing, Self::VertexNormals, Self::FaceNormals];

    /// What it is called in the window.
    #[must_use]
    pub fn title(&self) -> String {
        match self {
            Self::Nothing => "nothing".to_owned(),
            Self::VertexNormals => "normals of vertices".to_owned(),
            Self::FaceNormals => "normals of faces".to_owned(),
            Self::Property(name) => name.clone(),
        }
    }
}

/// Arrows in scene coordinates; the length of one that is neither long nor short is 1.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ArrowSet {
    /// Begin and direction of each.
    pub arrows: Vec<[f32; 6]>,
    /// Of how many elements one has an arrow: more would cover everything.
    pub every: usize,
    /// The length in world units of those that are drawn as long as 1.
    pub unit: f64,
    /// Mean length of the edges in scene units.
    pub mean_edge: f32,
}

/// Most arrows.
const MOST: usize = 100_000;

impl ArrowSet {
    /// The arrows of a mesh. Linear in the mesh.
    ///
    /// # Errors
    /// When the mesh lacks what is asked for, or when stopped.
    pub fn new(subject: &Subject<'_>, arrows: &Arrows, stop: &Stop) -> Result<Self, NoField> {
        stop.check()?;
        let mut set = Self { every: 1, unit: 1.0, mean_edge: subject.scene.mesh.mean_edge, ..Self::default() };
        match arrows {
            Arrows::Nothing => {}
            Arrows::VertexNormals => set.vertex_normals(subject.scene),
            Arrows::FaceNormals => set.face_normals(subject, stop)?,
            Arrows::Property(name) => {
                let properties = subject.mesh.vertex_properties();
                match properties.iter().find(|p| p.name == *name).map(|p| &p.values) {
                    Some(Values::Vec(values)) => set.property(subject, values),
                    _ => return Err(NoField::Missing(format!("no vertex property `{name}` of type vec here"))),
                }
            }
        }
        Ok(set)
    }

    fn vertex_normals(&mut self, scene: &Scene) {
        let corners = &scene.mesh.corners[..scene.mesh.vertex_count as usize];
        self.every = corners.len().div_ceil(MOST).max(1);
        for corner in corners.iter().step_by(self.every).filter(|corner| corner.normal != 0) {
            let ([x, y, z], n) = (corner.position, unpack(corner.normal));
            self.arrows.push([x, y, z, n.x, n.y, n.z]);
        }
    }

    fn face_normals(&mut self, subject: &Subject<'_>, stop: &Stop) -> Result<(), Stopped> {
        self.every = subject.faces.len().div_ceil(MOST).max(1);
        for face in subject.faces.iter().step_by(self.every) {
            stop.check()?;
            let points: Vec<DVec3> = face.iter().map(|&v| subject.mesh.position(v)).collect();
            let middle = points.iter().sum::<DVec3>() / points.len().max(1) as f64;
            let normal = vv::mesh::triangulate::newell(&points).normalize_or_zero();
            self.push(subject.scene, middle, normal);
        }
        Ok(())
    }

    fn property(&mut self, subject: &Subject<'_>, values: &[DVec3]) {
        const PART: f64 = 0.95;
        let mut lengths: Vec<f64> = values.iter().map(|v| v.length()).filter(|l| l.is_finite() && *l > 0.0).collect();
        if lengths.is_empty() {
            return;
        }
        // A few that are very long do not make all others invisible.
        let place = ((lengths.len() - 1) as f64 * PART).round() as usize;
        let (_, &mut unit, _) = lengths.select_nth_unstable_by(place, f64::total_cmp);
        self.unit = unit;
        self.every = values.len().div_ceil(MOST).max(1);
        for (&p, &v) in subject.mesh.positions().iter().zip(values).step_by(self.every) {
            self.push(subject.scene, p, v / unit);
        }
    }

    fn push(&mut self, scene: &Scene, p: DVec3, direction: DVec3) {
        let p = (p - scene.origin) / scene.unit;
        if p.is_finite() && direction.is_finite() && direction != DVec3::ZERO {
            let ([x, y, z], [u, v, w]) = (p.as_vec3().to_array(), direction.as_vec3().to_array());
            self.arrows.push([x, y, z, u, v, w]);
        }
    }
}
