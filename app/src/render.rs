//! Scenes to pictures with wgpu, for the window and headless alike. Knows no egui.
