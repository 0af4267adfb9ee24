//! The viewpoint: an arcball around a pivot.

use glam::{DQuat, DVec3};

/// Where the eye is and how it looks. World units throughout.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Camera {
    /// Point the camera turns around and looks at.
    pub pivot: DVec3,
    /// Turns view directions (x right, y up, z towards the eye) into world directions.
    pub world_from_view: DQuat,
    /// From the eye to the pivot.
    pub distance: f64,
    /// Vertical opening angle in radians.
    pub field_of_view: f64,
}
