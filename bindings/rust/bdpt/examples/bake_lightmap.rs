// SPDX-License-Identifier: Apache-2.0

//! A lightmap of a floor and a wall under a glass ball: its caustic, soft shadow and bounced light, as lightmap.exr with
//! one layer for each plane, and lightmap.png. Floor and wall share an atlas. The first argument is the folder to write
//! to, the second the number of passes.

use bdpt::*;
use std::path::Path;

pub const SIDE: u32 = 256; // texels of the atlas

/// A unit square in the xz plane round the origin, whose front looks up.
fn square() -> Mesh {
    let corners = vec![[-0.5, 0.0, 0.5], [0.5, 0.0, 0.5], [0.5, 0.0, -0.5], [-0.5, 0.0, -0.5]];
    let uv = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    Mesh::new(corners).indices(vec![[0_u16, 1, 2], [0, 2, 3]]).lightmap_uv(uv).label("square")
}

/// Bakes so many passes and writes the files; gives the planes, and the texels' area in the world.
pub fn bake(folder: &Path, passes: u64) -> Result<(Vec<Image>, LightmapTexels)> {
    let context = Context::new()?;
    let mut builder = Builder::new(&context)?;
    let square = builder.add_mesh(square())?;
    let ball = builder.add_sphere(Sphere::new([0.0, 0.75, 0.0], 0.5))?;
    let grey = builder.add_material(Material::diffuse([0.7; 3]))?;
    let glass = builder.add_material(Material::dielectric(1.5))?;
    let lamp = builder.add_material(Material::diffuse([0.0; 3]).emission([150.0; 3]))?;

    let wall_at = Transform::from_rows([3.0, 0.0, 0.0, 0.0, 0.0, 0.0, -3.0, 1.5, 0.0, 1.0, 0.0, -1.5]); // looks along +z
    let lamp_at = Transform::from_rows([0.3, 0.0, 0.0, 0.5, 0.0, -1.0, 0.0, 3.0, 0.0, 0.0, -0.3, 0.5]); // looks down
    let floor_at = Transform::from_rows([3.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 3.0, 0.0]);
    let floor = builder.add_instance(&Instance::new(square, grey).transform(floor_at))?;
    let wall = builder.add_instance(&Instance::new(square, grey).transform(wall_at))?;
    builder.add_instance(&Instance::new(ball, glass))?;
    builder.add_instance(&Instance::new(square, lamp).transform(lamp_at))?;
    let scene = builder.build()?;

    // Three outputs of six planes: all light, indirect light, and spherical harmonics for normal maps.
    let sensor = Lightmap::new(SIDE, SIDE)
        .instance(LightmapInstance::new(floor).rectangle([0.48, 0.96], [0.01, 0.02])) // the left half, with a margin
        .instance(LightmapInstance::new(wall).rectangle([0.48, 0.96], [0.51, 0.02]))
        .output(Output::new(OutputKind::IrradianceOverPi))
        .output(Output::new(OutputKind::IrradianceOverPi).paths(LightPaths::Indirect))
        .output(Output::new(OutputKind::IrradianceSh1))
        .create(&scene)?;
    let film = Film::new(&sensor, &FilmOptions::default())?;
    let mut render = Render::new(&scene, &sensor, film, &RenderOptions::default().max_edges(6))?;
    render.advance(Advance::passes(passes))?;

    // Each plane, its margins filled, is a layer of the file.
    let texels = sensor.lightmap_texels()?;
    let mut planes = Vec::new();
    for plane in 0..6 {
        let mut image = render.film().read(ReadOptions::new(Layer::Color).plane(plane))?;
        Dilate::new(SIDE, SIDE, 3).run(image.as_floats_mut(), &mut texels.mask())?;
        planes.push(image);
    }
    let names = ["indirect", "sh.00", "sh.1-1", "sh.10", "sh.11"];
    let exr = names.iter().zip(&planes[1..]).fold(Exr::new(&planes[0]), |exr, (name, plane)| exr.layer(*name, plane));
    exr.write(folder.join("lightmap.exr"))?;
    let mut picture = planes[0].clone();
    Display::srgb().apply(&mut picture)?;
    picture.write_png(folder.join("lightmap.png"))?;
    Ok((planes, texels))
}

/// The light that falls on all of the surface, in watts: irradiance is pi times what is in the plane.
pub fn power(plane: &Image, texels: &LightmapTexels) -> f64 {
    let power = |(pixel, area): (&[f32; 3], &f32)| std::f64::consts::PI * f64::from(pixel[1]) * f64::from(*area);
    plane.pixels().iter().zip(&texels.area).map(power).sum()
}

fn main() -> std::result::Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let folder = arguments.next().unwrap_or_else(|| ".".to_string());
    let passes = arguments.next().map_or(Ok(32), |text| text.parse())?;
    let (planes, texels) = bake(Path::new(&folder), passes)?;
    let (all, indirect) = (power(&planes[0], &texels), power(&planes[1], &texels));
    println!("floor and wall receive {all:.2} W, {indirect:.2} W of it indirectly");
    Ok(())
}
