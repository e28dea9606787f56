#!/bin/sh
# What a column means is decided in data/ alone: nothing else asks for its name
# or looks for it by a name of its own:
#
#   check_roles.sh [ROOT]
#
# Prints each violation as file:line: what. The program of 1995 reads files of
# its own, whose columns it names; a name that is free may be given (< 0).
set -eu

root=${1:-$(dirname -- "$0")/..}
CDPATH='' cd -- "$root"

deciders="NamesPosition|IsCalledPosition|NamesTime|IsCalled|Says|SayAny"
deciders="$deciders|KeepsRecord|CountsCycles|FindLeaks|FindAxis|FindClock"
roles="cycle|day|session|run|time|time_s|position|position_mm|direction"
roles="$roles|error|error_um|error_mm"

found=$(grep -rnE --include='*.h' --include='*.cc' \
  "data::($deciders)\\(|able\\.Find\\(\"($roles)\"\\)|name == \"($roles)\"" \
  stats fitting models cli | grep -v '/netcg/report_study\.cc:' |
  grep -v '") < 0' || true)
if [ -n "$found" ]; then
  printf '%s\n' "$found"
  echo "check_roles: take the role from the Reading of the data" >&2
  exit 1
fi
echo "check_roles: no column is looked for by its name outside of data/"
