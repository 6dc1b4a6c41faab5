// SPDX-License-Identifier: Apache-2.0

//! The C compiler: that of the environment's CC, else cc.

use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};

/// Runs it over a text; what it wrote to standard output, or its messages if it failed.
pub fn run(arguments: &[&str], include: &Path, text: &str) -> Result<String, String> {
    let cc = std::env::var("CC").unwrap_or_else(|_| "cc".to_string());
    let mut child = Command::new(&cc)
        .args(["-std=c11", "-Wall", "-Wextra", "-Werror", "-I"])
        .arg(include)
        .args(arguments)
        .args(["-x", "c", "-"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(|error| format!("{}: {}", cc, error))?;
    if let Some(mut input) = child.stdin.take() {
        input.write_all(text.as_bytes()).map_err(|error| error.to_string())?;
    }
    let Output { status, stdout, stderr } = child.wait_with_output().map_err(|error| error.to_string())?;
    if !status.success() {
        return Err(String::from_utf8_lossy(&stderr).into_owned());
    }
    String::from_utf8(stdout).map_err(|error| error.to_string())
}

/// Whether a text compiles; its messages if not.
pub fn check(include: &Path, text: &str) -> Result<(), String> {
    run(&["-fsyntax-only"], include, text).map(|_| ())
}
