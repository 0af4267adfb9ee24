//! What to draw of a mesh: triangles, lines, points. No GPU; built on the worker's thread.
//!
//! Positions become `f32` only after the centre of the mesh was taken away and its size was divided out, so that a
//! mesh far from the origin, or one a nanometre or a light year wide, is drawn as precisely as any other:
//!
//! ```text
//!   scene = (world − origin) / unit      unit a power of two, so that dividing is exact
//! ```

mod part;
mod pick;
mod sight;
#[cfg(test)]
mod tests;
mod tree;

use std::sync::{Arc, OnceLock};

use glam::{DVec3, Vec3};

use crate::camera::{Camera, Ray, Up};
use crate::trace;
use vv::mesh::Mesh;
use vv::mesh::faces::Faces;
use vv::stop::{Stop, Stopped};

use pick::Index;

pub use part::{Corner, Part, pack_color, unpack};
pub use pick::{Near, Picked, Pointer};

/// Light or dark surroundings.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
pub enum Theme {
    /// Bright paper: for print and bright windows.
    #[default]
    Light,
    /// For dark windows.
    Dark,
}

/// How a mesh is drawn. The same for window and headless pictures. Lengths are in points, which the scale factor of a
/// screen turns into pixels.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub struct Style {
    /// Fill the faces.
    pub faces: bool,
    /// Shade with vertex normals instead of face normals.
    pub smooth: bool,
    /// Colour the faces by the vertex property [`vv::io::COLOR`], where there is one.
    pub colors: bool,
    /// Draw the edges.
    pub edges: bool,
    /// Draw the vertices.
    pub vertices: bool,
    /// Superimpose the control mesh's edges and vertices.
    pub control: bool,
    /// Colours.
    pub theme: Theme,
    /// Leave the background transparent.
    pub transparent: bool,
    /// The colour behind it, in place of those of the theme.
    #[serde(skip)]
    pub backdrop: Option<[u8; 3]>,
    /// Width of edges between two faces; edges of the boundary are drawn wider in proportion.
    pub edge_width: f32,
    /// Diameter of vertices.
    pub vertex_size: f32,
    /// How the surface shows its quality.
    pub surface: Surface,
    /// Where the mesh is cut open.
    pub cut: Cut,
    /// Darken hollows, where little of the sky is seen.
    pub occlusion: bool,
    /// Draw a grid on the ground, with the axes of the world.
    pub grid: bool,
    /// Which axis points up from the ground.
    pub up: Up,
    /// Show the directions of the axes in a corner of the window.
    pub axes: bool,
}

/// How a surface shows its quality.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Surface {
    /// By its light alone.
    #[default]
    Lights,
    /// The mirror images of long lamps.
    ReflectionLines,
    /// Lines of equal light.
    Isophotes,
}

/// A plane that cuts away what lies on one side of it.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub struct Cut {
    /// Whether anything is cut away.
    pub on: bool,
    /// What it is perpendicular to.
    pub across: Axis,
    /// Where it is: 0 at the middle of the mesh, ±1 at its ends.
    pub position: f32,
    /// Cuts the other side away.
    pub flipped: bool,
}

impl Default for Cut {
    fn default() -> Self {
        Self { on: false, across: Axis::X, position: 0.0, flipped: false }
    }
}

/// A direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Axis {
    /// Of the world.
    #[default]
    X,
    /// Of the world, upwards.
    Y,
    /// Of the world.
    Z,
    /// Towards the eye.
    View,
}

/// A plane, of which one side is cut away: the points p with n · p > d.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// n, of length one.
    pub normal: DVec3,
    /// d.
    pub place: f64,
}

impl Plane {
    /// How far beyond it a point lies; up to 0 it is seen.
    #[must_use]
    pub fn beyond(&self, p: DVec3) -> f64 {
        self.normal.dot(p) - self.place
    }

