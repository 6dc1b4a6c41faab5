// SPDX-License-Identifier: Apache-2.0

//! Lightmaps, points and vertices: what they measure is right, and what cannot be is refused.

use bdpt::*;
use std::f32::consts::PI;

fn code<T>(result: Result<T>) -> ErrorCode {
    result.err().expect("an error").code()
}

/// A square of side 2 round the origin, whose front looks up; both sets of coordinates cover it.
fn square() -> Mesh {
    let corners = vec![[-1.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 0.0, -1.0], [-1.0, 0.0, -1.0]];
    let uv = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    Mesh::new(corners).indices(vec![[0_u32, 1, 2], [0, 2, 3]]).uv(uv.clone()).lightmap_uv(uv)
}

/// A floor under a sky of radiance 1, seen from above as from below.
struct Open {
    context: Context,
    builder: Builder,
    floor: InstanceId,
    grey: MaterialId,
}

impl Open {
    fn new() -> Self {
        let context = ContextOptions::default().threads(2).create().unwrap();
        let mut builder = Builder::new(&context).unwrap();
        let shape = builder.add_mesh(square()).unwrap();
        let grey = builder.add_material(Material::diffuse([0.5; 3])).unwrap();
        let floor = builder.add_instance(&Instance::new(shape, grey)).unwrap();
        builder.add_light(&Light::environment([1.0; 3])).unwrap();
        Self { context, builder, floor, grey }
    }
    fn scene(&mut self) -> Scene {
        self.builder.build().unwrap()
    }
}

/// What a sensor measures, plane after plane, by path tracing, which has little noise under a sky.
fn measure(scene: &Scene, sensor: &Sensor, passes: u64) -> Vec<Image> {
    let film = Film::new(sensor, &FilmOptions::default()).unwrap();
    let planes = film.info().unwrap().planes;
    let options = RenderOptions::default().techniques(Techniques::PATH_TRACING);
    let mut render = Render::new(scene, sensor, film, &options).unwrap();
    render.advance(Advance::passes(passes)).unwrap();
    (0..planes).map(|plane| render.film().read(ReadOptions::new(Layer::Color).plane(plane)).unwrap()).collect()
}

fn near(value: f32, expected: f32, tolerance: f32) -> bool {
    (value - expected).abs() <= tolerance * expected.abs()
}

#[test]
fn a_lightmap_measures_what_a_sky_sends() {
    let mut open = Open::new();
    let scene = open.scene();
    let map = Lightmap::new(4, 4)
        .instance(open.floor)
        .output(Output::new(OutputKind::Irradiance))
        .output(Output::new(OutputKind::Openness));
    let planes = measure(&scene, &map.create(&scene).unwrap(), 1024);
    assert_eq!(planes.len(), 2);
    for (irradiance, openness) in planes[0].pixels().iter().zip(planes[1].pixels()) {
        // After 1024 passes texels deviate by 0.06 %, root mean square.
        assert!(near(irradiance[0], PI, 0.005) && near(openness[0], 1.0, 1e-5), "{irradiance:?} {openness:?}");
    }
}

#[test]
fn places_in_atlases() {
    let mut open = Open::new();
    let scene = open.scene();
    let left_half = LightmapInstance::new(open.floor).rectangle([0.5, 1.0], [0.0, 0.0]).atlas(1);
    let map = Lightmap::new(8, 4).atlases(2).instance(left_half);
    let sensor = map.create(&scene).unwrap();
    let info = sensor.lightmap_info().unwrap();
    assert_eq!((info.width, info.height, info.texels, info.area), (8, 8, 16, 4.0));
    let texels = sensor.lightmap_texels().unwrap();
    let expected = |i: usize| u8::from(i / 8 >= 4 && i % 8 < 4);
    assert_eq!(texels.mask(), (0..64).map(expected).collect::<Vec<_>>());
    assert!(near(texels.area.iter().sum(), 4.0, 1e-5));
    // By the other set of coordinates, which is the same here.
    let by_uv = LightmapInstance::new(open.floor).by_texture_coordinates(true);
    assert_eq!(Lightmap::new(4, 4).instance(by_uv).create(&scene).unwrap().lightmap_info().unwrap().texels, 16);
}

