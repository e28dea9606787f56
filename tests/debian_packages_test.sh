#!/bin/sh
# Debian's packages: built, looked at by lintian, installed by dpkg into a clean
# Debian 12, used from /usr, and removed without a trace.
#
#   debian_packages_test.sh ROOT BUILD_DIR CPACK
#
# Needs root, lintian, debootstrap and a mirror; exits with 77 where one of them
# is not there. Takes minutes, so it runs by name alone:
#
#   ctest --test-dir build -C packages -R '^debian_packages$'
set -eu

if [ $# -ne 3 ]; then
  echo "usage: debian_packages_test.sh ROOT BUILD_DIR CPACK" >&2
  exit 2
fi
root=$(CDPATH='' cd -- "$1" && pwd)
build=$(CDPATH='' cd -- "$2" && pwd)
cpack=$3

skip() {
  printf 'skipped: %s\n' "$*"
  exit 77
}
[ "$(id -u)" -eq 0 ] || skip "debootstrap needs root"
for tool in lintian debootstrap dpkg-shlibdeps; do
  command -v "$tool" >/dev/null 2>&1 ||
    skip "apt-get install lintian debootstrap dpkg-dev"
done

scratch=$(mktemp -d)
clean=$scratch/debian
at_exit() {
  umount "$clean/proc" 2>/dev/null || true
  rm -rf "$scratch"
}
trap at_exit EXIT
log=$scratch/log

die() {
  printf 'debian_packages: %s\n' "$*" >&2
  exit 1
}
quietly() {
  if "$@" >"$log" 2>&1 </dev/null; then return 0; fi
  cat "$log" >&2
  die "$1 failed"
}

quietly "$cpack" --config "$build/CPackConfig.cmake" -B "$scratch/packages"
set -- "$scratch"/packages/*.deb
[ $# -ge 2 ] || die "only $# packages: $*"
quietly lintian --allow-root --fail-on error,warning \
  --suppress-tags no-manual-page "$@"
if [ -s "$log" ]; then cat "$log"; fi

debootstrap --variant=minbase bookworm "$clean" >"$log" 2>&1 </dev/null ||
  skip "no Debian 12 from a mirror: $(tail -1 "$log")"
mount -t proc proc "$clean/proc" || skip "cannot mount /proc"
mkdir "$clean/packages"
cp "$@" "$clean/packages/"
inside() { chroot "$clean" env DEBIAN_FRONTEND=noninteractive "$@"; }
cp /etc/resolv.conf "$clean/etc/resolv.conf" 2>/dev/null || true
files() { (cd "$clean" && find usr etc -type f | sort); }
files >"$scratch/before"
names=""
for package in "$@"; do
  names="$names $(dpkg-deb -f "$package" Package)"
done
# What they depend on, and then they by themselves.
quietly inside apt-get update
quietly inside sh -c 'apt-get install -y --no-install-recommends /packages/*.deb g++ cmake make'

# The README's main job, from /usr.
table=/usr/share/errmap/sets/nistir5367_xdisp_down.csv
quietly inside errmap compare "$table"
grep -q '^Use blend: 0.704 um RMSE' "$log" || die "errmap says: $(cat "$log")"
quietly inside sh -c "[ -s /usr/share/bash-completion/completions/errmap ]"
case $names in
*python3-errmap*)
  quietly inside python3 -c "
import errmap
study = errmap.compare('$table', models=['mean', 'poly:eq8'], progress=False)
assert study.recommendation['model'], study"
  ;;
esac
# A program of ten lines.
mkdir "$clean/outside"
cat >"$clean/outside/CMakeLists.txt" <<'CMAKE'
cmake_minimum_required(VERSION 3.25)
project(outside CXX)
find_package(errmap REQUIRED)
add_executable(outside outside.cc)
target_link_libraries(outside PRIVATE errmap::errmap)
CMAKE
cat >"$clean/outside/outside.cc" <<'CPP'
#include <cstdio>
#include <errmap/errmap.h>
int main() {
  std::puts(errmap::models::Version());
}
CPP
quietly inside sh -c 'cd /outside && cmake -B build && cmake --build build && build/outside'
version=$(sed -n 's/^project(errmap VERSION \([0-9.]*\).*/\1/p' "$root/CMakeLists.txt")
grep -Fqx "$version" "$log" || die "the library has another version than $version"

# shellcheck disable=SC2086 # a list of words
quietly inside dpkg --purge $names
if (cd "$clean" && find usr etc var/lib/dpkg/info -iname '*errmap*') | grep .; then
  die "these files are left behind"
fi
echo "debian_packages: installed, used and removed:$names"
