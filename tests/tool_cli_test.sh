# The program as its users meet it: exit codes, one line for an error, merge and resume to the bit, Ctrl-C.
# SPDX-License-Identifier: Apache-2.0
set -u
[ -x "${BDPT_TOOL:-}" ] || { echo "BDPT_TOOL is not set"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
failures=0

fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

# expect CODE PATTERN ARGUMENTS...: the exit code, and one line on stderr that matches (none for an empty pattern).
expect() {
  local code=$1 pattern=$2
  shift 2
  "$BDPT_TOOL" "$@" >stdout.txt 2>stderr.txt
  local got=$?
  [ $got -eq "$code" ] || fail "bdpt $*: exit code $got, not $code: $(cat stderr.txt)"
  if [ -z "$pattern" ]; then
    [ ! -s stderr.txt ] || fail "bdpt $*: $(cat stderr.txt)"
  else
    [ "$(wc -l <stderr.txt)" -eq 1 ] || fail "bdpt $*: not one line: $(cat stderr.txt)"
    grep -qE -- "$pattern" stderr.txt || fail "bdpt $*: '$(cat stderr.txt)' does not match '$pattern'"
  fi
}

cat >box.pbrt <<'SCENE'
Integrator "path" "integer maxdepth" 4
LookAt 0 0 5  0 0 0  0 1 0
Film "rgb" "integer xresolution" 32 "integer yresolution" 24
Camera "perspective" "float fov" 40
WorldBegin
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [5 5 5]
  Translate 0 2 0
  Shape "sphere" "float radius" .3
AttributeEnd
Material "diffuse" "rgb reflectance" [.8 .5 .2]
Shape "trianglemesh" "point3 P" [-3 -1 -3  3 -1 -3  3 -1 3  -3 -1 3] "integer indices" [0 2 1 0 3 2]
Shape "sphere" "float radius" .7
SCENE
printf 'Camera "perspective"\nWorldBegin\nShape "torus"\n' >torus.pbrt
# One triangle that emits from both sides.
cat >triangle.gltf <<'SCENE'
{"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "children": [1]}, {"camera": 0, "translation": [0.3, 0.3, 3]}],
 "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
 "materials": [{"emissiveFactor": [1, 1, 1], "doubleSided": true}],
 "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}]}
SCENE
sed 's/"mesh": 0/"mesh": 1/' triangle.gltf >no-mesh.gltf
cp triangle.gltf triangle.3ds

expect 0 '' --version
expect 0 '' render --help
expect 2 '^bdpt: .*subcommand'
expect 2 '^bdpt: .*--output' render box.pbrt
expect 2 '^bdpt: .*greater than zero' render box.pbrt -o a.exr --spp 0
expect 2 '^bdpt: .*must end in .exr' render box.pbrt -o a.png
expect 2 '^bdpt: .*--techniques' render box.pbrt -o a.exr --techniques 's<'
expect 2 '^bdpt: --passes' render box.pbrt -o a.exr --passes 4:4
expect 3 "^bdpt: torus.pbrt:3: .*'torus' is not known" render torus.pbrt -o a.exr
expect 3 '^bdpt: .*no.pbrt' render no.pbrt -o a.exr
expect 4 '^bdpt: --output: there is no folder' render box.pbrt -o no/a.exr

# A picture of passes 0:4 is the same to the bit when made at once, merged, or resumed.
expect 0 '' render box.pbrt -o full.exr --spp 4 --film full.film --json
grep -q '"relative_error"' stdout.txt || fail "no JSON"
expect 0 '' render box.pbrt -o a.exr --passes 0:2 --film a.film
expect 0 '' render box.pbrt -o b.exr --passes 2:4 --film b.film
expect 0 '' merge b.film a.film -o sum.film
expect 0 '' resolve sum.film -o sum.exr --png sum.png
cmp -s full.exr sum.exr || fail "the merged picture differs"
expect 0 '' render box.pbrt -o resumed.exr --spp 4 --film a.film --resume
cmp -s full.exr resumed.exr || fail "the resumed picture differs"
expect 5 '^bdpt: ' merge a.film b.film -o never.film
expect 5 '^bdpt: ' render box.pbrt -o x.exr --spp 8 --film a.film --resume --seed 1
expect 3 '^bdpt: full.exr: ' merge full.exr a.film -o never.film
[ ! -e never.film ] || fail "a failed merge left a file"

expect 0 '' compare full.exr sum.film --json --diff diff.png
grep -q '"mse": 0,' stdout.txt || fail "equal pictures differ: $(cat stdout.txt)"
expect 0 '' render box.pbrt -o small.exr --spp 1 --width 16 --height 12
expect 5 '^bdpt: .*of one size' compare full.exr small.exr
for side in '--width 16' '--height 12'; do  # the other by the file's shape
  expect 0 '' render box.pbrt -o shaped.exr --spp 1 $side
  expect 0 '' compare small.exr shaped.exr --json
  grep -q '"mse": 0,' stdout.txt || fail "$side is another picture: $(cat stdout.txt)"
done

expect 0 '' render triangle.gltf -o triangle.exr --spp 1 --width 16 --height 12
expect 0 '' info triangle.gltf
grep -q 'lights *1' stdout.txt || fail "info: $(cat stdout.txt)"
expect 3 '^bdpt: no-mesh.gltf: nodes\[0\].mesh is 1, and meshes has 1 element$' info no-mesh.gltf
expect 3 '^bdpt: .*no.glb' render no.glb -o a.exr
expect 3 '^bdpt: triangle.3ds: .*pbrt-v4 .*glTF 2.0 .*OBJ .*PLY' info triangle.3ds
expect 0 '' info triangle.gltf --scene 0
expect 3 "^bdpt: triangle.gltf: there is no scene '1' in it; there are scenes.0.\$" info triangle.gltf --scene 1
expect 2 '^bdpt: --scene: only glTF' info box.pbrt --scene 1

expect 0 '' info box.pbrt
grep -q 'spheres *2' stdout.txt || fail "info: $(cat stdout.txt)"

expect 0 '' render box.pbrt -o p.exr --spp 1 --max-edges 2 --pyramid pyramid
for name in s0t2 s1t1 s0t3 s1t2 s2t1; do
  [ -s pyramid/$name.exr ] && [ -s pyramid/$name.png ] || fail "the pyramid has no $name"
done
[ -s pyramid/pyramid.png ] || fail "the pyramid has no sheet"

# Rendering spaces, and views of a configuration; $OCIO is not read.
cat > user.ocio <<'OCIO'
ocio_profile_version: 2
roles: {aces_interchange: ap0, default: ap0, scene_linear: ap0}
displays:
  Screen:
    - !<View> {name: Whole, colorspace: ap0}
    - !<View> {name: Half, colorspace: halved}
  Wall:
    - !<View> {name: Half, colorspace: halved}
colorspaces:
  - !<ColorSpace> {name: ap0}
  - !<ColorSpace> {name: log, to_scene_reference: !<ExponentTransform> {value: [2, 2, 2, 1]}}
  - !<ColorSpace> {name: halved, from_scene_reference: !<MatrixTransform> {matrix: [0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 1]}}
OCIO
export OCIO=$PWD/no-such.ocio
expect 0 '' render box.pbrt -o acescg.exr --spp 4 --working-space acescg --png acescg.png --view aces --film acescg.film
expect 0 '' compare acescg.exr full.exr
expect 0 '' resolve acescg.film -o again.exr --working-space acescg
cmp -s acescg.exr again.exr || fail "the film's picture in its space differs"
expect 5 '^bdpt: ' merge acescg.film full.film -o never.film
expect 0 '' render box.pbrt -o u.exr --spp 1 --config user.ocio --working-space ap0 --view Half --png half.png
expect 0 '' render box.pbrt -o u.exr --spp 1 --config user.ocio --working-space ap0 --display Wall --png wall.png
cmp -s half.png wall.png || fail "the view of a display differs"
expect 0 '' render box.pbrt -o u.exr --spp 1 --config user.ocio --display Screen --view Whole --exposure -1 --png whole.png
expect 2 "^bdpt: .*'filmic' is not known; choose one of: aces, srgb" render box.pbrt -o u.exr --view filmic
expect 2 '^bdpt: --display needs --config' render box.pbrt -o u.exr --display Wall
expect 2 '^bdpt: --display goes with' render box.pbrt -o u.exr --config user.ocio --display Wall --view srgb
expect 3 "^bdpt: .*did you mean 'ACEScg'" render box.pbrt -o u.exr --working-space ACESgc
expect 3 "^bdpt: .*'log' is not linear" render box.pbrt -o u.exr --config user.ocio --working-space log
expect 3 '^bdpt: .*no.ocio' render box.pbrt -o u.exr --config no.ocio
expect 3 "^bdpt: .*did you mean 'Half'" render box.pbrt -o never.exr --spp 1 --config user.ocio --view Hlf --png u.png
[ ! -e never.exr ] || fail "it rendered before it looked at the view"
unset OCIO

# Cameras where the file's stands, and exposures of a photograph.
for camera in perspective equidistant equisolid equirectangular; do
  expect 0 '' render box.pbrt -o $camera.exr --spp 1 --camera $camera
done
expect 0 '' render box.pbrt -o orthographic.exr --spp 1 --camera orthographic --field-height 4
expect 0 '' render box.pbrt -o cube.exr --spp 1 --camera cube --width 48 --height 8
expect 3 '^bdpt: .*six square faces' render box.pbrt -o x.exr --spp 1 --camera cube
expect 3 '^bdpt: .*field_height' render box.pbrt -o x.exr --spp 1 --camera orthographic
expect 2 "^bdpt: .*'torus' is not known" render box.pbrt -o x.exr --camera torus

# Layers beside the picture, which stays what it is; a denoiser that is not there is told of before the render.
expect 0 '' render box.pbrt -o layers.exr --spp 4 --outputs albedo,normal,depth,direct,group:0,cryptoobject,samples
"$BDPT_TOOL" compare layers.exr full.exr --json >same.json || fail "compare"
grep -q '"mse": 0,' same.json || fail "outputs changed the picture: $(cat same.json)"
expect 2 "^bdpt: --outputs: 'colour' is not known" render box.pbrt -o x.exr --outputs colour
expect 2 "^bdpt: --outputs: 'group:64' names no group" render box.pbrt -o x.exr --outputs group:64
"$BDPT_TOOL" render box.pbrt -o denoised.exr --spp 1 --denoise >stdout.txt 2>stderr.txt
case $? in
  0) [ -s denoised.exr ] || fail "--denoise wrote nothing" ;;
  2) grep -q '^bdpt: --denoise needs Open Image Denoise' stderr.txt || fail "--denoise: $(cat stderr.txt)" ;;
  *) fail "--denoise: $(cat stderr.txt)" ;;
