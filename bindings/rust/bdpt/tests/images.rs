// SPDX-License-Identifier: Apache-2.0

//! Display, files, denoising, skies and colours, with what is right and with what is not.

use bdpt::{Chromaticities, Context, Denoise, Display, ErrorCode, Exposure, Exr, Image, Sky};
use std::path::PathBuf;

fn code<T>(result: bdpt::Result<T>) -> ErrorCode {
    result.err().expect("an error").code()
}

/// A path in the folder of this test's own files.
fn path(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name)
}

fn grey(width: u32, height: u32) -> Image {
    Image::from_pixels(width, height, vec![[0.5; 3]; (width * height) as usize]).unwrap()
}

#[test]
fn what_is_no_number_is_displayed_as_zero() {
    let mut image = Image::from_pixels(2, 1, vec![[f32::NAN, f32::INFINITY, -1.0], [0.0; 3]]).unwrap();
    Display::srgb().apply(&mut image).unwrap();
    assert_eq!(image.pixels(), [[0.0, 1.0, 0.0], [0.0; 3]]);
}

#[test]
fn aces_rolls_off() {
    let mut image = grey(1, 1);
    let mut srgb = image.clone();
    Display::aces().exposure(2.0).apply(&mut image).unwrap();
    Display::srgb().exposure(2.0).apply(&mut srgb).unwrap();
    assert_eq!(srgb.pixels()[0], [1.0; 3]);
    assert!(image.pixels()[0][0] > 0.5 && image.pixels()[0][0] < 1.0);
}

#[test]
fn display_refuses_what_it_cannot_do_and_leaves_the_picture() {
    let mut image = grey(2, 2);
    assert_eq!(code(Display::ocio().apply(&mut image)), ErrorCode::InvalidArgument);
    assert_eq!(code(Display::ocio().config("/nowhere/config.ocio").apply(&mut image)), ErrorCode::Io);
    assert_eq!(code(Display::ocio().context(&Context::new().unwrap()).apply(&mut image)), ErrorCode::InvalidArgument);
    assert_eq!(code(Display::ocio().display("a\0b").apply(&mut image)), ErrorCode::InvalidArgument);
    assert_eq!(code(Display::srgb().exposure(f32::NAN).apply(&mut image)), ErrorCode::InvalidArgument);
    assert_eq!(image, grey(2, 2));
}

#[test]
fn an_image_without_pixels_is_refused_by_every_writer() {
    let mut none = Image::new(0, 3).unwrap();
    assert_eq!(code(Display::srgb().apply(&mut none)), ErrorCode::InvalidArgument);
    assert_eq!(code(none.write_png(path("none.png"))), ErrorCode::InvalidArgument);
    assert_eq!(code(Exr::new(&none).write(path("none.exr"))), ErrorCode::InvalidArgument);
    if bdpt::has_denoiser() {
        assert_eq!(code(Denoise::new(&none).run()), ErrorCode::InvalidArgument);
    }
}

#[test]
fn files_that_cannot_be_written() {
    let image = grey(2, 2);
    assert_eq!(code(image.write_png("/nowhere/there.png")), ErrorCode::Io);
    assert_eq!(code(Exr::new(&image).write("/nowhere/there.exr")), ErrorCode::Io);
    assert_eq!(code(image.write_png("a\0b.png")), ErrorCode::InvalidArgument);
    assert_eq!(code(Exr::new(&image).layer("a\0b", &image).write(path("nul.exr"))), ErrorCode::InvalidArgument);
    let bad = Image::from_pixels(1, 1, vec![[f32::NAN; 3]]).unwrap();
    assert_eq!(code(bad.write_png(path("nan.png"))), ErrorCode::InvalidArgument);
}

#[test]
fn layers_are_of_one_size_and_of_different_names() {
    let (image, wider, higher) = (grey(4, 3), grey(5, 3), grey(4, 4));
    let error = Exr::new(&image).layer("wider", &wider).write(path("wider.exr")).err().unwrap();
    assert!(error.text().contains("wider") && error.text().contains("5 x 3"), "{}", error);
    assert_eq!(code(Exr::new(&image).layer("higher", &higher).write(path("higher.exr"))), ErrorCode::InvalidArgument);
    let twice = Exr::new(&image).layer("a", &image).layer("a", &image);
    assert_eq!(code(twice.write(path("twice.exr"))), ErrorCode::InvalidArgument);
}

