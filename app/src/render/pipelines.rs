//! How each pass is set up.

use super::shaders;

/// The bytes of the colour target as egui wants to see them.
pub(super) const COLOR_BYTES: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
pub(super) const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// One number from 0 to 1 at each pixel.
pub(super) const OCCLUSION: wgpu::TextureFormat = wgpu::TextureFormat::R8Unorm;

/// What is there is multiplied with what is drawn; its opacity stays.
const TIMES: wgpu::BlendState = wgpu::BlendState {
    color: wgpu::BlendComponent {
        src_factor: wgpu::BlendFactor::Dst,
        dst_factor: wgpu::BlendFactor::Zero,
        operation: wgpu::BlendOperation::Add,
    },
    alpha: wgpu::BlendComponent {
        src_factor: wgpu::BlendFactor::Zero,
        dst_factor: wgpu::BlendFactor::One,
        operation: wgpu::BlendOperation::Add,
    },
};

/// Colour of the target: sRGB, so that blending happens in linear light. OpenGL cannot show the bytes of such a texture
/// as they are; there the shaders encode what they draw, and blending is a little less exact.
pub(super) fn color_format(opengl: bool) -> wgpu::TextureFormat {
    if opengl { COLOR_BYTES } else { wgpu::TextureFormat::Rgba8UnormSrgb }
}

#[derive(Debug)]
pub(super) struct Pipelines {
    pub background: wgpu::RenderPipeline,
    /// Whole, and cut open.
    faces: [wgpu::RenderPipeline; 2],
    /// The same in colours.
    tinted_faces: [wgpu::RenderPipeline; 2],
    pub grid: wgpu::RenderPipeline,
    pub arrows: wgpu::RenderPipeline,
    pub occlusion: wgpu::RenderPipeline,
    pub shadow: wgpu::RenderPipeline,
    edges: wgpu::RenderPipeline,
    vertices: wgpu::RenderPipeline,
    hidden_edges: wgpu::RenderPipeline,
    hidden_vertices: wgpu::RenderPipeline,
    /// Group 0: frame and layer.
    pub frame_layout: wgpu::BindGroupLayout,
    /// Group 1: corners and edges of one mesh.
    pub part_layout: wgpu::BindGroupLayout,
    /// Group 1: depths.
    pub depth_layout: wgpu::BindGroupLayout,
    /// Group 1: depths and ambient occlusion.
    pub shadow_layout: wgpu::BindGroupLayout,
}

/// What distinguishes one pass from another.
#[derive(Clone, Copy)]
struct Pass {
    name: &'static str,
    shader: &'static str,
    /// The entry point of the vertex shader.
    vertex: &'static str,
    /// The entry point of the fragment shader.
    fragment: &'static str,
    depth: wgpu::CompareFunction,
    /// Covers what is there and writes depth; otherwise blends over it.
    solid: bool,
    buffers: &'static [Option<wgpu::VertexBufferLayout<'static>>],
}

const CORNER: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: size_of::<crate::scene::Corner>() as u64,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Uint32, 2 => Uint32],
};
const WORD: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: size_of::<u32>() as u64,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![3 => Uint32],
};

impl Pipelines {
    pub(super) fn new(device: &wgpu::Device, color: wgpu::TextureFormat, samples: u32) -> Self {
        use wgpu::CompareFunction::{Always, Greater, GreaterEqual, Less};
        let frame_layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("frame"),
            entries: &[uniform(0, false), uniform(1, true)],
        });
        let part_layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("part"),
            entries: &[storage(0), storage(1)],
        });
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("all passes"),
            bind_group_layouts: &[Some(&frame_layout), Some(&part_layout)],
            immediate_size: 0,
        });
        let flat_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("without mesh"),
            bind_group_layouts: &[Some(&frame_layout)],
            immediate_size: 0,
        });
        let depths = texture(0, wgpu::TextureSampleType::Depth, samples > 1);
        let occlusion = texture(1, wgpu::TextureSampleType::Float { filterable: false }, false);
        let depth_layout = device
            .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some("depths"), entries: &[depths] });
        let shadow_layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("occlusion"),
            entries: &[depths, occlusion],
        });
        let whole = Pass {
            name: "",
            shader: "",
            vertex: "vertex",
            fragment: "fragment",
            depth: GreaterEqual,
            solid: false,
            buffers: &[],
        };
        let lines =
            |name, shader, depth| pipeline(device, &layout, (color, samples), &Pass { name, shader, depth, ..whole });
        let flat = |pass: Pass| pipeline(device, &flat_layout, (color, samples), &pass);
        let faces = |name, vertex, buffers| {
            ["fragment", "fragment_with_cut"].map(|fragment| {
                let shader = shaders::FACES;
                flat(Pass { name, shader, vertex, fragment, depth: Greater, solid: true, buffers })
            })
        };
        Self {
            background: flat(Pass { name: "background", shader: shaders::BACKGROUND, depth: Always, ..whole }),
            faces: faces("faces", "vertex", const { &[Some(CORNER)] }),
            tinted_faces: faces("tinted faces", "vertex_with_tint", const { &[Some(CORNER), Some(WORD)] }),
            grid: flat(Pass { name: "grid", shader: shaders::GRID, ..whole }),
            arrows: lines("arrows", shaders::ARROWS, GreaterEqual),
            edges: lines("edges", shaders::EDGES, GreaterEqual),
            vertices: lines("vertices", shaders::VERTICES, GreaterEqual),
            hidden_edges: lines("hidden edges", shaders::EDGES, Less),
            hidden_vertices: lines("hidden vertices", shaders::VERTICES, Less),
            occlusion: over_all(
                device,
                [&frame_layout, &depth_layout],
                &shaders::occlusion(samples),
                OCCLUSION,
                1,
                None,
            ),
            shadow: over_all(
                device,
                [&frame_layout, &shadow_layout],
                &shaders::shadow(samples),
                color,
                samples,
                Some(TIMES),
            ),
            frame_layout,
            part_layout,
            depth_layout,
            shadow_layout,
        }
    }

    /// For faces with or without colours, cut open or whole.
    pub(super) fn faces(&self, tinted: bool, cut: bool) -> &wgpu::RenderPipeline {
        &(if tinted { &self.tinted_faces } else { &self.faces })[usize::from(cut)]
    }

    /// For what lies in front of the faces or, `hidden`, behind them.
    pub(super) fn lines_and_points(&self, hidden: bool) -> (&wgpu::RenderPipeline, &wgpu::RenderPipeline) {
        if hidden { (&self.hidden_edges, &self.hidden_vertices) } else { (&self.edges, &self.vertices) }
    }
}

