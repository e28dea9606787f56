#!/bin/sh
# The checks can fail: each kind of violation in a made-up tree is found, and
# a good tree passes. quickstart.sh, with made-up system tools, refuses to
# replace a package and calls apt-get only when something is missing.
#
#   check_scripts_test.sh [ROOT]
set -eu

root=${1:-$(dirname -- "$0")/..}
root=$(CDPATH='' cd -- "$root" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
tree=$scratch/tree
output=$scratch/output
failures=0
cases=0

fail() {
  printf 'FAILED: %s\n' "$1" >&2
  sed 's/^/    /' "$output" >&2
  failures=$((failures + 1))
}

good_tree() {
  rm -rf "$tree"
  mkdir -p "$tree/stats" "$tree/data" "$tree/fitting/minimisers" \
    "$tree/models/study" "$tree/models/net" "$tree/cli/report" \
    "$tree/cli/study_setup" \
    "$tree/cli/output" "$tree/tests/benchmarks"
  printf '%s\n' '#pragma once' '#include <vector>' '#include <Eigen/Core>' \
    >"$tree/stats/summary.h"
  printf '%s\n' '#include "stats/summary.h"' \
    '#include <boost/math/distributions/normal.hpp>' >"$tree/stats/summary.cc"
  printf '%s\n' '#pragma once' '#include <string>' >"$tree/data/csv.h"
  printf '%s\n' '#pragma once' '#include "stats/summary.h"' \
    >"$tree/fitting/minimisers/optimizer.h"
  printf '%s\n' '#include <ceres/ceres.h>' \
    '#include "fitting/minimisers/optimizer.h"' >"$tree/fitting/minimisers/ceres_optimizer.cc"
  printf '%s\n' '#include <nlopt.hpp>' >"$tree/fitting/minimisers/nlopt_optimizer.cc"
  printf '%s\n' '#pragma once' '#include "data/csv.h"' \
    '#include "fitting/minimisers/optimizer.h"' '#include "stats/summary.h"' \
    >"$tree/models/study/study.h"
  printf '%s\n' '#include "models/study/study.h"' '#include <nlohmann/json.hpp>' \
    '#include <fmt/format.h>' \
    >"$tree/models/study/study.cc"
  printf '%s\n' '#pragma once' '#include <nlohmann/json_fwd.hpp>' \
    '#include "models/study/study.h"' >"$tree/cli/output/report.h"
  printf '%s\n' '#include "cli/output/report.h"' '#include <unistd.h>' \
    '#include "data/csv.h"' >"$tree/cli/output/report.cc"
  printf '%s\n' '#include <CLI/CLI.hpp>' >"$tree/cli/application.cc"
  printf '%s\n' '#pragma once' '#include "models/kind.h"' \
    >"$tree/models/net/net.h"
  printf '%s\n' '#pragma once' >"$tree/models/kind.h"
  printf '%s\n' '#pragma once' '#include "models/study/study.h"' \
    >"$tree/cli/report/page.h"
  printf '%s\n' '#pragma once' '#include "cli/report/page.h"' \
    >"$tree/cli/study_setup/config.h"
  printf '%s\n' '#pragma once' '#include "fitting/minimisers/optimizer.h"' \
    >"$tree/tests/test_problems.h"
  printf '%s\n' '#include <gtest/gtest.h>' '#include <nlohmann/json.hpp>' \
    '#include "cli/output/report.h"' '#include "tests/test_problems.h"' \
    >"$tree/tests/optimizer_test.cc"
}

check_includes() { sh "$root/tests/check_includes.sh" "$tree" >"$output" 2>&1; }

# violation FILE LINE: LINE appended to FILE of a good tree is found there.
violation() {
  cases=$((cases + 1))
  good_tree
  printf '%s\n' "$2" >>"$tree/$1"
  place="$1:$(wc -l <"$tree/$1" | tr -d ' '):"
  if check_includes; then
    fail "check_includes passes $2 in $1"
  elif ! grep -Fq "$place" "$output"; then
    fail "check_includes does not name $place"
  elif [ "$(grep -c ':[0-9][0-9]*: ' "$output")" -ne 1 ]; then
    fail "check_includes reports more than $2 in $1"
  fi
}

good_tree
check_includes || fail "check_includes refuses a good tree"

# Upwards.
violation stats/summary.h '#include "data/csv.h"'
violation stats/summary.cc '#include "fitting/minimisers/optimizer.h"'
violation stats/summary.cc '#include "models/study/study.h"'
violation stats/summary.cc '#include "cli/output/report.h"'
violation data/csv.h '#include "stats/summary.h"'
violation data/csv.h '#include "fitting/minimisers/optimizer.h"'
violation data/csv.h '#include "models/study/study.h"'
violation data/csv.h '#include "cli/output/report.h"'
violation fitting/minimisers/optimizer.h '#include "data/csv.h"'
violation fitting/minimisers/optimizer.h '#include "models/study/study.h"'
violation fitting/minimisers/ceres_optimizer.cc '#include "cli/output/report.h"'
violation models/study/study.cc '#include "cli/output/report.h"'
violation models/study/study.cc '  #  include "cli/output/report.h"  // indented'
violation cli/report/page.h '#include "cli/output/report.h"'
violation cli/study_setup/config.h '#include "cli/output/report.h"'
# Flags in texts.
violation data/csv.h 'const char* kAdvice = "name it with --target";'
violation models/study/study.cc '  "a \"b\" with --keep-dead");'
cases=$((cases + 1))
good_tree
printf '%s\n' '// Where "--target" is not given.' '#define KEPT "a -- b"' \
  >>"$tree/data/csv.h"
printf '%s\n' 'const char* kFlag = "--target";' >>"$tree/cli/report/page.h"
check_includes || fail "check_includes refuses flags where they may be"
# Between rooms: upwards, sideways, unknown, and from the root of a folder.
violation models/net/net.h '#include "models/study/study.h"'
violation models/study/study.cc '#include "cli/report/page.h"'
violation cli/report/page.h '#include "cli/study_setup/config.h"'
violation cli/study_setup/config.h '#include "cli/study_setup/toml/keys.h"'
violation models/kind.h '#include "models/net/net.h"'
violation fitting/minimisers/optimizer.h '#include "fitting/nonlinear/fit.h"'
# From the core to a slice.
violation cli/output/report.h '#include "cli/machine/machine_file.h"'
violation cli/study_setup/config.h '#include "cli/fleet/run/fleet_run.h"'
violation cli/report/page.h '#include "cli/machine/record/machine_record.h"'
cases=$((cases + 1))
good_tree
mkdir "$tree/models/attic"
printf '%s\n' '#pragma once' >"$tree/models/attic/old.h"
if check_includes; then fail "check_includes passes an unknown room"; fi
# In a circle, which no room forbids.
cases=$((cases + 1))
good_tree
printf '%s\n' '#include "models/net/circle.h"' >>"$tree/models/net/net.h"
printf '%s\n' '#pragma once' '#include "models/net/net.h"' \
  >"$tree/models/net/circle.h"
if check_includes; then
  fail "check_includes passes a circle"
elif ! grep -q 'models/net/circle.h: .*circle' "$output"; then
  fail "check_includes does not name the circle"
fi
# Into the tests.
violation stats/summary.cc '#include "tests/test_problems.h"'
violation data/csv.h '#include "tests/test_problems.h"'
violation fitting/minimisers/optimizer.h '#include "tests/test_problems.h"'
violation models/study/study.h '#include "tests/test_problems.h"'
violation cli/output/report.cc '#include "tests/test_problems.h"'
# Not written from the root, not in quotes, not readable.
violation stats/summary.cc '#include "summary.h"'
violation models/study/study.cc '#include "../stats/summary.h"'
violation models/study/study.cc '#include "models/../stats/summary.h"'
violation tests/optimizer_test.cc '#include "test_problems.h"'
violation cli/output/report.cc '#include <models/study/study.h>'
violation cli/output/report.cc '#include REPORT_HEADER'
# Foreign libraries away from home.
violation fitting/minimisers/optimizer.h '#include <ceres/types.h>'
violation models/study/study.cc '#include <ceres/ceres.h>'
violation fitting/minimisers/nlopt_optimizer.cc '#include <ceres/ceres.h>'
violation tests/optimizer_test.cc '#include <ceres/ceres.h>'
violation fitting/minimisers/ceres_optimizer.cc '#include <nlopt.hpp>'
violation models/study/study.cc '#include <nlopt.h>'
violation fitting/minimisers/ceres_optimizer.cc '#include <boost/math/tools/roots.hpp>'
violation stats/summary.h '#include <boost/math/tools/roots.hpp>'
violation models/study/study.cc '#include <CLI/CLI.hpp>'
violation cli/output/report.cc '#include <toml++/toml.h>'
violation cli/study_setup/config.h '#include <toml++/toml.h>'
violation cli/output/report.h '#include <CLI/App.hpp>'
violation cli/output/report.cc '#include <CLI/CLI.hpp>'
violation data/csv.h '#include <nlohmann/json.hpp>'
violation models/study/study.h '#include <nlohmann/json_fwd.hpp>'
violation stats/summary.cc '#include <nlohmann/json.hpp>'
violation models/study/study.cc '#include <gtest/gtest.h>'
# Public headers.
violation stats/summary.h '#include <fmt/format.h>'
violation data/csv.h '#include <unistd.h>'
violation fitting/minimisers/optimizer.h '#include <tbb/parallel_for.h>'
violation models/study/study.cc '#include <oneapi/tbb/task_arena.h>'
violation models/study/study.h '#include <openssl/sha.h>'

cases=$((cases + 1))
rm -rf "$tree"
mkdir "$tree"
if check_includes; then fail "check_includes passes a tree without sources"; fi

# check_format.
check_format() { sh "$root/tests/check_format.sh" "$tree" >"$output" 2>&1; }
cases=$((cases + 2))
good_tree
printf '%s\n' 'BasedOnStyle: Google' 'SortIncludes: Never' \
  >"$tree/.clang-format"
check_format || fail "check_format refuses a good tree"
printf 'int   x;\n' >>"$tree/data/csv.h"
if check_format; then
  fail "check_format passes a file out of format"
elif ! grep -Fq 'data/csv.h:3:' "$output"; then
  fail "check_format does not name data/csv.h:3"
fi

# quickstart.sh in a scratch clone, with a made-up system in front of PATH.
clone="$scratch/a clone"
fake=$scratch/fake
mkdir "$clone" "$fake"
cp "$root/quickstart.sh" "$clone"

# fake_tool NAME: the script on stdin.
fake_tool() {
  {
    printf '#!/bin/sh\nset -eu\nscratch="%s"\n' "$scratch"
    cat
  } >"$fake/$1"
  chmod +x "$fake/$1"
}

# All but the packages in $scratch/missing are installed.
fake_tool dpkg-query <<'END'
shift 3
for package in "$@"; do
  grep -Fqx "$package" "$scratch/missing" && continue
  echo "$package installed"
done
END
fake_tool apt-get <<'END'
echo "apt-get $*" >>"$scratch/calls"
case " $* " in
  *" -s "*)
    cat "$scratch/simulation"
    if [ -e "$scratch/unfit" ]; then
      case " $* " in *" $(cat "$scratch/unfit") "*) exit 100 ;; esac
    fi
    ;;
  *" install "*)
    if [ -e "$scratch/broken" ]; then echo "no space left"; exit 100; fi
    : >"$scratch/missing"
    ;;
