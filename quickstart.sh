#!/bin/sh
# From a fresh Debian 12 and a clone to a result, without questions:
#
#   sh quickstart.sh        install what is missing, build, compare models on
#                           the shipped measurements
#   sh quickstart.sh test   the same, then the whole test suite
#   sh quickstart.sh python the package errmap for the python3 on the PATH
#
# Safe to run again: what is installed stays, the build is incremental. A
# package that is already there is never replaced or removed.
set -eu

packages="g++ cmake ninja-build libeigen3-dev libopenblas-dev libceres-dev
  libnlopt-dev libnlopt-cxx-dev libboost-dev libtbb-dev libcli11-dev
  nlohmann-json3-dev libfmt-dev libtomlplusplus-dev libssl-dev libsqlite3-dev
  zlib1g-dev libminizip-dev libpugixml-dev help2man"
test_packages="libgtest-dev libgmock-dev libbenchmark-dev clang-format-14 python3-jsonschema chromium patch"
python_packages="pybind11-dev python3-dev python3-pip python3-setuptools python3-wheel python3-numpy"
# Without these a few tests are skipped.
optional_packages="pybind11-dev python3-dev python3-pandas python3-sklearn
  python3-matplotlib python3-tqdm python3-nbclient python3-ipykernel mypy r-base-core
  r-cran-jsonlite clang cmark-gfm linuxcnc-uspace linuxcnc-uspace-dev slurm-wlm munge
  openmpi-bin mosquitto python3-paho-mqtt"
example="data/sets/turning_centre/six_days.csv"

usage="usage: sh quickstart.sh [test|python]"
step=""
log=""

say() { printf 'errmap: %s\n' "$*"; }
complain() { printf 'errmap: %s\n' "$*" >&2; }

at_exit() {
  status=$?
  if [ -n "$log" ]; then rm -f "$log"; fi
  if [ "$status" -ne 0 ] && [ -n "$step" ]; then
    complain "failed: $step"
  fi
  exit "$status"
}
trap at_exit EXIT
trap 'exit 130' INT
trap 'exit 143' TERM

# Runs a command with its output in $log, shown only if it fails.
quietly() {
  if "$@" >"$log" 2>&1 </dev/null; then return 0; fi
  cat "$log" >&2
  return 1
}

have() { command -v "$1" >/dev/null 2>&1; }

# Boost's headers may come from any package: is there a 1.74 or newer?
have_boost() {
  for header in /usr/include/boost/version.hpp \
    /usr/local/include/boost/version.hpp; do
    [ -r "$header" ] || continue
    version=$(awk '$1 == "#define" && $2 == "BOOST_VERSION" { print $3 }' \
      "$header")
    if [ "${version:-0}" -ge 107400 ]; then return 0; fi
  done
  return 1
}

# Is there something else that does the work of package $1?
have_equivalent() {
  case $1 in
    libboost-dev) have_boost ;;
    clang) have clang ;;
    clang-format-14) have clang-format-14 ;;
    chromium) have chromium || have chromium-browser || have google-chrome ;;
    libopenblas-dev) # Any flavour of it.
      case $(dpkg-query -W -f '${db:Status-Status} ' libopenblas-pthread-dev \
        libopenblas-openmp-dev libopenblas-serial-dev 2>/dev/null) in
        "installed "* | *" installed "*) return 0 ;;
      esac
      return 1
      ;;
    *) return 1 ;;
  esac
}

# Those of the packages "$@" that must be installed.
missing_packages() {
  installed=$(dpkg-query -W -f '${Package} ${db:Status-Status}\n' "$@" \
    2>/dev/null | awk '$2 == "installed" { print $1 }') || true
  for package in "$@"; do
    if printf '%s\n' "$installed" | grep -Fqx -e "$package"; then continue; fi
    if have_equivalent "$package"; then continue; fi
    printf '%s ' "$package"
  done
}

