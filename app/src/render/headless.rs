//! Pictures without a window.

use std::time::Duration;

use image::RgbaImage;

use super::frame::Tile;
use super::palette::{to_linear, to_srgb};
use super::{Dress, NoRenderer, RenderError, Renderer, Size, Target, Uploaded, device_descriptor};
use crate::annotate::{ArrowSet, Tint};
use crate::camera::Camera;
use crate::scene::{Scene, Style};

/// Pictures are drawn in tiles of at most this many pixels a side, which bounds the memory of the GPU they take.
const TILE: u32 = 2048;

/// So many pixels around a tile are drawn with it where pixels ask their neighbours. As in `shaders/occlusion.wgsl`.
const MARGIN: u32 = 204;

/// Most pixels of a picture: a gigabyte.
const MOST_PIXELS: u64 = 1 << 28;

/// How long a picture that is drawn may take to be read.
const PATIENCE: Duration = Duration::from_secs(20);

/// A renderer with a device of its own.
#[derive(Debug)]
pub struct Headless {
    renderer: Renderer,
    /// Pixels that are drawn for each one of the picture, along a side.
    fine: u32,
}

/// Draws one picture, with smooth outlines.
///
/// # Errors
/// Without a graphics driver, or if the scene or the picture is too large for it.
pub fn render_image(
    scene: &Scene,
    dressing: Dressing<'_>,
    camera: &Camera,
    style: &Style,
    size: Size,
) -> Result<RgbaImage, RenderError> {
    Headless::new(4)?.dressed_image(scene, dressing, camera, style, size)
}

/// What is drawn with a scene that is not part of it.
#[derive(Debug, Clone, Copy, Default)]
pub struct Dressing<'a> {
    /// The colours of its faces.
    pub tint: Option<&'a Tint>,
    /// Arrows, and how long they are as a multiple of the mean length of the edges.
    pub arrows: Option<(&'a ArrowSet, f32)>,
}

impl Headless {
    /// On the adapter whose name contains `WGPU_ADAPTER_NAME`, if that is set, or else on the fastest. `samples` are those
    /// of a pixel: 1, 4 for smooth outlines; 16 and 64, four for each of the 4 or 16 pixels that are drawn in place of
    /// one, for lines finer than a pixel. Others are taken for the next lower ones.
    ///
    /// # Errors
    /// Without a graphics driver.
    pub fn new(samples: u32) -> Result<Self, RenderError> {
        let name = std::env::var("WGPU_ADAPTER_NAME").ok().filter(|name| !name.is_empty());
        Self::on_adapter(name.as_deref(), samples)
    }

    /// On the first adapter whose name contains `name`, in any case; on the fastest without a name.
    ///
    /// # Errors
    /// Without such an adapter.
    pub fn on_adapter(name: Option<&str>, samples: u32) -> Result<Self, RenderError> {
        let adapter = adapter(name).map_err(|cause| NoRenderer { cause })?;
        let (device, queue) = pollster::block_on(adapter.request_device(&device_descriptor(&adapter)))
            .map_err(|error| NoRenderer { cause: error.to_string() })?;
        // What no scope catches, such as a device that is lost, shows when the picture is read.
        device.on_uncaptured_error(std::sync::Arc::new(|error| log::error!("graphics: {error}")));
        let (samples, fine) = match samples {
            0..4 => (1, 1),
            4..16 => (4, 1),
            16..64 => (4, 2),
            _ => (4, 4),
        };
        let renderer = Renderer::new(&device, &queue, samples).map_err(|error| match adapter.get_info().backend {
            // Of what is drawn some needs more than every OpenGL can do: it counts as none.
            wgpu::Backend::Gl => NoRenderer { cause: format!("OpenGL alone does not do: {error}") }.into(),
            _ => error,
        })?;
        Ok(Self { renderer, fine })
    }

    /// Brings a scene to the GPU.
    ///
    /// # Errors
    /// If it is larger than the driver takes.
    pub fn upload(&self, scene: &Scene) -> Result<Uploaded, RenderError> {
        self.renderer.upload(scene)
    }

    /// Draws a picture.
    ///
    /// # Errors
    /// If the scene or the picture is too large, or the driver gives up.
    pub fn image(&self, scene: &Scene, camera: &Camera, style: &Style, size: Size) -> Result<RgbaImage, RenderError> {
        self.dressed_image(scene, Dressing::default(), camera, style, size)
    }

