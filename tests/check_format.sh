#!/bin/sh
# Every .h and .cc is formatted as .clang-format says (version 14):
#
#   check_format.sh [ROOT]
#
# Looks at the files that git tracks under ROOT (default: the folder above this
# script), or at all of the project's folders where git knows none.
set -eu

root=${1:-$(dirname -- "$0")/..}
CDPATH='' cd -- "$root"

formatter=""
for candidate in clang-format-14 clang-format; do
  if command -v "$candidate" >/dev/null 2>&1 &&
    "$candidate" --version | grep -q 'version 14\.'; then
    formatter=$candidate
    break
  fi
done
if [ -z "$formatter" ]; then
  echo "check_format: no clang-format 14: apt-get install clang-format-14" >&2
  exit 1
fi

list=$(mktemp)
found=$(mktemp)
trap 'rm -f "$list" "$found"' EXIT
git ls-files -- '*.h' '*.cc' >"$list" 2>/dev/null || : >"$list"
if [ ! -s "$list" ]; then
  for folder in stats data fitting models cli tests; do
    if [ -d "$folder" ]; then
      find "$folder" -type f \( -name '*.h' -o -name '*.cc' \)
    fi
  done >"$list"
fi

checked=0
failed=0
while IFS= read -r file; do
  [ -f "$file" ] || continue # Deleted, but still in git's index.
  checked=$((checked + 1))
  if ! "$formatter" --dry-run -Werror "$file" >"$found" 2>&1; then
    failed=$((failed + 1))
    # One line per place; anything else that went wrong as it is.
    if grep -q 'Wclang-format-violations' "$found"; then
      sed -n 's/^\(.*:[0-9]*\):[0-9]*: error: code.*/\1: not formatted/p' \
        "$found" | uniq
    else
      cat "$found"
    fi
  fi
done <"$list"

if [ "$checked" -eq 0 ]; then
  echo "check_format: no source file in $(pwd)" >&2
  exit 1
fi
if [ "$failed" -ne 0 ]; then
  echo "check_format: $failed of $checked files; mend: $formatter -i FILE" >&2
  exit 1
fi
echo "check_format: $checked files, all formatted"
