// SPDX-License-Identifier: Apache-2.0
//! Materials whose scattering the host computes.

use crate::host::host;
use bdpt_sys as sys;
use std::os::raw::c_void;

/// Where a [`HostMaterial`] scatters. Directions are unit vectors that point away from the surface, in the shading
/// frame: z along the normal on the front, x along u.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScatteringPlace {
    /// Where the subpath comes from; of an eye subpath, or a light subpath: you are not told.
    pub previous: [f32; 3],
    /// Of the description, times its textures.
    pub reflectance: [f32; 3],
    /// GGX alpha along u and v, alike.
    pub roughness: [f32; 2],
}

/// How a [`HostMaterial`] scatters from one direction to another.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Scattering {
    /// At least 0, per projected solid angle, without cosines; the same with both directions exchanged.
    pub f: [f32; 3],
    /// With which [`HostMaterial::sample`] gives the next direction, per solid angle; above 0 where `f` is.
    pub density: f32,
    /// With which it gives the previous direction, coming from the next.
    pub density_reverse: f32,
}

/// A material of yours.
///
/// Both functions depend on nothing but their arguments; else techniques disagree, and no two renders are the same.
/// Numbers that are negative or not finite, and directions that are no unit vectors, are rejected contributions:
/// [`FilmInfo::rejected`](crate::FilmInfo::rejected) counts them. Both are called on any thread that renders, several
/// at a time. A panic in them stops the render soon, and goes on where [`Render::advance`](crate::Render::advance)
/// returns.
///
/// ```
/// use bdpt::{HostMaterial, Scattering, ScatteringPlace};
/// use std::f32::consts::PI;
/// /// Lambert's.
/// struct Chalk;
/// impl HostMaterial for Chalk {
///     fn evaluate(&self, place: &ScatteringPlace, next: [f32; 3]) -> Scattering {
///         Scattering {
///             f: place.reflectance.map(|r| r / PI),
///             density: next[2].abs() / PI,
///             density_reverse: place.previous[2].abs() / PI,
///         }
///     }
///     fn sample(&self, place: &ScatteringPlace, u: [f32; 3]) -> Option<[f32; 3]> {
///         let (r, phi) = (u[0].sqrt(), 2.0 * PI * u[1]);
///         let z = (1.0 - u[0]).sqrt().copysign(place.previous[2]);
///         Some([r * phi.cos(), r * phi.sin(), z])
///     }
///     fn hash(&self) -> u64 {
///         1
///     }
/// }
/// # fn main() -> bdpt::Result<()> {
/// let mut builder = bdpt::Builder::new(&bdpt::Context::new()?)?;
/// builder.add_material(bdpt::Material::host(Chalk, [0.7; 3]))?;
/// # Ok(()) }
/// ```
///
/// What it borrows would have to live as long as the last scene that has it, which nobody knows:
/// ```compile_fail,E0597
/// # use bdpt::{Material, HostMaterial, Scattering, ScatteringPlace};
/// struct Borrows<'a>(&'a [f32]);
/// impl HostMaterial for Borrows<'_> {
/// #   fn evaluate(&self, _: &ScatteringPlace, _: [f32; 3]) -> Scattering { Scattering::default() }
/// #   fn sample(&self, _: &ScatteringPlace, _: [f32; 3]) -> Option<[f32; 3]> { None }
/// #   fn hash(&self) -> u64 { 0 }
///     // ...
/// }
/// let table = vec![0.5];
/// let material = Material::host(Borrows(&table), [0.5; 3]);
/// # drop(material);
/// ```
pub trait HostMaterial: Send + Sync {
    /// How light is scattered between the two directions.
    fn evaluate(&self, place: &ScatteringPlace, next: [f32; 3]) -> Scattering;
    /// The next direction, by three numbers uniform in [0,1); `None` if the light is absorbed.
    fn sample(&self, place: &ScatteringPlace, u: [f32; 3]) -> Option<[f32; 3]>;
    /// Of all that decides the scattering: films of other scenes do not merge. Asked once.
    fn hash(&self) -> u64;
    /// Whether light may go through: if not, both directions are on one side. Asked once.
    fn transmits(&self) -> bool {
        false
    }
}

pub(crate) type BoxedMaterial = Box<dyn HostMaterial>;

fn place_of(place: &sys::bdpt_scattering_place) -> ScatteringPlace {
    ScatteringPlace { previous: place.previous, reflectance: place.reflectance, roughness: place.roughness }
}

/// The callback `evaluate` of `bdpt_host_material`.
pub(crate) unsafe extern "C" fn evaluate(
    user: *mut c_void,
    place: *const sys::bdpt_scattering_place,
    next: *const f32,
    value: *mut sys::bdpt_scattering_value,
) -> i32 {
    // SAFETY: `user` is that of a material that lives; the pointers are valid during the call, next of three floats.
    let (material, place, next, value) =
        unsafe { (host::<BoxedMaterial>(user), &*place, *next.cast::<[f32; 3]>(), &mut *value) };
    match material.panics.catch(|| material.value.evaluate(&place_of(place), next)) {
        Some(Scattering { f, density, density_reverse }) => {
            *value = sys::bdpt_scattering_value { f, density, density_reverse };
            0
        }
        None => 1,
    }
}

/// The callback `sample` of `bdpt_host_material`.
pub(crate) unsafe extern "C" fn sample(
    user: *mut c_void,
    place: *const sys::bdpt_scattering_place,
    u: *const f32,
    next: *mut f32,
) -> i32 {
    // SAFETY: as above; u and next have three floats.
    let (material, place, u, next) =
        unsafe { (host::<BoxedMaterial>(user), &*place, *u.cast::<[f32; 3]>(), &mut *next.cast::<[f32; 3]>()) };
    match material.panics.catch(|| material.value.sample(&place_of(place), u)) {
        Some(direction) => {
            *next = direction.unwrap_or_default();
            0
        }
        None => 1,
    }
}
