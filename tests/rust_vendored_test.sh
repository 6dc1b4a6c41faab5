# The crates with the library that they build themselves from the sources in the package; and the packages.
# SPDX-License-Identifier: Apache-2.0
set -eu
[ -e "$BDPT_BINARY_DIR/lib/libbdpt.so" ] || exit 77
command -v cargo > /dev/null || exit 77
unset BDPT_LIB_DIR LD_LIBRARY_PATH PKG_CONFIG_PATH
export CARGO_TARGET_DIR=$BDPT_BINARY_DIR/rust-vendored RUSTFLAGS="-D warnings" RUSTDOCFLAGS="-D warnings"
export BDPT_CODE_ISAS=baseline  # one is enough to see that it works
cd "$BDPT_SOURCE_DIR/bindings/rust"
cargo test --quiet --locked -p bdpt-sys -p bdpt --features bdpt/vendored,bdpt/ndarray

# What was built for them is a static library that any program can link.
installed=$(dirname "$(dirname "$(find "$CARGO_TARGET_DIR/debug/build" -path '*/install/lib/libbdpt.a' | head -1)")")
"$BDPT_SOURCE_DIR/scripts/check-package" "$installed" static
cargo doc --quiet --locked --no-deps -p bdpt-sys -p bdpt --features bdpt/vendored,bdpt/ndarray
