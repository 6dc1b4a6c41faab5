// SPDX-License-Identifier: Apache-2.0
//! Chained setters of descriptions whose fields are the library's.

macro_rules! setters {
    ($($(#[$doc:meta])* $name:ident: $type:ty => $($field:tt).+;)*) => {
        $(
            $(#[$doc])*
            pub fn $name(mut self, $name: $type) -> Self {
                self.raw.$($field).+ = $name.into();
                self
            }
        )*
    };
}

macro_rules! labelled {
    () => {
        /// Names the object in error texts.
        pub fn label(mut self, label: impl Into<String>) -> Self {
            self.label = Some(label.into());
            self
        }
    };
}

/// An enumeration of the library's, which may grow.
macro_rules! enumeration {
    ($(#[$doc:meta])* $name:ident: $raw:ident { $($(#[$value_doc:meta])* $value:ident = $constant:ident,)* }) => {
        $(#[$doc])*
        #[non_exhaustive]
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum $name {
            $($(#[$value_doc])* $value,)*
            /// One that this version of the crate does not know.
            Other(i32),
        }

        impl $name {
            #[allow(dead_code)]
            pub(crate) fn new(raw: bdpt_sys::$raw) -> Self {
                match raw {
                    $(bdpt_sys::$constant => Self::$value,)*
                    other => Self::Other(other),
                }
            }
            #[allow(dead_code)]
            pub(crate) fn raw(self) -> bdpt_sys::$raw {
                match self {
                    $(Self::$value => bdpt_sys::$constant,)*
                    Self::Other(other) => other,
                }
            }
        }

        impl From<$name> for i32 {
            fn from(value: $name) -> Self {
                value.raw()
            }
        }
    };
}
