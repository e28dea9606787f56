#!/bin/sh
# No folder and no room in it includes upwards, no headers include each other
# in a circle, each foreign library has one home, and no text of the library
# names a flag of the command line (data::ArgumentName does):
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
    # What each room may include of its folder besides itself; a folder without
    # rooms here has none.
    rooms["stats"] = ""
    rooms["stats/normality"] = " stats "
    rooms["stats/comparison"] = " stats "
    rooms["fitting"] = ""
    rooms["fitting/least_squares"] = " fitting "
    rooms["fitting/selection"] = " fitting fitting/least_squares "
    rooms["fitting/minimisers"] = " fitting fitting/least_squares "
    rooms["fitting/nonlinear"] = " fitting fitting/least_squares " \
                                 "fitting/minimisers "
    rooms["data"] = ""
    rooms["data/files"] = " data "
    rooms["data/tables/cells"] = " data "
    rooms["data/tables/text"] = " data data/files data/tables/cells "
    rooms["data/tables/shapes"] = " data data/tables/cells "
    rooms["data/tables"] = rooms["data/tables/text"] \
                           "data/tables/text data/tables/shapes "
    rooms["data/measurements"] = rooms["data/tables"] \
                                 "data/tables data/measurements/axis " \
                                 "data/measurements/clock " \
                                 "data/measurements/reading "
    rooms["data/measurements/clock"] = " data data/measurements " \
                                       "data/measurements/reading "
    rooms["data/measurements/axis"] = rooms["data/measurements/clock"] \
                                      "data/measurements/clock "
    rooms["data/measurements/faults"] = rooms["data/measurements/axis"]
    rooms["data/measurements/reading"] = rooms["data/measurements/faults"] \
                                         "data/files " \
                                         "data/measurements/axis " \
                                         "data/measurements/faults "
    rooms["data/measurements/builders"] = rooms["data/measurements/reading"]
    rooms["data/formats"] = " data data/files data/measurements "
    rooms["models"] = ""
    rooms["models/history"] = " models "
    rooms["models/polynomial"] = " models models/history "
    rooms["models/net"] = " models models/history "
    rooms["models/blend"] = " models models/history models/polynomial " \
                            "models/net "
    rooms["models/file"] = " models models/history models/polynomial " \
                           "models/net models/blend "
    rooms["models/study"] = " models models/history models/polynomial " \
                            "models/net models/blend "
    rooms["models/study/journal"] = rooms["models/study"] "models/study " \
                                    "models/file "
    rooms["models/study/judgement"] = " models models/study "
    rooms["models/study/rezero"] = " models models/study " \
                                   "models/study/judgement "
    rooms["models/study/record"] = rooms["models/study"] "models/study " \
                                   "models/study/judgement " \
                                   "models/study/rezero models/export " \
                                   "models/export/program "
    rooms["models/study/record/builders"] = rooms["models/study/record"] \
                                          "models/study/record "
    rooms["models/sensors"] = rooms["models/study"] "models/study " \
                              "models/study/judgement "
    rooms["models/session"] = rooms["models/sensors"] "models/sensors "
    rooms["models/uncertainty"] = rooms["models/session"] "models/session "
    rooms["models/learning"] = rooms["models/sensors"] "models/study/record "
    rooms["models/fleet"] = rooms["models/session"] \
                            "models/session models/study/record "
    rooms["models/kinematics"] = " models models/history "
    rooms["models/export/program"] = " models models/history " \
                                     "models/polynomial models/net " \
                                     "models/blend "
    rooms["models/export"] = rooms["models/export/program"] \
                             "models/export/program "
    rooms["models/certification"] = " models models/polynomial models/net "
    rooms["models/comparison"] = rooms["models/uncertainty"] \
                                 "models/uncertainty models/study/record " \
                                 "models/study/rezero "
    # Libraries of their own: a record as words, tables, figures, pages.
    rooms["cli/report"] = ""
    rooms["cli/report/figures"] = " cli/report "
    rooms["cli/report/text/answers"] = rooms["cli/report/figures"]
    rooms["cli/report/text/commands"] = rooms["cli/report/text/answers"] \
                                         "cli/report/text/answers "
    rooms["cli/report/tables"] = rooms["cli/report/text/commands"] \
                                 "cli/report/text/commands "
    rooms["cli/report/documents"] = rooms["cli/report/tables"] \
                                    "cli/report/tables cli/report/figures "
    # What a study or a machine is given, and its run.
    rooms["cli/study_setup"] = rooms["cli/report/documents"] "cli/report/documents "
    rooms["cli/study_setup/plan"] = rooms["cli/study_setup"] "cli/study_setup "
    rooms["cli/study_setup/toml"] = rooms["cli/study_setup/plan"] "cli/study_setup/plan "
    # The command line, which is linked with all of them.
    rooms["cli"] = rooms["cli/study_setup/toml"] "cli/study_setup/toml "
    rooms["cli/shell"] = rooms["cli"] "cli "
    rooms["cli/output"] = rooms["cli/shell"] "cli/shell "
    rooms["cli/commands"] = rooms["cli/output"] "cli/output "
    rooms["cli/commands/studies"] = rooms["cli/commands"] "cli/commands "
    rooms["cli/commands/maps"] = rooms["cli/commands/studies"]
    rooms["cli/commands/control"] = rooms["cli/commands/maps"] \
                                    "cli/commands/maps "
    rooms["cli/python"] = rooms["cli/commands/maps"] "cli/commands/studies "
    # Slices: nothing else includes anything of them. `record` is what a slice
    # adds to a record.
    slice["cli/fleet"] = 1
    slice["cli/machine"] = 1
    slice["cli/netcg"] = 1
    slice["cli/turning_centre"] = 1
    rooms["cli/machine/record"] = rooms["cli/report/documents"]
    rooms["cli/machine"] = rooms["cli"] "cli/machine/record "
    rooms["cli/fleet/store"] = rooms["cli"]
    rooms["cli/fleet/run"] = rooms["cli"] "cli/fleet/store "
    rooms["cli/netcg"] = ""
    rooms["cli/turning_centre"] = ""
    for (name in slice) {
      rooms[name "/commands"] = rooms["cli/commands/control"] name " " \
                                "cli/commands/control cli/commands/studies "
    }
    rooms["cli/machine/commands"] = rooms["cli/machine/commands"] \
                                    "cli/machine/record "
    rooms["cli/fleet/commands"] = rooms["cli/fleet/commands"] \
                                  "cli/fleet/run cli/fleet/store "
    # These know every room, since they put them together.
    knows_all["cli/application.cc"] = 1
    knows_all["models/file_recipe.cc"] = 1
    knows_all["models/fitted_model.cc"] = 1
    knows_all["models/recipe_catalog.cc"] = 1
    knows_all["cli/report/report.cc"] = 1
  }

  function room_of(path) {
    sub(/\/[^\/]*$/, "", path)
    return path
  }

  function slice_of(room) {
    if (match(room, /^cli\/[a-z_]+/)) room = substr(room, 1, RLENGTH)
    return room in slice ? room : ""
  }

  function violation(what) { printf "%s:%d: %s\n", FILENAME, FNR, what }

  FNR == 1 {
    folder = FILENAME
    sub(/\/.*/, "", folder)
    is_header = FILENAME ~ /\.h$/
    room = room_of(FILENAME)
    public_header = is_header &&
        (folder ~ /^(stats|data|fitting|models)$/ ||
         room ~ /^cli\/(report|study_setup|machine)$|^cli\/(report|study_setup)\//)
    print "checked"
    if (folder != "tests" && !(room in rooms)) {
      violation("the room " room "/ is not known to this check")
    }
  }

  # Of the library, only the report and the page of a store print commands to
  # type; a study_setup reads them.
  (folder ~ /^(stats|data|fitting|models)$/ || room ~ /^cli\/(study_setup|fleet\/run)|^cli\/(machine|netcg|turning_centre)$/) &&
  /"([^"\\]|\\.)*--[a-z]/ && !/^[ \t]*\/\// {
    violation("a flag is named in a text; see data/argument_name.h")
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
      } else if (home == folder && folder != "tests") {
        other = room_of(name)
        if (slice_of(other) != "" && slice_of(other) != slice_of(room)) {
          violation(room "/ must not include the slice " name)
        } else if (other != room && !(FILENAME in knows_all) &&
            index(rooms[room], " " other " ") == 0) {
          violation(room "/ must not include " name)
        }
      }
      if (is_header) print "edge " FILENAME " " name
      next
    }

    if (name ~ /^ceres\// && FILENAME !~ /^fitting\/minimisers\/ceres_optimizer[^\/]*\.cc$/) {
      violation("<" name "> belongs in fitting/minimisers/ceres_optimizer*.cc")
      next
    }
    if (name ~ /^nlopt/ && FILENAME !~ /^fitting\/minimisers\/nlopt_optimizer[^\/]*\.cc$/) {
      violation("<" name "> belongs in fitting/minimisers/nlopt_optimizer*.cc")
      next
    }
    if (folder == "tests") next  # May use the other libraries.
    if (name ~ /^(oneapi\/)?tbb\// && name !~ /version/ &&
        FILENAME != "fitting/parallel_for.cc") {
      violation("<" name "> belongs in fitting/parallel_for.cc")
      next
    }
    if (name ~ /^boost\// && FILENAME !~ /^stats\/.*\.cc$/) {
      violation("<" name "> belongs in stats/*.cc")
      next
    }
    if (name ~ /^pybind11\// && FILENAME !~ /^cli\/python\//) {
      violation("<" name "> belongs in cli/python/")
      next
    }
    if (name ~ /^CLI\// && FILENAME !~ /^cli\/(shell\/.*|application)\.cc$/) {
      violation("<" name "> belongs in cli/shell/*.cc and cli/application.cc")
      next
    }
    # How records, models and findings become JSON; no public header includes
    # them, nor are they installed.
    if (FILENAME ~ /^models\/.*_json\.h$/) next
    if (name ~ /^nlohmann\// && FILENAME !~ /^(models\/.*\.cc|cli\/.*)$/) {
      violation("<" name "> belongs in models/*.cc and cli/")
      next
    }
    if (name ~ /^toml\+\+\// && FILENAME !~ /^cli\/study_setup\/toml\//) {
      violation("<" name "> belongs in cli/study_setup/toml/")
      next
    }
    # Nor is how TOML is read.
    if (FILENAME ~ /^cli\/study_setup\/toml\/toml_(keys|parser)\.h$/) next
    if (name ~ /^sqlite3/ && FILENAME !~ /^data\/files\/sqlite[^\/]*\.cc$/) {
      violation("<" name "> belongs in data/files/sqlite*.cc")
      next
    }
    if (name ~ /^zlib/ && FILENAME !~ /^data\/tables\/text\/gzip\.cc$/) {
      violation("<" name "> belongs in data/tables/text/gzip.cc")
      next
    }
    if (name ~ /^minizip\// && FILENAME !~ /^data\/tables\/text\/zip_archive\.cc$/) {
      violation("<" name "> belongs in data/tables/text/zip_archive.cc")
      next
    }
    if (name ~ /^pugixml/ && FILENAME !~ /^data\/tables\/text\/spreadsheet\.cc$/) {
      violation("<" name "> belongs in data/tables/text/spreadsheet.cc")
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
# tsort names the headers that include each other, if there are any.
sed -n 's/^edge //p' "$report" | tsort 2>&1 >/dev/null |
  sed -n 's/^tsort: \([^ ]*\/.*\)/\1: is in a circle of includes/p' >>"$report"
sed -i '/^edge /d' "$report"
if grep -qvx checked "$report"; then
  grep -vx checked "$report" | sort -t: -k1,1 -k2,2n
  echo "check_includes: failed" >&2
  exit 1
fi
echo "check_includes: $checked files, no violation"
