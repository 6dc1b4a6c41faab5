# Both crates can be packed, bdpt-sys with the library's sources, and find the library wherever it is installed; they are
# built by the oldest compiler that they promise.
# SPDX-License-Identifier: Apache-2.0
set -eu
[ -e "$BDPT_BINARY_DIR/lib/libbdpt.so" ] || exit 77
case $(nm -D "$BDPT_BINARY_DIR/lib/libbdpt.so") in *__asan_init*) exit 77 ;; esac  # which programs would have to link, too
command -v cargo > /dev/null || exit 77
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
for component in library development; do
  cmake --install "$BDPT_BINARY_DIR" --prefix "$folder/installed" --component $component > /dev/null
done
cd "$BDPT_SOURCE_DIR/bindings/rust"
./test-linking "$folder/installed"

export BDPT_LIB_DIR=$BDPT_BINARY_DIR/lib LD_LIBRARY_PATH=$BDPT_BINARY_DIR/lib
CARGO_TARGET_DIR=$folder/package cargo package --quiet --allow-dirty -p bdpt-sys
# bdpt names bdpt-sys by version, which cargo can resolve from the neighbouring package since 1.90.
if CARGO_TARGET_DIR=$folder/package cargo package --quiet --allow-dirty -p bdpt-sys -p bdpt 2> "$folder/log"; then
  [ -s "$folder"/package/package/bdpt-0.1.0.crate ]
else
  cargo --version | grep -qE ' 1\.([0-9]|[1-8][0-9])\.' || { cat "$folder/log"; exit 1; }
fi

export CARGO_TARGET_DIR=$BDPT_BINARY_DIR/rust-oldest
status=0
./test-oldest test --quiet --workspace --features bdpt/ndarray --lib --test panics --test drops --test misuse || status=$?
[ $status = 0 ] || [ $status = 77 ]