    /// How far along a ray what is not cut away begins and ends.
    #[must_use]
    pub fn kept(&self, ray: Ray) -> [f64; 2] {
        let (beyond, approach) = (self.beyond(ray.origin), self.normal.dot(ray.direction));
        let t = -beyond / approach;
        match (beyond > 0.0, approach < 0.0) {
            (true, true) => [t, f64::INFINITY],
            (true, false) => [f64::INFINITY, f64::INFINITY],
            (false, true) => [0.0, f64::INFINITY],
            (false, false) => [0.0, if t.is_nan() { f64::INFINITY } else { t }],
        }
    }

    /// In the coordinates of a scene.
    fn in_scene(self, scene: &Scene) -> Self {
        Self { place: (self.place - self.normal.dot(scene.origin)) / scene.unit, ..self }
    }
}

impl Cut {
    /// What is cut away of the world; `None` if nothing is.
    #[must_use]
    pub fn plane(&self, bounds: Sphere, camera: &Camera) -> Option<Plane> {
        if !self.on {
            return None;
        }
        let normal = match self.across {
            Axis::X => DVec3::X,
            Axis::Y => DVec3::Y,
            Axis::Z => DVec3::Z,
            Axis::View => camera.world_from_view * DVec3::Z,
        };
        let place = normal.dot(bounds.center) + f64::from(self.position) * bounds.radius;
        Some(if self.flipped { Plane { normal: -normal, place: -place } } else { Plane { normal, place } })
    }
}

impl Default for Style {
    fn default() -> Self {
        Self {
            faces: true,
            smooth: false,
            colors: true,
            edges: true,
            vertices: false,
            control: false,
            theme: Theme::Light,
            transparent: false,
            backdrop: None,
            edge_width: 1.2,
            vertex_size: 6.0,
            surface: Surface::Lights,
            cut: Cut::default(),
            occlusion: false,
            grid: false,
            up: Up::Y,
            axes: false,
        }
    }
}

/// A ball around everything.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    /// Its centre in world units.
    pub center: DVec3,
    /// Its radius in world units; 0 for a single point and for nothing.
    pub radius: f64,
}

impl Sphere {
    /// One that holds all of these.
    #[must_use]
    pub fn around(spheres: impl Iterator<Item = Self> + Clone) -> Self {
        let corners = |s: Self| [s.center - DVec3::splat(s.radius), s.center + DVec3::splat(s.radius)];
        let extent = Extent::of(&spheres.clone().flat_map(corners).collect::<Vec<_>>());
        if extent.low.x > extent.high.x {
            return Self { center: DVec3::ZERO, radius: 0.0 };
        }
        let center = (extent.low + extent.high) / 2.0;
        Self { center, radius: spheres.map(|s| s.center.distance(center) + s.radius).fold(0.0, f64::max) }
    }
}

/// Everything to draw, in arrays ready for the GPU. Immutable; what [`Style`] switches on and off is decided when
/// drawing, so a change of style needs no new scene.
#[derive(Debug, Clone)]
pub struct Scene {
    /// World position of the scene's zero.
    pub origin: DVec3,
    /// World length of the scene's one; a power of two.
    pub unit: f64,
    /// The mesh.
    pub mesh: Part,
    /// The control mesh, without triangles.
    pub control: Part,
    /// The least coordinates of the mesh along each axis of the world.
    pub lowest: DVec3,
    bounds: Sphere,
    bounds_with_control: Sphere,
    /// What is where: of the mesh, and of the control mesh.
    index: OnceLock<Arc<[Index; 2]>>,
}

impl Default for Scene {
    fn default() -> Self {
        let bounds = Sphere { center: DVec3::ZERO, radius: 0.0 };
        Self {
            origin: DVec3::ZERO,
            unit: 1.0,
            mesh: Part::default(),
            control: Part::default(),
            lowest: DVec3::ZERO,
            bounds,
            bounds_with_control: bounds,
            index: OnceLock::new(),
        }
    }
}

