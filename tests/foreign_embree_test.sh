# What happens when the program brings another Embree, or another OpenEXR, than the library was built with: it renders, or
# is told what is wrong; it never calls the wrong one. See docs/embedding.md, "Another Embree".
# SPDX-License-Identifier: Apache-2.0
set -eu
lib=$BDPT_BINARY_DIR/lib
[ -e "$lib/libbdpt.so" ] || exit 77
[ "$(uname -s)" = Linux ] || exit 77
cc=${CC:-cc}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
export LD_LIBRARY_PATH=$lib:$folder${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
fail() { echo "$*" >&2; exit 1; }

undefined=$(nm -D --undefined-only "$lib/libbdpt.so" | awk '{print $2}' | sed 's/@.*//')
functions=$(echo "$undefined" | grep '^rtc' || true)
[ -n "$functions" ] || exit 77  # a library that has Embree inside

# All that the library calls is looked at before the first call.
for f in $functions; do
  grep -q "(const void\*)$f,\|(const void\*)$f}" "$BDPT_SOURCE_DIR/src/geometry/embree.cpp" ||
    fail "$f is missing in kFunctions of src/geometry/embree.cpp"
done

# other_embree NAME VERSION FILTERS FUNCTION...: the source of another Embree, whose functions end the program, but for
# those that are the same in all versions.
other_embree() {
  name=$1 version=$2 filters=$3
  shift 3
  {
    echo '#include <stdio.h>'
    echo '#include <stdlib.h>'
    for f in "$@"; do
      case $f in
        rtcNewDevice) echo 'void *rtcNewDevice(const char *c) { static long device[64]; (void)c; return device; }' ;;
        rtcReleaseDevice) echo 'void rtcReleaseDevice(void *d) { (void)d; }' ;;
        rtcGetDeviceProperty)
          # 66: filter functions; 65: culling of back faces
          echo 'long rtcGetDeviceProperty(void *d, int p) {'
          echo "  (void)d; return p == 0 ? $version : p == 66 ? $filters : p != 65; }"
          ;;
        *) echo "void $f(void) { fputs(\"wrong: $f\\n\", stderr); abort(); }" ;;
      esac
    done
  } > "$name.c"
}
other_embree other 20001 1 $functions
other_embree newer 90001 1 $functions
other_embree mixture 90001 1 rtcNewDevice rtcNewScene
own=$(sed -n 's/^#define RTC_VERSION \([0-9]*\)/\1/p' /usr/include/embree4/rtcore_config.h /usr/include/embree3/rtcore_config.h 2> /dev/null | head -1)
other_embree unfiltered "${own:-0}" 0 $functions
other_embree older "$((${own:-10100} - 100))" 1 $functions
for name in other newer mixture unfiltered older; do $cc -shared -fPIC $name.c -o lib$name.so; done

# The picture of hello.c, and where it goes wrong the text of the error.
hello=$BDPT_SOURCE_DIR/examples/c/hello.c
include=-I$BDPT_SOURCE_DIR/include
link() { out=$1; shift; $cc -std=c99 $include "$@" -o "$out"; }
runs() {
  rm -f hello.png
  "$@" 2> errors.txt || fail "$*: $(cat errors.txt)"
  [ -s hello.png ] || fail "$*: no picture"
}
refused() {  # refused PROGRAM PART...: with a text that has these parts
  program=$1
  shift
  status=0
  $program 2> errors.txt || status=$?
  [ $status = 1 ] || fail "$program: ended with $status, $(cat errors.txt)"
  for part in BDPT_ERROR_UNSUPPORTED "$@"; do
    grep -qF -- "$part" errors.txt || fail "$program: no \"$part\" in: $(cat errors.txt)"
  done
}
versions() { echo "$1" | awk '{ printf "%d.%d.%d", $1 / 10000, $1 / 100 % 100, $1 % 100 }'; }

link plain $hello -L"$lib" -lbdpt
runs ./plain

