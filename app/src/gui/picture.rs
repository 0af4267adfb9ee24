//! The picture of the mesh, drawn by [`crate::render`] and handed to egui as a texture.

use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, TryRecvError};

use eframe::egui::TextureId;
use eframe::egui_wgpu::RenderState;

use crate::annotate::{ArrowSet, Tint};
use crate::camera::Camera;
use crate::render::{Dress, RenderError, Renderer, Size, Target, Uploaded, UploadedArrows, UploadedTint};
use crate::scene::{Scene, Style};
use crate::worker::release;

/// Smooth outlines; software drivers take a third longer for them.
const SAMPLES: u32 = 4;

/// Scenes of more corners come to the GPU in a thread of their own, so that the window waits for none.
const AT_ONCE: usize = 100_000;

/// Draws only when something has changed.
pub struct Picture {
    state: RenderState,
    renderer: Arc<Renderer>,
    wake: Arc<dyn Fn() + Send + Sync>,
    target: Option<Target>,
    texture: Option<TextureId>,
    uploaded: Option<(Arc<Scene>, Uploaded)>,
    uploading: Option<Uploading>,
    /// What cannot be brought to the GPU, and why.
    refused: Option<(Arc<Scene>, RenderError)>,
    /// The colours on the GPU.
    tint: Option<(Arc<Tint>, UploadedTint)>,
    arrows: Option<(Arc<ArrowSet>, UploadedArrows)>,
    drawn: Option<Drawn>,
    /// How often it was drawn.
    pub drawings: u64,
}

/// What is drawn with a scene, made for it.
#[derive(Default)]
pub struct Wardrobe {
    pub tint: Option<Arc<Tint>>,
    pub arrows: Option<Arc<ArrowSet>>,
    /// As a multiple of the mean length of the edges.
    pub arrow_length: f32,
}

/// What was drawn.
struct Drawn {
    camera: Camera,
    style: Style,
    tint: Option<Arc<Tint>>,
    arrows: Option<(Arc<ArrowSet>, f32)>,
}

impl PartialEq for Drawn {
    fn eq(&self, other: &Self) -> bool {
        let arrows = |drawn: &Self| drawn.arrows.as_ref().map(|(arrows, length)| (Arc::as_ptr(arrows), *length));
        (self.camera, self.style) == (other.camera, other.style)
            && same(self.tint.as_ref(), other.tint.as_ref())
            && arrows(self) == arrows(other)
    }
}

struct Uploading {
    scene: Arc<Scene>,
    result: Receiver<Result<Uploaded, RenderError>>,
}

impl Picture {
    /// On the window's device. `wake` is called, from another thread, when a large scene has come to the GPU.
    ///
    /// # Errors
    /// If the driver refuses a pipeline.
    pub fn new(state: RenderState, wake: Arc<dyn Fn() + Send + Sync>) -> Result<Self, RenderError> {
        let renderer = Arc::new(Renderer::new(&state.device, &state.queue, SAMPLES)?);
        Ok(Self {
            state,
            renderer,
            wake,
            target: None,
            texture: None,
            uploaded: None,
            uploading: None,
            refused: None,
            tint: None,
            arrows: None,
            drawn: None,
            drawings: 0,
        })
    }

