# The examples, each run where nothing else is, and their pictures looked at: at places where what is seen is known.
# SPDX-License-Identifier: Apache-2.0
set -eu
examples=$BDPT_BINARY_DIR/examples
[ -x "$examples/hello" ] || exit 77
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
fail() { echo "$*" >&2; exit 1; }

# near FILE TOLERANCE R G B [X0 Y0 X1 Y1]: the means of a picture or of a rectangle of it, 0 to 255.
near() {
  file=$1 tolerance=$2 r=$3 g=$4 b=$5
  shift 5
  means=$("$BDPT_BINARY_DIR/tests/picture_mean" "$file" "$@")
  echo "$means" | awk -v t="$tolerance" -v r="$r" -v g="$g" -v b="$b" '
    function off(x, y) { return (x > y ? x - y : y - x) > t }
    { exit off($3, r) || off($4, g) || off($5, b) }' || fail "$file $*: $means, not $r $g $b"
}

# A header's manual is no longer than a screen.
[ "$(wc -l < "$BDPT_SOURCE_DIR/examples/c/hello.c")" -le 60 ] || fail "hello.c has more than 60 lines"
"$examples/hello"
# In the middle 20 W/sr at a distance of 7.004^½, from 40.9 degrees off the normal, by the sRGB curve.
near hello.png 1 195.6 158.4 103.6 180 160 220 180
near hello.png 0 0 0 0 0 0 70 300
[ "$("$BDPT_BINARY_DIR/tests/picture_mean" hello.png | cut -d' ' -f1,2)" = '400 300' ]

"$examples/bake_lightmap" 2> progress.txt
[ -s lightmap.png ] && [ -s lightmap.exr ]
grep -q '100 %' progress.txt
# The floor in the light, in the shadow of the ball of glass, and where that gathers light; a wall, and its dark top.
near lightmap.png 6 139 139 139 0 0 30 256
near lightmap.png 12 69 69 69 34 100 42 125
near lightmap.png 12 251 251 251 52 108 61 120
near lightmap.png 6 135 135 135 130 180 256 256
near lightmap.png 6 34 34 34 130 0 256 8

# A leaf alone measures 2 pi times its area; among others it gets less, and takes up part of that.
"$examples/custom_measurement" > leaves.txt
awk '/alone/ { d = $4 - $NF; exit !(d * d < 1e-5 * $NF * $NF) }' leaves.txt
awk '/^ *[0-9]/ { ++n; if (!($2 > 0.3 && $2 < 0.754 && $3 > 0.7 * $2 && $3 < 0.82 * $2)) exit 1 } END { exit n != 12 }' leaves.txt

# The host's own log, limit and threads. The sky is constant; the floor has the sun's irradiance and the sky's, in part
# hidden by the ball, which gives some of it back.
"$examples/embed_in_host" 16 > report.txt 2> log.txt
grep -q '^\[warning\] .*1 of 3 triangles' log.txt || fail "no log: $(cat log.txt)"
grep -q '1024 x 1024 pixels: .*memory_limit of 67108864' log.txt || fail "nothing of memory: $(cat log.txt)"
grep -q 'done after 16 passes of 256 x 256 pixels, [1-9]' report.txt || fail "$(cat report.txt)"
awk '/^memory/ { n = $4 } END { exit !(n > 0 && n <= 67108864) }' report.txt
awk '/^threads/ { n = $2; m = $6 } END { exit n != m }' report.txt || fail "$(cat report.txt)"
near embed_in_host.png 1 124 149 187.5 0 0 256 90
near embed_in_host.png 5 193.6 198.7 210.5 0 220 256 256
# Ctrl-C ends it with the picture so far.
rm embed_in_host.png
"$examples/embed_in_host" 1000000 > report.txt 2> log.txt &
host=$!
for i in $(seq 600); do grep -q '%' log.txt && break || sleep 0.1; done
kill -INT $host
wait $host || fail "Ctrl-C ended it with $?: $(cat log.txt)"
grep -q '^cancelled after' report.txt || fail "$(cat report.txt)"
[ -s embed_in_host.png ]

# The same scene from C and from C++ is the same picture.
mkdir c
"$examples/cornell_box" c 16 256 > /dev/null 2>&1
"$examples/cornell_box_cpp" 16 2> /dev/null
cmp c/cornell_box.png cornell_box.png
[ -s c/cornell_box.exr ] && [ -s c/cornell_box_pyramid.png ]
near cornell_box.png 6 118 11 11 0 100 30 160     # red on the left,
near cornell_box.png 6 44 96 32 226 100 256 160   # green on the right,
near cornell_box.png 1 255 255 255 106 28 150 38  # and the lamp
