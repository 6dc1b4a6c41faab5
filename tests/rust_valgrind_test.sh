# What safe Rust can do to the library is free of invalid reads and writes: the crate's tests under valgrind.
# SPDX-License-Identifier: Apache-2.0
set -eu
export BDPT_LIB_DIR=$BDPT_BINARY_DIR/lib
[ -e "$BDPT_LIB_DIR/libbdpt.so" ] || exit 77
command -v cargo > /dev/null && command -v valgrind > /dev/null || exit 77
# valgrind knows no AVX-512: a library for this machine alone may have it.
[ "$BDPT_DISPATCH" = ON ] || exit 77
export LD_LIBRARY_PATH=$BDPT_LIB_DIR${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH} BDPT_ISA=baseline
export CARGO_TARGET_DIR=$BDPT_BINARY_DIR/rust-valgrind
cd "$BDPT_SOURCE_DIR/bindings/rust"
runner="valgrind -q --error-exitcode=9 --leak-check=full --show-leak-kinds=definite --errors-for-leak-kinds=definite"
export CARGO_TARGET_X86_64_UNKNOWN_LINUX_GNU_RUNNER=$runner
# Without two that measure long, by calls that others make too.
cargo test --quiet --locked -p bdpt --features ndarray --lib --tests -- --test-threads 1 \
  --skip a_bake_has_its_caustic_its_shadow_and_its_light --skip host_functions_measure_what_the_library_does