    /// The texture with the scene drawn in this size; the scene before, while a large one is on its way to the GPU.
    ///
    /// # Errors
    /// If the driver refuses it; the next call tries anew.
    pub fn texture(
        &mut self,
        size: Size,
        scene: &Arc<Scene>,
        dress: &Wardrobe,
        camera: &Camera,
        style: &Style,
    ) -> Result<TextureId, RenderError> {
        let texture = self.sized(size)?;
        if !self.uploaded.as_ref().is_some_and(|(uploaded, _)| Arc::ptr_eq(uploaded, scene)) {
            self.upload(scene)?;
        }
        // A scene that is still on its way is not the one these colours are for.
        let arrived = self.uploaded.as_ref().is_some_and(|(uploaded, _)| Arc::ptr_eq(uploaded, scene));
        if arrived {
            self.upload_tint(dress.tint.as_ref())?;
            self.upload_arrows(dress.arrows.as_ref())?;
        }
        let wanted = Drawn {
            camera: *camera,
            style: *style,
            tint: self.tint.as_ref().map(|(tint, _)| Arc::clone(tint)),
            arrows: self.arrows.as_ref().map(|(arrows, _)| (Arc::clone(arrows), dress.arrow_length)),
        };
        if self.drawn.as_ref() != Some(&wanted)
            && let (Some(target), Some((_, uploaded))) = (&self.target, &self.uploaded)
        {
            let dress = Dress {
                tint: self.tint.as_ref().map(|(tint, words)| (&**tint, words)),
                arrows: self.arrows.as_ref().map(|(_, arrows)| (arrows, dress.arrow_length)),
            };
            self.renderer.draw(target, uploaded, dress, camera, style)?;
            self.drawn = Some(wanted);
            self.drawings += 1;
        }
        Ok(texture)
    }

    fn upload_tint(&mut self, tint: Option<&Arc<Tint>>) -> Result<(), RenderError> {
        self.tint = match (tint, self.tint.take()) {
            (None, _) => None,
            // Another range only: the words are the same.
            (Some(tint), Some((old, words))) if Arc::ptr_eq(&old.words, &tint.words) => Some((Arc::clone(tint), words)),
            (Some(tint), _) => Some((Arc::clone(tint), self.renderer.upload_tint(tint)?)),
        };
        Ok(())
    }

    fn upload_arrows(&mut self, arrows: Option<&Arc<ArrowSet>>) -> Result<(), RenderError> {
        if !same(self.arrows.as_ref().map(|(arrows, _)| arrows), arrows) {
            self.arrows = match arrows {
                Some(arrows) => Some((Arc::clone(arrows), self.renderer.upload_arrows(arrows)?)),
                None => None,
            };
        }
        Ok(())
    }

    fn upload(&mut self, scene: &Arc<Scene>) -> Result<(), RenderError> {
        if let Some((_, error)) = self.refused.as_ref().filter(|(refused, _)| Arc::ptr_eq(refused, scene)) {
            return Err(error.clone());
        }
        let result = match &self.uploading {
            Some(on_its_way) if Arc::ptr_eq(&on_its_way.scene, scene) => match on_its_way.result.try_recv() {
                Ok(result) => result,
                Err(TryRecvError::Empty) => return Ok(()),
                Err(TryRecvError::Disconnected) => Err(RenderError::Failed("the graphics driver gave up".to_owned())),
            },
            _ if scene.mesh.corners.len() + scene.control.corners.len() <= AT_ONCE => self.renderer.upload(scene),
            _ => {
                self.send(scene);
                return Ok(());
            }
        };
        self.uploading = None;
        self.drawn = None;
        match result {
            Ok(uploaded) => {
                (self.tint, self.arrows) = (None, None); // they are of the scene before
                release(self.uploaded.replace((Arc::clone(scene), uploaded)));
            }
            // Perhaps there is room without the one before.
            Err(_) if self.uploaded.take().is_some() => self.send(scene),
            Err(error) => {
                self.refused = Some((Arc::clone(scene), error.clone()));
                return Err(error);
            }
        }
        Ok(())
    }

    /// Begins to bring a scene to the GPU.
    fn send(&mut self, scene: &Arc<Scene>) {
        let (sender, result) = mpsc::channel();
        let (renderer, wake, sent) = (Arc::clone(&self.renderer), Arc::clone(&self.wake), Arc::clone(scene));
        std::thread::spawn(move || {
            let _ = sender.send(renderer.upload(&sent));
            drop(sent);
            wake();
        });
        self.uploading = Some(Uploading { scene: Arc::clone(scene), result });
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

fn same<T>(a: Option<&Arc<T>>, b: Option<&Arc<T>>) -> bool {
    match (a, b) {
        (Some(a), Some(b)) => Arc::ptr_eq(a, b),
        (None, None) => true,
        _ => false,
    }
}
