// SPDX-License-Identifier: Apache-2.0
//! What safe code can do wrong.

mod common;
use bdpt::*;
use common::*;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU32, Ordering};

/// Whatever a function makes of the bodies.
struct Odd<F>(u32, F);
impl<F: Fn(u32, &(dyn Fn(u32) + Sync)) + Send + Sync> Executor for Odd<F> {
    fn worker_count(&self) -> u32 {
        self.0
    }
    fn run(&self, n: u32, body: &(dyn Fn(u32) + Sync)) {
        (self.1)(n, body);
    }
}

#[test]
fn an_executor_may_do_as_it_likes() {
    type Run = fn(u32, &(dyn Fn(u32) + Sync));
    let odd: [(&str, Run); 8] = [
        ("nothing", |_, _| {}),
        ("backwards", |n, body| (0..n).rev().for_each(body)),
        ("twice", |n, body| (0..n).chain(0..n).for_each(body)),
        ("half", |n, body| (0..n / 2).for_each(body)),
        ("beyond", |n, body| [n, n + 1, u32::MAX, n / 2].into_iter().chain(0..n).for_each(body)),
        ("inside of each other", |n, body| (0..n).for_each(|i| std::thread::scope(|s| drop(s.spawn(|| body(i)))))),
        ("all at once, twice", |n, body| {
            std::thread::scope(|scope| {
                for i in (0..n.min(8)).chain(0..n.min(8)) {
                    scope.spawn(move || body(i));
                }
            })
        }),
        ("the last only", |n, body| body(n.wrapping_sub(1))),
    ];
    let reference = reference(3);
    for (name, run) in odd {
        for plan in ["one-to-one", "pooled", "matrix"] {
            let context = ContextOptions::default().executor(Odd(1, run)).create().unwrap();
            let scene = scene(&context).unwrap();
            if plan == "one-to-one" {
                let mut render = render_of(&scene).unwrap();
                render.advance(Advance::passes(3)).unwrap();
                assert!(bits(render.film()) == reference, "{name}");
                continue;
            }
            let sensor = camera().create(&context).unwrap();
            let film = Film::new(&sensor, &FilmOptions::default()).unwrap();
            let mut render = Render::new(&scene, &sensor, film, &RenderOptions::new().plan(plan)).unwrap();
            assert_eq!(render.advance(Advance::passes(8)).unwrap().passes, 8, "{name} {plan}");
        }
    }
}

#[test]
fn a_body_may_render_itself() {
    static DEPTH: AtomicU32 = AtomicU32::new(0);
    let inner = Odd(1, |n: u32, body: &(dyn Fn(u32) + Sync)| {
        if DEPTH.fetch_add(1, Ordering::SeqCst) == 0 {
            render(&threads(1)).unwrap().advance(Advance::passes(1)).unwrap();
        }
        (0..n).for_each(body);
    });
    let context = ContextOptions::default().executor(inner).create().unwrap();
    let mut render = render(&context).unwrap();
    render.advance(Advance::passes(2)).unwrap();
    assert!(DEPTH.load(Ordering::SeqCst) > 0);
    assert!(bits(render.film()) == reference(2));
}

#[test]
fn callbacks_read_the_film_and_ask_for_statistics() {
    let mut render = render(&threads(2)).unwrap();
    let mut other = Film::new(&camera().create(render.scene().context()).unwrap(), &FilmOptions::default()).unwrap();
    let path = std::env::temp_dir().join(format!("bdpt-misuse-{}.film", std::process::id()));
    let mut calls = 0;
    let report = render.advance(Advance::passes(4).progress(|now| {
        calls += 1;
        now.film.read(Layer::Color).unwrap();
        now.film.read(ReadOptions::new(Layer::Variance).include_partial(true)).unwrap();
        now.film.info().unwrap();
        now.film.save(&path).unwrap();
        now.stats().unwrap();
        now.technique_stats(1, 2).unwrap();
        assert_eq!(code(now.technique_stats(0, 1)), ErrorCode::InvalidArgument);
        assert_eq!(code(other.merge(now.film)), ErrorCode::Reentrant);
    }));
    assert_eq!(report.unwrap().passes, 4);
    assert!(calls >= 2);
    std::fs::remove_file(path).unwrap();
    assert!(bits(render.film()) == reference(4));
}

