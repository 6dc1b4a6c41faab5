// SPDX-License-Identifier: Apache-2.0

//! Work on the buffers of lightmaps: gutters, seams, coordinates, encodings.

use bdpt::{
    encode_half, encode_rgbd, encode_rgbm, AtlasImage, Coefficients, Dilate, ErrorCode, FixSeams, Sh, Transform,
    UvCheck, UvInstance,
};

fn code<T>(result: bdpt::Result<T>) -> ErrorCode {
    result.err().expect("an error").code()
}

const POSITIONS: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
const UV: [[f32; 2]; 4] = [[0.1, 0.1], [0.9, 0.1], [0.9, 0.9], [0.1, 0.9]];
const SMALL: [[u16; 3]; 2] = [[0, 1, 2], [0, 2, 3]];
const LARGE: [[u32; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

fn square() -> UvInstance<'static> {
    UvInstance::new(&POSITIONS, &UV).triangles(&LARGE)
}

#[test]
fn buffers_that_are_too_small_are_refused_and_stay() {
    let (mut pixels, mut mask) = ([1.0; 3 * 8], [1; 8]);
    assert_eq!(code(Dilate::new(3, 3, 3).run(&mut pixels, &mut mask)), ErrorCode::InvalidArgument);
    assert_eq!(code(Dilate::new(4, 2, 4).run(&mut pixels, &mut mask)), ErrorCode::InvalidArgument);
    assert_eq!(code(Dilate::new(4, 2, 3).run(&mut pixels, &mut mask[..7])), ErrorCode::InvalidArgument);
    assert_eq!(
        code(Dilate::new(4, 2, 3).run_in_charts(&mut pixels, &mut mask, &mut [0; 7])),
        ErrorCode::InvalidArgument
    );
    assert_eq!(code(Dilate::new(0, 2, 3).run(&mut pixels, &mut mask)), ErrorCode::InvalidArgument);
    assert_eq!(code(Dilate::new(u32::MAX, u32::MAX, u32::MAX).run(&mut [], &mut [])), ErrorCode::InvalidArgument);
    assert_eq!((pixels, mask), ([1.0; 24], [1; 8]));

    fn atlas(pixels: &mut [f32]) -> AtlasImage<'_> {
        AtlasImage::new(8, 8, pixels)
    }
    let instances = [square()];
    let (mut short, mut full) = (vec![0.0; 63], vec![0.0; 64]);
    assert_eq!(code(FixSeams::new(1).run(&instances, &mut [atlas(&mut short)])), ErrorCode::InvalidArgument);
    assert_eq!(
        code(FixSeams::new(1).run(&instances, &mut [atlas(&mut full).mask(&[1; 63])])),
        ErrorCode::InvalidArgument
    );
    assert_eq!(code(FixSeams::new(1).run(&instances, &mut [])), ErrorCode::InvalidArgument);
    assert_eq!(code(FixSeams::new(1).run(&[], &mut [atlas(&mut full)])), ErrorCode::InvalidArgument);
    let elsewhere = [square().atlas(1)];
    assert_eq!(code(FixSeams::new(1).run(&elsewhere, &mut [atlas(&mut full)])), ErrorCode::InvalidArgument);
}

#[test]
fn values_spread_within_their_chart() {
    let (mut pixels, mut mask, mut charts) = ([1.0, 0.0, 0.0, 9.0], [1, 0, 0, 1], [1, 1, 2, 2]);
    let report = Dilate::new(4, 1, 1).run_in_charts(&mut pixels, &mut mask, &mut charts).unwrap();
    assert_eq!((pixels, report.filled), ([1.0, 1.0, 9.0, 9.0], 2));
}

#[test]
fn values_that_are_not_finite_are_counted_and_replaced() {
    let (mut pixels, mut mask) = ([f32::NAN, 2.0], [1, 1]);
    let report = Dilate::new(2, 1, 1).run(&mut pixels, &mut mask).unwrap();
    assert_eq!((pixels, mask, report.not_finite), ([2.0, 2.0], [1, 1], 1));
}