esac
END
fake_tool sudo <<'END'
echo "sudo $*" >>"$scratch/calls"
exec "$@"
END
fake_tool id <<'END'
cat "$scratch/uid"
END
fake_tool cmake <<'END'
echo "cmake $*" >>"$scratch/calls"
mkdir -p build
printf '#!/bin/sh\necho "table of $2"\n' >build/errmap
chmod +x build/errmap
END
fake_tool ctest <<'END'
echo "ctest $*" >>"$scratch/calls"
echo "Total Test time (real) = 0.00 sec"
exit 8
END

system() { # system UID MISSING...
  echo "$1" >"$scratch/uid"
  shift
  printf '%s\n' "$@" >"$scratch/missing"
  : >"$scratch/calls"
  : >"$scratch/simulation"
  rm -f "$scratch/broken" "$scratch/unfit"
}

# expect STATUS ARGUMENTS...: runs quickstart.sh, from elsewhere.
expect() {
  cases=$((cases + 1))
  expected=$1
  shift
  status=0
  (cd / && CI='' PATH="$fake:$PATH" sh "$clone/quickstart.sh" "$@") \
    >"$output" 2>&1 </dev/null || status=$?
  if [ "$status" -ne "$expected" ]; then
    fail "quickstart.sh $*: exit status $status, not $expected"
  fi
}

