//! Every shader is valid WGSL, and says in its header what it computes.

use app::render::shaders;

#[test]
fn every_shader_passes_validation() {
    for (name, source) in shaders::all() {
        let module = naga::front::wgsl::parse_str(&source)
            .unwrap_or_else(|error| panic!("{name}: {}", error.emit_to_string(&source)));
        let mut validator =
            naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::empty());
        validator.validate(&module).unwrap_or_else(|error| panic!("{name}: {}", error.emit_to_string(&source)));
    }
}

#[test]
fn every_file_of_shaders_is_used_and_begins_with_its_mathematics() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../shaders");
    for file in std::fs::read_dir(folder).unwrap() {
        let path = file.unwrap().path();
        let text = std::fs::read_to_string(&path).unwrap();
        assert!(shaders::all().iter().any(|(_, source)| source.contains(&text)), "{} is not used", path.display());
        assert!(text.starts_with("// "), "{} has no header", path.display());
    }
}
