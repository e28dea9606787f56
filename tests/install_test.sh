#!/bin/sh
# `cmake --install` gives all that a user needs, and nothing of it points back
# to the build:
#
#   install_test.sh ROOT BUILD_DIR CMAKE
#
# - tests/outside_project finds the package, builds against it and runs;
# - the installed program runs from another folder;
# - schemas and completions are there, and the latter work (bash, and
#   fish where it is installed; zsh's is checked for its syntax).
set -eu

if [ $# -ne 3 ]; then
  echo "usage: install_test.sh ROOT BUILD_DIR CMAKE" >&2
  exit 2
fi
root=$(CDPATH='' cd -- "$1" && pwd)
build=$(CDPATH='' cd -- "$2" && pwd)
cmake=$3

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
prefix="$scratch/a prefix"
outside=$scratch/outside
log=$scratch/log
mkdir "$scratch/elsewhere"

die() {
  printf 'install: %s\n' "$*" >&2
  exit 1
}

failures=0
fail() {
  printf 'install: %s\n' "$*" >&2
  failures=$((failures + 1))
}

# Runs a command with its output in $log, shown only if it fails.
quietly() {
  what=$1
  shift
  if "$@" >"$log" 2>&1 </dev/null; then return 0; fi
  cat "$log" >&2
  die "$what failed"
}

have() { command -v "$1" >/dev/null 2>&1; }

quietly "cmake --install" "$cmake" --install "$build" --prefix "$prefix"

# Nothing points back.
package=$(find "$prefix" -type d -path '*/cmake/errmap')
[ -n "$package" ] || die "no CMake package"
if grep -rnF -e "$build" -e "$root/" "$package"; then
  fail "the package names a folder of the build"
fi

# The outside project, with the compiler and flags of the library (sanitisers
# must match).
cached() { sed -n "s/^$1:[^=]*=//p" "$build/CMakeCache.txt"; }
configure() {
  "$cmake" -S "$root/tests/outside_project" -B "$outside" \
    -G "$(cached CMAKE_GENERATOR)" \
    "-DCMAKE_MAKE_PROGRAM=$(cached CMAKE_MAKE_PROGRAM)" \
    "-DCMAKE_CXX_COMPILER=$(cached CMAKE_CXX_COMPILER)" \
    "-DCMAKE_CXX_FLAGS=$(cached CMAKE_CXX_FLAGS)" \
    "-DCMAKE_BUILD_TYPE=$(cached CMAKE_BUILD_TYPE)" \
    "-DCMAKE_PREFIX_PATH=$prefix" "$@"
}
quietly "configuring the outside project" configure
quietly "building the outside project" "$cmake" --build "$outside"
share=$prefix/share/errmap
table=$share/sets/nistir5367_xdisp_down.csv
[ -f "$table" ] || die "no $table"
# prints PROGRAM ARGUMENTS... -- WORDS: the program says these words.
prints() {
  program=$1
  shift
  arguments=""
  while [ "$1" != -- ]; do
    arguments="$arguments $1"
    shift
  done
  # shellcheck disable=SC2086 # a list of words
  (cd "$scratch/elsewhere" && quietly "running $program" \
    "$outside/$program" $arguments)
  grep -Fq -e "$2" "$log" || fail "$program prints: $(cat "$log")"
}
cp "$table" "$scratch/elsewhere/data.csv"
prints fit_predict_save data.csv map.json -- 'poly:full:degree=3 0.553'
prints early_stopping data.csv 6 -- 'ended by the caller'
prints lilliefors -- 'D = 0.10095'
prints one_row map.json -- '0 allocations'
prints my_model data.csv -- 'mm by neighbours'
prints compare data.csv results.json page.html -- '0.704 um RMSE (95 %'
cat >"$scratch/elsewhere/study.toml" <<'TOML'
holdouts = ["every:3", "groups:5"]
models = ["mean", "poly:eq8"]
[[component]]
data = "data.csv"
goal = "2um"
TOML
prints study study.toml study.json study.html -- 'poly:eq8'
"$prefix/bin/errmap" simulate turning-centre -o "$scratch/elsewhere/s" \
  --days 6 --cycles 6 --points 40 --dead 3,4,16,19 --quiet
prints machine s/machine.toml s machine.json -- 'recommended'
"$prefix/bin/errmap" predict "$scratch/elsewhere/early.json" "$table" --quiet \
  >"$log" || fail "predict does not know the net that was stopped early"
# An older language is refused in words.
if c++ -std=c++17 -fsyntax-only -isystem /usr/include/eigen3 \
  -I "$prefix/include" -include errmap/errmap.h -x c++ /dev/null 2>"$log"; then
  fail "C++17 compiles the headers"
fi
grep -Fq 'errmap needs C++20' "$log" || fail "C++17 is not refused in words"
for source in "$root"/tests/outside_project/*.cc; do
  most=25
  case $source in
    */my_model.cc) most=40 ;;
    */early_stopping.cc) most=35 ;;
  esac
  # Programs as short as the library is said to make them.
  [ "$(grep -c '[^ ]' "$source")" -le "$most" ] ||
    fail "$(basename "$source") has more than $most lines"
