// SPDX-License-Identifier: Apache-2.0

//! A library that is there already.

use std::env;
use std::path::Path;

const WHAT_TO_DO: &str = "\
Do one of these:
  - install the library with its development files, so that `pkg-config --modversion bdpt` finds it;
    in a folder of its own, add its lib/pkgconfig to PKG_CONFIG_PATH;
  - set BDPT_LIB_DIR to the folder that holds libbdpt.so or libbdpt.a
    (and BDPT_INCLUDE_DIR to that of bdpt.h, for C code of yours);
  - turn on the feature `vendored` of bdpt-sys (or of bdpt), which builds the library from the sources in the package
    with CMake and a C++20 compiler.";

/// The library in `folder`; shared where both kinds are there.
pub fn in_folder(folder: &Path, include: Option<&Path>) -> Result<(), String> {
    if !has_shared(folder) && !has_static(folder) {
        return Err(format!(
            "BDPT_LIB_DIR is {:?}, where there is neither libbdpt.so nor libbdpt.a.\n{}",
            folder, WHAT_TO_DO
        ));
    }
    let nearby = folder.join("../include");
    let include = include.or_else(|| Some(nearby.as_path()).filter(|folder| folder.join("bdpt.h").is_file()));
    if has_shared(folder) {
        println!("cargo:rustc-link-search=native={}", folder.display());
        println!("cargo:rustc-link-lib=dylib=bdpt");
    } else {
        statically(folder)?;
    }
    if let Some(include) = include {
        if !include.join("bdpt.h").is_file() {
            return Err(format!("BDPT_INCLUDE_DIR is {:?}, where there is no bdpt.h.", include));
        }
        println!("cargo:include={}", include.display());
    }
    Ok(())
}

fn has_shared(folder: &Path) -> bool {
    ["libbdpt.so", "libbdpt.dylib", "bdpt.lib"].iter().any(|name| folder.join(name).is_file())
}

fn has_static(folder: &Path) -> bool {
    folder.join("libbdpt.a").is_file()
}

/// libbdpt.a of an installation: pkgconfig/bdpt.pc beside it names all that it stands on.
pub fn statically(folder: &Path) -> Result<(), String> {
    let ours = folder.join("pkgconfig");
    let mut search = vec![ours];
    if let Some(others) = env::var_os("PKG_CONFIG_PATH") {
        search.extend(env::split_paths(&others));
    }
    let search = env::join_paths(search).map_err(|error| error.to_string())?;
    env::set_var("PKG_CONFIG_PATH", search);
    probe(true).map_err(|error| {
        format!(
            "{:?} holds libbdpt.a, but pkg-config cannot tell from pkgconfig/bdpt.pc there what it stands on.\n\
             {}\n{}",
            folder, error, WHAT_TO_DO
        )
    })
}

/// The library that pkg-config knows; shared where both kinds are there.
pub fn by_pkg_config() -> Result<(), String> {
    let folder = pkg_config::get_variable("bdpt", "libdir").unwrap_or_default();
    let statik = has_static(folder.as_ref()) && !has_shared(folder.as_ref());
    probe(statik).map_err(|error| format!("libbdpt was not found.\n{}\n{}", WHAT_TO_DO, error))
}

fn probe(statik: bool) -> Result<(), String> {
    // A library of an older minor version lacks functions that are declared here.
    let version = concat!(env!("CARGO_PKG_VERSION_MAJOR"), ".", env!("CARGO_PKG_VERSION_MINOR"));
    let mut config = pkg_config::Config::new();
    config.atleast_version(version);
    if statik {
        config.statik(true);
    }
    let library = config.probe("bdpt").map_err(|error| error.to_string())?;
    let include = library.include_paths.iter().find(|path| path.join("bdpt.h").is_file());
    if let Some(include) = include {
        println!("cargo:include={}", include.display());
    }
    Ok(())
}