# Linked before the library, or after it: the program's own libraries come first either way.
link before $hello -Wl,--no-as-needed -L. -lother -L"$lib" -lbdpt
refused ./before 'Embree 2.0.1' "built for Embree ${own:+$(versions "$own")}" libother.so 'embedding.md'
link after $hello -Wl,--no-as-needed -L"$lib" -lbdpt -L. -lnewer
refused ./after 'Embree 9.0.1' libnewer.so
link mixed $hello -Wl,--no-as-needed -L. -lmixture -L"$lib" -lbdpt
refused ./mixed 'two files' libmixture.so
# Linked into the program, which by that gives it to all libraries; hidden it stays the program's own.
$cc -c -fPIC newer.c && ar rcs libinside.a newer.o
link inside $hello newer.o -L"$lib" -lbdpt
refused ./inside 'Embree 9.0.1' ./inside
link hidden $hello -Wl,--whole-archive libinside.a -Wl,--no-whole-archive -Wl,--exclude-libs,ALL -L"$lib" -lbdpt
runs ./hidden
if [ -n "$own" ]; then
  link unfiltered $hello -Wl,--no-as-needed -L. -lunfiltered -L"$lib" -lbdpt
  refused ./unfiltered 'filter functions' libunfiltered.so
  link older $hello -Wl,--no-as-needed -L. -lolder -L"$lib" -lbdpt
  refused ./older "Embree $(versions $((own - 100)))" libolder.so
fi

# A plugin that uses the library, opened by a program that has another Embree: FILE:FLAGS, of which g is RTLD_GLOBAL, d
# RTLD_DEEPBIND, z RTLD_LAZY.
cat > opener.c << 'END'
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdio.h>
#include <string.h>
int main(int n, char **files) {
  int (*run)(void) = NULL;
  for (int i = 1; i < n; ++i) {
    char *flags = strchr(files[i], ':');
    *flags++ = 0;
    void *handle = dlopen(files[i], (strchr(flags, 'z') ? RTLD_LAZY : RTLD_NOW) | (strchr(flags, 'g') ? RTLD_GLOBAL : 0) |
                                        (strchr(flags, 'd') ? RTLD_DEEPBIND : 0));
    if (!handle) return fprintf(stderr, "%s\n", dlerror()), 2;
    void *found = dlsym(handle, "plugin_run");
    if (found) memcpy(&run, &found, sizeof run);
  }
  return run ? run() : 3;
}
END
$cc -std=c99 -shared -fPIC -Dmain=plugin_run $include $hello -o plugin.so -L"$lib" -lbdpt
$cc opener.c -o opener -ldl
runs ./opener ./plugin.so:
runs ./opener ./libnewer.so: ./plugin.so:
refused "./opener ./libnewer.so:g ./plugin.so:" 'Embree 9.0.1' libnewer.so
case $(nm -D "$lib/libbdpt.so") in
  *__asan_init*) ;;  # which refuses RTLD_DEEPBIND
  *) runs ./opener ./libnewer.so:g ./plugin.so:d ;;
esac
# One that comes later changes nothing, though functions that were not yet called are looked up lazily elsewhere.
runs ./opener ./plugin.so:z ./libnewer.so:g

# OpenEXR, Imath and OpenColorIO have their version in the name of every function, libpng a version at it: another one
# lives beside ours. A stranger under the very same names would be called, which shows that the test can see it.
names=$(echo "$undefined" | grep -E '^_Z.*(Imf_[0-9]+_[0-9]+|OpenColorIO_v[0-9]+_[0-9]+)' | grep -vE '^_ZT[ISV]' || true)
[ -n "$names" ] || fail "the library calls no OpenEXR"
stranger() {  # stranger NAME: of the functions that it reads
  { echo '#include <stdlib.h>'; sed 's/.*/void &(void) { abort(); }/'; } > "$1.c"
  $cc -shared -fPIC "$1.c" -o "lib$1.so"
}
echo "$names" | sed -E 's/(Imf_[0-9]+_)[0-9]/\19/g; s/(OpenColorIO_v[0-9]+_)[0-9]/\19/g' | stranger exr_beside
echo "$names" | stranger exr_same
link beside $hello -Wl,--no-as-needed -L. -lexr_beside -L"$lib" -lbdpt
runs ./beside
link same $hello -Wl,--no-as-needed -L. -lexr_same -L"$lib" -lbdpt
if ./same 2> /dev/null; then fail "a stranger's OpenColorIO was not called: this test sees nothing"; fi