#[test]
fn indices_of_both_sizes_and_none_are_the_same_mesh() {
    let in_order = [0, 1, 2, 0, 2, 3];
    let (positions, uv) = (in_order.map(|i: usize| POSITIONS[i]), in_order.map(|i: usize| UV[i]));
    let check = UvCheck::new(32, 32);
    let large = check.run(&[square()]).unwrap();
    assert_eq!(check.run(&[UvInstance::new(&POSITIONS, &UV).small_triangles(&SMALL)]).unwrap(), large);
    assert_eq!(check.run(&[UvInstance::new(&positions, &uv)]).unwrap(), large);
    assert_eq!((large.triangles, large.charts, large.padding), (2, 1, None));
}

#[test]
fn maps_tell_where_charts_overlap() {
    let (report, maps) = UvCheck::new(16, 16).run_with_maps(&[square(), square().atlas(0)]).unwrap();
    assert!(report.overlaps_between >= 2 && report.padding == Some(0));
    // Two squares in the same place of the world and of the atlas are of two instances, and so of two charts.
    assert_eq!(maps.triangle_charts, [1, 1, 2, 2]);
    assert_eq!((maps.texel_charts.len(), maps.texel_claims[8 * 16 + 8], maps.texel_claims[0]), (256, 2, 0));
    assert!(maps.texel_overlaps[8 * 16 + 8] >= 1);
}

#[test]
fn instances_of_other_atlases_are_passed_over() {
    let (report, maps) = UvCheck::new(16, 16).atlas(1).run_with_maps(&[square(), square().atlas(1)]).unwrap();
    assert_eq!((report.triangles, report.charts), (2, 1));
    assert_eq!(maps.triangle_charts, [0, 0, 1, 1]);
}

#[test]
fn coordinates_that_cannot_be_looked_at() {
    let check = UvCheck::new(16, 16);
    assert_eq!(code(check.run(&[])), ErrorCode::InvalidArgument);
    assert_eq!(code(check.run(&[UvInstance::new(&POSITIONS, &UV[..3]).triangles(&LARGE)])), ErrorCode::InvalidArgument);
    assert_eq!(
        code(check.run(&[UvInstance::new(&POSITIONS, &UV).triangles(&[[0, 1, 4]])])),
        ErrorCode::InvalidArgument
    );
    assert_eq!(
        code(check.run(&[UvInstance::new(&POSITIONS, &UV).small_triangles(&[[9; 3]])])),
        ErrorCode::InvalidArgument
    );
    assert_eq!(code(check.run(&[square().normals(&POSITIONS[..1])])), ErrorCode::InvalidArgument);
    assert_eq!(code(check.run(&[square().transform(Transform::from_rows([1.0; 12]))])), ErrorCode::InvalidArgument);
    assert_eq!(code(check.run(&[UvInstance::new(&[], &[])])), ErrorCode::InvalidArgument);
    for size in [(0, 16), (16, 0), (1 << 17, 1), (1 << 15, 1 << 15), (u32::MAX, u32::MAX)] {
        assert_eq!(code(UvCheck::new(size.0, size.1).run_with_maps(&[square()])), ErrorCode::InvalidArgument);
    }
    assert_eq!(code(check.padding_reach(2000).run(&[square()])), ErrorCode::InvalidArgument);
}

#[test]
fn seams_that_need_no_work_leave_the_bits() {
    let mut texels: Vec<f32> = (0..256).map(|i| i as f32).collect();
    let before = texels.clone();
    let report = FixSeams::new(1).run(&[square()], &mut [AtlasImage::new(16, 16, &mut texels)]).unwrap();
    assert_eq!((report.seams, report.error_before, texels), (0, 0.0, before));
}

