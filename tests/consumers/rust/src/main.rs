// The same program by the safe crate.
use bdpt::*;

fn main() -> Result<()> {
    let context = Context::new()?;
    let mut builder = Builder::new(&context)?;
    let (a, b, c, d) = ([-1.0, -1.0, 1.0], [1.0, -1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, -1.0, -1.0]);
    let floor = builder.add_mesh(Mesh::new([a, b, c, a, c, d]))?;
    let grey = builder.add_material(Material::diffuse([0.5; 3]))?;
    builder.add_instance(&Instance::new(floor, grey))?;
    builder.add_light(&Light::point([0.0, 2.0, 0.0], [4.0; 3]))?;
    let sensor = Points::new(&[Point::new([0.0; 3]).normal([0.0, 1.0, 0.0])]).create(&context)?;
    let film = Film::new(&sensor, &FilmOptions::default())?;
    let mut render = Render::new(&builder.build()?, &sensor, film, &RenderOptions::new())?;
    render.advance(Advance::passes(16))?;
    let image = render.film().read(Layer::Color)?;
    println!("irradiance {:.4}", image.pixels()[0][1]); // 4 W/sr from 2 above: 1 W/m²
    Ok(())
}