impl Scene {
    /// Of a mesh and its faces, with the control mesh it came from.
    ///
    /// The whole universe of the mesh is drawn. Vertices whose position is not finite, or so far away (10¹⁵⁰) that
    /// lengths overflow, are left out together with their faces and edges; all others stay. Linear in the size of the
    /// mesh, but for concave polygons with many corners.
    ///
    /// # Errors
    /// When `stop` is requested.
    pub fn new(mesh: &Mesh, faces: &Faces, control: Option<(&Mesh, &Faces)>, stop: &Stop) -> Result<Self, Stopped> {
        let own = Extent::of(mesh.positions());
        let all = match control {
            Some((control, _)) => own.and(Extent::of(control.positions())),
            None => own,
        };
        let bounds = own.sphere(&[mesh]);
        let bounds_with_control = match control {
            Some((control, _)) => all.sphere(&[mesh, control]),
            None => bounds,
        };
        let origin = bounds.center;
        let unit = power_of_two(bounds.radius);
        let to_scene = |p: DVec3| usable(p).then(|| (p - origin) / unit);
        Ok(Self {
            origin,
            unit,
            mesh: Part::new(mesh, faces, &to_scene, part::Fill::Faces, stop)?,
            control: match control {
                Some((mesh, faces)) => Part::new(mesh, faces, &to_scene, part::Fill::Nothing, stop)?,
                None => Part::default(),
            },
            lowest: if own.low.is_finite() { own.low } else { DVec3::ZERO },
            bounds,
            bounds_with_control,
            index: OnceLock::new(),
        })
    }

    /// Makes ready for [`Scene::pick`] and [`Scene::fit`], which else cannot look anything up. A picture does without, so
    /// this is best done after it, on another thread. Cost: sorting the triangles, on all threads.
    pub fn build_index(&self) {
        let _span = trace::span("index");
        self.index.get_or_init(|| Arc::new([Index::new(&self.mesh), Index::new(&self.control)]));
    }

    /// Whether [`Scene::fit`] takes no time that one would notice.
    #[must_use]
    pub fn fits_at_once(&self) -> bool {
        const FEW: usize = 200_000;
        self.is_indexed() || self.mesh.owners.len() + self.control.owners.len() <= FEW
    }

    /// Whether [`Scene::build_index`] was done.
    #[must_use]
    pub fn is_indexed(&self) -> bool {
        self.index.get().is_some()
    }

    /// What `style` cuts away; `None` if nothing is.
    #[must_use]
    pub fn cut(&self, style: &Style, camera: &Camera) -> Option<Plane> {
        style.cut.plane(self.bounds, camera)
    }

    /// A ball around what `style` shows.
    #[must_use]
    pub fn bounds(&self, style: &Style) -> Sphere {
        if style.control { self.bounds_with_control } else { self.bounds }
    }

    /// The standard view of what `style` shows, as close as it gets.
    #[must_use]
    pub fn standard_view(&self, style: &Style, aspect: f64) -> Camera {
        self.fit(Camera::standard(self.bounds(style), aspect), style, aspect)
    }

    /// `camera` looking from the same side at all that `style` shows, as close as it gets. Cost: linear in the vertices
    /// unless [`Scene::is_indexed`].
    #[must_use]
    pub fn fit(&self, camera: Camera, style: &Style, aspect: f64) -> Camera {
        let parts = &[&self.mesh, &self.control][..if style.control { 2 } else { 1 }];
        let world = |p: Vec3| self.to_world(p);
        let bounds = self.bounds(style);
        if let Some(indices) = self.index.get() {
            let directions = camera.decisive_directions(aspect);
            let farthest = |(part, index): (&&Part, &Index)| directions.map(|d| index.farthest(part, d));
            let points = parts.iter().zip(indices.iter()).flat_map(farthest).flatten();
            return camera.fit_points(points.map(world), bounds, aspect);
        }
        let corners = parts.iter().flat_map(|part| &part.corners[..part.vertex_count as usize]);
        camera.fit_points(corners.map(|corner| world(corner.position.into())), bounds, aspect)
    }