esac
expect 0 '' resolve sum.film -o sum.exr --png photograph.png --iso 200 --shutter 0.5 --f-number 1.4
cmp -s photograph.png sum.png && fail "the exposure changed nothing"
expect 2 '^bdpt: --iso.*f_number' resolve sum.film -o sum.exr --png x.png --shutter 0.5
expect 2 '^bdpt: --iso.*f_number' render box.pbrt -o x.exr --spp 1 --shutter 0.5

# Every integrator by name; what does not fit is told, and what fits is another picture of the same thing.
for name in path light two-way pooled matrix combinatorial; do
  expect 0 '' render box.pbrt -o $name.exr --spp 16 --integrator $name --light-samples 2
  expect 0 '' compare $name.exr full.exr
done
expect 0 '' render box.pbrt -o m.exr --spp 8 --integrator matrix --connections 2 --pool-passes 4 --order hilbert \
  --partners latin-hypercube
expect 0 '' render box.pbrt -o m.exr --spp 8 --integrator matrix --pool-pixels 64 --matrix all-lengths
expect 0 '' compare m.exr full.exr
expect 3 '^bdpt: .*pool_pixels.*65537' render box.pbrt -o m.exr --spp 8 --integrator matrix --pool-pixels 65537
expect 3 '^bdpt: .*pool_pixels.*another plan' render box.pbrt -o m.exr --spp 8 --pool-pixels 64
expect 2 '^bdpt: .*choose one of: all-lengths, per-technique' render box.pbrt -o m.exr --matrix one
expect 0 '' render box.pbrt -o r.exr --spp 16 --roulette efficiency --json
grep -q '"1x2": {"energy": 0\.' stdout.txt || fail "no statistics of techniques"
expect 0 '' render box.pbrt -o r.exr --spp 16 --roulette fixed --roulette-threshold 0.01
expect 3 '^bdpt: .*shadow_threshold.*above 0' render box.pbrt -o r.exr --roulette fixed
expect 0 '' render box.pbrt -o adaptive.exr --spp 16 --adaptive
expect 0 '' compare adaptive.exr full.exr
expect 3 '^bdpt: .*adaptive.*another plan' render box.pbrt -o a.exr --integrator mmlt --adaptive
expect 0 '' render box.pbrt -o mmlt.exr --spp 16 --integrator mmlt --pool-passes 4 --json
grep -q '"mutations": [1-9]' stdout.txt || fail "mmlt: $(cat stdout.txt)"
expect 0 '' compare mmlt.exr full.exr
expect 3 '^bdpt: .*light_samples.*one light subpath' render box.pbrt -o a.exr --integrator mmlt --light-samples 2
expect 3 '^bdpt: .*multiple of 16' render box.pbrt -o a.exr --integrator mmlt --spp 8
for selection in power uniform tree each; do
  expect 0 '' render box.pbrt -o s.exr --spp 8 --light-selection $selection --direct-samples 2 --direct-candidates 2
  expect 0 '' compare s.exr full.exr
