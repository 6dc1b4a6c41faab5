// SPDX-License-Identifier: Apache-2.0
//! The Cornell box with two balls, as cornell_box.png.
use bdpt::*;
fn main() -> Result<()> {
    let context = Context::new()?;
    let mut builder = Builder::new(&context)?;
    let white = builder.add_material(Material::diffuse([0.73; 3]))?;
    let red = builder.add_material(Material::diffuse([0.65, 0.05, 0.05]))?;
    let green = builder.add_material(Material::diffuse([0.12, 0.45, 0.15]))?;
    let lamp = builder.add_material(Material::diffuse([0.78; 3]).emission([36.0, 30.0, 20.0]))?;
    let mirror = builder.add_material(Material::mirror([0.95; 3]))?;
    let glass = builder.add_material(Material::dielectric(1.5))?;
    let square = Mesh::new([[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0; 3], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
    let (square, ball) = (builder.add_mesh(square)?, builder.add_sphere(Sphere::new([0.0; 3], 1.0))?);
    for (shape, material, x, y, z, at) in [
        (square, white, [2.0, 0.0, 0.0], [0.0, 0.0, -2.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 1.0]), // floor
        (square, white, [2.0, 0.0, 0.0], [0.0, 0.0, 2.0], [0.0, -1.0, 0.0], [-1.0, 2.0, -1.0]), // ceiling
        (square, white, [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 1.0], [-1.0, 0.0, -1.0]), // back wall
        (square, red, [0.0, 0.0, -2.0], [0.0, 2.0, 0.0], [1.0, 0.0, 0.0], [-1.0, 0.0, 1.0]),
        (square, green, [0.0, 0.0, 2.0], [0.0, 2.0, 0.0], [-1.0, 0.0, 0.0], [1.0, 0.0, -1.0]),
        (square, lamp, [0.48, 0.0, 0.0], [0.0, 0.0, 0.4], [0.0, -1.0, 0.0], [-0.24, 1.995, -0.2]),
        (ball, mirror, [0.42, 0.0, 0.0], [0.0, 0.42, 0.0], [0.0, 0.0, 0.42], [-0.43, 0.42, -0.4]),
        (ball, glass, [0.36, 0.0, 0.0], [0.0, 0.36, 0.0], [0.0, 0.0, 0.36], [0.42, 0.36, 0.3]),
    ] {
        builder.add_instance(&Instance::new(shape, material).transform(Transform::from_columns(x, y, z, at)))?;
    }
    let camera = Camera::perspective(256, 256).field_of_view(38.0).transform(Transform::translate([0.0, 1.0, 3.9]));
    let sensor = camera.create(&context)?;
    let film = Film::new(&sensor, &FilmOptions::default())?;
    let mut render = Render::new(&builder.build()?, &sensor, film, &RenderOptions::new())?;
    render.advance(Advance::passes(64))?;
    let mut image = render.film().read(Layer::Color)?;
    Display::aces().apply(&mut image)?;
    image.write_png("cornell_box.png")
}