    /// `camera` looking from the same side at all that `style` shows of all `scenes`, as close as it gets. Cost: linear in
    /// the vertices.
    #[must_use]
    pub fn fit_all(scenes: &[&Self], camera: Camera, style: &Style, aspect: f64) -> Camera {
        let bounds = Sphere::around(scenes.iter().map(|scene| scene.bounds(style)));
        let points = scenes.iter().flat_map(|scene| {
            let parts = &[&scene.mesh, &scene.control][..if style.control { 2 } else { 1 }];
            let corners = parts.iter().flat_map(|part| &part.corners[..part.vertex_count as usize]).collect::<Vec<_>>();
            corners.into_iter().map(|corner| scene.to_world(corner.position.into()))
        });
        camera.fit_points(points, bounds, aspect)
    }

    /// `camera` looking from the same side at all that `style` shows, as close as it gets while that turns around the line
    /// through the middle of its ball along `axis`, of length one. Cost: linear in the vertices.
    ///
    /// What a vertex, at the height h and the distance r of the line, passes on its way reaches farthest in a direction d
    /// where it is `h (d · axis) + r |d − (d · axis) axis|` far.
    #[must_use]
    pub fn fit_turning(&self, camera: Camera, axis: DVec3, style: &Style, aspect: f64) -> Camera {
        let bounds = self.bounds(style);
        let parts = &[&self.mesh, &self.control][..if style.control { 2 } else { 1 }];
        let corners = parts.iter().flat_map(|part| &part.corners[..part.vertex_count as usize]);
        let directions = camera.decisive_directions(aspect).map(|d| {
            let along = d.dot(axis);
            (along, d - along * axis)
        });
        let mut farthest = [(f64::NEG_INFINITY, 0.0, 0.0); 4];
        for corner in corners {
            let p = self.to_world(corner.position.into()) - bounds.center;
            let height = p.dot(axis);
            let radius = (p - height * axis).length();
            for (farthest, (along, beside)) in farthest.iter_mut().zip(directions) {
                let reach = height * along + radius * beside.length();
                if reach > farthest.0 {
                    *farthest = (reach, height, radius);
                }
            }
        }
        let reached = farthest.into_iter().zip(directions).filter(|(farthest, _)| farthest.0.is_finite());
        let points = reached.map(|((_, height, radius), (_, beside))| {
            bounds.center + height * axis + radius * beside.normalize_or_zero()
        });
        camera.fit_points(points, bounds, aspect)
    }

    /// World position of a point of the scene.
    #[must_use]
    pub fn to_world(&self, p: Vec3) -> DVec3 {
        self.origin + self.unit * p.as_dvec3()
    }
}

/// Beyond this, squares and products of lengths overflow.
const FARTHEST: f64 = 1e150;

fn usable(p: DVec3) -> bool {
    p.abs().max_element() < FARTHEST && !p.is_nan()
}

/// The largest power of two up to `length`, so that lengths divided by it lie around 1; 1 for a length of 0.
fn power_of_two(length: f64) -> f64 {
    if length > 0.0 { length.max(f64::MIN_POSITIVE).log2().floor().exp2() } else { 1.0 }
}

/// The box around some points; `low > high` while there is none.
#[derive(Clone, Copy)]
struct Extent {
    low: DVec3,
    high: DVec3,
}

impl Extent {
    fn of(points: &[DVec3]) -> Self {
        let none = Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY };
        points.iter().filter(|p| usable(**p)).fold(none, |e, &p| Self { low: e.low.min(p), high: e.high.max(p) })
    }

    fn and(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// The ball around the middle of the box that holds all points of `meshes`.
    fn sphere(self, meshes: &[&Mesh]) -> Sphere {
        if self.low.x > self.high.x {
            return Sphere { center: DVec3::ZERO, radius: 0.0 };
        }
        let center = (self.low + self.high) / 2.0;
        let points = meshes.iter().flat_map(|m| m.positions()).filter(|p| usable(**p));
        let radius = points.map(|p| p.distance_squared(center)).fold(0.0, f64::max).sqrt();
        Sphere { center, radius }
    }
}
