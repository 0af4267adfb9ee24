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

/// What has more elements comes to the GPU in a thread of its own, so that the window waits for none.
const AT_ONCE: usize = 100_000;

/// Draws only when something has changed.
pub struct Picture {
    state: RenderState,
    renderer: Arc<Renderer>,
    wake: Arc<dyn Fn() + Send + Sync>,
    target: Option<Target>,
    texture: Option<TextureId>,
    uploaded: Option<(Arc<Scene>, Uploaded)>,
    /// The colours and arrows on the GPU, made for that scene.
    tint: Option<(Arc<Tint>, UploadedTint)>,
    arrows: Option<(Arc<ArrowSet>, UploadedArrows)>,
    underway: Option<Delivery>,
    /// What cannot be brought to the GPU, and why.
    refused: Option<(Load, RenderError)>,
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

/// What is to be brought to the GPU: what of a scene and of what was made for it is not there.
struct Load {
    scene: Arc<Scene>,
    /// Whether the scene itself is to be brought.
    whole: bool,
    tint: Option<Arc<Tint>>,
    arrows: Option<Arc<ArrowSet>>,
}

struct Loaded {
    scene: Option<Uploaded>,
    tint: Option<UploadedTint>,
    arrows: Option<UploadedArrows>,
}

/// A load on its way.
struct Delivery {
    load: Load,
    result: Receiver<Result<Loaded, RenderError>>,
}

impl Load {
    fn is_empty(&self) -> bool {
        !self.whole && self.tint.is_none() && self.arrows.is_none()
    }

    /// How many elements it has, about.
    fn size(&self) -> usize {
        let scene = if self.whole { self.scene.mesh.corners.len() + self.scene.control.corners.len() } else { 0 };
        let words = self.tint.as_ref().map_or(0, |tint| tint.words.len());
        scene + words + self.arrows.as_ref().map_or(0, |arrows| arrows.arrows.len())
    }

    /// Whether it is all that is wanted.
    fn is(&self, wanted: &Self) -> bool {
        let same_dress = same(self.tint.as_ref().map(|tint| &tint.words), wanted.tint.as_ref().map(|tint| &tint.words))
            && same(self.arrows.as_ref(), wanted.arrows.as_ref());
        Arc::ptr_eq(&self.scene, &wanted.scene) && self.whole == wanted.whole && same_dress
    }

    /// Whether it is worth waiting for: a scene comes in whatever dress.
    fn serves(&self, wanted: &Self) -> bool {
        self.is(wanted) || self.whole && wanted.whole && Arc::ptr_eq(&self.scene, &wanted.scene)
    }