#[test]
fn a_builder_goes_on_after_a_build_that_failed() {
    let mut builder = Builder::new(&threads(1)).unwrap();
    assert_eq!(code(builder.build()), ErrorCode::InvalidArgument);
    let floor = builder.add_material(Material::diffuse([0.7; 3])).unwrap();
    fill(&mut builder, floor).unwrap();
    let token = CancelToken::new().unwrap();
    token.cancel();
    assert_eq!(code(builder.build_with(BuildOptions::new().cancel(&token))), ErrorCode::Cancelled);
    let stop = BuildOptions::new().progress(|_| ControlFlow::Break(()));
    assert_eq!(code(builder.build_with(stop)), ErrorCode::CallbackFailed);
    token.reset();
    let scene = builder.build_with(BuildOptions::new().cancel(&token)).unwrap();
    let mut render = render_of(&scene).unwrap();
    render.advance(Advance::passes(2)).unwrap();
    assert!(bits(render.film()) == reference(2));
}

#[test]
fn a_render_is_cancelled_from_another_thread_and_goes_on() {
    let mut render = render(&threads(2)).unwrap();
    let token = CancelToken::new().unwrap();
    std::thread::scope(|scope| {
        let elsewhere = token.clone();
        scope.spawn(move || {
            std::thread::sleep(std::time::Duration::from_millis(20));
            elsewhere.cancel();
        });
        let report = render.advance(Advance::passes(u64::MAX).cancel(&token)).unwrap();
        assert_eq!(report.reason, StopReason::Cancelled);
    });
    // Still cancelled: nothing more is done.
    let done = render.film().info().unwrap().passes;
    assert_eq!(render.advance(Advance::passes(1).cancel(&token)).unwrap().reason, StopReason::Cancelled);
    assert_eq!(render.film().info().unwrap().passes, done);
    render.film().read(ReadOptions::new(Layer::Color).include_partial(true)).unwrap();
    render.advance(Advance::passes(2)).unwrap();
    let passes = render.film().info().unwrap().passes;
    assert_eq!(passes, done + 2);
    if passes < 3000 {
        assert!(bits(render.film()) == reference(passes));
    }
}

#[test]
fn renders_go_to_other_threads() {
    let scene = scene(&threads(1)).unwrap();
    let reference = reference(2);
    std::thread::scope(|scope| {
        for _ in 0..3 {
            let (scene, reference) = (scene.clone(), &reference);
            scope.spawn(move || {
                let mut render = render_of(&scene).unwrap();
                render.advance(Advance::passes(1)).unwrap();
                let film = std::thread::spawn(move || {
                    render.advance(Advance::passes(1)).unwrap();
                    render.into_film()
                });
                assert!(&bits(&film.join().unwrap()) == reference);
            });
        }
    });
}

#[test]
fn ids_are_of_one_builder_and_one_life() {
    let context = threads(1);
    let (mut one, mut other) = (Builder::new(&context).unwrap(), Builder::new(&context).unwrap());
    let shape = one.add_mesh(square()).unwrap();
    let clay = one.add_material(Material::diffuse([0.5; 3])).unwrap();
    other.add_mesh(square()).unwrap();
    other.add_material(Material::diffuse([0.5; 3])).unwrap();
    assert_eq!(code(other.add_instance(&Instance::new(shape, clay))), ErrorCode::InvalidId);
    let instance = one.add_instance(&Instance::new(shape, clay)).unwrap();
    assert_eq!(code(one.remove_shape(shape)), ErrorCode::InUse);
    one.remove_instance(instance).unwrap();
    one.remove_shape(shape).unwrap();
    one.add_mesh(square()).unwrap();
    assert_eq!(code(one.remove_shape(shape)), ErrorCode::InvalidId);
    assert_eq!(code(one.update_instance(instance, &Instance::new(shape, clay))), ErrorCode::InvalidId);
}