    /// Draws a picture of a scene and what belongs to it.
    ///
    /// # Errors
    /// As [`Headless::image`].
    pub fn dressed_image(
        &self,
        scene: &Scene,
        dressing: Dressing<'_>,
        camera: &Camera,
        style: &Style,
        size: Size,
    ) -> Result<RgbaImage, RenderError> {
        let Size { width, height, scale } = size;
        if width == 0 || height == 0 || u64::from(width) * u64::from(height) > MOST_PIXELS {
            return Err(RenderError::TooLarge(format!(
                "a picture of {width}x{height} pixels cannot be drawn; it needs at least 1 and at most {MOST_PIXELS} pixels"
            )));
        }
        let uploaded = self.renderer.upload(scene)?;
        let words = dressing.tint.map(|tint| self.renderer.upload_tint(tint)).transpose()?;
        let arrows = match dressing.arrows {
            Some((set, length)) => Some((self.renderer.upload_arrows(set)?, length)),
            None => None,
        };
        let dress = Dress {
            tint: dressing.tint.zip(words.as_ref()),
            arrows: arrows.as_ref().map(|(arrows, length)| (arrows, *length)),
        };
        let side = TILE.min(self.renderer.device.limits().max_texture_dimension_2d - 2 * MARGIN);
        let fine = self.fine;
        let side = side - side % fine;
        let picture = Size { width: width * fine, height: height * fine, scale: scale * fine as f32 };
        let mut image = RgbaImage::new(width, height);
        for top in (0..picture.height).step_by(side as usize) {
            for left in (0..picture.width).step_by(side as usize) {
                let (right, bottom) = (picture.width.min(left + side), picture.height.min(top + side));
                let tile = Tile { picture, left, top, width: right - left, height: bottom - top };
                let drawn = if style.occlusion { tile.with_margin(MARGIN) } else { tile };
                let target = self.renderer.target(Size { width: drawn.width, height: drawn.height, scale })?;
                self.renderer.draw_tile(&target, &uploaded, dress, camera, style, drawn)?;
                let from = [tile.left - drawn.left, tile.top - drawn.top];
                if fine == 1 {
                    self.read(&target, &mut image, tile, from)?;
                    continue;
                }
                let mut pixels = RgbaImage::new(tile.width, tile.height);
                self.read(&target, &mut pixels, Tile { left: 0, top: 0, ..tile }, from)?;
                average(&pixels, fine, &mut image, [tile.left / fine, tile.top / fine]);
            }
        }
        if style.transparent {
            image.pixels_mut().for_each(|pixel| pixel.0 = unmultiplied(pixel.0));
        }
        Ok(image)
    }

    /// Copies what was drawn into its place in the picture.
    fn read(&self, target: &Target, image: &mut RgbaImage, tile: Tile, [x, y]: [u32; 2]) -> Result<(), RenderError> {
        let device = &self.renderer.device;
        let failed =
            |what: &str| RenderError::Failed(format!("the graphics driver did not give back the picture: {what}"));
        let row = (tile.width * 4).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = super::guarded(device, || {
            let buffer = device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("picture"),
                size: u64::from(row) * u64::from(tile.height),
                usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
                mapped_at_creation: false,
            });
            let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            encoder.copy_texture_to_buffer(
                wgpu::TexelCopyTextureInfo { origin: wgpu::Origin3d { x, y, z: 0 }, ..target.color.as_image_copy() },
                wgpu::TexelCopyBufferInfo {
                    buffer: &buffer,
                    layout: wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: None },
                },
                wgpu::Extent3d { width: tile.width, height: tile.height, depth_or_array_layers: 1 },
            );
            self.renderer.queue.submit([encoder.finish()]);
            buffer
        })?;
        let (sender, receiver) = std::sync::mpsc::channel();
        buffer.map_async(wgpu::MapMode::Read, .., move |result| {
            let _ = sender.send(result); // the receiver is gone only after an error
        });
        device.poll(wgpu::PollType::wait_indefinitely()).map_err(|error| failed(&error.to_string()))?;
        // Another thread that waits for the same device may be the one that is told, a little later.
        match receiver.recv_timeout(PATIENCE) {
            Ok(Ok(())) => {}
            Ok(Err(error)) => return Err(failed(&error.to_string())),
            Err(error) => return Err(failed(&error.to_string())),
        }
        let bytes = buffer.slice(..).get_mapped_range().map_err(|error| failed(&error.to_string()))?;
        for (y, from) in bytes.chunks_exact(row as usize).enumerate() {
            let start = ((tile.top as usize + y) * image.width() as usize + tile.left as usize) * 4;
            let length = tile.width as usize * 4;
            if let Some(to) = image.get_mut(start..start + length) {
                to.copy_from_slice(&from[..length]);
            }
        }
        Ok(())
    }
}

