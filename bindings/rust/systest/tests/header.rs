// SPDX-License-Identifier: Apache-2.0

//! bdpt-sys declares what the header does.

use std::fmt::Write;
use systest::names::Names;
use systest::rust::{parse, read_text, Declarations};
use systest::{compiler, declarations, header, include, mirror};

/// Lines of names and numbers, as the C program below writes them.
macro_rules! layout_of {
    ($lines:ident, $name:ident, [$($field:ident,)*]) => {{
        use bdpt_sys::$name;
        $lines.push(format!(
            "{} {} {}",
            stringify!($name),
            std::mem::size_of::<$name>(),
            std::mem::align_of::<$name>()
        ));
        let one = std::mem::MaybeUninit::<$name>::uninit();
        let base = one.as_ptr();
        $({
            // SAFETY: the address of a field is taken, nothing is read.
            let field = unsafe { std::ptr::addr_of!((*base).$field) };
            let name = stringify!($field);
            let offset = field as usize - base as usize;
            $lines.push(format!("{}.{} {} {}", stringify!($name), mirror::c_field(name), offset, size_behind(field)));
        })*
    }};
}

fn size_behind<T>(_: *const T) -> usize {
    std::mem::size_of::<T>()
}

mod tables {
    use super::*;
    include!(concat!(env!("OUT_DIR"), "/tables.rs"));
}

fn ours() -> Declarations {
    parse(&read_text(&declarations())).unwrap()
}

#[test]
fn types_constants_and_signatures_are_the_headers() {
    if let Err(messages) = compiler::check(&include(), &mirror::write(&ours())) {
        panic!("{}", messages);
    }
}

#[test]
fn sizes_alignments_and_offsets_of_rustc_are_those_of_the_c_compiler() {
    let mut c = String::from("#include <bdpt.h>\n#include <stdio.h>\nint main(void) {\n");
    for one in &ours().structs {
        let name = &one.name;
        writeln!(c, "  printf(\"{0} %zu %zu\\n\", sizeof({0}), _Alignof({0}));", name).unwrap();
        for (field, _) in &one.fields {
            let field = mirror::c_field(field);
            let size = format!("sizeof((({} *)0)->{})", name, field);
            writeln!(c, "  printf(\"{0}.{1} %zu %zu\\n\", offsetof({0}, {1}), {2});", name, field, size).unwrap();
        }
    }
    c.push_str("  return 0;\n}\n");
    let program = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("layout");
    compiler::run(&["-o", program.to_str().unwrap()], &include(), &c).unwrap();
    let output = std::process::Command::new(&program).output().unwrap();
    let theirs = String::from_utf8(output.stdout).unwrap();
    assert!(theirs.lines().count() > 500);
    assert_eq!(theirs.lines().collect::<Vec<_>>(), tables::layout());
}

#[test]
fn every_name_of_the_header_is_declared_and_no_other() {
    let (ours, theirs) = (Names::from(&ours()), header::names(&include()).unwrap());
    assert_eq!(theirs.without(&ours), [""; 0], "names of the header that bdpt-sys lacks");
    assert_eq!(ours.without(&theirs), [""; 0], "names of bdpt-sys that the header lacks");
    // What was read is all there is: the counts of another look at the header's text.
    let text = std::fs::read_to_string(include().join("bdpt.h")).unwrap();
    assert_eq!(theirs.functions.len(), text.lines().filter(|line| line.starts_with("BDPT_API ")).count());
    assert_eq!(theirs.types.len(), text.lines().filter(|line| line.starts_with("typedef ")).count());
}

#[test]
fn the_library_has_every_function() {
    for (name, address) in tables::addresses() {
        assert!(!address.is_null(), "{}", name);
    }
}

#[test]
fn defaults_set_struct_size() {
    for (name, size, expected) in tables::struct_sizes() {
        assert_eq!(size as usize, expected, "{}", name);
    }
    let with = ours().structs.iter().filter(|one| one.fields[0].0 == "struct_size").count();
    assert_eq!(tables::struct_sizes().len(), with);
}

#[test]
fn the_library_is_of_the_declared_abi() {
    assert!(bdpt_sys::is_compatible(unsafe { bdpt_sys::bdpt_abi_version() }));
    assert!(!bdpt_sys::is_compatible(bdpt_sys::BDPT_ABI + 1));
}

#[test]
fn another_abi_is_refused_by_name() {
    let mut context = std::ptr::null_mut();
    let other = bdpt_sys::BDPT_ABI + 41;
    let result = unsafe { bdpt_sys::bdpt_context_create(other, std::ptr::null(), &mut context) };
    assert_eq!(result, bdpt_sys::BDPT_ERROR_ABI);
    assert!(context.is_null());
    let text = unsafe { std::ffi::CStr::from_ptr(bdpt_sys::bdpt_last_error()) }.to_str().unwrap();
    assert!(text.contains("42") && text.contains('1'), "{}", text);
}