done
expect 0 '' render box.pbrt -o s.exr --spp 8 --integrator pooled --pool-selection importance
expect 0 '' compare s.exr full.exr
expect 3 '^bdpt: .*pool_selection.*no pool' render box.pbrt -o a.exr --pool-selection importance
expect 0 '' render box.pbrt -o s.exr --spp 8 --integrator combinatorial --correlation-aware
expect 0 '' compare s.exr full.exr
expect 3 '^bdpt: .*correlation_aware.*no two samples' render box.pbrt -o a.exr --integrator two-way --correlation-aware
for start in uniform importance; do
  expect 0 '' render box.pbrt -o s.exr --spp 8 --light-start $start
  expect 0 '' compare s.exr full.exr
done
expect 2 '^bdpt: .*choose one of: importance, power, uniform' render box.pbrt -o a.exr --light-start guess
expect 2 '^bdpt: .*choose one of: each, power, tree, uniform' render box.pbrt -o a.exr --light-selection guess
expect 2 '^bdpt: .*greater than zero' render box.pbrt -o a.exr --direct-samples 0
expect 3 '^bdpt: .*direct_candidates' render box.pbrt -o a.exr --direct-candidates 65
expect 2 '^bdpt: .*--integrator' render box.pbrt -o a.exr --integrator guess
expect 2 '^bdpt: .*greater than zero' render box.pbrt -o a.exr --integrator pooled --connections 0
expect 3 '^bdpt: .*connections.*does not choose' render box.pbrt -o a.exr --integrator two-way --connections 2
expect 3 '^bdpt: .*multiple of 8' render box.pbrt -o a.exr --integrator matrix --spp 4

