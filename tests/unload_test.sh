# A program that opens and closes the library, a hundred times, as hosts do with plugins: no crash, no more threads, and an
# end that is one.
# SPDX-License-Identifier: Apache-2.0
set -eu
lib=$BDPT_BINARY_DIR/lib
[ -e "$lib/libbdpt.so" ] || exit 77
case $(nm -D "$lib/libbdpt.so") in *__asan_init*) exit 77 ;; esac  # which would have to come first
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat > host.c << 'END'
#define _POSIX_C_SOURCE 200809L
#include <dirent.h>
#include <dlfcn.h>
#include <stdio.h>
#include <string.h>
static int threads(void) {
  int n = 0;
  DIR *folder = opendir("/proc/self/task");
  if (!folder) return 0;
  for (const struct dirent *e; (e = readdir(folder)) != NULL;) n += e->d_name[0] != '.';
  closedir(folder);
  return n;
}
int main(void) {
  int first = 0;
  for (int i = 0; i < 100; ++i) {
    void *handle = dlopen("./plugin.so", RTLD_NOW | RTLD_LOCAL), *found = handle ? dlsym(handle, "plugin_run") : NULL;
    int (*run)(void);
    if (!found) return fprintf(stderr, "%s\n", dlerror()), 1;
    memcpy(&run, &found, sizeof run);
    if (run() != 0) return 2;
    if (dlclose(handle) != 0) return 3;
    if (i == 0) first = threads();
  }
  printf("threads: %d after one time, %d after a hundred\n", first, threads());
  return threads() > first;
}
END
sed 's/#define WIDTH 400/#define WIDTH 40/; s/#define HEIGHT 300/#define HEIGHT 30/' \
  "$BDPT_SOURCE_DIR/examples/c/hello.c" > plugin.c
${CC:-cc} -std=c99 -shared -fPIC -Dmain=plugin_run "-I$BDPT_SOURCE_DIR/include" plugin.c -o plugin.so "-L$lib" -lbdpt
${CC:-cc} host.c -o host -ldl
LD_LIBRARY_PATH=$lib ./host
