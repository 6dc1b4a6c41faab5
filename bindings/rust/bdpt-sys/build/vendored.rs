// SPDX-License-Identifier: Apache-2.0

//! The library built from the sources in this package, by CMake, without a network. What it stands on (Embree, oneTBB,
//! OpenEXR, OpenColorIO, libpng) is the system's.

use crate::found;
use std::env;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

const NEEDS: &str = "\
The feature `vendored` needs CMake 3.25, a C++20 compiler and the development files of Embree 3.13 or 4, oneTBB,
OpenEXR 3, OpenColorIO 2 and libpng. On Debian:
  apt install cmake g++ pkg-config libembree-dev libtbb-dev libopenexr-dev libopencolorio-dev libpng-dev";

/// Instruction sets to compile for, as the CMake option of this name; by default all that the library may choose from
/// when it is loaded. Fewer are quicker to build.
const CODE_ISAS: &str = "BDPT_CODE_ISAS";

pub fn build() -> Result<(), String> {
    for name in ["CMAKE", "CMAKE_GENERATOR", "CMAKE_TOOLCHAIN_FILE", "CMAKE_PREFIX_PATH", "CXX", "CC", CODE_ISAS] {
        println!("cargo:rerun-if-env-changed={}", name);
    }
    let sources = variable("CARGO_MANIFEST_DIR")?.join("bdpt");
    for name in ["CMakeLists.txt", "cmake", "include", "src"] {
        println!("cargo:rerun-if-changed={}", sources.join(name).display());
    }
    if env::var_os("TARGET") != env::var_os("HOST") && env::var_os("CMAKE_TOOLCHAIN_FILE").is_none() {
        return Err(
            "to build bdpt for another machine, set CMAKE_TOOLCHAIN_FILE to a file that tells CMake of it.".into()
        );
    }
    let out = variable("OUT_DIR")?;
    let (tree, prefix) = (out.join("build"), out.join("install"));

    let mut configure = cmake();
    configure.arg("-S").arg(&sources).arg("-B").arg(&tree);
    configure.arg(define("CMAKE_INSTALL_PREFIX", &prefix));
    // Debug builds of the library are for who works on it, and some thirty times slower.
    configure.args(["-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_INSTALL_LIBDIR=lib", "-DBUILD_SHARED_LIBS=OFF"]);
    for part in ["TOOL", "TESTS", "EXAMPLES", "BENCHMARKS"] {
        configure.arg(format!("-DBDPT_BUILD_{}=OFF", part));
    }
    configure.args(["-DBDPT_NATIVE=OFF", "-DCMAKE_UNITY_BUILD=ON"]);
    if let Ok(isas) = env::var(CODE_ISAS) {
        configure.arg(format!("-DBDPT_CODE_ISAS={}", isas.replace(',', ";")));
    }
    run(configure)?;

    let mut compile = cmake();
    compile.arg("--build").arg(&tree);
    if let Ok(jobs) = env::var("NUM_JOBS") {
        compile.args(["--parallel", &jobs]);
    }
    run(compile)?;

    let mut install = cmake();
    install.arg("--install").arg(&tree);
    run(install)?;

    found::in_folder(&prefix.join("lib"), Some(&prefix.join("include")))
}

fn cmake() -> Command {
    Command::new(env::var_os("CMAKE").unwrap_or_else(|| "cmake".into()))
}

fn variable(name: &str) -> Result<PathBuf, String> {
    env::var_os(name).map(PathBuf::from).ok_or_else(|| format!("{} is not set: this is to be run by Cargo.", name))
}

fn define(name: &str, value: &Path) -> OsString {
    let mut argument = OsString::from(format!("-D{}=", name));
    argument.push(value);
    argument
}

/// Cargo shows what a command says when it, and with it the build, has failed.
fn run(mut command: Command) -> Result<(), String> {
    let said = format!("{:?}", command);
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("{} failed ({}).\n{}", said, status, NEEDS)),
        Err(error) => Err(format!("{} could not be started: {}.\n{}", said, error, NEEDS)),
    }
}
