//! Scenes to pictures with wgpu, for the window and headless alike. Knows no egui.
//!
//! ```text
//!   Renderer   pipelines; made once, never changes
//!   Target     where one view is drawn: colour, depth, its uniform buffers; one per view and size
//!   Uploaded   a scene in the memory of the GPU; one per scene
//!   draw       Renderer + Target + Uploaded + Camera + Style → colour in the target
//! ```
//!
//! The colour target is sRGB, so that light is added up linearly. Passes, in order: background, faces, occlusion, grid, edges,
//! vertices, control mesh, arrows; lines and points blend over the faces, tested against their depth but writing none.

mod frame;
mod headless;
pub(crate) mod palette;
mod pipelines;
pub mod shaders;
mod target;
mod upload;

use std::fmt;

use crate::annotate::{ArrowSet, Tint};
use crate::camera::Camera;
use crate::scene::{Scene, Style};
use crate::trace;

pub use headless::{Dressing, Headless, put_on, render_image};
pub use target::Target;
pub use upload::{Uploaded, UploadedArrows, UploadedTint};

use frame::{Tile, layer_draws};
use pipelines::{Pipelines, color_format};

/// A picture's size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Size {
    /// In pixels.
    pub width: u32,
    /// In pixels.
    pub height: u32,
    /// Pixels per point: how much wider lines are on a dense screen. 1 for pictures in files.
    pub scale: f32,
}

impl Size {
    /// Of a picture in a file.
    #[must_use]
    pub fn new(width: u32, height: u32) -> Self {
        Self { width, height, scale: 1.0 }
    }

    /// Width over height.
    #[must_use]
    pub fn aspect(self) -> f64 {
        f64::from(self.width.max(1)) / f64::from(self.height.max(1))
    }
}

/// Why there is no picture.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum RenderError {
    /// No graphics driver to draw with.
    NoRenderer(NoRenderer),
    /// More than the driver takes, in a sentence.
    TooLarge(String),
    /// The driver refused or was lost, in a sentence.
    Failed(String),
}

/// There is no graphics driver to draw with; displayed as a sentence that says what to do.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NoRenderer {
    /// What the system said.
    pub cause: String,
}

impl fmt::Display for NoRenderer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "no graphics driver found: install one (on Debian `apt install mesa-vulkan-drivers libvulkan1` draws without \
             a graphics card), or point VK_DRIVER_FILES at its .json file ({})",
            self.cause
        )
    }
}

impl fmt::Display for RenderError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoRenderer(none) => none.fmt(f),
            Self::TooLarge(why) | Self::Failed(why) => f.write_str(why),
        }
    }
}

impl std::error::Error for NoRenderer {}
impl std::error::Error for RenderError {}

impl From<NoRenderer> for RenderError {
    fn from(none: NoRenderer) -> Self {
        Self::NoRenderer(none)
    }
}

/// Draws scenes. Immutable; clones of device and queue are cheap handles.
#[derive(Debug)]
pub struct Renderer {
    device: wgpu::Device,
    queue: wgpu::Queue,
    pipelines: Pipelines,
    samples: u32,
    /// OpenGL differs in which corner speaks for a triangle, and in what it can do with sRGB.
    opengl: bool,
}

/// What is drawn with a scene that is not part of it.
#[derive(Debug, Clone, Copy, Default)]
pub struct Dress<'a> {
    /// The colours of its faces, made for this scene.
    pub tint: Option<(&'a Tint, &'a UploadedTint)>,
    /// Arrows, made for this scene, and how long they are as a multiple of the mean length of the edges.
    pub arrows: Option<(&'a UploadedArrows, f32)>,
}

/// How to ask an adapter for a device that takes meshes and pictures as large as it can.
#[must_use]
pub fn device_descriptor(adapter: &wgpu::Adapter) -> wgpu::DeviceDescriptor<'static> {
    wgpu::DeviceDescriptor { label: Some("vv"), required_limits: adapter.limits(), ..Default::default() }
}