#[test]
fn objects_of_two_contexts_do_not_mix_and_the_film_comes_back() {
    let (scene, other) = (scene(&threads(1)).unwrap(), threads(1));
    let sensor = camera().create(&other).unwrap();
    let film = Film::new(&sensor, &FilmOptions::default()).unwrap();
    let refused = Render::new(&scene, &sensor, film, &RenderOptions::new()).err().unwrap();
    assert_eq!(refused.error().code(), ErrorCode::Mismatch);
    assert!(refused.to_string().contains("different contexts"));
    assert_eq!(refused.into_film().info().unwrap().passes, 0);
}

#[test]
fn a_film_is_in_one_render_and_comes_back_with_its_passes() {
    let mut render = render(&threads(1)).unwrap();
    render.advance(Advance::passes(2)).unwrap();
    let (scene, sensor) = (render.scene().clone(), render.sensor().clone());
    let mut film = render.into_film();
    // Options that the film does not fit: it is not lost.
    let other = RenderOptions::new().seed(6);
    film = Render::new(&scene, &sensor, film, &other).err().unwrap().into_film();
    assert_eq!(film.info().unwrap().passes, 2);
    let mut render = Render::new(&scene, &sensor, film, &RenderOptions::new().seed(5)).unwrap();
    render.advance(Advance::passes(1)).unwrap();
    assert!(bits(render.film()) == reference(3));
    let mut film = render.into_film();
    film.clear().unwrap();
    Render::new(&scene, &sensor, film, &other).unwrap();
}

const WILD: [f32; 11] = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, -0.0, 0.0, 1e-40, 0.5, 1.0, 1e30, f32::MAX];

