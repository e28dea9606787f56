#!/bin/sh
# No folder includes upwards, and each foreign library has one home:
#
#   check_includes.sh [ROOT]
#
# Looks at every .h and .cc of the project's folders under ROOT (default: the
# folder above this script) and prints each violation as file:line: what.
set -eu

root=${1:-$(dirname -- "$0")/..}
CDPATH='' cd -- "$root"

folders=""
for folder in stats data fitting models cli tests; do
  if [ -d "$folder" ]; then folders="$folders $folder"; fi
done
if [ -z "$folders" ]; then
  echo "check_includes: no source folder in $(pwd)" >&2
  exit 1
fi

report=$(mktemp)
trap 'rm -f "$report"' EXIT

# shellcheck disable=SC2086 # a list of words
find $folders -type f \( -name '*.h' -o -name '*.cc' \) -exec awk '
  BEGIN {
    # What each folder may include of ours.
    allowed["stats"] = " stats "
    allowed["data"] = " data "
    allowed["fitting"] = " fitting stats "
    allowed["models"] = " models fitting stats data "
    allowed["cli"] = " cli models fitting stats data "
    allowed["tests"] = " tests cli models fitting stats data "
  }

  function violation(what) { printf "%s:%d: %s\n", FILENAME, FNR, what }

  FNR == 1 {
    folder = FILENAME
    sub(/\/.*/, "", folder)
    is_header = FILENAME ~ /\.h$/
    public_header = is_header && folder ~ /^(stats|data|fitting|models)$/
    print "checked"
  }

  /^[ \t]*#[ \t]*include([ \t<"]|$)/ {
    line = $0
    sub(/^[ \t]*#[ \t]*include[ \t]*/, "", line)
    open = substr(line, 1, 1)
    if (open != "<" && open != "\"") {
      violation("include by macro cannot be checked: " line)
      next
    }
    name = substr(line, 2)
    if (open == "<") sub(/>.*/, "", name)
    else sub(/".*/, "", name)
    home = name
    sub(/\/.*/, "", home)
    ours = name ~ /\// && (home in allowed)

    if (open == "\"" && (!ours || name ~ /(^|\/)\.\.?\//)) {
      violation("\"" name "\" is not written from the root")
      next
    }
    if (open == "<" && ours) {
      violation("<" name "> is ours: write it in quotes")
    }
    if (ours) {
      if (home == "tests" && folder != "tests") {
        violation("nothing but tests includes " name)
      } else if (index(allowed[folder], " " home " ") == 0) {
        violation(folder "/ must not include " name)
      }
      next
    }

    if (name ~ /^ceres\// && FILENAME !~ /^fitting\/ceres_optimizer[^\/]*\.cc$/) {
      violation("<" name "> belongs in fitting/ceres_optimizer*.cc")
      next
    }
    if (name ~ /^nlopt/ && FILENAME !~ /^fitting\/nlopt_optimizer[^\/]*\.cc$/) {
      violation("<" name "> belongs in fitting/nlopt_optimizer*.cc")
      next
    }
    if (folder == "tests") next  # May use the other libraries.
    if (name ~ /^boost\// && FILENAME !~ /^stats\/.*\.cc$/) {
      violation("<" name "> belongs in stats/*.cc")
      next
    }
    if (name ~ /^CLI\// && FILENAME !~ /^cli\/.*\.cc$/) {
      violation("<" name "> belongs in cli/*.cc")
      next
    }
    if (name ~ /^nlohmann\// && FILENAME !~ /^(models\/.*\.cc|cli\/.*)$/) {
      violation("<" name "> belongs in models/*.cc and cli/")
      next
    }
    if (name ~ /^toml\+\+\// && FILENAME !~ /^cli\/study_file\.cc$/) {
      violation("<" name "> belongs in cli/study_file.cc")
      next
    }
    if (name ~ /^(gtest|gmock|benchmark)\//) {
      violation("<" name "> belongs in tests/")
      next
    }
    if (public_header && name !~ /^[a-z0-9_]+$/ &&
        name !~ /^(unsupported\/)?Eigen\//) {
      violation("a public header includes only the standard library, Eigen " \
                "and ours, not <" name ">")
    }
  }
' {} + >"$report"

checked=$(grep -cx checked "$report" || true)
if [ "$checked" -eq 0 ]; then
  echo "check_includes: no source file in $(pwd)" >&2
  exit 1
fi
if grep -qvx checked "$report"; then
  grep -vx checked "$report" | sort -t: -k1,1 -k2,2n
  echo "check_includes: failed" >&2
  exit 1
fi
echo "check_includes: $checked files, no violation"
