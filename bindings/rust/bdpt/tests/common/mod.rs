// SPDX-License-Identifier: Apache-2.0
//! A small scene, and values that count their drops.
#![allow(dead_code)]

use bdpt::*;
use std::any::Any;
use std::panic::{catch_unwind, AssertUnwindSafe};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::Arc;

/// Tells how many of its [`Counted`] are gone.
#[derive(Clone, Default)]
pub struct Drops(Arc<AtomicUsize>);

impl Drops {
    pub fn new() -> Self {
        Self::default()
    }
    /// One that is to be dropped once.
    pub fn one(&self) -> Counted {
        Counted(self.clone())
    }
    pub fn count(&self) -> usize {
        self.0.load(Ordering::SeqCst)
    }
}

pub struct Counted(Drops);

impl Drop for Counted {
    fn drop(&mut self) {
        self.0 .0.fetch_add(1, Ordering::SeqCst);
    }
}

impl Counted {
    /// Captures it in a closure that does nothing with it.
    pub fn touch(&self) {}
}

/// An owner of an array that counts its drop.
pub struct CountedArray<T>(pub Vec<T>, pub Counted);
impl<T> AsRef<[T]> for CountedArray<T> {
    fn as_ref(&self) -> &[T] {
        &self.0
    }
}

/// A texture that gives one grey.
pub struct Grey(pub f32, pub Option<Counted>);
impl HostTexture for Grey {
    fn look_up(&self, _: &[TexturePlace], colors: &mut [[f32; 4]]) {
        colors.fill([self.0, self.0, self.0, 1.0]);
    }
    fn hash(&self) -> u64 {
        self.0.to_bits().into()
    }
}

/// Lambert's.
pub struct Chalk(pub Option<Counted>);
impl HostMaterial for Chalk {
    fn evaluate(&self, place: &ScatteringPlace, next: [f32; 3]) -> Scattering {
        const PI: f32 = std::f32::consts::PI;
        Scattering {
            f: place.reflectance.map(|r| r / PI),
            density: next[2].abs() / PI,
            density_reverse: place.previous[2].abs() / PI,
        }
    }
    fn sample(&self, place: &ScatteringPlace, u: [f32; 3]) -> Option<[f32; 3]> {
        let (r, phi) = (u[0].sqrt(), 2.0 * std::f32::consts::PI * u[1]);
        Some([r * phi.cos(), r * phi.sin(), (1.0 - u[0]).sqrt().copysign(place.previous[2])])
    }
    fn hash(&self) -> u64 {
        1
    }
}

pub const CORNERS: [[f32; 3]; 4] = [[-1.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 0.0, -1.0], [-1.0, 0.0, -1.0]];
pub const TRIANGLES: [[u32; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

pub fn square() -> Mesh {
    Mesh::new(CORNERS).indices(TRIANGLES.to_vec())
}

/// A floor of a material of the caller's, a ball, and a lamp above.
pub fn fill(builder: &mut Builder, floor: MaterialId) -> Result<()> {
    let plane = builder.add_mesh(square())?;
    let ball = builder.add_sphere(Sphere::new([0.0, 0.4, 0.0], 0.4))?;
    let clay = builder.add_material(Material::diffuse([0.6, 0.4, 0.3]))?;
    let lamp = builder.add_material(Material::diffuse([0.0; 3]).emission([9.0; 3]))?;
    let above = Transform::scale(0.3)
        .then(Transform::rotate([1.0, 0.0, 0.0], 180.0))
        .then(Transform::translate([0.0, 2.0, 0.0]));
    builder.add_instance(&Instance::new(plane, floor))?;
    builder.add_instance(&Instance::new(ball, clay).label("ball"))?;
    builder.add_instance(&Instance::new(plane, lamp).transform(above).label("lamp"))?;
    Ok(())
}

pub fn scene(context: &Context) -> Result<Scene> {
    scene_with(context, |builder| builder.add_material(Material::diffuse([0.7; 3])))
}

pub fn scene_with(context: &Context, floor: impl FnOnce(&mut Builder) -> Result<MaterialId>) -> Result<Scene> {
    let mut builder = Builder::new(context)?;
    let floor = floor(&mut builder)?;
    fill(&mut builder, floor)?;
    builder.build()
}

pub fn camera() -> Camera {
    let from = Transform::look_at([0.0, 1.0, 4.0], [0.0, 0.6, 0.0], [0.0, 1.0, 0.0]);
    Camera::perspective(12, 10).transform(from)
}

pub fn render_of(scene: &Scene) -> Result<Render> {
    let sensor = camera().create(scene.context())?;
    let film = Film::new(&sensor, &FilmOptions::default())?;
    // Several blocks, so that there is work for several threads.
    Ok(Render::new(scene, &sensor, film, &RenderOptions::new().seed(5).block_size(16))?)
}

pub fn render(context: &Context) -> Result<Render> {
    render_of(&scene(context)?)
}

pub fn threads(count: u32) -> Context {
    ContextOptions::default().threads(count).create().unwrap()
}

/// The bits of the picture.
pub fn bits(film: &Film) -> Vec<u32> {
    film.read(Layer::Color).unwrap().as_floats().iter().map(|value| value.to_bits()).collect()
}

/// What the picture of so many passes is, by one thread.
pub fn reference(passes: u64) -> Vec<u32> {
    let mut render = render(&threads(1)).unwrap();
    render.advance(Advance::passes(passes)).unwrap();
    let bits = bits(render.film());
    assert!(bits.iter().any(|bits| *bits != 0));
    bits
}

/// The number that `code` panics with.
pub fn panic_of<R>(code: impl FnOnce() -> R) -> i32 {
    let payload = catch_unwind(AssertUnwindSafe(code)).err().expect("it panics");
    number(payload)
}

pub fn number(payload: Box<dyn Any + Send>) -> i32 {
    *payload.downcast::<i32>().expect("the payload is what it panicked with")
}

/// Panics on purpose are not told of.
pub fn quiet() {
    let told = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |info| {
        if info.payload().downcast_ref::<i32>().is_none() {
            told(info);
        }
    }));
}

pub fn code<T, E: Into<Error>>(result: std::result::Result<T, E>) -> ErrorCode {
    result.map(|_| ()).map_err(Into::into).expect_err("it fails").code()
}
