# The papers' experiments: one runs, the page shows it, and what is wrong is told.
# SPDX-License-Identifier: Apache-2.0
set -u
program=$BDPT_BINARY_DIR/bdpt_experiments
[ -x "$program" ] && command -v python3 >/dev/null || { echo "bdpt_experiments or python3 is not there"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0

fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

# shows FILE PATTERN
shows() { grep -qE -- "$2" "$1" || fail "$1 does not show '$2'"; }

# A row, and a row whose scene is not there.
"$program" --tiny --scenes /nowhere --output "$folder" course-2 veach-10.3 2>"$folder/progress" || fail "the run failed"
shows "$folder/progress" '^course-2 .* [0-9]+ s$'
[ "$(wc -l <"$folder/progress")" -eq 2 ] || fail "not one line of progress for each: $(cat "$folder/progress")"
python3 "$BDPT_SOURCE_DIR/benchmarks/experiments/page.py" "$folder" course-2 veach-10.3 own-plans || fail "page.py failed"
page=$folder/index.html
shows "$page" '<section id="course-2">'
shows "$page" '<td>plain average</td>'
shows "$page" 'src="data:image/png;base64,iVBOR'
shows "$page" 'Skipped: .*/nowhere/veach-bidir.* is not there'
shows "$page" 'own-plans.*not run'
! grep -qE '(src|href)="(http|//)' "$page" || fail "the page needs the network"
shows "$folder/experiments.md" '^\| power heuristic \|'

# Every row can be named, and no other.
"$program" --list >"$folder/list" || fail "--list failed"
ids=$(cut -d ' ' -f 1 "$folder/list" | paste -sd , | sed 's/,/, /g')
"$program" --tiny --output "$folder" course-2 veach-99 2>"$folder/error" && fail "an unknown id was taken"
[ "$(cat "$folder/error")" = "bdpt_experiments: there is no experiment 'veach-99'; there are: $ids" ] ||
  fail "the error is: $(cat "$folder/error")"

python3 "$BDPT_SOURCE_DIR/benchmarks/experiments/page.py" "$folder/nothing" 2>"$folder/error" && fail "a page of nothing"
shows "$folder/error" 'no results; run bdpt_experiments'
exit $((failures > 0))
