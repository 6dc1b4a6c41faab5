# The examples, each run where nothing else is.
# SPDX-License-Identifier: Apache-2.0
set -eu
examples=$BDPT_BINARY_DIR/examples
[ -x "$examples/hello" ] || exit 77
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

"$examples/hello"
[ -s hello.png ]
"$examples/bake_lightmap" 2> progress.txt
[ -s lightmap.png ] && [ -s lightmap.exr ]
grep -q '100 %' progress.txt
# A leaf alone measures 2 pi times its area; among others it gets less, and takes up part of that.
"$examples/custom_measurement" > leaves.txt
awk '/alone/ { d = $4 - $NF; exit !(d * d < 1e-5 * $NF * $NF) }' leaves.txt
awk '/^ *[0-9]/ { ++n; if (!($2 > 0.3 && $2 < 0.754 && $3 > 0.7 * $2 && $3 < 0.82 * $2)) exit 1 } END { exit n != 12 }' leaves.txt
