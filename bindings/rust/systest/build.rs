// SPDX-License-Identifier: Apache-2.0

//! Writes what rustc makes of the declarations into tables that the tests compare with the header's.

#[path = "src/rust.rs"]
#[allow(dead_code)]
mod rust;
#[path = "src/token.rs"]
#[allow(dead_code)]
mod token;

use std::env;
use std::fmt::Write;
use std::path::PathBuf;

fn main() {
    let sources = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").expect("Cargo sets it")).join("../bdpt-sys/src");
    println!("cargo:rerun-if-changed={}", sources.display());
    let found = rust::parse(&rust::read_text(&sources)).expect("declarations that are understood");

    let mut out = String::from("pub fn layout() -> Vec<String> {\n  let mut lines = Vec::new();\n");
    for one in &found.structs {
        writeln!(out, "  layout_of!(lines, {}, [", one.name).unwrap();
        for (field, _) in &one.fields {
            writeln!(out, "    {},", field).unwrap();
        }
        out.push_str("  ]);\n");
    }
    out.push_str("  lines\n}\npub fn addresses() -> Vec<(&'static str, *const ())> {\n  vec![\n");
    for one in &found.functions {
        writeln!(out, "    (\"{0}\", bdpt_sys::{0} as *const ()),", one.name).unwrap();
    }
    out.push_str("  ]\n}\npub fn struct_sizes() -> Vec<(&'static str, u32, usize)> {\n  vec![\n");
    for name in &found.sized {
        let size = format!("bdpt_sys::{}::default().struct_size", name);
        writeln!(out, "    (\"{0}\", {1}, std::mem::size_of::<bdpt_sys::{0}>()),", name, size).unwrap();
    }
    out.push_str("  ]\n}\n");
    let path = PathBuf::from(env::var_os("OUT_DIR").expect("Cargo sets it")).join("tables.rs");
    std::fs::write(&path, out).unwrap_or_else(|error| panic!("{:?}: {}", path, error));
}
