// SPDX-License-Identifier: Apache-2.0

//! What one side has and the other lacks.

use crate::mirror::c_field;
use crate::rust::Declarations;
use std::collections::BTreeSet;

#[derive(Default)]
pub struct Names {
    pub functions: BTreeSet<String>,
    pub constants: BTreeSet<String>,
    /// Structs, opaque ones too, and aliases.
    pub types: BTreeSet<String>,
    /// As `struct.field`.
    pub fields: BTreeSet<String>,
}

impl From<&Declarations> for Names {
    fn from(found: &Declarations) -> Self {
        let field = |owner: &str, name: &str| format!("{}.{}", owner, c_field(name));
        Names {
            functions: found.functions.iter().map(|one| one.name.clone()).collect(),
            constants: found.constants.iter().map(|one| one.0.clone()).collect(),
            types: (found.opaque.iter())
                .chain(found.structs.iter().map(|one| &one.name))
                .chain(found.aliases.iter().map(|one| &one.0))
                .cloned()
                .collect(),
            fields: (found.structs.iter())
                .flat_map(|one| one.fields.iter().map(move |(name, _)| field(&one.name, name)))
                .collect(),
        }
    }
}

impl Names {
    /// Those of `self` that `other` lacks.
    pub fn without<'a>(&'a self, other: &'a Names) -> Vec<&'a str> {
        (self.functions.difference(&other.functions))
            .chain(self.constants.difference(&other.constants))
            .chain(self.types.difference(&other.types))
            .chain(self.fields.difference(&other.fields))
            .map(String::as_str)
            .collect()
    }
}
