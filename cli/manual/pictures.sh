#!/bin/sh
# Draws the pictures of the manual with errmap, from the days of its tutorial:
#
#   pictures.sh ERRMAP OUT_DIR
set -eu

if [ $# -ne 2 ]; then
  echo "usage: pictures.sh ERRMAP OUT_DIR" >&2
  exit 2
fi
errmap=$(CDPATH='' cd -- "$(dirname -- "$1")" && pwd)/$(basename -- "$1")
mkdir -p "$2"
out=$(CDPATH='' cd -- "$2" && pwd)
sets=$(CDPATH='' cd -- "$(dirname -- "$0")/../../data/sets" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"

cp "$sets/turning_centre/six_days.csv" six.csv
"$errmap" compare six.csv --quiet --out study --models \
  mean,poly:position,poly:eq8,poly:full:degree=2,poly:ridge:view=auto,blend \
  >study.txt
"$errmap" learn six.csv --quiet --by sessions --out study >learn.txt
"$errmap" compare six.csv --quiet --out views --models \
  poly:ridge:view=raw,poly:ridge:view=history,poly:ridge:view=zero,poly:ridge:view=auto \
  >views.txt
"$errmap" report study --figures figures 2>report.txt
"$errmap" report views --figures view_figures 2>report.txt

keep() { cp "$1" "$out/$2.svg"; }
keep figures/c1-time.svg error
keep figures/c1-compensation.svg map
keep figures/c1-clock.svg cycle
keep study/learn-sessions.svg session
keep figures/c1-gap.svg hold-out
keep view_figures/c1-gap.svg view
keep figures/c1-units.svg blend
keep figures/c1-best-histogram.svg promise
keep figures/c1-best-map.svg probe
keep figures/c1-temperatures.svg inside