/// A pass over all pixels without depth.
fn over_all(
    device: &wgpu::Device,
    groups: [&wgpu::BindGroupLayout; 2],
    shader: &str,
    format: wgpu::TextureFormat,
    samples: u32,
    blend: Option<wgpu::BlendState>,
) -> wgpu::RenderPipeline {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("over all"),
        source: wgpu::ShaderSource::Wgsl(shader.into()),
    });
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("over all"),
        bind_group_layouts: &groups.map(Some),
        immediate_size: 0,
    });
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("over all"),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vertex"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: None,
        multisample: wgpu::MultisampleState { count: samples, ..Default::default() },
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("fragment"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(wgpu::ColorTargetState { format, blend, write_mask: wgpu::ColorWrites::ALL })],
        }),
        multiview_mask: None,
        cache: None,
    })
}

fn texture(binding: u32, sample_type: wgpu::TextureSampleType, multisampled: bool) -> wgpu::BindGroupLayoutEntry {
    let ty = wgpu::BindingType::Texture { sample_type, view_dimension: wgpu::TextureViewDimension::D2, multisampled };
    wgpu::BindGroupLayoutEntry { binding, visibility: wgpu::ShaderStages::FRAGMENT, ty, count: None }
}

fn uniform(binding: u32, has_dynamic_offset: bool) -> wgpu::BindGroupLayoutEntry {
    let ty = wgpu::BufferBindingType::Uniform;
    entry(binding, wgpu::ShaderStages::VERTEX_FRAGMENT, ty, has_dynamic_offset)
}

fn storage(binding: u32) -> wgpu::BindGroupLayoutEntry {
    entry(binding, wgpu::ShaderStages::VERTEX, wgpu::BufferBindingType::Storage { read_only: true }, false)
}

fn entry(
    binding: u32,
    visibility: wgpu::ShaderStages,
    ty: wgpu::BufferBindingType,
    has_dynamic_offset: bool,
) -> wgpu::BindGroupLayoutEntry {
    let ty = wgpu::BindingType::Buffer { ty, has_dynamic_offset, min_binding_size: None };
    wgpu::BindGroupLayoutEntry { binding, visibility, ty, count: None }
}

fn pipeline(
    device: &wgpu::Device,
    layout: &wgpu::PipelineLayout,
    (format, samples): (wgpu::TextureFormat, u32),
    pass: &Pass,
) -> wgpu::RenderPipeline {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(pass.name),
        source: wgpu::ShaderSource::Wgsl(pass.shader.into()),
    });
    let over = wgpu::BlendState {
        color: wgpu::BlendComponent {
            src_factor: wgpu::BlendFactor::SrcAlpha,
            dst_factor: wgpu::BlendFactor::OneMinusSrcAlpha,
            operation: wgpu::BlendOperation::Add,
        },
        alpha: wgpu::BlendComponent::OVER,
    };
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(pass.name),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some(pass.vertex),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: pass.buffers,
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(pass.solid),
            depth_compare: Some(pass.depth),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState { count: samples, ..Default::default() },
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some(pass.fragment),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(wgpu::ColorTargetState {
                format,
                blend: if pass.solid { None } else { Some(over) },
                write_mask: wgpu::ColorWrites::ALL,
            })],
        }),
        multiview_mask: None,
        cache: None,
    })
}