#[test]
fn wild_numbers_are_refused_or_taken() {
    let context = threads(1);
    let mut builder = Builder::new(&context).unwrap();
    let shape = builder.add_mesh(square()).unwrap();
    let clay = builder.add_material(Material::diffuse([0.5; 3])).unwrap();
    let medium = builder.add_medium(&Medium::new([1.0; 3], [1.0; 3])).unwrap();
    let pixel = builder.add_texture(Texture::linear(1, 1, 3, &[0.5_f32; 3])).unwrap();
    for x in WILD {
        let color = [x; 3];
        let _ = builder.add_sphere(Sphere::new(color, x));
        let _ = builder.add_sphere(Sphere::new([0.0; 3], x));
        let _ = builder.add_mesh(Mesh::new(vec![[x, 0.0, 0.0], [0.0, x, 0.0], [0.0, 0.0, x]]));
        let _ = builder.add_mesh(square().normals(vec![color; 4]).uv(vec![[x; 2]; 4]).colors(vec![color; 4]));
        let _ = builder.add_mesh(square().tangents(vec![[x; 4]; 4]).lightmap_uv(vec![[x; 2]; 4]));
        let _ = builder.add_curves(Curves::new(CurveBasis::Bezier, vec![color; 4], vec![x]));
        let _ = builder.add_curves(Curves::new(CurveBasis::BSpline, CORNERS.to_vec(), vec![x; 4]));
        let surface = || Subdivision::new(CORNERS, vec![0, 1, 2, 3]).level(2);
        let _ = builder.add_subdivision(surface().creases(&[([0, 1], x)]).corners(&[(2, x)]));
        let _ = builder.add_subdivision(surface().displace(|_| color));
        let _ = builder.add_medium(&Medium::new(color, color).mean_cosine(x));
        let _ = builder.update_medium(medium, &Medium::new([0.0; 3], color));
        let _ = builder.add_texture(Texture::srgb(1, 1, 3, &color));
        let host = builder.add_host_texture(Grey(x, None)).unwrap();
        for material in [
            Material::diffuse(color).emission(color).emission_exponent(x).diffuse_roughness(x),
            Material::mirror(color).opacity_mask(x, x),
            Material::conductor(color, color).roughness([x, x]),
            Material::dielectric(x).roughness([x, 0.5]).interior(medium),
            Material::diffuse_transmission(color, color).opacity_blend(x),
            Material::coated_diffuse(color).ior(x).roughness([0.1, x]),
            Material::coated_conductor(color, color).coat_ior(x).coat_roughness(x),
            Material::principled(color).metalness(x).specular(x).specular_color(color).sheen_color(color),
            Material::principled([0.5; 3]).sheen_roughness(x).transmission(x).diffuse_transmission_weight(x),
            Material::principled([0.5; 3]).anisotropy(x).anisotropy_rotation(x).coat(x).coat_roughness(x),
            Material::principled([0.5; 3]).iridescence(x, x, x, x).transmittance(color),
            Material::mix(clay, clay, x),
            Material::brushed(color),
            Material::diffuse([1.0; 3]).reflectance_texture(host),
            Material::dielectric(1.5)
                .roughness([0.5; 2])
                .texture(TextureUse::new(Slot::Roughness, pixel).level(x).scale(x).transform([x; 6])),
        ] {
            let _ = builder.add_material(material);
        }
        for light in [
            Light::point(color, color).up(color).direction(color),
            Light::spot(color, color, color, x).cone_falloff(x),
            Light::environment(color).texture(pixel).transform(Transform::from_rows([x; 12])),
            Light::directional(color, color).angular_radius(x),
            Light::directional([0.0, -1.0, 0.0], color).portals(&[Portal {
                corner: color,
                edge_u: color,
                edge_v: color,
            }]),
            Light::point([0.0; 3], [1.0; 3]).photometry(Photometry::new(vec![x; 2], vec![x], vec![x; 2]).unwrap()),
        ] {
            let _ = builder.add_light(&light);
        }
        let placed = Instance::new(shape, clay).transform(Transform::rotate(color, x));
        let _ = builder.add_instance(&placed.clone().end_transform(Transform::look_at(color, color, color)));
        let _ = builder.add_instance(&placed);
        let rows = Transform::from_rows([x; 12]);
        for camera in [
            Camera::perspective(4, 4).field_of_view(x).lens(x, x).focus_tilt([x; 2]).shift([x; 2]),
            Camera::perspective(4, 4).transform(rows).aperture(3, x),
            Camera::orthographic(4, 4, x).end_transform(rows),
            Camera::equidistant(4, 4).field_of_view(x),
            Camera::equisolid(4, 4).field_of_view(x).shift([x; 2]),
            Camera::traced_lens(4, 4, &[LensSurface { radius: x, thickness: x, ior: x, aperture: x }])
                .film_height(x)
                .lens_unit(x)
                .focus_distance(x),
            Camera::perspective(4, 4).output(Output::new(OutputKind::Openness).reach(x)),
        ] {
            let _ = camera.create(&context);
        }
        let sensor = camera().create(&context).unwrap();
        let _ = Film::new(&sensor, &FilmOptions::default().gaussian(x).filter_radius(x));
        let _ = Film::new(&sensor, &FilmOptions::default().mitchell(x, x));
    }
}

