// SPDX-License-Identifier: Apache-2.0
//! Every captured value is dropped once, whatever happens to the call that took it.

mod common;
use bdpt::*;
use common::*;
use std::ops::ControlFlow;
use std::sync::Arc;

/// Runs bodies here, and counts its drop.
struct Here(#[allow(dead_code)] Counted);
impl Executor for Here {
    fn worker_count(&self) -> u32 {
        1
    }
    fn run(&self, n: u32, body: &(dyn Fn(u32) + Sync)) {
        (0..n).for_each(body);
    }
}
struct NoWorkers(#[allow(dead_code)] Counted);
impl Executor for NoWorkers {
    fn worker_count(&self) -> u32 {
        0
    }
    fn run(&self, _: u32, _: &(dyn Fn(u32) + Sync)) {}
}

#[test]
fn executor_and_log_go_with_the_last_object_of_the_context() {
    let (executor, log) = (Drops::new(), Drops::new());
    let token = log.one();
    let context =
        ContextOptions::default().executor(Here(executor.one())).log(move |_, _| token.touch()).create().unwrap();
    let builder = Builder::new(&context).unwrap();
    drop(context.clone());
    drop(context);
    assert_eq!((executor.count(), log.count()), (0, 0));
    drop(builder);
    assert_eq!((executor.count(), log.count()), (1, 1));
}

#[test]
fn executor_and_log_go_when_no_context_comes_of_them() {
    let options = |executor: &Drops, log: &Drops| {
        let token = log.one();
        ContextOptions::default().executor(Here(executor.one())).log(move |_, _| token.touch())
    };
    let refused: [fn(ContextOptions) -> ContextOptions; 4] = [
        |options| options.threads(2),
        |options| options.isa(Isa::Other(77)),
        |options| options.rendering_space("no such space"),
        |options| options.rendering_space("zero \0 byte"),
    ];
    for refused in refused {
        let (executor, log) = (Drops::new(), Drops::new());
        assert_eq!(code(refused(options(&executor, &log)).create()), ErrorCode::InvalidArgument);
        assert_eq!((executor.count(), log.count()), (1, 1));
    }
    let drops = Drops::new();
    assert_eq!(code(ContextOptions::default().executor(NoWorkers(drops.one())).create()), ErrorCode::InvalidArgument);
    assert_eq!(drops.count(), 1);
    drop(ContextOptions::default().executor(Here(drops.one())));
    assert_eq!(drops.count(), 2);
}

#[test]
fn closures_of_a_build_go_with_it() {
    let drops = Drops::new();
    let options = || {
        let token = drops.one();
        BuildOptions::new().progress(move |_| token.touch())
    };
    let context = threads(1);
    let mut builder = Builder::new(&context).unwrap();
    assert_eq!(code(builder.build_with(options())), ErrorCode::InvalidArgument);
    assert_eq!(drops.count(), 1);
    builder.add_light(&Light::environment([1.0; 3])).unwrap();
    builder.build_with(options()).unwrap();
    assert_eq!(drops.count(), 2);
    let token = CancelToken::new().unwrap();
    token.cancel();
    assert_eq!(code(builder.build_with(options().cancel(&token))), ErrorCode::Cancelled);
    assert_eq!(drops.count(), 3);
    drop(options());
    assert_eq!(drops.count(), 4);
    // The second closure replaces the first.
    let token = drops.one();
    let both = options().progress(move |_| {
        token.touch();
        ControlFlow::Break(())
    });
    assert_eq!(drops.count(), 5);
    assert_eq!(code(builder.build_with(both)), ErrorCode::CallbackFailed);
    assert_eq!(drops.count(), 6);
}

#[test]
fn closures_of_an_advance_go_with_it() {
    struct Both(Counted);
    impl Sink for Both {
        fn tile(&mut self, _: Tile<'_>) -> ControlFlow<()> {
            self.0.touch();
            ControlFlow::Continue(())
        }
    }
    let (progress, tiles, sink) = (Drops::new(), Drops::new(), Drops::new());
    let options = |passes| {
        let (a, b) = (progress.one(), tiles.one());
        Advance::passes(passes).progress(move |_| a.touch()).tiles(1, move |_| b.touch())
    };
    let mut render = render(&threads(1)).unwrap();
    render.advance(options(1)).unwrap();
    assert_eq!((progress.count(), tiles.count()), (1, 1));
    assert_eq!(code(render.advance(options(0))), ErrorCode::InvalidArgument);
    assert_eq!((progress.count(), tiles.count()), (2, 2));
    let replaced = options(1).sink(1, Both(sink.one()));
    assert_eq!((progress.count(), tiles.count(), sink.count()), (2, 3, 0));
    render.advance(replaced).unwrap();
    assert_eq!((progress.count(), sink.count()), (3, 1));
    drop(options(1));
    assert_eq!((progress.count(), tiles.count()), (4, 4));
}

#[test]
fn a_host_texture_goes_with_the_last_that_has_it() {
    let drops = Drops::new();
    let context = threads(1);
    let mut builder = Builder::new(&context).unwrap();
    // Removed.
    let texture = builder.add_host_texture(Grey(0.5, Some(drops.one()))).unwrap();
    builder.remove_texture(texture).unwrap();
    assert_eq!(drops.count(), 1);
    assert_eq!(code(builder.remove_texture(texture)), ErrorCode::InvalidId);
    // Kept by a scene.
    let texture = builder.add_host_texture(Grey(0.5, Some(drops.one()))).unwrap();
    let material = builder.add_material(Material::diffuse([1.0; 3]).reflectance_texture(texture)).unwrap();
    fill(&mut builder, material).unwrap();
    let scene = builder.build().unwrap();
    assert_eq!(code(builder.remove_texture(texture)), ErrorCode::InUse);
    drop(builder);
    assert_eq!(drops.count(), 1);
    let mut render = render_of(&scene).unwrap();
    drop(scene);
    render.advance(Advance::passes(1)).unwrap();
    assert_eq!(drops.count(), 1);
    drop(render.into_film());
    assert_eq!(drops.count(), 2);
}

#[test]
fn a_host_texture_that_is_refused_goes_at_once() {
    struct Wild(f32, [f32; 2], &'static str, #[allow(dead_code)] Counted);
    impl HostTexture for Wild {
        fn look_up(&self, _: &[TexturePlace], _: &mut [[f32; 4]]) {}
        fn hash(&self) -> u64 {
            0
        }
        fn maximum(&self) -> f32 {
            self.0
        }
        fn bump_step(&self) -> [f32; 2] {
            self.1
        }
        fn label(&self) -> String {
            self.2.to_string()
        }
    }
    let mut builder = Builder::new(&threads(1)).unwrap();
    let nan = f32::NAN;
    for (maximum, step, label) in
        [(nan, [0.1; 2], ""), (-1.0, [0.1; 2], ""), (1.0, [nan, 1.0], ""), (1.0, [2.0; 2], ""), (1.0, [0.1; 2], "\0")]
    {
        let drops = Drops::new();
        let texture = Wild(maximum, step, label, drops.one());
        assert_eq!(code(builder.add_host_texture(texture)), ErrorCode::InvalidArgument);
        assert_eq!(drops.count(), 1);
    }
}

#[test]
fn a_host_material_goes_with_the_last_that_has_it() {
    let drops = Drops::new();
    let mut builder = Builder::new(&threads(1)).unwrap();
    let host = || Material::host(Chalk(Some(drops.one())), [0.7; 3]);
    // Never added.
    drop(host());
    assert_eq!(drops.count(), 1);
    // Removed.
    let material = builder.add_material(host()).unwrap();
    builder.remove_material(material).unwrap();
    assert_eq!(drops.count(), 2);
    // Refused.
    assert_eq!(code(builder.add_material(host().reflectance([-1.0; 3]))), ErrorCode::InvalidArgument);
    assert_eq!(drops.count(), 3);
    assert_eq!(code(builder.add_material(host().label("\0"))), ErrorCode::InvalidArgument);
    assert_eq!(drops.count(), 4);
    // Replaced, while a scene has the first.
    let material = builder.add_material(host()).unwrap();
    fill(&mut builder, material).unwrap();
    let scene = builder.build().unwrap();
    builder.update_material(material, host()).unwrap();
    assert_eq!(drops.count(), 4);
    drop(scene);
    assert_eq!(drops.count(), 5);
    // Replaced by one that is refused: the one before stays.
    assert_eq!(code(builder.update_material(material, host().reflectance([2.0; 3]))), ErrorCode::InvalidArgument);
    assert_eq!(drops.count(), 6);
    // Replaced, without a scene.
    builder.update_material(material, Material::diffuse([0.5; 3])).unwrap();
    assert_eq!(drops.count(), 7);
    // Of an id that is none.
    let mut other = Builder::new(builder.context()).unwrap();
    assert_eq!(code(other.update_material(material, host())), ErrorCode::InvalidId);
    assert_eq!(drops.count(), 8);
    // Given to what takes none.
    drop(builder);
    assert_eq!(drops.count(), 8);
}

fn counted_mesh(drops: &Drops) -> Mesh {
    let uv = |drops: &Drops| Data::from_owner(CountedArray(vec![[0.0_f32; 2]; 4], drops.one()));
    Mesh::new(Data::from_owner(CountedArray(CORNERS.to_vec(), drops.one())))
        .indices(Data::from_owner(CountedArray(TRIANGLES.to_vec(), drops.one())))
        .normals(Data::from_owner(CountedArray(vec![[0.0_f32, 1.0, 0.0]; 4], drops.one())))
        .uv(uv(drops))
        .lightmap_uv(uv(drops))
        .colors(Data::from_owner(CountedArray(vec![[0.5_f32; 4]; 4], drops.one())))
        .tangents(Data::from_owner(CountedArray(vec![[1.0_f32, 0.0, 0.0, 1.0]; 4], drops.one())))
}

#[test]
fn arrays_of_a_mesh_go_with_the_last_that_needs_them() {
    let drops = Drops::new();
    let mut builder = Builder::new(&threads(1)).unwrap();
    drop(counted_mesh(&drops));
    assert_eq!(drops.count(), 7);
    let mesh = builder.add_mesh(counted_mesh(&drops)).unwrap();
    builder.remove_shape(mesh).unwrap();
    assert_eq!(drops.count(), 14);
    let mesh = builder.add_mesh(counted_mesh(&drops)).unwrap();
    let clay = builder.add_material(Material::diffuse([0.5; 3])).unwrap();
    builder.add_instance(&Instance::new(mesh, clay)).unwrap();
    let scene = builder.build().unwrap();
    drop(builder);
    // Indices without slack are copied by the library.
    assert_eq!(drops.count(), 15);
    drop(scene);
    assert_eq!(drops.count(), 21);
}

#[test]
fn arrays_of_a_mesh_that_is_refused_go_at_once() {
    let refused: [fn(Mesh) -> Mesh; 5] = [
        |mesh| mesh.indices(vec![[0_u32, 1, 4]]),
        |mesh| mesh.uv(vec![[f32::NAN; 2]; 4]),
        |mesh| mesh.normals(vec![[0.0; 3]; 3]),
        |mesh| mesh.label("\0"),
        |mesh| mesh.indices(vec![[0_u16, 0, 70]]),
    ];
    for refused in refused {
        let drops = Drops::new();
        let mut builder = Builder::new(&threads(1)).unwrap();
        assert_eq!(code(builder.add_mesh(refused(counted_mesh(&drops)))), ErrorCode::InvalidArgument);
        assert_eq!(drops.count(), 7);
    }
}

#[test]
fn shared_arrays_are_shared() {
    let positions: Arc<[[f32; 3]]> = CORNERS.into_iter().chain(CORNERS).collect();
    let indices: Arc<[[u32; 3]]> = TRIANGLES.iter().chain(&TRIANGLES).chain(&TRIANGLES).copied().collect();
    let mut builder = Builder::new(&threads(1)).unwrap();
    let mesh = |last: u32| {
        let some = Data::range(indices.clone(), 0..2).unwrap();
        Mesh::new(Data::range(positions.clone(), 0..last as usize).unwrap()).indices(some)
    };
    let shape = builder.add_mesh(mesh(4)).unwrap();
    assert_eq!((Arc::strong_count(&positions), Arc::strong_count(&indices)), (2, 2));
    assert_eq!(code(builder.add_mesh(mesh(2))), ErrorCode::InvalidArgument);
    assert_eq!((Arc::strong_count(&positions), Arc::strong_count(&indices)), (2, 2));
    builder.remove_shape(shape).unwrap();
    assert_eq!((Arc::strong_count(&positions), Arc::strong_count(&indices)), (1, 1));
    // Indices with nothing behind them are copied.
    builder.add_mesh(Mesh::new(positions.clone()).indices(indices.clone())).unwrap();
    assert_eq!((Arc::strong_count(&positions), Arc::strong_count(&indices)), (2, 1));
    drop(builder);
    assert_eq!(Arc::strong_count(&positions), 1);
}

#[test]
fn arrays_and_closures_of_what_is_copied_go_with_the_call() {
    let drops = Drops::new();
    let mut builder = Builder::new(&threads(1)).unwrap();
    let points = || Data::from_owner(CountedArray(CORNERS.to_vec(), drops.one()));
    builder.add_curves(Curves::new(CurveBasis::Linear, points(), vec![0.1])).unwrap();
    assert_eq!(drops.count(), 1);
    assert!(builder.add_curves(Curves::new(CurveBasis::Linear, points(), vec![-0.1])).is_err());
    assert_eq!(drops.count(), 2);
    let surface = |level| {
        let token = drops.one();
        Subdivision::new(points(), vec![0, 1, 2, 3]).level(level).displace(move |place| {
            token.touch();
            place.position
        })
    };
    builder.add_subdivision(surface(2)).unwrap();
    assert_eq!(drops.count(), 4);
    assert!(builder.add_subdivision(surface(0)).is_err());
    assert_eq!(drops.count(), 6);
}

/// All orders of 0..n.
fn orders(n: usize) -> Vec<Vec<usize>> {
    if n == 0 {
        return vec![vec![]];
    }
    let mut all = Vec::new();
    for order in orders(n - 1) {
        for place in 0..n {
            let mut longer = order.clone();
            longer.insert(place, n - 1);
            all.push(longer);
        }
    }
    all
}

#[test]
fn handles_go_in_any_order() {
    for order in orders(5) {
        let drops = Drops::new();
        let token = drops.one();
        let context =
            ContextOptions::default().executor(Here(drops.one())).log(move |_, _| token.touch()).create().unwrap();
        let mut builder = Builder::new(&context).unwrap();
        let texture = builder.add_host_texture(Grey(0.5, Some(drops.one()))).unwrap();
        let floor = builder.add_material(Material::diffuse([1.0; 3]).reflectance_texture(texture)).unwrap();
        let mesh = builder.add_mesh(counted_mesh(&drops)).unwrap();
        builder.add_instance(&Instance::new(mesh, floor)).unwrap();
        let scene = builder.build().unwrap();
        let sensor = camera().create(&context).unwrap();
        let film = Film::new(&sensor, &FilmOptions::default()).unwrap();
        let render = Render::new(&scene, &sensor, film, &RenderOptions::new()).unwrap();
        let mut handles: Vec<Option<Box<dyn std::any::Any>>> = vec![
            Some(Box::new(context)),
            Some(Box::new(builder)),
            Some(Box::new(scene)),
            Some(Box::new(sensor)),
            Some(Box::new(render)),
        ];
        assert_eq!(drops.count(), 1, "the library copies the indices");
        for handle in &order {
            handles[*handle] = None;
        }
        assert_eq!(drops.count(), 10, "{order:?}");
    }
}
