//! Where a view is drawn.

use super::Size;
use super::frame::{Frame, LAYERS, Layer};
use super::pipelines::{COLOR_BYTES, DEPTH, Pipelines};

/// Layers lie this far apart in their buffer: the largest alignment a driver may ask for.
const LAYER_STRIDE: u64 = 256;

/// Colour, depth and uniform buffers of one view. Make a new one when the size changes.
#[derive(Debug)]
pub struct Target {
    pub(super) size: Size,
    pub(super) color: wgpu::Texture,
    color_view: wgpu::TextureView,
    /// Where several samples a pixel are drawn, before they are averaged into `color`.
    multisampled: Option<wgpu::TextureView>,
    depth: wgpu::TextureView,
    frame: wgpu::Buffer,
    layers: wgpu::Buffer,
    bindings: wgpu::BindGroup,
}

impl Target {
    pub(super) fn new(
        device: &wgpu::Device,
        pipelines: &Pipelines,
        format: wgpu::TextureFormat,
        size: Size,
        samples: u32,
    ) -> Self {
        let texture = |label, format, sample_count, usage, view_formats| {
            let size =
                wgpu::Extent3d { width: size.width.max(1), height: size.height.max(1), depth_or_array_layers: 1 };
            device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size,
                mip_level_count: 1,
                sample_count,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage,
                view_formats,
            })
        };
        let attachment = wgpu::TextureUsages::RENDER_ATTACHMENT;
        let shown = attachment | wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_SRC;
        let view = |texture: &wgpu::Texture| texture.create_view(&wgpu::TextureViewDescriptor::default());
        let buffer = |label, size| {
            let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
            device.create_buffer(&wgpu::BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false })
        };
        let color = texture("color", format, 1, shown, if format == COLOR_BYTES { &[] } else { &[COLOR_BYTES] });
        let frame = buffer("frame", size_of::<Frame>() as u64);
        let layers = buffer("layers", LAYER_STRIDE * LAYERS as u64);
        let one_layer =
            wgpu::BufferBinding { buffer: &layers, offset: 0, size: wgpu::BufferSize::new(size_of::<Layer>() as u64) };
        let bindings = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("frame"),
            layout: &pipelines.frame_layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: frame.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::Buffer(one_layer) },
            ],
        });
        Self {
            size,
            color_view: view(&color),
            multisampled: (samples > 1).then(|| view(&texture("samples", format, samples, attachment, &[]))),
            depth: view(&texture("depth", DEPTH, samples, attachment, &[])),
            color,
            frame,
            layers,
            bindings,
        }
    }

    /// Its size.
    #[must_use]
    pub fn size(&self) -> Size {
        self.size
    }

    /// The picture's bytes as they are, without decoding sRGB: what egui's `register_native_texture` wants.
    #[must_use]
    pub fn bytes_view(&self) -> wgpu::TextureView {
        self.color.create_view(&wgpu::TextureViewDescriptor { format: Some(COLOR_BYTES), ..Default::default() })
    }

    pub(super) fn write_uniforms(&self, queue: &wgpu::Queue, frame: &Frame, layers: &[Layer; LAYERS]) {
        queue.write_buffer(&self.frame, 0, bytemuck::bytes_of(frame));
        for (offset, layer) in (0..).step_by(LAYER_STRIDE as usize).zip(layers) {
            queue.write_buffer(&self.layers, offset, bytemuck::bytes_of(layer));
        }
    }

    pub(super) fn begin<'a>(&self, encoder: &'a mut wgpu::CommandEncoder) -> wgpu::RenderPass<'a> {
        let (view, resolve_target) = match &self.multisampled {
            Some(samples) => (samples, Some(&self.color_view)),
            None => (&self.color_view, None),
        };
        let discard_if_resolved = if resolve_target.is_some() { wgpu::StoreOp::Discard } else { wgpu::StoreOp::Store };
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("scene"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                    store: discard_if_resolved,
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.depth,
                // Reversed depth: zero is infinitely far.
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Discard }),
                stencil_ops: None,
            }),
            ..Default::default()
        })
    }

    pub(super) fn bind(&self, pass: &mut wgpu::RenderPass<'_>, layer: usize) {
        pass.set_bind_group(0, &self.bindings, &[layer as u32 * LAYER_STRIDE as u32]);
    }
}