done
rm -rf "$outside"
quietly "configuring with the report alone" configure -DERRMAP_PARTS=report
quietly "building with the report alone" "$cmake" --build "$outside"
[ ! -e "$outside/study" ] || fail "the report alone builds more"
(cd "$scratch/elsewhere" &&
  quietly "running with the report alone" "$outside/report" study.json alone.html)
cmp "$scratch/elsewhere/study.html" "$scratch/elsewhere/alone.html" ||
  fail "the report alone draws another page"
rm -rf "$outside"
quietly "configuring with the statistics alone" configure \
  -DERRMAP_PARTS=stats -DCMAKE_DISABLE_FIND_PACKAGE_Ceres=TRUE \
  -DCMAKE_DISABLE_FIND_PACKAGE_NLopt=TRUE
quietly "building with the statistics alone" "$cmake" --build "$outside"
quietly "running with the statistics alone" "$outside/lilliefors"
if configure -DERRMAP_WANTED=99 >"$log" 2>&1; then
  fail "the package calls itself version 99"
fi
if configure -DERRMAP_WANTED=0.2 "-DCMAKE_CXX_FLAGS=-march=another" \
  >"$log" 2>&1; then
  fail "the package lets Eigen have another alignment than the library's"
fi
grep -q 'march=another' "$log" || fail "no word of -march: $(cat "$log")"

# The program.
PATH="$prefix/bin:$PATH"
export PATH
cd "$scratch/elsewhere"
[ "$(command -v errmap)" = "$prefix/bin/errmap" ] || die "no $prefix/bin/errmap"
quietly "errmap --version" errmap --version
quietly "errmap compare" errmap compare "$table" --models mean,poly:eq8
grep -q '^[* =] *poly:eq8 ' "$log" || fail "errmap compare prints no table"

# What the library made above: the program draws the same page from the same
# record, and finds the same record but for where and how long.
mkdir lib
cp results.json lib/results.json
quietly "errmap report" errmap report lib
cmp lib/report.html page.html || fail "compare draws another page"
cat >"$scratch/same.py" <<'SCRIPT'
import json, sys

def figures(value):
    """Less what is measured of the machine; keep_dead is --keep-dead."""
    if isinstance(value, str):
        return value.replace("--", "").replace("-", "_")
    if isinstance(value, list):
        return [figures(one) for one in value]
    if not isinstance(value, dict):
        return value
    return {
        key: figures(one)
        for key, one in value.items()
        if "seconds" not in key and not key.endswith("_ns") and key != "provenance"
    }

mine, theirs = (figures(json.load(open(name))) for name in sys.argv[1:])
for one, other in zip(mine["components"], theirs["components"]):
    for key in one:
        assert one[key] == other[key], key
