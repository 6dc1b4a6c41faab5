// SPDX-License-Identifier: Apache-2.0
//! Ids of what a builder holds.

use bdpt_sys as sys;

macro_rules! id {
    ($(#[$doc:meta])* $name:ident, $raw:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub struct $name(pub(crate) sys::$raw);

        impl $name {
            /// The number behind the id, as coverage and the error texts have it.
            pub fn number(self) -> u64 {
                self.0.id
            }
        }
    };
}

id!(
    /// A mesh, sphere, set of curves or subdivision surface of a [`Builder`](crate::Builder).
    ShapeId,
    bdpt_shape_id
);
id!(
    /// A texture of a [`Builder`](crate::Builder).
    TextureId,
    bdpt_texture_id
);
id!(
    /// A material of a [`Builder`](crate::Builder).
    MaterialId,
    bdpt_material_id
);
id!(
    /// A light of a [`Builder`](crate::Builder).
    LightId,
    bdpt_light_id
);
id!(
    /// An instance of a [`Builder`](crate::Builder).
    InstanceId,
    bdpt_instance_id
);
id!(
    /// A medium of a [`Builder`](crate::Builder).
    MediumId,
    bdpt_medium_id
);
