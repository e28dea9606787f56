#!/bin/sh
# A comparison with several jobs, a learning curve and a fit on all cores under
# ThreadSanitizer, without a report; and a race planted on purpose, with one.
#
#   threads_test.sh ERRMAP PLANTED_RACE DATA.csv
set -eu

errmap=$1
planted_race=$2
data=$3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# 66 is ThreadSanitizer's own status.
TSAN_OPTIONS="halt_on_error=1 exitcode=66"
export TSAN_OPTIONS
status=0
"$planted_race" 2>"$scratch/race" || status=$?
if [ "$status" -ne 66 ] || ! grep -q "data race" "$scratch/race"; then
  echo "threads_test: the planted race is not reported (status $status)" >&2
  exit 1
fi

run() {
  if "$errmap" "$@" --quiet >/dev/null 2>"$scratch/messages"; then return 0; fi
  status=$?
  echo "threads_test: status $status: errmap $*" >&2
  cat "$scratch/messages" >&2
  exit 1
}
run compare "$data" --jobs 4 --out "$scratch/study" --models "mean,poly:eq8,\
poly:full:degree=4,poly:stepwise,poly:ridge,poly:lasso,blend,\
net:scg:hidden=4:iterations=30:starts=3,net:lm:hidden=3:iterations=10"
run compare "$data" --jobs 4 --out "$scratch/study" --resume --models mean,poly:eq8
run learn "$data" --by cycles --jobs 4 --models poly:eq8,poly:ridge
run fit "$data" --model poly:stepwise:degree=3:bootstrap=20 -o "$scratch/m.json"
