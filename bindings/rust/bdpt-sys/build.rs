// To be replaced by the real one.
fn main() {
    println!("cargo:rerun-if-env-changed=BDPT_LIB_DIR");
    println!("cargo:rustc-link-search=native={}", std::env::var("BDPT_LIB_DIR").expect("BDPT_LIB_DIR"));
    println!("cargo:rustc-link-lib=dylib=bdpt");
}