assert mine == theirs
SCRIPT
# finds_what PROGRAM MINE WORDS...: errmap compare WORDS finds the same.
finds_what() {
  program=$1
  mine=$2
  shift 2
  errmap compare "$@" --quiet --format json >theirs.json
  python3 "$scratch/same.py" "$mine" theirs.json >"$log" 2>&1 ||
    fail "$program finds something else than errmap: $(tail -1 "$log")"
}
finds_what compare results.json data.csv
finds_what study study.json --config study.toml --set seed=2
finds_what machine machine.json --machine s/machine.toml s --later 2 \
  --holdout sessions:4 --models poly:ridge:view=raw
rm -r lib s theirs.json

# Schemas.
count=0
for schema in "$root"/cli/*/*.schema.json; do
  count=$((count + 1))
  cmp -s "$schema" "$share/schemas/$(basename "$schema")" ||
    fail "$(basename "$schema") is not installed"
done
[ "$count" -ge 4 ] || fail "only $count schemas in cli"

# The manual, where it could be made.
if [ -e "$build/manual/index.html" ]; then
  manual=$(find "$prefix" -path '*/manual/index.html')
  [ -n "$manual" ] || fail "the manual is not installed"
  [ -s "$(dirname "$manual")/cli/manual/tutorial.html" ] ||
    fail "the manual has no tutorial"
fi

# Completions.
: >data.csv
: >notes.txt
: >map.json
mkdir folder
# offers SHELL LINE WORDS: completing LINE gives just these, in any order.
offers() {
  sort -u offered >"$scratch/offered"
  # shellcheck disable=SC2086 # a list of words
  printf '%s\n' $3 | sort -u >"$scratch/expected"
  diff -u "$scratch/expected" "$scratch/offered" >"$log" ||
    fail "$1, '$2': $(sed 1,2d "$log")"
}

bash_offers() {
  bash --norc -c '
    source "$1"
    COMP_LINE=$2
    COMP_POINT=${#COMP_LINE}
    _errmap errmap
    printf "%s\n" "${COMPREPLY[@]}"
  ' bash "$prefix/share/bash-completion/completions/errmap" "$1" >offered
  offers bash "$1" "$2"
}
if have bash; then
  bash_offers "errmap comp" "compare"
  bash_offers "errmap compare --hol" "--holdout"
  bash_offers "errmap compare " "data.csv folder"
  bash_offers "errmap predict map.json data.csv -o fol" "folder"
  bash_offers "errmap compare data.csv --format j" "json"
  # What follows the last ':' or '=' is all that readline replaces.
  bash_offers "errmap compare data.csv --model net:nl" "nlopt"
  bash_offers "errmap compare data.csv --model net:scg:wf" "wfactor="
  bash_offers "errmap compare data.csv --models mean,poly:eq" "eq7 eq8 eq9"
  bash_offers "errmap compare data.csv --models mean,poly:none" ""
  bash_offers "errmap compare data.csv --holdout groups:5:re" "repeats=20"
  bash_offers "errmap compare data.csv --holdout file:da" "data.csv"
  bash_offers "errmap compare data.csv --out f" "folder"
fi

fish_script=$prefix/share/fish/vendor_completions.d/errmap.fish
[ -s "$fish_script" ] || fail "no completions for fish"
fish_offers() {
  fish --no-config -c '
    source $argv[1]
    complete -C $argv[2] | string replace -r "\t.*" ""
  ' "$fish_script" "$1" >offered || true # 1: nothing to replace
  offers fish "$1" "$2"
}
if have fish; then
  fish_offers "errmap comp" "compare"
  fish_offers "errmap compare data.csv --holdo" "--holdout"
  fish_offers "errmap compare data.csv --model net:nl" "net:nlopt"
  fish_offers "errmap compare da" "data.csv"
  fish_offers "errmap compare data.csv --holdout file:da" "file:data.csv"
fi

zsh_script=$prefix/share/zsh/site-functions/_errmap
[ -s "$zsh_script" ] || fail "no completions for zsh"
if have zsh; then zsh -n "$zsh_script" || fail "zsh cannot read $zsh_script"; fi

if [ "$failures" -ne 0 ]; then exit 1; fi
echo "install: package, program, $count schemas, completions"
