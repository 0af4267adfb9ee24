//! Where a view is drawn.

use super::Size;
use super::frame::{Frame, LAYERS, Layer};
use super::pipelines::{COLOR_BYTES, DEPTH, OCCLUSION, Pipelines};

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
    occlusion: wgpu::TextureView,
    depth_bindings: wgpu::BindGroup,
    shadow_bindings: wgpu::BindGroup,
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
        let binding = wgpu::TextureUsages::TEXTURE_BINDING;
        let depth = view(&texture("depth", DEPTH, samples, attachment | binding, &[]));
        let occlusion = view(&texture("occlusion", OCCLUSION, 1, attachment | binding, &[]));
        let views = [&depth, &occlusion];
        let group = |layout, count| {
            let entries: Vec<_> = (0..)
                .zip(&views[..count])
                .map(|(binding, view)| wgpu::BindGroupEntry {
                    binding,
                    resource: wgpu::BindingResource::TextureView(view),
                })
                .collect();
            device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some("depths"), layout, entries: &entries })
        };
        Self {
            depth_bindings: group(&pipelines.depth_layout, 1),
            shadow_bindings: group(&pipelines.shadow_layout, 2),
            occlusion,
            depth,
            size,
            color_view: view(&color),
            multisampled: (samples > 1).then(|| view(&texture("samples", format, samples, attachment, &[]))),
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

    /// Begins to draw into it: `first` over nothing, later over what is there; after what is `last` depths are forgotten.
    pub(super) fn begin<'a>(
        &self,
        encoder: &'a mut wgpu::CommandEncoder,
        first: bool,
        last: bool,
    ) -> wgpu::RenderPass<'a> {
        let load = if first { wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT) } else { wgpu::LoadOp::Load };
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("scene"),
            color_attachments: &[Some(self.attachment(load, last))],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.depth,
                depth_ops: Some(wgpu::Operations {
                    // Reversed depth: zero is infinitely far.
                    load: if first { wgpu::LoadOp::Clear(0.0) } else { wgpu::LoadOp::Load },
                    store: if last { wgpu::StoreOp::Discard } else { wgpu::StoreOp::Store },
                }),
                stencil_ops: None,
            }),
            ..Default::default()
        })
    }

    fn attachment(&self, load: wgpu::LoadOp<wgpu::Color>, last: bool) -> wgpu::RenderPassColorAttachment<'_> {
        let (view, resolve_target) = match &self.multisampled {
            Some(samples) => (samples, Some(&self.color_view).filter(|_| last)),
            None => (&self.color_view, None),
        };
        let store = if resolve_target.is_some() { wgpu::StoreOp::Discard } else { wgpu::StoreOp::Store };
        wgpu::RenderPassColorAttachment {
            view,
            depth_slice: None,
            resolve_target,
            ops: wgpu::Operations { load, store },
        }
    }

    /// Darkens what was drawn where little of the sky is seen.
    pub(super) fn shade(&self, encoder: &mut wgpu::CommandEncoder, pipelines: &Pipelines) {
        let white = wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::WHITE), store: wgpu::StoreOp::Store };
        let occlusion = wgpu::RenderPassColorAttachment {
            view: &self.occlusion,
            depth_slice: None,
            resolve_target: None,
            ops: white,
        };
        let picture = self.attachment(wgpu::LoadOp::Load, false);
        for (pipeline, bindings, attachment) in [
            (&pipelines.occlusion, &self.depth_bindings, occlusion),
            (&pipelines.shadow, &self.shadow_bindings, picture),
        ] {
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("occlusion"),
                color_attachments: &[Some(attachment)],
                ..Default::default()
            });
            pass.set_pipeline(pipeline);
            self.bind(&mut pass, 0);
            pass.set_bind_group(1, bindings, &[]);
            pass.draw(0..3, 0..1);
        }
    }

    pub(super) fn bind(&self, pass: &mut wgpu::RenderPass<'_>, layer: usize) {
        pass.set_bind_group(0, &self.bindings, &[layer as u32 * LAYER_STRIDE as u32]);
    }
}
