// SPDX-License-Identifier: Apache-2.0

//! Each kind of fault in the declarations is seen: the comparison with the header can fail.

use systest::names::Names;
use systest::rust::{parse, read_text};
use systest::{compiler, declarations, header, include, mirror};

/// The messages about the declarations with `old` replaced by `new`, of the compiler, and of the comparison of names.
fn with_fault(old: &str, new: &str) -> (String, Vec<String>) {
    let text = read_text(&declarations());
    assert_eq!(text.matches(old).count(), 1, "{:?}", old);
    let found = parse(&text.replace(old, new)).unwrap();
    let messages = compiler::check(&include(), &mirror::write(&found)).err().unwrap_or_default();
    let (ours, theirs) = (Names::from(&found), header::names(&include()).unwrap());
    let names = theirs.without(&ours).into_iter().chain(ours.without(&theirs)).map(String::from).collect();
    (messages, names)
}

#[test]
fn swapped_fields() {
    let fields = "pub layer: bdpt_layer,\n    pub s: u32,\n    pub t: u32,";
    let (messages, _) = with_fault(fields, "pub layer: bdpt_layer,\n    pub t: u32,\n    pub s: u32,");
    assert!(messages.contains("bdpt_read_desc.s: offset"), "{}", messages);
}

#[test]
fn a_missing_field() {
    let (messages, names) = with_fault("    pub lens_radius: f32,\n", "");
    assert!(messages.contains("bdpt_camera_desc.focus_distance: offset"), "{}", messages);
    assert_eq!(names, ["bdpt_camera_desc.lens_radius"]);
}

#[test]
fn a_missing_field_where_padding_hides_it() {
    // reserved2 ends the struct: with or without it the size is the same to who looks at fields alone.
    let (_, names) =
        with_fault("    pub luminance: [f32; 3],\n    pub reserved2: u32,\n", "    pub luminance: [f32; 3],\n");
    assert_eq!(names, ["bdpt_color_info.reserved2"]);
}

#[test]
fn a_field_too_many() {
    let (messages, names) = with_fault("pub lens_radius: f32,", "pub lens_radius: f32,\n    pub lens: f32,");
    assert!(messages.contains("lens"), "{}", messages);
    assert_eq!(names, ["bdpt_camera_desc.lens"]);
}

#[test]
fn a_wrong_type_of_the_same_size() {
    let (messages, _) = with_fault("pub turbidity: f32", "pub turbidity: u32");
    assert!(messages.contains("bdpt_sky_desc.turbidity: type"), "{}", messages);
}

#[test]
fn a_wrong_length_of_an_array() {
    let (messages, _) = with_fault("pub techniques: [u32; 32]", "pub techniques: [u32; 31]");
    assert!(messages.contains("bdpt_render_desc.techniques: type"), "{}", messages);
}

#[test]
fn a_wrong_constant() {
    let (messages, _) = with_fault("BDPT_ERROR_MISMATCH: bdpt_result = -9", "BDPT_ERROR_MISMATCH: bdpt_result = 9");
    assert!(messages.contains("BDPT_ERROR_MISMATCH: value"), "{}", messages);
}

#[test]
fn a_constant_of_another_type() {
    let (messages, _) = with_fault("BDPT_NO_MEASUREMENT: u64 = u64::MAX", "BDPT_NO_MEASUREMENT: i32 = -1");
    assert!(messages.contains("BDPT_NO_MEASUREMENT: type"), "{}", messages);
}

#[test]
fn a_constant_of_another_name() {
    let (_, names) = with_fault("BDPT_WRAP_MIRROR:", "BDPT_WRAP_MIRRORED:");
    assert_eq!(names, ["BDPT_WRAP_MIRROR", "BDPT_WRAP_MIRRORED"]);
}

#[test]
fn a_changed_argument() {
    let (messages, _) =
        with_fault("index: u32, light: *mut bdpt_scene_light", "index: u64, light: *mut bdpt_scene_light");
    assert!(messages.contains("bdpt_scene_get_light: signature"), "{}", messages);
}

#[test]
fn a_pointer_that_is_not_const() {
    let (messages, _) = with_fault("source: *const bdpt_film", "source: *mut bdpt_film");
    assert!(messages.contains("bdpt_film_merge: signature"), "{}", messages);
}

#[test]
fn a_changed_result() {
    let (messages, _) = with_fault("pub fn bdpt_has_denoiser() -> i32;", "pub fn bdpt_has_denoiser() -> u64;");
    assert!(messages.contains("bdpt_has_denoiser: signature"), "{}", messages);
}

#[test]
fn a_changed_callback() {
    let (messages, _) = with_fault("progress: *const bdpt_progress) -> i32", "progress: *const bdpt_progress)");
    assert!(messages.contains("bdpt_progress_fn: type"), "{}", messages);
}

#[test]
fn a_function_left_out() {
    let (_, names) = with_fault("pub fn bdpt_has_denoiser() -> i32;", "");
    assert_eq!(names, ["bdpt_has_denoiser"]);
}

#[test]
fn a_struct_left_out() {
    let text = "#[repr(C)]\n#[derive(Clone, Copy, Debug, Default, PartialEq)]\npub struct bdpt_portal {\n    \
                pub corner: [f32; 3],\n    pub edge_u: [f32; 3],\n    pub edge_v: [f32; 3],\n}";
    let (_, names) = with_fault(text, "");
    let fields = ["bdpt_portal.corner", "bdpt_portal.edge_u", "bdpt_portal.edge_v"];
    assert_eq!(names, [&["bdpt_portal"], &fields[..]].concat());
}

#[test]
fn a_layout_that_is_rusts_own() {
    let text = read_text(&declarations()).replacen("#[repr(C)]\n", "", 2);
    assert!(parse(&text).err().unwrap().contains("is not repr(C)"));
}

#[test]
fn what_is_not_understood() {
    assert!(parse("pub static bdpt_count: u32 = 1;").is_err());
    assert!(parse("pub type bdpt_call = Option<extern fn()>;").is_err());
    assert!(parse("pub struct bdpt_x").is_err());
}
