// SPDX-License-Identifier: Apache-2.0

//! The declarations as C, beside the header's: a text that only compiles if both are the same.

use crate::rust::{Declarations, Type};
use std::fmt::Write;

/// What stands at its head; `same` compares types, qualifiers of what pointers point to included.
const HEAD: &str = "\
#include <bdpt.h>
#define same(a, b) __builtin_types_compatible_p(a, b)
";

/// One assertion for each alias, constant, struct, field and function.
pub fn write(found: &Declarations) -> String {
    let mut c = String::from(HEAD);
    for (name, alias) in &found.aliases {
        check(&mut c, &format!("same({}, {})", name, declare(alias, "")), name, "type");
    }
    for (name, kind, value) in &found.constants {
        let value = value.replace("u64::MAX", "UINT64_MAX");
        check(&mut c, &format!("{} == ({})", name, value), name, "value");
        check(&mut c, &format!("same(__typeof__({}), {})", name, declare(kind, "")), name, "type");
    }
    for one in &found.structs {
        writeln!(c, "struct rust_{} {{", one.name).unwrap();
        for (field, kind) in &one.fields {
            writeln!(c, "  {};", declare(kind, c_field(field))).unwrap();
        }
        c.push_str("};\n");
        for (field, kind) in &one.fields {
            let (place, field) = (format!("{}.{}", one.name, c_field(field)), c_field(field));
            let offset = format!("offsetof({0}, {1}) == offsetof(struct rust_{0}, {1})", one.name, field);
            check(&mut c, &offset, &place, "offset");
            let same = format!("same(__typeof__((({} *)0)->{}), {})", one.name, field, declare(kind, ""));
            check(&mut c, &same, &place, "type");
        }
        for property in ["sizeof", "_Alignof"] {
            check(&mut c, &format!("{0}({1}) == {0}(struct rust_{1})", property, one.name), &one.name, property);
        }
    }
    for one in &found.functions {
        let kind = declare(&one.result, &format!("({})", list(&one.arguments)));
        check(&mut c, &format!("same(__typeof__({}), {})", one.name, kind), &one.name, "signature");
    }
    c
}

fn check(c: &mut String, condition: &str, name: &str, what: &str) {
    writeln!(c, "_Static_assert({}, \"{}: {}\");", condition, name, what).unwrap();
}

/// `type` is a word of Rust.
pub fn c_field(name: &str) -> &str {
    name.strip_suffix('_').unwrap_or(name)
}

/// A declaration of C: of `name`, or of a type alone where that is empty.
fn declare(kind: &Type, name: &str) -> String {
    let around = |name: String, to: &Type| match to {
        Type::Array { .. } | Type::Function { .. } => format!("({})", name),
        _ => name,
    };
    match kind {
        Type::Nothing => format!("void {}", name),
        Type::Name(rust) => format!("{} {}", c_name(rust), name).trim().to_string(),
        Type::Pointer { mutable: true, to } => declare(to, &around(format!("*{}", name), to)),
        Type::Pointer { mutable: false, to } => {
            format!("const {}", declare(to, &around(format!("*{}", name), to)))
        }
        Type::Array { of, count } => declare(of, &format!("{}[{}]", name, count)),
        Type::Function { arguments, result } => declare(result, &format!("(*{})({})", name, list(arguments))),
    }
}

fn list(arguments: &[Type]) -> String {
    if arguments.is_empty() {
        return "void".to_string();
    }
    arguments.iter().map(|kind| declare(kind, "")).collect::<Vec<_>>().join(", ")
}

fn c_name(rust: &str) -> &str {
    match rust {
        "u8" => "uint8_t",
        "u32" => "uint32_t",
        "i32" => "int32_t",
        "u64" => "uint64_t",
        "f32" => "float",
        "f64" => "double",
        "c_char" => "char",
        "c_void" => "void",
        other => other,
    }
}