impl Renderer {
    /// On a device of the window's or of one's own; best made by [`device_descriptor`]. `samples` is 1, or 4 for smooth
    /// outlines.
    ///
    /// # Errors
    /// If the driver refuses a pipeline.
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue, samples: u32) -> Result<Self, RenderError> {
        let opengl = device.adapter_info().backend == wgpu::Backend::Gl;
        let pipelines = guarded(device, || Pipelines::new(device, color_format(opengl), samples))?;
        Ok(Self { device: device.clone(), queue: queue.clone(), pipelines, samples, opengl })
    }

    /// Somewhere to draw.
    ///
    /// # Errors
    /// If the size is beyond the driver's limits or its memory.
    pub fn target(&self, size: Size) -> Result<Target, RenderError> {
        let most = self.device.limits().max_texture_dimension_2d;
        if size.width.max(size.height) > most {
            let Size { width, height, .. } = size;
            return Err(RenderError::TooLarge(format!(
                "a picture of {width}x{height} pixels is too large for this graphics driver, which takes {most} a side"
            )));
        }
        guarded(&self.device, || {
            Target::new(&self.device, &self.pipelines, color_format(self.opengl), size, self.samples)
        })
    }

    /// Brings a scene to the GPU.
    ///
    /// # Errors
    /// If it is larger than the driver takes.
    pub fn upload(&self, scene: &Scene) -> Result<Uploaded, RenderError> {
        let _span = trace::span("upload");
        Uploaded::check(scene, &self.device.limits())?;
        guarded(&self.device, || Uploaded::new(&self.device, &self.queue, &self.pipelines, scene, self.opengl))
    }

    /// Brings the arrows of a scene to the GPU.
    ///
    /// # Errors
    /// If the driver is out of memory.
    pub fn upload_arrows(&self, arrows: &ArrowSet) -> Result<UploadedArrows, RenderError> {
        let _span = trace::span("uploading arrows");
        guarded(&self.device, || UploadedArrows::new(&self.device, &self.queue, &self.pipelines, arrows))
    }

    /// Draws into the target; returns as soon as the work is handed over to the GPU.
    ///
    /// # Errors
    /// If the driver refuses it or the device was lost.
    pub fn draw(
        &self,
        target: &Target,
        scene: &Uploaded,
        dress: Dress<'_>,
        camera: &Camera,
        style: &Style,
    ) -> Result<(), RenderError> {
        self.draw_tile(target, scene, dress, camera, style, Tile::whole(target.size))
    }

    /// Brings the colours of a scene to the GPU.
    ///
    /// # Errors
    /// If the driver is out of memory.
    pub fn upload_tint(&self, tint: &Tint) -> Result<UploadedTint, RenderError> {
        let _span = trace::span("uploading colours");
        guarded(&self.device, || UploadedTint::new(&self.device, &self.queue, tint))
    }

    /// Draws the part of a larger picture that lies in `tile`.
    fn draw_tile(
        &self,
        target: &Target,
        scene: &Uploaded,
        dress: Dress<'_>,
        camera: &Camera,
        style: &Style,
        tile: Tile,
    ) -> Result<(), RenderError> {
        let _span = trace::span("drawing");
        let frame = frame::frame(scene, camera, style, dress.tint.map(|(tint, _)| tint), tile, self.opengl);
        let arrow = dress.arrows.map_or(0.0, |(arrows, length)| arrows.mean_edge * length);
        let layers = frame::layers(scene, style, arrow, tile.picture.scale);
        guarded(&self.device, || {
            target.write_uniforms(&self.queue, &frame, &layers);
            let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            // OpenGL cannot read several depths of a pixel everywhere.
            let shaded = style.occlusion && style.faces && scene.faces.is_some() && !self.opengl;
            {
                let mut pass = target.begin(&mut encoder, true, !shaded);
                if !style.transparent {
                    pass.set_pipeline(&self.pipelines.background);
                    target.bind(&mut pass, 0);
                    pass.draw(0..3, 0..1);
                }
                if style.faces
                    && let Some(faces) = &scene.faces
                {
                    let colors = faces.colors.as_ref().filter(|_| style.colors);
                    let words = dress.tint.map(|(_, uploaded)| &uploaded.words).or(colors);
                    pass.set_pipeline(self.pipelines.faces(words.is_some(), style.cut.on));
                    target.bind(&mut pass, 0);
                    pass.set_vertex_buffer(0, faces.corners.slice(..));
                    if let Some(words) = words {
                        pass.set_vertex_buffer(1, words.slice(..));
                    }
                    pass.set_index_buffer(faces.indices.slice(..), wgpu::IndexFormat::Uint32);
                    pass.draw_indexed(0..faces.index_count, 0, 0..1);
                }
                if shaded {
                    drop(pass);
                    target.shade(&mut encoder, &self.pipelines);
                    pass = target.begin(&mut encoder, false, true);
                }
                if style.grid {
                    pass.set_pipeline(&self.pipelines.grid);
                    target.bind(&mut pass, 0);
                    pass.draw(0..6, 0..1);
                }
                for draw in layer_draws(scene, camera, style, tile.picture) {
                    let Some(part) = draw.part.of(scene) else { continue };
                    target.bind(&mut pass, draw.layer);
                    pass.set_bind_group(1, &part.bindings, &[]);
                    let (edges, vertices) = self.pipelines.lines_and_points(draw.hidden);
                    if !draw.edges.is_empty() {
                        pass.set_pipeline(edges);
                        pass.draw(draw.edges.start * 6..draw.edges.end * 6, 0..1);
                    }
                    if !draw.vertices.is_empty() {
                        pass.set_pipeline(vertices);
                        pass.draw(draw.vertices.start * 6..draw.vertices.end * 6, 0..1);
                    }
                }
                if let Some((arrows, _)) = dress.arrows.filter(|(arrows, _)| arrows.count > 0) {
                    pass.set_pipeline(&self.pipelines.arrows);
                    target.bind(&mut pass, frame::ARROWS);
                    pass.set_bind_group(1, &arrows.bindings, &[]);
                    pass.draw(0..9, 0..arrows.count);
                }
            }
            self.queue.submit([encoder.finish()]);
        })
    }
}

/// Does something on the device; what the driver refuses comes back as an error instead of a panic.
fn guarded<T>(device: &wgpu::Device, work: impl FnOnce() -> T) -> Result<T, RenderError> {
    let scopes = [wgpu::ErrorFilter::Internal, wgpu::ErrorFilter::OutOfMemory, wgpu::ErrorFilter::Validation]
        .map(|filter| device.push_error_scope(filter));
    let result = work();
    // Scopes end in the reverse order of their beginning.
    let errors: Vec<_> = scopes.into_iter().rev().filter_map(|scope| pollster::block_on(scope.pop())).collect();
    match errors.into_iter().next() {
        None => Ok(result),
        Some(wgpu::Error::OutOfMemory { .. }) => {
            Err(RenderError::TooLarge("the graphics driver is out of memory".to_owned()))
        }
        Some(error) => Err(RenderError::Failed(format!("the graphics driver refused to draw: {error}"))),
    }
}
