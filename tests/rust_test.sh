# The crates against the library just built: tests, documentation, packages and examples, warnings denied.
# SPDX-License-Identifier: Apache-2.0
set -eu
export BDPT_LIB_DIR=$BDPT_BINARY_DIR/lib
[ -e "$BDPT_LIB_DIR/libbdpt.so" ] || exit 77
case $(nm -D "$BDPT_LIB_DIR/libbdpt.so") in *__asan_init*) exit 77 ;; esac  # which programs would have to link, too
command -v cargo > /dev/null || exit 77
export LD_LIBRARY_PATH=$BDPT_LIB_DIR${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
export CARGO_TARGET_DIR=$BDPT_BINARY_DIR/rust RUSTFLAGS="-D warnings" RUSTDOCFLAGS="-D warnings"
cd "$BDPT_SOURCE_DIR/bindings/rust"

# Debian's cargo comes without these.
if cargo fmt --version > /dev/null 2>&1; then cargo fmt --all --check; fi
if cargo clippy --version > /dev/null 2>&1; then
  cargo clippy --quiet --workspace --all-targets --features bdpt/ndarray -- -D warnings
fi

cargo test --quiet --locked --workspace --features bdpt/ndarray
cargo doc --quiet --locked --no-deps -p bdpt-sys -p bdpt --features bdpt/ndarray

cargo build --quiet --locked --examples -p bdpt
examples=$CARGO_TARGET_DIR/debug/examples
./check-examples "$examples"
# The same as the examples in C, to the byte.
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/c" "$folder/rust"
for example in bake_lightmap custom_measurement; do
  (cd "$folder/c" && "$BDPT_BINARY_DIR/examples/$example" > $example.txt 2> /dev/null)
  (cd "$folder/rust" && "$examples/$example" > $example.txt 2> /dev/null)
done
cmp "$folder/c/lightmap.exr" "$folder/rust/lightmap.exr"
cmp "$folder/c/lightmap.png" "$folder/rust/lightmap.png"
cmp "$folder/c/custom_measurement.txt" "$folder/rust/custom_measurement.txt"