#[test]
fn the_side_that_receives() {
    let context = Context::new().unwrap();
    let mut builder = Builder::new(&context).unwrap();
    let shape = builder.add_mesh(square()).unwrap();
    let grey = builder.add_material(Material::diffuse([0.5; 3])).unwrap();
    let floor = builder.add_instance(&Instance::new(shape, grey)).unwrap();
    builder.add_light(&Light::directional([0.0, -1.0, 0.0], [2.0; 3])).unwrap();
    let scene = builder.build().unwrap();
    let of = |flip| {
        let sensor = Lightmap::new(2, 2).instance(LightmapInstance::new(floor).flip(flip)).create(&scene).unwrap();
        measure(&scene, &sensor, 1)[0].pixels()[0][0]
    };
    assert_eq!((of(false), of(true)), (2.0, 0.0));
    let front = Vertices::new().instance(floor).create(&scene).unwrap();
    let back = Vertices::new().back_of(floor).create(&scene).unwrap();
    assert!(near(measure(&scene, &front, 1)[0].pixels()[0][0], 2.0, 1e-5));
    assert_eq!(measure(&scene, &back, 1)[0].pixels()[0][0], 0.0);
}

#[test]
fn bands_have_the_bits_of_the_whole() {
    let mut open = Open::new();
    let scene = open.scene();
    let map = Lightmap::new(4, 8).instance(open.floor);
    let options = RenderOptions::default().techniques(Techniques::PATH_TRACING);
    let bake = |map: &Lightmap| {
        let sensor = map.create(&scene).unwrap();
        let film = Film::new(&sensor, &FilmOptions::default()).unwrap();
        let mut render = Render::new(&scene, &sensor, film, &options).unwrap();
        render.advance(Advance::passes(4)).unwrap();
        render.film().read(Layer::Color).unwrap()
    };
    let whole = bake(&map);
    let band = bake(&map.clone().rect(Rect::new(0, 2, 4, 5)).film_of_rect(true));
    assert_eq!((band.width(), band.height()), (4, 3));
    assert_eq!(band.pixels(), &whole.pixels()[8..20]);
}

#[test]
fn memory_is_told_beforehand() {
    let mut open = Open::new();
    let scene = open.scene();
    let map = Lightmap::new(64, 64).instance(open.floor);
    let options = FilmOptions::default();
    let all = map.estimate(&scene, &options, u64::MAX).unwrap();
    assert_eq!(all.band_rows, 64);
    assert_eq!(all.total, all.sensor + all.film + all.render);
    let half = map.estimate(&scene, &options, all.total / 2).unwrap().band_rows;
    assert!(half > 0 && half < 64, "{half}");
    assert_eq!(map.estimate(&scene, &options, 1).unwrap().band_rows, 0);
    let film = Film::estimate(&map.create(&scene).unwrap(), &options).unwrap();
    assert_eq!((film.sensor, film.film), (0, all.film));
}

#[test]
fn what_is_buried_is_not_measured() {
    let mut open = Open::new();
    // A closed box over a quarter of the floor, which runs on under it.
    let corner = |i: u32| [i & 1, i >> 1 & 1, i >> 2 & 1].map(|bit| bit as f32);
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles: Vec<[u32; 3]> = faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    let shape = open.builder.add_mesh(Mesh::new((0..8).map(corner).collect::<Vec<_>>()).indices(triangles)).unwrap();
    let solid = open.builder.add_material(Material::diffuse([0.5; 3]).one_sided(true)).unwrap();
    let at = Transform::translate([0.0, -0.5, 0.0]);
    open.builder.add_instance(&Instance::new(shape, solid).transform(at)).unwrap();
    let scene = open.scene();
    let map = Lightmap::new(8, 8).instance(open.floor).buried_rays(16);
    let sensor = map.create(&scene).unwrap();
    let info = sensor.lightmap_info().unwrap();
    assert_eq!((info.texels_buried, info.texels), (16, 48));
    assert!((info.area_buried - 1.0).abs() < 1e-5);
    let buried: f32 = sensor.lightmap_buried().unwrap().iter().sum();
    assert!(near(buried, 16.0, 1e-5));
    let without = Lightmap::new(8, 8).instance(open.floor).create(&scene).unwrap();
    assert!(without.lightmap_buried().unwrap().iter().all(|part| *part == 0.0));

    let token = CancelToken::new().unwrap();
    token.cancel();
    assert_eq!(code(map.clone().cancel(&token).create(&scene)), ErrorCode::Cancelled);
    token.reset();
    map.cancel(&token).create(&scene).unwrap();
}

