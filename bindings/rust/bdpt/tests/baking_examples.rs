// SPDX-License-Identifier: Apache-2.0

//! What two of the examples measure is right.

#[allow(dead_code)]
#[path = "../examples/bake_lightmap.rs"]
mod bake_lightmap;
#[allow(dead_code)]
#[path = "../examples/custom_measurement.rs"]
mod custom_measurement;

use bake_lightmap::{bake, power, SIDE};
use custom_measurement::{measure, AREA};
use std::path::Path;

#[test]
fn a_bake_has_its_caustic_its_shadow_and_its_light() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let (planes, texels) = bake(folder, 4).unwrap();
    // 17.3 W of the lamp's 150 pi 0.09 W fall on floor and wall, 4.1 W of them indirectly.
    let (all, indirect) = (power(&planes[0], &texels), power(&planes[1], &texels));
    assert!((all / 17.31 - 1.0).abs() < 0.02, "{all}");
    assert!((indirect / 4.08 - 1.0).abs() < 0.05, "{indirect}");

    // The mean of 5 x 5 texels.
    let at = |x: u32, y: u32| -> f32 {
        let texel = |i: u32| planes[0].pixel(x + i % 5 - 2, y + i / 5 - 2).unwrap()[1];
        (0..25).map(texel).sum::<f32>() / 25.0
    };
    let (caustic, shadow, open) = (at(57, 113), at(57, 75), at(20, 113));
    assert!(caustic > 3.0 * open && shadow < 0.7 * open && shadow > 0.0, "{caustic} {shadow} {open}");

    // Rows above the charts are margin: nothing is measured there, and they are filled in.
    assert_eq!(texels.coverage[SIDE as usize * 2 + 60], 0.0);
    assert!(planes[0].pixel(60, 2).unwrap()[1] > 0.0);

    assert_eq!(planes.len(), 6);
    assert!(std::fs::read(folder.join("lightmap.png")).unwrap().starts_with(b"\x89PNG"));
    let exr = std::fs::read(folder.join("lightmap.exr")).unwrap();
    for name in ["indirect.R", "sh.00.G", "sh.11.B"] {
        assert!(exr.windows(name.len()).any(|window| window == name.as_bytes()), "{name}");
    }
}

#[test]
fn leaves_receive_what_the_sky_sends() {
    let [falls, taken] = measure(1, 4096).unwrap();
    assert!((falls[0] / (std::f32::consts::PI * AREA) - 1.0).abs() < 1e-3, "{falls:?}");
    // 0.85 (1 - R), R the hemispherical mean of Schlick's reflectance of 0.04: 0.04 + 0.96 / 21.
    let expected = 0.85 * (1.0 - 0.04 - 0.96 / 21.0);
    assert!((taken[0] / falls[0] / expected - 1.0).abs() < 0.01, "{taken:?}");
    // In a plant they shade one another.
    let [falls, taken] = measure(12, 256).unwrap();
    assert_eq!((falls.len(), taken.len()), (12, 12));
    assert!(falls.iter().all(|power| *power > 0.55 && *power < 0.75), "{falls:?}");
}
