// SPDX-License-Identifier: Apache-2.0

//! Finds libbdpt and tells Cargo how to link it: in the folder BDPT_LIB_DIR, else built from the sources of this
//! package (feature `vendored`), else where pkg-config knows it.

mod found;
mod vendored;

use std::env;
use std::process::exit;

fn main() {
    println!("cargo:rerun-if-changed=build");
    for name in ["BDPT_LIB_DIR", "BDPT_INCLUDE_DIR", "DOCS_RS"] {
        println!("cargo:rerun-if-env-changed={}", name);
    }
    if env::var_os("DOCS_RS").is_some() {
        return; // Documentation needs no library.
    }
    let result = if let Some(folder) = env::var_os("BDPT_LIB_DIR") {
        found::in_folder(folder.as_ref(), env::var_os("BDPT_INCLUDE_DIR").as_ref().map(AsRef::as_ref))
    } else if env::var_os("CARGO_FEATURE_VENDORED").is_some() {
        vendored::build()
    } else {
        found::by_pkg_config()
    };
    if let Err(text) = result {
        eprintln!("error: {}", text);
        exit(1);
    }
}