#[test]
fn lightmaps_that_cannot_be() {
    let mut open = Open::new();
    let bare = open.builder.add_mesh(Mesh::new(vec![[0.0, 5.0, 0.0], [1.0, 5.0, 0.0], [0.0, 6.0, 0.0]])).unwrap();
    let bare = open.builder.add_instance(&Instance::new(bare, open.grey)).unwrap();
    let ball = open.builder.add_sphere(Sphere::new([9.0, 0.0, 0.0], 1.0)).unwrap();
    let ball = open.builder.add_instance(&Instance::new(ball, open.grey)).unwrap();
    let scene = open.scene();
    let create = |map: Lightmap| code(map.create(&scene));
    let floor = Lightmap::new(4, 4).instance(open.floor);
    assert_eq!(create(Lightmap::new(4, 4)), ErrorCode::InvalidArgument);
    assert_eq!(create(Lightmap::new(0, 4).instance(open.floor)), ErrorCode::InvalidArgument);
    assert_eq!(create(Lightmap::new(u32::MAX, 4).instance(open.floor)), ErrorCode::InvalidArgument);
    assert_eq!(create(floor.clone().instance(open.floor)), ErrorCode::InvalidArgument);
    assert_eq!(create(Lightmap::new(4, 4).instance(bare)), ErrorCode::InvalidArgument);
    assert_eq!(create(Lightmap::new(4, 4).instance(ball)), ErrorCode::InvalidArgument);
    assert_eq!(create(floor.clone().output(Output::new(OutputKind::Albedo))), ErrorCode::InvalidArgument);
    assert_eq!(create(floor.clone().output(Output::new(OutputKind::Other(999)))), ErrorCode::InvalidArgument);
    assert_eq!(create(floor.clone().rect(Rect::new(3, 3, 2, 2))), ErrorCode::InvalidArgument);
    assert_eq!(create(floor.clone().backface_tolerance(f32::NAN).buried_rays(4)), ErrorCode::InvalidArgument);
    let elsewhere = LightmapInstance::new(open.floor).rectangle([0.1, 0.1], [5.0, 5.0]);
    assert_eq!(create(Lightmap::new(4, 4).instance(elsewhere)), ErrorCode::InvalidArgument);
    let other_atlas = LightmapInstance::new(open.floor).atlas(1);
    assert_eq!(create(Lightmap::new(4, 4).instance(other_atlas)), ErrorCode::InvalidArgument);
    assert_eq!(code(Lightmap::new(4, 4).estimate(&scene, &FilmOptions::default(), 0)), ErrorCode::InvalidArgument);

    open.builder.remove_instance(ball).unwrap();
    let after = open.scene();
    assert_eq!(code(Lightmap::new(4, 4).instance(ball).create(&after)), ErrorCode::InvalidId);
    assert_eq!(code(Vertices::new().instance(ball).create(&after)), ErrorCode::InvalidId);
}

#[test]
fn other_sensors_are_no_lightmaps() {
    let mut open = Open::new();
    let scene = open.scene();
    let point = Points::new(&[Point::new([0.0; 3])]).create(&open.context).unwrap();
    let map = Lightmap::new(4, 4).instance(open.floor).create(&scene).unwrap();
    assert_eq!(code(point.lightmap_info()), ErrorCode::InvalidArgument);
    assert_eq!(code(point.lightmap_texels()), ErrorCode::InvalidArgument);
    assert_eq!(code(point.lightmap_buried()), ErrorCode::InvalidArgument);
    assert_eq!(code(map.vertex_areas(&mut [0.0; 16])), ErrorCode::InvalidArgument);
    assert_eq!(code(map.solve_vertices(&mut [[0.0; 3]; 16])), ErrorCode::InvalidArgument);
}