#[test]
fn wild_counts_are_refused() {
    let context = threads(1);
    let mut builder = Builder::new(&context).unwrap();
    for n in [0, 1, 64, 65, 4096, 65537, u32::MAX - 1, u32::MAX] {
        let _ = builder.add_subdivision(Subdivision::new(CORNERS, vec![0, 1, 2, n]).level(n.min(100)));
        let _ = builder.add_subdivision(Subdivision::new(CORNERS, vec![0, 1, 2, 3]).face_counts(vec![n]));
        let _ = builder.add_subdivision(Subdivision::new(CORNERS, vec![0, 1, 2, 3]).corners(&[(n, 1.0)]));
        let _ = builder
            .add_subdivision(Subdivision::new(CORNERS, vec![0, 1, 2, 3]).uv(vec![[0.0; 2]; 2]).uv_indices(vec![n; 4]));
        let _ = builder.add_curves(Curves::new(CurveBasis::Linear, CORNERS, vec![0.1]).counts(vec![n, n]));
        let _ = builder.add_mesh(Mesh::new(CORNERS).indices(vec![[0, 1, n]]));
        for (width, height, channels) in [(n, 1, 1), (1, n, 1), (1, 1, n), (n, n, n)] {
            let pixels = [0.5_f32; 8];
            let _ = builder.add_texture(Texture::linear(width, height, channels, &pixels).mip_levels(n));
            let _ = builder.add_texture(Texture::linear(width, height, channels, &pixels).row_stride(n as usize));
            let strided = Texture::srgb(width, height, channels, &[1_u8; 8]).row_stride(usize::MAX);
            let _ = builder.add_texture(strided);
        }
        let _ = Camera::cube(n).create(&context);
        let camera = camera().crop(Rect::new(n, 0, 4, n)).aperture(n, 0.0);
        let _ = camera.create(&context);
        let _ = common::camera().output(Output::new(OutputKind::Radiance).size(n).groups(n.into())).create(&context);
        let sensor = common::camera().create(&context).unwrap();
        let _ = sensor.plane(n);
        let film = Film::new(&sensor, &FilmOptions::default()).unwrap();
        let _ = Film::new(&sensor, &FilmOptions::default().groups(n).pyramid_edges(n));
        for layer in [Layer::Color, Layer::Technique { s: n, t: n }, Layer::Samples] {
            let _ = film.read(ReadOptions::new(layer).plane(n));
            let _ = film.read(ReadOptions::new(layer).rect(Rect::new(0, 0, n, n)));
            let _ = film.read(ReadOptions::new(layer).rect(Rect::new(n, n, 1, 1)));
            let mut few = [0.0; 7];
            assert!(film.read_into(&ReadOptions::new(layer), &mut few).is_err());
            let _ = film.read_into(&ReadOptions::new(layer).row_stride(n as usize), &mut few);
            let _ = film.read_into(&ReadOptions::new(layer).row_stride(usize::MAX / 4), &mut few);
            let _ = film.read_into(&ReadOptions::new(layer).row_stride(usize::MAX), &mut few);
        }
        let _ = film.read_coverage(&CoverageOptions::new().ranks(n).coverage(n).rect(Rect::new(0, 0, n, n)));
        assert!(film.read(Layer::Color).unwrap().pixel(n, n).is_none() || n < 10);
    }
    assert!(Data::range(CORNERS.to_vec(), 2..9).is_err());
    #[allow(clippy::reversed_empty_ranges)]
    let reversed = 3..2;
    assert!(Data::range(CORNERS.to_vec(), reversed).is_err());
    for offset in [0, 1, 11, 12, 13, usize::MAX] {
        for stride in [0, 2, 3, 4, 12, usize::MAX] {
            if let Ok(data) = Data::<[f32; 3]>::interleaved(vec![1.0_f32; 12], offset, stride) {
                assert!(stride >= 3 && data.len() <= 4);
                let _ = builder.add_mesh(Mesh::new(data));
            } else {
                assert!(stride < 3);
            }
        }
    }
}

