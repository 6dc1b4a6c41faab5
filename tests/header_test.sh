# The header, by itself, in every language it is for, with all warnings; that such compilations can fail; and a C
# program that calls every function.
# SPDX-License-Identifier: Apache-2.0
set -euo pipefail
tests=$BDPT_SOURCE_DIR/tests
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
strict=(-fsyntax-only -pedantic-errors -Wall -Wextra -Wconversion -Wundef -Wpadded -Werror)
# Before C++11 there was no long long, which the system's own stdint.h needs.
cxx=(-x c++ -Wno-long-long)
c=(-x c -Wstrict-prototypes -Wold-style-definition -Wmissing-prototypes -Wc++-compat)
# All that clang knows, but what is about other compilers' languages: that C++98 is not C++11, that C99 is not C89.
everything=(-Weverything -Wno-c++98-compat -Wno-c++98-compat-pedantic -Wno-declaration-after-statement)

# compile_all FOLDER SOURCE: with the header of that folder, by every compiler, as every standard.
compile_all() {
  for standard in c99 c11 c17 c2x; do
    "$BDPT_CC" "${c[@]}" -std=$standard "${strict[@]}" "-I$1" "$2" || return 1
    [ -n "${BDPT_CLANG-}" ] || continue
    "$BDPT_CLANG" "${c[@]}" -std=$standard "${strict[@]}" "${everything[@]}" "-I$1" "$2" || return 1
  done
  for standard in c++98 c++11 c++14 c++17 c++20 c++2b; do
    "$BDPT_CXX" "${cxx[@]}" -std=$standard "${strict[@]}" "-I$1" "$2" || return 1
    [ -n "${BDPT_CLANGXX-}" ] || continue
    "$BDPT_CLANGXX" "${cxx[@]}" -std=$standard "${strict[@]}" "${everything[@]}" "-I$1" "$2" || return 1
  done
}

compile_all "$BDPT_SOURCE_DIR/include" "$tests/header_test.c"
"$BDPT_CC" -DBDPT_STATIC "${c[@]}" -std=c99 "${strict[@]}" "-I$BDPT_SOURCE_DIR/include" "$tests/header_test.c"

# A handle of one kind is not taken for another.
if "$BDPT_CC" "${c[@]}" -std=c99 "${strict[@]}" "-I$BDPT_SOURCE_DIR/include" "$tests/header_wrong_handle.c" \
  2> "$folder/told.txt"; then
  echo "a film was taken for a scene"
  exit 1
fi
grep -q incompatible "$folder/told.txt"

# What only some languages have, or what warnings are for, is seen: in C, in C++98, and by layout.
for planted in 'BDPT_API void bdpt_lone();' 'bool bdpt_lone(void);' \
  'enum bdpt_lone { BDPT_LONE, };' 'struct bdpt_lone { void *pointer; uint32_t size; };' '#if BDPT_LONE'; do
  case $planted in '#if'*) end='\n#endif' ;; *) end= ;; esac
  sed "s/^typedef struct bdpt_film bdpt_film;/&\n$planted$end/" "$BDPT_SOURCE_DIR/include/bdpt.h" > "$folder/bdpt.h"
  if compile_all "$folder" "$tests/header_test.c" > /dev/null 2>&1; then
    echo "not seen: $planted"
    exit 1
  fi
done

# Every function is called, and answers.
command -v python3 > /dev/null || exit 77
"$BDPT_BINARY_DIR/tests/header_calls" | sort > "$folder/called.txt"
python3 - "$BDPT_SOURCE_DIR/scripts" > "$folder/declared.txt" << 'END'
import sys
sys.path.insert(0, sys.argv[1])
import bdpt_header
print('\n'.join(sorted(f.name for f in bdpt_header.Header().functions)))
END
diff "$folder/declared.txt" "$folder/called.txt"
