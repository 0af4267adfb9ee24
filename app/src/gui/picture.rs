//! The picture of the mesh, drawn by [`crate::render`] and handed to egui as a texture.

use std::sync::Arc;

use eframe::egui::TextureId;
use eframe::egui_wgpu::RenderState;

use crate::camera::Camera;
use crate::render::{RenderError, Renderer, Size, Target, Uploaded};
use crate::scene::{Scene, Style};

/// Smooth outlines; software drivers take a third longer for them.
const SAMPLES: u32 = 4;

/// Draws only when something has changed.
pub struct Picture {
    state: RenderState,
    renderer: Renderer,
    target: Option<Target>,
    texture: Option<TextureId>,
    uploaded: Option<(Arc<Scene>, Uploaded)>,
    drawn: Option<(Camera, Style)>,
    /// How often it was drawn.
    pub drawings: u64,
}

impl Picture {
    /// On the window's device.
    ///
    /// # Errors
    /// If the driver refuses a pipeline.
    pub fn new(state: RenderState) -> Result<Self, RenderError> {
        let renderer = Renderer::new(&state.device, &state.queue, SAMPLES)?;
        Ok(Self { state, renderer, target: None, texture: None, uploaded: None, drawn: None, drawings: 0 })
    }

    /// The texture with the scene drawn in this size.
    ///
    /// # Errors
    /// If the driver refuses it; the next call tries anew.
    pub fn texture(
        &mut self,
        size: Size,
        scene: &Arc<Scene>,
        camera: &Camera,
        style: &Style,
    ) -> Result<TextureId, RenderError> {
        let texture = self.sized(size)?;
        if !self.uploaded.as_ref().is_some_and(|(uploaded, _)| Arc::ptr_eq(uploaded, scene)) {
            self.uploaded = None; // before the new one, so that both need not fit
            self.drawn = None;
            self.uploaded = Some((Arc::clone(scene), self.renderer.upload(scene)?));
        }
        if self.drawn != Some((*camera, *style))
            && let (Some(target), Some((_, uploaded))) = (&self.target, &self.uploaded)
        {
            self.renderer.draw(target, uploaded, camera, style)?;
            self.drawn = Some((*camera, *style));
            self.drawings += 1;
        }
        Ok(texture)
    }

    /// The texture in this size.
    fn sized(&mut self, size: Size) -> Result<TextureId, RenderError> {
        if let (Some(target), Some(texture)) = (&self.target, self.texture)
            && target.size() == size
        {
            return Ok(texture);
        }
        self.target = None;
        self.drawn = None;
        let target = self.renderer.target(size)?;
        let view = target.bytes_view();
        let mut renderer = self.state.renderer.write();
        let filter = wgpu::FilterMode::Linear;
        let texture = match self.texture {
            Some(texture) => {
                renderer.update_egui_texture_from_wgpu_texture(&self.state.device, &view, filter, texture);
                texture
            }
            None => renderer.register_native_texture(&self.state.device, &view, filter),
        };
        self.texture = Some(texture);
        self.target = Some(target);
        Ok(texture)
    }
}