#[test]
fn enumerations_of_the_future_are_refused() {
    let context = threads(1);
    let mut builder = Builder::new(&context).unwrap();
    let pixel = builder.add_texture(Texture::linear(1, 1, 1, &[1_u8])).unwrap();
    let scene = scene(&context).unwrap();
    let sensor = camera().create(&context).unwrap();
    for n in [-100, -1, 77, i32::MIN, i32::MAX] {
        assert!(ContextOptions::default().isa(Isa::Other(n)).create().is_err());
        assert!(builder.add_curves(Curves::new(CurveBasis::Other(n), CORNERS, vec![0.1])).is_err());
        let surface = Subdivision::new(CORNERS, vec![0, 1, 2, 3]).boundary(Boundary::Other(n));
        assert!(builder.add_subdivision(surface).is_err());
        let uses = [
            TextureUse::new(Slot::Other(n), pixel),
            TextureUse::new(Slot::Reflectance, pixel).wrap([Wrap::Other(n); 2]),
            TextureUse::new(Slot::Reflectance, pixel).lookup(Lookup::Other(n)),
        ];
        for texture in uses {
            assert!(builder.add_material(Material::diffuse([0.5; 3]).texture(texture)).is_err());
        }
        assert!(camera().output(Output::new(OutputKind::Other(n.wrapping_sub(5)))).create(&context).is_err());
        let paths = Output::new(OutputKind::Radiance).paths(LightPaths::Other(n));
        assert!(camera().output(paths).create(&context).is_err());
        assert!(Film::new(&sensor, &FilmOptions::default().filter(Filter::Other(n))).is_err());
        assert!(Film::new(&sensor, &FilmOptions::default().normalization(Normalization::Other(n))).is_err());
        let options = RenderOptions::new;
        for options in [
            options().heuristic(Heuristic::Other(n)),
            options().sampler(Sampler::Other(n)),
            options().shadow_roulette(ShadowRoulette::Other(n)),
            options().adaptive(Adaptive::Other(n)),
            options().light_start(LightStart::Other(n)),
            options().light_selection(LightSelection::Other(n)),
            options().plan("matrix").order(Order::Other(n)),
            options().plan("matrix").partners(Partners::Other(n)),
            options().plan("matrix").matrix(MatrixKind::Other(n)),
            options().plan("pooled").pool_selection(PoolSelection::Other(n)),
            options().beta(f32::NAN),
            options().cutoff(n as f32),
            options().strata(u32::MAX),
            options().block_size(u32::MAX),
            options().connections(u32::MAX),
            options().light_samples(u32::MAX),
            options().direct_samples(u32::MAX),
            options().techniques(Techniques::only(0, 2).without(0, 2)),
            options().plan("one\0to one"),
        ] {
            let film = Film::new(&sensor, &FilmOptions::default()).unwrap();
            assert_eq!(code(Render::new(&scene, &sensor, film, &options)), ErrorCode::InvalidArgument, "{options:?}");
        }
    }
}

#[test]
fn limits_that_are_none_are_refused() {
    let mut render = render(&threads(1)).unwrap();
    for wild in [f64::NAN, f64::INFINITY, -1.0] {
        assert_eq!(code(render.advance(Advance::passes(1).seconds(wild))), ErrorCode::InvalidArgument);
        assert_eq!(code(render.advance(Advance::to_noise(wild))), ErrorCode::InvalidArgument);
    }
    assert_eq!(code(render.advance(Advance::passes(0))), ErrorCode::InvalidArgument);
    assert_eq!(render.advance(Advance::passes(1)).unwrap().passes, 1);
}

#[test]
fn photometry_needs_an_intensity_for_each_pair_of_angles() {
    assert_eq!(code(Photometry::new(vec![0.0, 90.0], vec![0.0, 90.0], vec![1.0; 3])), ErrorCode::InvalidArgument);
    assert_eq!(code(Photometry::new(vec![], vec![0.0], vec![1.0])), ErrorCode::InvalidArgument);
    let mut builder = Builder::new(&threads(1)).unwrap();
    let empty = Light::point([0.0; 3], [1.0; 3]).photometry(Photometry::new(vec![], vec![], vec![]).unwrap());
    assert_eq!(code(builder.add_light(&empty)), ErrorCode::InvalidArgument);
}

#[test]
fn a_texture_has_as_many_texels_as_it_says() {
    let mut builder = Builder::new(&threads(1)).unwrap();
    let eleven = [1_u8; 11];
    assert_eq!(code(builder.add_texture(Texture::srgb(2, 2, 3, &eleven))), ErrorCode::InvalidArgument);
    builder.add_texture(Texture::srgb(1, 2, 3, &eleven).row_stride(8)).unwrap();
    assert_eq!(code(builder.add_texture(Texture::srgb(1, 2, 3, &eleven).row_stride(9))), ErrorCode::InvalidArgument);
    builder.add_texture(Texture::linear(2, 2, 1, &[Half(0x3c00); 4])).unwrap();
    builder.add_texture(Texture::linear(2, 2, 1, &[7_u16; 4]).mip_levels(2)).unwrap();
}