#[cfg(unix)]
#[test]
fn a_path_need_not_be_unicode() {
    use std::os::unix::ffi::OsStringExt;
    let name = std::ffi::OsString::from_vec(b"bdpt-\xff.png".to_vec());
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    grey(1, 1).write_png(&path).unwrap();
    assert!(std::fs::read(&path).unwrap().starts_with(b"\x89PNG"));
}

#[test]
fn guides_of_a_denoiser_have_the_pictures_size() {
    let (image, other) = (grey(16, 16), grey(16, 15));
    assert_eq!(code(Denoise::new(&image).albedo(&other).run()), ErrorCode::InvalidArgument);
    assert_eq!(code(Denoise::new(&image).albedo(&image).normal(&other).run()), ErrorCode::InvalidArgument);
    let without_albedo = code(Denoise::new(&image).normal(&image).run());
    assert!(without_albedo == ErrorCode::InvalidArgument || !bdpt::has_denoiser());
}

#[test]
fn skies_out_of_range() {
    let sky = Sky::new([0.0, 1.0, 0.0]);
    assert_eq!(code(sky.fill(0, 4)), ErrorCode::InvalidArgument);
    assert_eq!(code(sky.turbidity(1.0).fill(4, 4)), ErrorCode::InvalidArgument);
    assert_eq!(code(sky.ground([-1.0, 0.0, 0.0]).fill(4, 4)), ErrorCode::InvalidArgument);
    assert_eq!(code(Sky::new([0.0; 3]).fill(4, 4)), ErrorCode::InvalidArgument);
    assert_eq!(code(Sky::new([0.0, -1.0, 0.0]).fill(4, 4)), ErrorCode::InvalidArgument);
    assert_eq!(sky.fill(8, 4).unwrap().pixels().len(), 32);
}

#[test]
fn exposures_out_of_range() {
    assert_eq!(code(Exposure::camera(0.0, 8.0).stops()), ErrorCode::InvalidArgument);
    assert_eq!(code(Exposure::camera(0.01, f32::NAN).stops()), ErrorCode::InvalidArgument);
    assert_eq!(code(Exposure::ev100(100.0).stops()), ErrorCode::InvalidArgument);
    assert_eq!(code(Exposure::ev100(10.0).iso(200.0).stops()), ErrorCode::InvalidArgument);
}

#[test]
fn colours_that_have_no_space() {
    let context = Context::new().unwrap();
    let mut colors = [[0.1, 0.2, 0.3]; 2];
    assert_eq!(code(context.convert_colors(Some("no such space"), None, &mut colors)), ErrorCode::InvalidArgument);
    assert_eq!(code(context.convert_colors(None, Some("a\0b"), &mut colors)), ErrorCode::InvalidArgument);
    assert_eq!(colors, [[0.1, 0.2, 0.3]; 2]);
    context.convert_colors(None, Some("ACEScg"), &mut []).unwrap();
    let line = Chromaticities { green: [0.64, 0.33], ..Chromaticities::REC709 };
    assert_eq!(code(line.convert(&Chromaticities::REC709, &mut colors)), ErrorCode::InvalidArgument);
    assert_eq!(code(line.convert(&Chromaticities::REC709, &mut [])), ErrorCode::InvalidArgument);
}

#[test]
fn colours_go_there_and_back() {
    let context = Context::new().unwrap();
    let mut colors = [[0.1, 0.2, 0.3], [1.0, 1.0, 1.0]];
    context.convert_colors(None, Some("ACEScg"), &mut colors).unwrap();
    // Rec. 709's primaries lie inside of ACEScg's: colours are less saturated there.
    assert!(colors[0][0] > 0.11 && colors[0][2] < 0.3);
    assert!(colors[1].iter().all(|white| (white - 1.0).abs() < 1e-5)); // white is white in all
    context.convert_colors(Some("ACEScg"), None, &mut colors).unwrap();
    for (c, expected) in [0.1, 0.2, 0.3].into_iter().enumerate() {
        assert!((colors[0][c] - expected).abs() < 1e-5);
    }
}