simulate_install() {
  LC_ALL=C apt-get install -s --no-install-recommends "$@" 2>&1 </dev/null
}

# Stops if installing "$@" would take away a package that is there.
refuse_to_replace() {
  removed=$(simulate_install "$@" |
    awk '$1 == "Remv" { printf " %s", $2 }') || true
  if [ -n "$removed" ]; then
    step=""
    complain "installing $* would remove$removed: nothing was installed;" \
      "settle the conflict yourself, then run this again"
    exit 1
  fi
}

# Stops if some of "$@" cannot be installed beside what is there.
refuse_to_conflict() {
  if simulate_install "$@" >/dev/null; then return 0; fi
  conflicts=""
  for package in "$@"; do
    simulate_install "$package" >/dev/null || conflicts="$conflicts $package"
  done
  step=""
  complain "Debian cannot install${conflicts:- $*} beside the packages that" \
    "are there: nothing was installed; see: apt-get install -s${conflicts:- $*}"
  exit 1
}

as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    env DEBIAN_FRONTEND=noninteractive "$@"
  else
    sudo env DEBIAN_FRONTEND=noninteractive "$@"
  fi
}

install_packages() {
  step="finding out which packages are missing"
  # shellcheck disable=SC2086 # a list of words
  missing=$(missing_packages $wanted)
  missing=${missing% }
  if [ -z "$missing" ]; then
    say "all packages are installed"
    return 0
  fi
  say "missing packages: $missing"
  # shellcheck disable=SC2086
  refuse_to_replace $missing
  if [ "$(id -u)" -ne 0 ] && ! have sudo; then
    step=""
    complain "neither root nor sudo: have an administrator run:" \
      "apt-get install --no-install-recommends $missing"
    exit 1
  fi
  say "fetching Debian's package lists"
  step="fetching Debian's package lists (apt-get update)"
  quietly as_root apt-get -o Acquire::Retries=3 update
  # With the new lists the answer may be another.
  # shellcheck disable=SC2086
  refuse_to_replace $missing
  # shellcheck disable=SC2086
  refuse_to_conflict $missing
  say "installing them"
  step="installing packages (apt-get install)"
  # shellcheck disable=SC2086
  quietly as_root apt-get install -y --no-install-recommends --no-remove \
    -o Acquire::Retries=3 -o DPkg::Lock::Timeout=120 $missing
}

# What Debian cannot install beside the rest only costs the tests that need it.
install_optional() {
  for package in $optional_packages; do
    if [ -z "$(missing_packages "$package")" ]; then continue; fi
    if simulate_install "$package" >"$log" && ! grep -q '^Remv ' "$log" &&
      as_root apt-get install -y --no-install-recommends --no-remove \
        -o Acquire::Retries=3 -o DPkg::Lock::Timeout=120 "$package" \
        >"$log" 2>&1 </dev/null; then
      say "installed $package for the tests"
    else
      say "$package cannot be installed: tests that need it are skipped"
    fi
  done
}

# Where there is no Debian, nothing is installed.
check_tools() {
  absent=""
  for tool in cmake ninja; do
    have "$tool" || absent="$absent $tool"
  done
  have c++ || have g++ || have clang++ || absent="$absent c++"
  if [ -n "$absent" ]; then
    complain "this is not Debian, so nothing was installed; missing:$absent" \
      "(and perhaps libraries: see the packages in quickstart.sh)"
    exit 1
  fi
  say "this is not Debian: nothing is installed, using what is there"
}

# One compiler per core, but not more than memory allows (1.75 GiB each).
compile_jobs() {
  jobs=$cores
  if [ -r /proc/meminfo ]; then
    room=$(awk '$1 == "MemTotal:" { print int($2 / 1835008) }' /proc/meminfo)
    if [ "${room:-$jobs}" -lt "$jobs" ]; then jobs=$room; fi
  fi
  if [ "$jobs" -lt 1 ]; then jobs=1; fi
  printf '%s\n' "$jobs"
}

