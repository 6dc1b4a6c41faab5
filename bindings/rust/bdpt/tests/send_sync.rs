// SPDX-License-Identifier: Apache-2.0
//! What may go to other threads, and what may be shared with them.

use bdpt::*;
use static_table::*;

/// Whether a type is Send, and whether it is Sync, as constants: an inherent constant hides that of a trait, where its
/// bound holds.
#[allow(dead_code)]
mod static_table {
    use std::marker::PhantomData;
    pub struct Send_<T: ?Sized>(PhantomData<T>);
    pub struct Sync_<T: ?Sized>(PhantomData<T>);
    pub trait NoSend {
        const IS: bool = false;
    }
    pub trait NoSync {
        const IS: bool = false;
    }
    impl<T: ?Sized> NoSend for Send_<T> {}
    impl<T: ?Sized> NoSync for Sync_<T> {}
    impl<T: ?Sized + Send> Send_<T> {
        pub const IS: bool = true;
    }
    impl<T: ?Sized + Sync> Sync_<T> {
        pub const IS: bool = true;
    }
}

macro_rules! table {
    ($($type:ty: $send:literal $sync:literal,)*) => {
        $(
            const _: () = assert!(Send_::<$type>::IS == $send, concat!(stringify!($type), " and Send"));
            const _: () = assert!(Sync_::<$type>::IS == $sync, concat!(stringify!($type), " and Sync"));
        )*
    };
}

table!(
    Context: true true,
    Scene: true true,
    Sensor: true true,
    CancelToken: true true,
    Builder: true false,
    Film: true false,
    Render: true false,
    RenderError: true true,
    Error: true true,
    ContextOptions: true true,
    Data<[f32; 3]>: true true,
    Mesh: true true,
    Curves: true true,
    Subdivision<'static>: false false,
    Texture<'static>: true true,
    Material: true true,
    Light: true true,
    Camera: true true,
    RenderOptions: true true,
    FilmOptions: true true,
    ReadOptions: true true,
    Image: true true,
    TileView<'static>: true true,
    Coverage: true true,
    Tile<'static>: true true,
    Running<'static>: false false,
    BuildOptions<'static>: false false,
    Advance<'static>: false false,
    Box<dyn Executor>: true true,
    Box<dyn HostTexture>: true true,
    Box<dyn HostMaterial>: true true,
    ShapeId: true true,
    InstanceId: true true,
);

#[test]
fn the_table_is_checked_when_this_compiles() {}
