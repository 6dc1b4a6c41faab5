# What `cmake --install` installs is all that a stranger's program needs: see scripts/check-package.
# SPDX-License-Identifier: Apache-2.0
set -eu
[ -e "$BDPT_BINARY_DIR/lib/libbdpt.so" ] || exit 77
case $(nm -D "$BDPT_BINARY_DIR/lib/libbdpt.so") in *__asan_init*) exit 77 ;; esac  # which programs would have to link, too
command -v pkg-config > /dev/null || exit 77
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
for component in library development; do
  cmake --install "$BDPT_BINARY_DIR" --prefix "$folder/installed" --component $component > /dev/null
done
# And it may be moved.
mkdir "$folder/elsewhere"
mv "$folder/installed" "$folder/elsewhere/prefix"
"$BDPT_SOURCE_DIR/scripts/check-package" "$folder/elsewhere/prefix"