# Builds target $3, which is $1 and takes one compiler $2 minutes of a 2023
# server's core: one line of progress on a terminal, nothing elsewhere.
build() {
  step="building (cmake --build build --target $3)"
  minutes=$((($2 + jobs - 1) / jobs))
  say "building $1: about $minutes min with $jobs compilers at a time, less" \
    "if some of it is built"
  if [ -t 1 ]; then
    NINJA_STATUS="errmap: %p of the build, %e s: " \
      cmake --build build --target "$3" --parallel "$jobs"
  else
    quietly cmake --build build --target "$3" --parallel "$jobs"
  fi
}

mode="compare"
if [ $# -gt 1 ]; then
  complain "$usage"
  exit 2
fi
case ${1-} in
  "") ;;
  test | python) mode=$1 ;;
  -h | --help)
    printf '%s\n' "$usage" \
      "Installs what is missing from Debian, builds errmap into build/ and" \
      "compares models on the shipped measurements; with 'test' it then runs" \
      "the test suite; with 'python' it builds the package errmap and installs" \
      "it for the python3 on the PATH."
    exit 0
    ;;
  *)
    complain "$usage"
    exit 2
    ;;
esac

CDPATH='' cd -- "$(dirname -- "$0")"
step="making a temporary file"
log=$(mktemp)

wanted=$packages
preset=release
tests=OFF
if [ "$mode" = python ]; then
  wanted="$packages $python_packages"
elif [ "$mode" = test ]; then
  wanted="$packages $test_packages"
  tests=ON
  # Warnings are errors only where they are ours to mend at once.
  if [ -n "${CI:-}" ]; then preset=ci; fi
fi
if have apt-get && have dpkg-query; then
  install_packages
  if [ "$mode" = test ]; then install_optional; fi
else
  step=""
  check_tools
fi

cores=$(nproc 2>/dev/null || echo 2)

if [ "$mode" = python ]; then
  python=$(python3 -c 'import sys; print(sys.executable)')
  step="building and installing the package errmap for $python (pip install ./cli/python)"
  say "building the package errmap for $python: some minutes"
  # Of what pip builds with, a Python without it is lent Debian's.
  debian=/usr/lib/python3/dist-packages
  lent=$(mktemp -d)
  for part in setuptools wheel; do
    "$python" -c "import $part" 2>/dev/null || ln -s "$debian/$part"* "$lent"
  done
  set -- --no-deps
  if PYTHONPATH=$lent "$python" -c 'import setuptools, wheel' 2>/dev/null; then
    set -- "$@" --no-build-isolation
  fi
  # An environment of its own has no packages of a user.
  if "$python" -c 'import sys; sys.exit(sys.prefix != sys.base_prefix)'; then
    set -- "$@" --user
  fi
  quietly env CMAKE_GENERATOR=Ninja "PYTHONPATH=$lent" PIP_BREAK_SYSTEM_PACKAGES=1 \
    "$python" -m pip install "$@" ./cli/python
  rm -r "$lent"
  cd /
  "$python" -c 'import errmap, os, sys
print("errmap: installed", errmap.__version__, "for", sys.executable, "in",
      os.path.dirname(os.path.dirname(errmap.__file__)))'
  exit 0
fi

say "configuring a Release build in build/"
step="configuring (cmake --preset $preset)"
quietly cmake --preset "$preset" -DERRMAP_BUILD_TESTS="$tests"

jobs=$(compile_jobs)
if [ "$mode" = test ]; then
  build "errmap and its tests" 15 all
else
  build errmap 6 errmap
fi

say "running: build/errmap compare $example"
step="build/errmap compare $example"
build/errmap compare "$example"

if [ "$mode" = test ]; then
  if [ "$cores" -lt 2 ]; then cores=2; fi
  say "running the test suite"
  rm -f "$log"
  # The last lines and the exit status are CTest's own.
  exec ctest --test-dir build --output-on-failure --no-tests=error \
    --parallel "$cores"
fi