#[test]
fn a_crease_is_no_seam() {
    // Two triangles at right angles, which share an edge along y in the world, and none in the atlas.
    let positions =
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]];
    let uv = [[0.4, 0.1], [0.05, 0.1], [0.4, 0.9], [0.6, 0.1], [0.6, 0.9], [0.95, 0.1]];
    let run = |angle| {
        let mut texels = vec![1.0; 256];
        let mut images = [AtlasImage::new(16, 16, &mut texels)];
        FixSeams::new(1).angle(angle).run(&[UvInstance::new(&positions, &uv)], &mut images).unwrap().seams
    };
    assert_eq!((run(15.0), run(180.0)), (0, 1));
}

#[test]
fn halves_are_whole_texels() {
    assert_eq!(code(encode_half(&[1.0; 4], 3)), ErrorCode::InvalidArgument);
    assert_eq!(code(encode_half(&[1.0; 4], 0)), ErrorCode::InvalidArgument);
    assert_eq!(code(encode_half(&[], 3)), ErrorCode::InvalidArgument);
    let encoded = encode_half(&[f32::NAN, 1.0, 1.0, 1.0], 2).unwrap();
    assert_eq!((encoded.texels, encoded.not_finite), (vec![0, 0, 0x3c00, 0x3c00], 1));
}

#[test]
fn ranges_of_colours() {
    assert_eq!(code(encode_rgbm(&[[1.0; 3]], -1.0)), ErrorCode::InvalidArgument);
    assert_eq!(code(encode_rgbd(&[[1.0; 3]], f32::NAN)), ErrorCode::InvalidArgument);
    assert_eq!(code(encode_rgbm(&[], 8.0)), ErrorCode::InvalidArgument);
    let encoded = encode_rgbm(&[[9.0, 0.0, 0.0], [8.0, 0.0, 0.0]], 8.0).unwrap();
    assert_eq!((encoded.texels[0], encoded.texels[1], encoded.clipped), ([255, 0, 0, 255], [255, 0, 0, 255], 1));
}

#[test]
fn packed_coefficients_and_planes_are_the_same() {
    let (texels, count) = (5, 9);
    let value = |texel: usize, lm: usize| [0, 1, 2].map(|c| ((texel * 31 + lm * 7 + c) % 13) as f32 / 13.0);
    let packed: Vec<_> = (0..texels).flat_map(|t| (0..count).map(move |lm| value(t, lm))).collect();
    let planes: Vec<_> = (0..count).flat_map(|lm| (0..texels).map(move |t| value(t, lm))).collect();
    let packed = Coefficients::packed(Sh::Radiance, &packed, count).unwrap();
    let planes = Coefficients::planes(Sh::Radiance, &planes, count).unwrap();
    assert_eq!(packed.encode_h6().unwrap(), planes.encode_h6().unwrap());
    assert_eq!(packed.encode_h4().unwrap(), planes.encode_h4().unwrap());
    assert_eq!(packed.encode_dominant().unwrap(), planes.encode_dominant().unwrap());
    assert_eq!(packed.encode_mono_sh().unwrap(), planes.encode_mono_sh().unwrap());
    assert_eq!(packed.encode_h6().unwrap().texels.len(), texels);
}

#[test]
fn too_few_coefficients() {
    let four = [[1.0; 3]; 8];
    let coefficients = Coefficients::packed(Sh::Irradiance, &four, 4).unwrap();
    assert_eq!(coefficients.encode_mono_sh().unwrap().texels.len(), 2);
    assert_eq!(code(coefficients.encode_h4()), ErrorCode::InvalidArgument);
    assert_eq!(code(coefficients.encode_h6()), ErrorCode::InvalidArgument);
    assert_eq!(code(Coefficients::packed(Sh::Irradiance, &four, 9)), ErrorCode::InvalidArgument);
    assert_eq!(code(Coefficients::planes(Sh::Irradiance, &four, 0)), ErrorCode::InvalidArgument);
    let one = Coefficients::packed(Sh::Irradiance, &four, 1).unwrap();
    assert_eq!(code(one.encode_dominant()), ErrorCode::InvalidArgument);
}
