# bdpt.hpp by itself: in every language it is for, by every compiler that is here; with all functions of C in it that take
# a handle; and with no name of its own outside of its inline namespace, where the library's are.
# SPDX-License-Identifier: Apache-2.0
set -eu
include=$BDPT_SOURCE_DIR/include
tests=$BDPT_SOURCE_DIR/tests
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { echo "$*" >&2; exit 1; }

for compiler in "${CXX:-${BDPT_CXX:-c++}}" clang++ clang++-19 clang++-14; do
  command -v "$compiler" > /dev/null || continue
  for standard in c++17 c++20 c++2b; do
    for test in api_hpp_test api_hpp_callables_test; do
      "$compiler" -std=$standard -fsyntax-only -pedantic-errors -Wall -Wextra -Wconversion -Wundef -Wshadow -Werror \
        "-I$include" "-I$tests" "$tests/$test.cpp" || fail "$test: $compiler -std=$standard"
    done
  done
done

# What takes no handle is called as it is.
free='version abi_version result_name last_error metal_find sky_fill color_convert_chromaticities plan_name plan_summary
uv_check lightmap_dilate lightmap_fix_seams lightmap_encode image_display exposure_stops has_denoiser denoise
image_write_exr image_write_png'
for function in $(sed -n 's/^BDPT_API.*[ *]bdpt_\([a-z_]*\)(.*/\1/p' "$include/bdpt.h"); do
  case " $(echo $free) " in *" $function "*) continue ;; esac
  grep -q "bdpt_$function\b" "$include/bdpt.hpp" || fail "bdpt_$function is not in bdpt.hpp"
done

# So a program can link the static library: none of its classes is one of the library's of the same name.
"${CXX:-${BDPT_CXX:-c++}}" -std=c++17 "-I$include" "-I$tests" -c "$tests/api_hpp_callables_test.cpp" -o "$folder/test.o"
names=$(nm -C --defined-only "$folder/test.o" | grep -E ' bdpt::' | sed 's/.* \(bdpt::[A-Za-z0-9_]*\).*/\1/' | sort -u)
echo "$names" | grep -q '^bdpt::abi1$' || fail "no symbol of bdpt.hpp: $names"
others=$(echo "$names" | grep -v '^bdpt::abi1$' || true)
[ -z "$others" ] || fail "outside of bdpt::abi1: $others"