output_has() {
  grep -Fq -e "$1" "$output" || fail "quickstart.sh does not say: $1"
}

calls_have() {
  grep -Fq -e "$1" "$scratch/calls" ||
    fail "quickstart.sh does not call: $1; calls: $(cat "$scratch/calls")"
}

calls_lack() {
  if grep -Fq -e "$1" "$scratch/calls"; then
    fail "quickstart.sh calls $1: $(cat "$scratch/calls")"
  fi
}

system 0 ""
expect 0
calls_lack apt-get
calls_have "cmake --preset release"
calls_have "--target errmap"
output_has "running: build/errmap compare data/sets/turning_centre/six_days.csv"
output_has "table of data/sets/turning_centre/six_days.csv"

system 0 libeigen3-dev
expect 0
output_has "missing packages: libeigen3-dev"
calls_have "apt-get -o Acquire::Retries=3 update"
calls_have "apt-get install -y --no-install-recommends --no-remove"
calls_lack sudo
expect 0 # Again, now that it is there.
if [ "$(grep -c 'update' "$scratch/calls")" -ne 1 ]; then
  fail "quickstart.sh calls apt-get update when nothing is missing"
fi

system 1000 libeigen3-dev
expect 0
calls_have "sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y"

# A conflict: one line names both sides, nothing is changed or built.
system 0 libfmt-dev
printf '%s\n' 'Remv libfmt-ours-dev [1.0]' 'Inst libfmt-dev (9.1.0)' \
  >"$scratch/simulation"
expect 1
output_has "installing libfmt-dev would remove libfmt-ours-dev: nothing"
calls_lack "install -y"
calls_lack "update"
calls_lack cmake

system 0 libceres-dev libfmt-dev
echo libfmt-dev >"$scratch/unfit"
expect 1
output_has "cannot install libfmt-dev beside"
calls_lack "install -y"
calls_lack cmake

system 0 libfmt-dev
: >"$scratch/broken"
expect 1
output_has "no space left"
output_has "failed: installing packages"
calls_lack cmake

# The last words and the exit status are CTest's.
system 0 clang-format-14
expect 8 test
calls_have "--target all"
calls_have "ctest --test-dir build --output-on-failure"
if [ "$(tail -n 1 "$output")" != "Total Test time (real) = 0.00 sec" ]; then
  fail "quickstart.sh test does not end with CTest's lines"
fi

system 0 ""
expect 2 tests
output_has "usage: sh quickstart.sh [test|python]"
expect 2 test test
expect 0 --help
output_has "usage: sh quickstart.sh [test|python]"
calls_lack cmake

if [ "$failures" -ne 0 ]; then
  echo "check_scripts_test: $failures failures in $cases cases" >&2
  exit 1
fi
echo "check_scripts_test: $cases cases"