    fn bring(&self, renderer: &Renderer) -> Result<Loaded, RenderError> {
        Ok(Loaded {
            scene: self.whole.then(|| renderer.upload(&self.scene)).transpose()?,
            tint: self.tint.as_ref().map(|tint| renderer.upload_tint(tint)).transpose()?,
            arrows: self.arrows.as_ref().map(|arrows| renderer.upload_arrows(arrows)).transpose()?,
        })
    }
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
            tint: None,
            arrows: None,
            underway: None,
            refused: None,
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
        self.supply(scene, dress)?;
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
            release(self.drawn.replace(wanted));
            self.drawings += 1;
        }
        Ok(texture)
    }

    /// Sees to it that the scene and what was made for it are on the GPU, or come there.
    fn supply(&mut self, scene: &Arc<Scene>, dress: &Wardrobe) -> Result<(), RenderError> {
        let whole = !self.uploaded.as_ref().is_some_and(|(uploaded, _)| Arc::ptr_eq(uploaded, scene));
        let mut wanted =
            Load { scene: Arc::clone(scene), whole, tint: dress.tint.clone(), arrows: dress.arrows.clone() };
        if !whole {
            self.keep(&mut wanted);
        }
        if wanted.is_empty() {
            self.underway = None; // nobody waits for it any more
            return Ok(());
        }
        if let Some((_, error)) = self.refused.as_ref().filter(|(refused, _)| refused.is(&wanted)) {
            return Err(error.clone());
        }
        let underway = self.underway.take_if(|delivery| delivery.load.serves(&wanted));
        let (load, result) = match underway {
            Some(delivery) => match delivery.result.try_recv() {
                Ok(result) => (delivery.load, result),
                Err(TryRecvError::Empty) => {
                    self.underway = Some(delivery);
                    return Ok(());
                }
                Err(TryRecvError::Disconnected) => {
                    (delivery.load, Err(RenderError::Failed("the graphics driver gave up".to_owned())))
                }
            },
            None if wanted.size() <= AT_ONCE => {
                let result = wanted.bring(&self.renderer);
                (wanted, result)
            }
            None => {
                self.send(wanted);
                return Ok(());
            }
        };
        match result {
            Ok(loaded) => {
                self.install(load, loaded);
                return self.supply(scene, dress); // it may be in another dress by now
            }
            // Perhaps there is room without what was there before.
            Err(_) if self.uploaded.is_some() => {
                (self.uploaded, self.tint, self.arrows, self.drawn) = (None, None, None, None);
                self.send(Load { whole: true, tint: dress.tint.clone(), arrows: dress.arrows.clone(), ..load });
            }
            Err(error) => {
                self.refused = Some((load, error.clone()));
                return Err(error);
            }
        }
        Ok(())
    }

    /// Leaves out of a load what is on the GPU, and takes from there what is not wanted any more.
    fn keep(&mut self, wanted: &mut Load) {
        match (&mut self.tint, &wanted.tint) {
            // At most another range: the words are the same.
            (Some((old, _)), Some(new)) if Arc::ptr_eq(&old.words, &new.words) => {
                *old = Arc::clone(new);
                wanted.tint = None;
            }
            // The colours before stay until the others come.
            (Some(_), Some(_)) | (None, _) => {}
            (tint, None) => release(tint.take()),
        }
        if same(self.arrows.as_ref().map(|(arrows, _)| arrows), wanted.arrows.as_ref()) {
            wanted.arrows = None;
        } else if wanted.arrows.is_none() {
            release(self.arrows.take());
        }
    }

    fn install(&mut self, load: Load, loaded: Loaded) {
        self.refused = None;
        if let Some(uploaded) = loaded.scene {
            // What is there is of the scene before.
            release((self.tint.take(), self.arrows.take(), self.drawn.take()));
            release(self.uploaded.replace((load.scene, uploaded)));
        }
        if let Some(tint) = load.tint.zip(loaded.tint) {
            release(self.tint.replace(tint));
        }
        if let Some(arrows) = load.arrows.zip(loaded.arrows) {
            release(self.arrows.replace(arrows));
        }
    }

    /// Begins to bring something to the GPU.
    fn send(&mut self, load: Load) {
        let (sender, result) = mpsc::channel();
        let (renderer, wake) = (Arc::clone(&self.renderer), Arc::clone(&self.wake));
        let Load { scene, whole, tint, arrows } = &load;
        let sent = Load { scene: Arc::clone(scene), whole: *whole, tint: tint.clone(), arrows: arrows.clone() };
        std::thread::spawn(move || {
            let _ = sender.send(sent.bring(&renderer));
            drop(sent);
            wake();
        });
        self.underway = Some(Delivery { load, result });
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

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use egui_kittest::wgpu::{create_render_state, default_wgpu_setup as setup};

    use vv::io::{Format, ReadOptions};
    use vv::mesh::faces::faces;
    use vv::stop::Stop;

    use super::*;
    use crate::annotate::{Annotations, Subject};
    use crate::inspect::lineage::Lineage;
    use crate::scene::Sphere;

    /// A square, and its colours with as many words as a large mesh has.
    fn square() -> (Arc<Scene>, Arc<Tint>) {
        let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
        let mesh = vv::io::read(text.as_bytes(), Format::Obj, &ReadOptions::default()).unwrap().0;
        let faces = faces(&mesh, &Stop::new()).unwrap();
        let scene = Scene::new(&mesh, &faces, None, &Stop::new()).unwrap();
        let lineage = Lineage::default();
        let subject = Subject {
            mesh: &mesh,
            faces: &faces,
            scene: &scene,
            generation: 0,
            before: None,
            lineage: &lineage,
            tint: None,
        };
        let asked = Annotations { color_by: "x".parse().unwrap(), ..Annotations::default() };
        let mut tint = Tint::new(&subject, &asked, &Stop::new()).unwrap().unwrap();
        let mut words = Vec::clone(&tint.words);
        words.resize(AT_ONCE + 1, 0);
        tint.words = Arc::new(words);
        (Arc::new(scene), Arc::new(tint))
    }

    #[test]
    fn many_colours_come_to_the_gpu_in_a_thread_of_their_own() {
        let state = create_render_state(setup(), Default::default());
        let (waker, awake) = mpsc::channel();
        let waker = std::sync::Mutex::new(waker);
        let wake = move || _ = waker.lock().unwrap().send(());
        let mut picture = Picture::new(state, Arc::new(wake)).unwrap();
        let (scene, tint) = square();
        let camera = Camera::standard(Sphere { center: glam::DVec3::ZERO, radius: 1.0 }, 1.0);
        let mut show = |tint: Option<&Arc<Tint>>| {
            let dress = Wardrobe { tint: tint.cloned(), ..Wardrobe::default() };
            picture.texture(Size::new(32, 32), &scene, &dress, &camera, &Style::default()).unwrap();
            (picture.drawings, picture.tint.is_some(), picture.underway.is_some())
        };
        assert_eq!(show(None), (1, false, false), "few corners come at once");
        assert_eq!(show(Some(&tint)), (1, false, true), "nobody waits");
        awake.recv_timeout(Duration::from_secs(30)).unwrap();
        assert_eq!(show(Some(&tint)), (2, true, false));
        assert_eq!(show(Some(&Arc::new(tint.with_range(Some([0.0, 9.0]))))), (3, true, false), "the words are there");
        assert_eq!(show(None), (4, false, false));
        assert_eq!(show(Some(&tint)), (4, false, true));
        assert_eq!(show(None), (4, false, false), "what is not wanted any more is not waited for");
    }
}