/// The adapter called so, or the fastest; what went wrong otherwise.
fn adapter(name: Option<&str>) -> Result<wgpu::Adapter, String> {
    let mut cause = String::new();
    // OpenGL only where nothing better is there: to look for it prints complaints on machines without a display.
    for backends in [wgpu::Backends::PRIMARY, wgpu::Backends::SECONDARY] {
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle_from_env();
        descriptor.backends &= backends;
        let instance = wgpu::Instance::new(descriptor);
        let found = match name {
            Some(name) => {
                let adapters = pollster::block_on(instance.enumerate_adapters(backends));
                let matches = |a: &wgpu::Adapter| a.get_info().name.to_lowercase().contains(&name.to_lowercase());
                let cause = || format!("of {} adapters none is called {name}", adapters.len());
                adapters.iter().find(|a| matches(a)).cloned().ok_or_else(cause)
            }
            None => pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions {
                power_preference: wgpu::PowerPreference::HighPerformance,
                ..Default::default()
            }))
            .map_err(|error| error.to_string()),
        };
        match found {
            Ok(adapter) => return Ok(adapter),
            Err(error) if cause.is_empty() => cause = error,
            Err(_) => {}
        }
    }
    Err(cause)
}

/// Puts the mean light of each square of `fine` by `fine` pixels into a picture, from a place on.
fn average(pixels: &RgbaImage, fine: u32, image: &mut RgbaImage, [left, top]: [u32; 2]) {
    let light: [f32; 256] = std::array::from_fn(|c| to_linear(c as f32 / 255.0));
    let count = (fine * fine) as f32;
    for y in 0..pixels.height() / fine {
        for x in 0..pixels.width() / fine {
            let mut sum = [0.0; 4];
            for (dx, dy) in (0..fine).flat_map(|dy| (0..fine).map(move |dx| (dx, dy))) {
                let [r, g, b, a] = pixels.get_pixel(x * fine + dx, y * fine + dy).0;
                let [r, g, b] = [r, g, b].map(|c| light[usize::from(c)]);
                [r, g, b, f32::from(a)].into_iter().zip(&mut sum).for_each(|(c, sum)| *sum += c);
            }
            let [r, g, b, a] = sum.map(|c| c / count);
            let [r, g, b] = [r, g, b].map(|c| (to_srgb(c) * 255.0).round() as u8);
            image.put_pixel(left + x, top + y, image::Rgba([r, g, b, a.round() as u8]));
        }
    }
}

/// Lays a colour behind a picture with transparent places.
pub fn put_on(image: &mut RgbaImage, color: [u8; 3]) {
    let paper = color.map(|c| to_linear(f32::from(c) / 255.0));
    for pixel in image.pixels_mut().filter(|pixel| pixel.0[3] < 255) {
        let [r, g, b, a] = pixel.0;
        let opacity = f32::from(a) / 255.0;
        let over = |c: u8, paper: f32| {
            let light = to_linear(f32::from(c) / 255.0) * opacity + paper * (1.0 - opacity);
            (to_srgb(light) * 255.0).round() as u8
        };
        let [x, y, z] = paper;
        pixel.0 = [over(r, x), over(g, y), over(b, z), 255];
    }
}

/// From light multiplied by opacity, as blending over nothing leaves it, to the plain colour that files hold.
fn unmultiplied(pixel: [u8; 4]) -> [u8; 4] {
    let [r, g, b, a] = pixel;
    if a == 0 || a == 255 {
        return pixel;
    }
    let opacity = f32::from(a) / 255.0;
    let plain = |c: u8| (to_srgb((to_linear(f32::from(c) / 255.0) / opacity).min(1.0)) * 255.0).round() as u8;
    [plain(r), plain(g), plain(b), a]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_lies_behind_what_is_transparent() {
        let mut image = RgbaImage::from_raw(3, 1, vec![9, 9, 9, 0, 0, 0, 0, 128, 10, 20, 30, 255]).unwrap();
        put_on(&mut image, [255; 3]);
        assert_eq!(image.into_raw(), [255, 255, 255, 255, 187, 187, 187, 255, 10, 20, 30, 255]);
    }

    #[test]
    fn a_pixel_is_the_mean_light_of_those_that_are_drawn_for_it() {
        let (white, black) = ([255; 4], [0, 0, 0, 255]);
        let pixels = RgbaImage::from_raw(4, 2, [white, black, white, white, black, white, white, white].concat());
        let mut image = RgbaImage::new(3, 1);
        average(&pixels.unwrap(), 2, &mut image, [1, 0]);
        assert_eq!(image.into_raw(), [[0; 4], [188, 188, 188, 255], white].concat());
    }

    #[test]
    fn half_covered_pixels_keep_their_colour() {
        assert_eq!(unmultiplied([10, 20, 30, 255]), [10, 20, 30, 255]);
        assert_eq!(unmultiplied([0, 0, 0, 0]), [0, 0, 0, 0]);
        // Half of the light of full white is 188 in sRGB.
        assert_eq!(unmultiplied([188, 188, 188, 128])[0], 255);
    }
}