#[test]
fn points_measure_what_a_sky_sends() {
    let mut open = Open::new();
    let scene = open.scene();
    let up = [0.0, 3.0, 0.0];
    let high = Point::new([0.0, 1000.0, 0.0]);
    let facing = [high.normal(up), high.normal(up).radius(0.1), high.normal(up).cone(60.0)];
    let sensor = Points::new(&facing).create(&open.context).unwrap();
    let measured = measure(&scene, &sensor, 256);
    for (pixel, expected) in measured[0].pixels().iter().zip([PI, PI, 0.75 * PI]) {
        assert!(near(pixel[1], expected, 0.05), "{pixel:?} {expected}");
    }
    let everywhere = [high, high.radius(1.0)];
    let sensor = Points::new(&everywhere).output(Output::new(OutputKind::Fluence)).create(&open.context).unwrap();
    for pixel in &measure(&scene, &sensor, 64)[0].pixels()[..2] {
        assert!(near(pixel[1], 4.0 * PI, 0.05), "{pixel:?}");
    }
}

#[test]
fn points_that_cannot_be() {
    let context = Context::new().unwrap();
    let create = |point: Point| code(Points::new(&[point]).create(&context));
    let point = Point::new([0.0; 3]);
    assert_eq!(code(Points::new(&[]).create(&context)), ErrorCode::InvalidArgument);
    assert_eq!(create(Point::new([f32::NAN, 0.0, 0.0])), ErrorCode::InvalidArgument);
    assert_eq!(create(point.radius(-1.0)), ErrorCode::InvalidArgument);
    assert_eq!(create(point.cone(30.0)), ErrorCode::InvalidArgument);
    assert_eq!(create(point.normal([0.0, 1.0, 0.0]).cone(91.0)), ErrorCode::InvalidArgument);
    let irradiance = Output::new(OutputKind::Irradiance);
    assert_eq!(code(Points::new(&[point]).output(irradiance).create(&context)), ErrorCode::InvalidArgument);
    assert_eq!(code(Points::new(&[point]).offset(f32::NAN).create(&context)), ErrorCode::InvalidArgument);
}

#[test]
fn vertices_measure_and_are_solved() {
    let mut open = Open::new();
    let scene = open.scene();
    let sensor = Vertices::new().instance(open.floor).geometric_normals(true).create(&scene).unwrap();
    let mut areas = [0.0; 4];
    sensor.vertex_areas(&mut areas).unwrap();
    // A third of each triangle's area, 2, to each of its corners.
    for (area, expected) in areas.iter().zip([4.0, 2.0, 4.0, 2.0].map(|thirds| thirds / 3.0)) {
        assert!(near(*area, expected, 1e-5), "{areas:?}");
    }
    let image = &measure(&scene, &sensor, 128)[0];
    let mut values = image.pixels()[..4].to_vec();
    sensor.solve_vertices(&mut values).unwrap();
    for value in &values {
        assert!(near(value[2], PI, 0.05), "{values:?}");
    }
    // Means of a constant are this constant, and so is what they are solved to.
    let mut constant = [[0.25, 0.5, 1.0]; 4];
    sensor.solve_vertices(&mut constant).unwrap();
    assert!(constant.iter().all(|value| near(value[0], 0.25, 1e-5) && near(value[2], 1.0, 1e-5)));

    assert_eq!(code(sensor.vertex_areas(&mut areas[..3])), ErrorCode::InvalidArgument);
    assert_eq!(code(sensor.solve_vertices(&mut values[..3])), ErrorCode::InvalidArgument);
    assert_eq!(code(sensor.solve_vertices(&mut [[f32::NAN; 3]; 4])), ErrorCode::InvalidArgument);
    assert_eq!(code(Vertices::new().create(&scene)), ErrorCode::InvalidArgument);
    assert_eq!(
        code(Vertices::new().instance(open.floor).instance(open.floor).create(&scene)),
        ErrorCode::InvalidArgument
    );
}

#[test]
fn a_sensor_of_a_scene_renders_with_this_scene_only() {
    let mut open = Open::new();
    let scene = open.scene();
    open.builder.add_light(&Light::point([0.0, 1.0, 0.0], [1.0; 3])).unwrap();
    let other = open.scene();
    let sensor = Lightmap::new(4, 4).instance(open.floor).create(&scene).unwrap();
    let film = Film::new(&sensor, &FilmOptions::default()).unwrap();
    let refused = Render::new(&other, &sensor, film, &RenderOptions::default()).err().unwrap();
    let film = refused.into_film();
    // It keeps the scene alive: nothing else does.
    drop((scene, open));
    assert_eq!(sensor.lightmap_info().unwrap().texels, 16);
    drop(sensor);
    assert_eq!(film.info().unwrap().passes, 0);
}
