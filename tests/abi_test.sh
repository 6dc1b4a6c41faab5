# The header and the library are what abi/ says, and scripts/check-abi sees every kind of break, planted in a copy.
# SPDX-License-Identifier: Apache-2.0
set -eu
command -v abidiff > /dev/null || exit 77
check=$BDPT_SOURCE_DIR/scripts/check-abi
header=$BDPT_SOURCE_DIR/include/bdpt.h
library=$BDPT_BINARY_DIR/lib/libbdpt.so
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

# plant SED...: planted.h is the header, changed by each of them.
plant() {
  cp "$header" planted.h
  for change in "$@"; do
    sed -E "$change" planted.h > changed.h
    ! cmp -s planted.h changed.h || { echo "the header has no place for $change"; exit 1; }
    mv changed.h planted.h
  done
}
# breaks WORD SED...: is told as a break, in a line that has the word.
breaks() {
  word=$1
  shift
  plant "$@"
  status=0
  "$check" --header planted.h > told.txt 2>&1 || status=$?
  { [ "$status" = 1 ] && grep -q -- "$word" told.txt; } || { echo "not seen: $*"; cat told.txt; exit 1; }
}
# grows LINE SED...: is told as no break, in that line and no other.
grows() {
  line=$1
  shift
  plant "$@"
  "$check" --header planted.h > told.txt
  [ "$(cat told.txt)" = "no break: $line" ] || { echo "not told: $line"; cat told.txt; exit 1; }
}

# What is new belongs to the baseline, in the same commit: then it can break, too.
"$check" --library "$library" > told.txt
[ ! -s told.txt ] || { cat told.txt; echo "new, but not in abi/: run scripts/check-abi --update"; exit 1; }

more='s/^\} bdpt_sky_desc;/  float more;\n&/'
inserted='s/^  float turbidity;/  float grain;\n&/'
breaks "'float turbidity' offset changed from 96 to 128" "$inserted"
breaks "'float turbidity' offset changed from 96 to 128" "$inserted" "$more"
breaks "type of 'float turbidity' changed" 's/^  float turbidity;/  uint32_t turbidity;/' "$more"
breaks "'float\[3\]' to 'float\[4\]'" 's/^  float ground\[3\];/  float ground[4];/'
breaks "turbidity' changed to 'bdpt_sky_desc::haze" 's/^  float turbidity;/  float haze;/'
breaks 'data member deletion' '/^  float ground\[3\];/d'
breaks padded 's/^\} bdpt_sky_desc;/  uint8_t more;\n&/'
breaks 'type size changed from 288 to 320' 's/^\} bdpt_portal;/  float more;\n&/'
breaks 'has another size' \
  '/^typedef struct bdpt_exposure_desc/,/^\}/s/uint32_t reserved;/float more[2];/'
breaks 'Removed function' '/^BDPT_API .*bdpt_film_clear\(/d'
breaks "'const char' to 'char'" 's/(bdpt_film_load\(bdpt_context \*context, )const char/\1char/'
breaks "'void' to .*'typedef int32_t'" 's/^BDPT_API void bdpt_scene_retain/BDPT_API int32_t bdpt_scene_retain/'
breaks "'void' to 'const bdpt_progress'" \
  's/\(\*bdpt_progress_fn\)\(void \*user, const bdpt_progress \*progress\)/(*bdpt_progress_fn)(const bdpt_progress *progress, void *user)/'
breaks 'BDPT_VIEW_ACES is 7; it was 1' 's/^#define BDPT_VIEW_ACES 1/#define BDPT_VIEW_ACES 7/'
breaks 'BDPT_VIEW_OCIO is gone' '/^#define BDPT_VIEW_OCIO/d'
breaks 'no function leads to bdpt_lone' 's/^typedef struct bdpt_film bdpt_film;/&\ntypedef int32_t bdpt_lone;/'

grows 'new field bdpt_sky_desc.more' "$more"
grows 'bdpt_exposure_desc.more in place of reserved' '/^typedef struct bdpt_exposure_desc/,/^\}/s/uint32_t reserved;/float more;/'
grows 'new constant BDPT_VIEW_MORE 3' 's/^#define BDPT_VIEW_ACES 1/#define BDPT_VIEW_MORE 3\n&/'
grows 'new function bdpt_more' 's/^BDPT_API .*bdpt_film_clear\(.*$/&\nBDPT_API void bdpt_more(bdpt_film *film);/'

# The library lacks a function of the header, and has one that the header lacks.
if "$check" --header planted.h --library "$library" > told.txt 2>&1; then exit 1; fi
grep -q 'does not export T bdpt_more@@BDPT_1.0' told.txt
plant '/^BDPT_API .*bdpt_film_clear\(/d'
if "$check" --header planted.h --library "$library" > told.txt 2>&1; then exit 1; fi
grep -q 'exports T bdpt_film_clear@@BDPT_1.0, which the header does not have' told.txt