# Ctrl-C writes what is finished.
"$BDPT_TOOL" render box.pbrt -o cut.exr --film cut.film --spp 100000000 2>stderr.txt &
job=$!
sleep 1
kill -INT $job
wait $job
code=$?
[ $code -eq 130 ] || fail "interrupted: exit code $code, not 130"
[ -s cut.exr ] && [ -s cut.film ] || fail "interrupted: nothing written"

# Bakes of two nodes: halves make the whole, and so does what goes on after it was killed, to the bit.
sed '/^Film/d; s/"integer indices" \[0 2 1 0 3 2\]/& "point2 uv" [0 0 1 0 1 1 0 1]/' box.pbrt >floor.pbrt
echo 'Shape "trianglemesh" "point3 P" [-3 -1 -3  3 -1 -3  3 3 -3  -3 3 -3] "integer indices" [0 2 1 0 3 2]
  "point2 uv" [0 0 1 0 1 1 0 1]' >>floor.pbrt
bake="bake floor.pbrt --uv 0 --resolution 48 --outputs e,sh1"
expect 0 '' $bake -o map.exr --spp 300
expect 0 '' $bake -o half.exr --passes 0:150 --film a.map
expect 0 '' $bake -o half.exr --passes 150:300 --film b.map
expect 0 '' merge a.map b.map -o sum.map
expect 0 '' $bake -o sum.exr --spp 300 --film sum.map --resume
cmp -s map.exr sum.exr || fail "the merged lightmap differs"
cmp -s map.exr half.exr && fail "half a lightmap is as good as a whole one"

"$BDPT_TOOL" $bake -o killed.exr --spp 300 --film killed.map --checkpoint 0.02 &
job=$!
for i in $(seq 1000); do
  [ -s killed.map ] && break
  sleep 0.01
done
kill -KILL $job
wait $job 2>/dev/null
code=$?
[ $code -eq 137 ] || fail "the bake was over before it was killed: exit code $code"
[ ! -e killed.exr ] || fail "killed, and a lightmap all the same"
cp killed.map found.map
expect 0 '' $bake -o never.exr --spp 1 --film found.map --resume
cmp -s found.map killed.map || fail "the film was not found to go on from"
expect 0 '' $bake -o killed.exr --spp 300 --film killed.map --resume
cmp -s map.exr killed.exr || fail "the lightmap that went on differs"
expect 5 '^bdpt: ' $bake -o x.exr --spp 8 --film killed.map --resume --seed 1

"$BDPT_TOOL" $bake -o cut-map.exr --film cut.map --spp 300 --checkpoint 0.02 &
job=$!
for i in $(seq 1000); do
  [ -s cut.map ] && break
  sleep 0.01
done
kill -INT $job
wait $job
code=$?
[ $code -eq 130 ] || fail "interrupted bake: exit code $code, not 130"
[ -s cut-map.exr ] && [ -s cut.map ] || fail "interrupted bake: nothing written"
expect 0 '' $bake -o cut-map.exr --spp 300 --film cut.map --resume
cmp -s map.exr cut-map.exr || fail "the interrupted lightmap that went on differs"

[ $failures -eq 0 ]
