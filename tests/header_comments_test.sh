# The header's comments are complete, and scripts/check-header sees what they lack, planted in a copy.
# SPDX-License-Identifier: Apache-2.0
set -eu
command -v python3 > /dev/null || exit 77
check=$BDPT_SOURCE_DIR/scripts/check-header
header=$BDPT_SOURCE_DIR/include/bdpt.h
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

"$check"

# lacks LINE SED: the changed header is told to lack just that.
lacks() {
  sed -E "$2" "$header" > planted.h
  ! cmp -s "$header" planted.h || { echo "the header has no place for $2"; exit 1; }
  status=0
  "$check" planted.h > told.txt || status=$?
  { [ "$status" = 1 ] && [ "$(sed 's/^[^ ]* //' told.txt)" = "$1" ]; } || { echo "not told: $1"; cat told.txt; exit 1; }
}

# In the comment above bdpt_film_clear, which begins with "Empties a film".
clear='/^\/\* Empties a film/,/\*\//'
lacks 'bdpt_film_clear has no comment of its own' "$clear{/./d}"
lacks 'bdpt_film_clear has no comment of its own' 's/^BDPT_API .*bdpt_film_clear/\n&/'
lacks 'bdpt_film_clear has the paragraphs Returns, Threads, Ownership, not Returns, Threads, Callbacks, Ownership' \
  "$clear{s/Callbacks: [^.]*\.//}"
lacks 'bdpt_film_clear has the paragraphs Threads, Callbacks, Ownership, not Returns, Threads, Callbacks, Ownership
bdpt_film_clear returns a bdpt_result, but names no result code' "$clear{s/Returns: //}"
lacks 'bdpt_film_clear says nothing for Ownership' "$clear{s/Ownership: none\./Ownership: ./}"
lacks 'bdpt_film_clear Threads begins with none of: any thread; one thread per object; one thread per builder' \
  "$clear{s/one thread per object/the main thread/}"
lacks 'bdpt_film_clear names _IN_HAND, but there is no BDPT_ERROR_IN_HAND' "$clear{s/_IN_USE/_IN_HAND/}"
lacks 'BDPT_ERROR_INVALID is not declared' "$clear{s/BDPT_ERROR_INVALID_ARGUMENT/BDPT_ERROR_INVALID/}"
lacks 'bdpt_film_clear returns a bdpt_result, but has no BDPT_CHECK' '/bdpt_film_clear\(/s/BDPT_CHECK //'
lacks 'bdpt_film_release returns nothing, and should say so: "Returns: nothing."' \
  '/^\/\* Takes a reference/{N; /film_release/s/Returns: nothing/Returns: a film/}'
lacks 'bdpt_film_inform is not declared' "$clear{s/Empties/bdpt_film_inform empties/}"
lacks 'bdpt_film_info has no field refused' 's/bdpt_film_info\.rejected/bdpt_film_info.refused/'
lacks 'not understood: union bdpt_film_part;' 's/^typedef struct bdpt_film bdpt_film;/&\n\nunion bdpt_film_part;/'
