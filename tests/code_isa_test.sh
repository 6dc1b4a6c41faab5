# Each instruction set that the library was compiled for runs, says so, and makes the same picture; what is not to be had
# is refused by name.
# SPDX-License-Identifier: Apache-2.0
set -eu
tests=$BDPT_BINARY_DIR/tests/bdpt_api_tests
[ -x "$tests" ] || exit 77
[ "$BDPT_DISPATCH" = ON ] || exit 77  # a build for one set alone
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

run() { BDPT_ISA=$1 "$tests" --gtest_filter='ApiCodeIsa.*' > "$folder/out.txt" 2>&1; }
run '' || { cat "$folder/out.txt"; exit 1; }
sets=0
for isa in baseline avx2 avx512; do
  if run $isa; then
    sets=$((sets + 1))
    awk '/^mean/ { print $2 }' "$folder/out.txt" >> "$folder/means.txt"
  else
    [ "$isa" != baseline ]
    grep -q "BDPT_ISA.*\"$isa\"" "$folder/out.txt"  # not on this machine
  fi
done
# As far apart as some paths that went another way make them.
awk 'NR == 1 { first = $1 } { d = $1 / first - 1; if (d * d > 1e-6) exit 1 }' "$folder/means.txt"
echo "$sets instruction sets"

# No code of a wider set is among the baseline's, of which some might come from a template that both have.
! objdump -d --no-show-raw-insn "$BDPT_BINARY_DIR/src/baseline.o" | grep -m 1 -E '%[yz]mm' || exit 1

if run sse9; then exit 1; fi
grep -q 'BDPT_ISA.*"sse9"' "$folder/out.txt"
