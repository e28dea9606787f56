#!/bin/sh
# Pages tell the truth: their commands run, their outputs are real, their C++
# compiles, links and runs.
#
#   README_commands_test.sh ROOT BUILD_DIR [developers|manual|gallery [--update]]
#
# developers: README.md and the READMEs of folders; manual: the users' pages;
# gallery: data/sets/examples.md. --update writes the outputs of today into the
# pages in place of comparing them: look at the difference before you keep it.
#
# Conventions of these pages that this relies on:
# - In a ```sh block, each line that starts with "errmap " (in the manual and
#   the gallery also with cp, sed and the like) is run (a trailing backslash continues it), in
#   the order of the text, in one scratch folder that holds a copy of data/sets.
#   Commands that cannot run stand in another block.
# - A ```text block that directly follows (blank lines apart) a ```sh block with
#   one command is that command's standard output. Measured times may
#   differ: numbers before s, ms, us or ns and numbers in columns headed by
#   such a unit; so may runs of blanks and dashes.
# - Between the two may stand "<!-- shown: SCRIPT -->": of the output the lines
#   that sed -n SCRIPT prints; and "<!-- digits masked -->": digits may differ;
#   or "<!-- nets masked -->": those of lines that name a net, and of the next,
#   may, as they do from one processor to another.
# - A ```cpp block is a whole program; run in the same scratch folder it exits
#   with 0.
set -eu

usage="README_commands_test.sh ROOT BUILD_DIR [developers|manual|gallery [--update]]"
if [ $# -lt 2 ] || [ $# -gt 4 ] || [ "${4---update}" != --update ]; then
  echo "usage: $usage" >&2
  exit 2
fi
root=$(CDPATH='' cd -- "$1" && pwd)
build=$(CDPATH='' cd -- "$2" && pwd)
set=${3-developers}
update=${4-}
starts="errmap "
# In this order, since later commands read what earlier ones wrote.
case $set in
manual | gallery)
  # As errmap help TOPIC shows it, indented by four.
  COLUMNS=76
  export COLUMNS
  ;;
esac
case $set in
manual)
  starts="(errmap|cp|head|cut|sed|cc|python3|printf) "
  pages=$(sed -n '/^set(manual_pages/,/)/p' "$root/cli/manual/pages.cmake" |
    sed '1d; s/)//; s/ //g; s|.*|cli/manual/&.md|')
  ;;
gallery)
  starts="(errmap|sed|printf|mkdir) "
  pages="data/sets/examples.md"
  ;;
developers)
  pages="README.md cli/study_setup/README.md models/README.md
  models/polynomial/README.md models/net/README.md models/history/README.md
  models/study/README.md models/uncertainty/README.md \
  models/uncertainty/measured.md models/session/README.md \
  models/session/measured.md
  models/export/README.md
  models/certification/README.md cli/netcg/README.md
  data/sets/nistir5367_xdisp_down.md data/sets/turning_centre/README.md
  cli/turning_centre/README.md
  data/sets/nistir5367_appendix_b.md data/sets/machines/README.md"
  ;;
*)
  echo "usage: $usage" >&2
  exit 2
  ;;
esac

die() {
  printf 'README: %s\n' "$*" >&2
  exit 1
}

[ -x "$build/errmap" ] || die "there is no $build/errmap: build it first"

failures=0
fail() {
  printf 'README: %s\n' "$*" >&2
  failures=$((failures + 1))
}

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
blocks=$scratch/blocks
work=$scratch/work
mkdir -p "$blocks" "$work/data"
readme=$scratch/pages.md
for page in $pages; do
  [ -f "$root/$page" ] || die "there is no $page"
  cat "$root/$page" >>"$readme"
  echo >>"$readme"
  # Links within the project lead somewhere.
  for link in $(sed 's/](/\n](/g' "$root/$page" |
    sed -n 's/^](\([^):#]*\)[^):]*).*/\1/p'); do
    [ -e "$root/$(dirname "$page")/$link" ] ||
      fail "$page links to $link, which is not there"
  done
done
cp -R "$root/data/sets" "$work/data/"
PATH=$build:$PATH
XDG_CACHE_HOME=$scratch/cache
export PATH XDG_CACHE_HOME

# The two commands, each on a line of its own in a ```sh block.
[ "$set" != developers ] || awk '/^```/ { inside = !inside && $0 ~ /^```sh[ \t]*$/; next } inside' \
  "$readme" >"$scratch/sh_lines"
for command in "sh quickstart.sh" "sh quickstart.sh test"; do
  [ "$set" = developers ] || continue
  sed 's/[[:space:]]*\(#.*\)\{0,1\}$//' "$scratch/sh_lines" |
    grep -Fqx -e "$command" || fail "does not name: $command"
done

# The blocks as files 001.sh, 002.text, ...; the index has number, language and
# whether only blank lines part it from the block before; 002.shown and
# 002.masked are what comments say of it.
awk -v blocks="$blocks" '
  /^```/ && !inside {
    inside = 1
    language = substr($0, 4)
    sub(/[ \t].*/, "", language)
    if (language !~ /^[a-z0-9+]+$/) language = "none"
    file = sprintf("%s/%03d.%s", blocks, ++count, language)
    printf "" >file
    printf "%03d %s %s\n", count, language, (prose ? "apart" : "adjacent")
    if (shown != "") {
      print shown >sprintf("%s/%03d.shown", blocks, count)
      close(sprintf("%s/%03d.shown", blocks, count))
    }
    if (masked != "") {
      print masked >sprintf("%s/%03d.masked", blocks, count)
      close(sprintf("%s/%03d.masked", blocks, count))
    }
    shown = ""
    masked = ""
    next
  }
  !inside && /^<!-- (digits|nets) masked -->$/ { masked = $2; next }
  !inside && /^<!-- shown: .* -->$/ {
    shown = substr($0, 13, length($0) - 16)
    next
  }
  /^```/ { inside = 0; prose = 0; close(file); next }
  inside { print >file; next }
  /[^ \t]/ { prose = 1 }
  END { if (inside) { print "open fence" >"/dev/stderr"; exit 1 } }
' "$readme" >"$scratch/index" || die "has a code block without an end"

# Replaces what a clock decides by "#": see the top of this file. Letters
# beyond ASCII become one "?" each, so that columns can be counted.
mask_times() {
  LC_ALL=C sed -e 's/\xc2\xb5s/us/g' -e 's/[\xc0-\xf7][\x80-\xbf]*/?/g' "$1" |
    LC_ALL=C awk '
    function numeric(token) {
      return token ~ /^[-+~<("]*[0-9][0-9.,]*([eE][-+]?[0-9]+)?[),;"]*$/
    }
    function unit(token) { return token ~ /^[(\[]?(s|ms|us|ns)[])]?[.,;:|"]*$/ }
    # Start and end of the tokens of this line.
    function split_line(line,   rest, at) {
      count = 0
      at = 1
      rest = line
      while (match(rest, /[^ \t]+/)) {
        token[++count] = substr(rest, RSTART, RLENGTH)
        first[count] = at + RSTART - 1
        last[count] = first[count] + RLENGTH - 1
        at += RSTART + RLENGTH - 1
        rest = substr(rest, RSTART + RLENGTH)
      }
    }
    /^[ \t]*$/ { columns = 0; print ""; next }
    {
      split_line($0)
      out = ""
      headings = 0
      for (i = 1; i <= count; ++i) {
        masked = token[i]
        if (unit(token[i])) {
          if (i > 1 && numeric(token[i - 1])) {
            masked = ""
          } else {
            # A heading: it reaches left to where two blanks part it.
            left = i
            while (left > 1 && first[left] - last[left - 1] == 2) --left
            ++headings
            new_left[headings] = first[left]
            new_right[headings] = last[i]
          }
        } else if (numeric(token[i])) {
          if (i < count && unit(token[i + 1])) masked = "#"
          for (c = 1; c <= columns; ++c) {
            if (first[i] <= right_of[c] && last[i] >= left_of[c]) masked = "#"
          }
        }
        if (masked != "") out = out (out == "" ? "" : " ") masked
      }
      if (headings > 0) {
        columns = headings
        for (c = 1; c <= columns; ++c) {
          left_of[c] = new_left[c]
          right_of[c] = new_right[c]
        }
      }
      gsub(/---*/, "-", out)
      gsub(/\?\?\?*/, "?", out)
      print out
    }'
}

commands=0
outputs=0
programs=0
single=""
while read -r number language gap; do
  block=$blocks/$number.$language
  if [ "$language" = text ] && [ "$gap" = adjacent ] && [ -n "$single" ]; then
    outputs=$((outputs + 1))
    shown=$blocks/$number.shown
    if [ -f "$shown" ]; then
      sed -n "$(cat "$shown")" "$scratch/stdout" >"$scratch/part"
      mv "$scratch/part" "$scratch/stdout"
    fi
    if [ -n "$update" ]; then cp "$scratch/stdout" "$blocks/$number.new"; fi
    mask_times "$block" >"$scratch/expected"
    mask_times "$scratch/stdout" >"$scratch/actual"
    if [ -f "$blocks/$number.masked" ]; then
      case $(cat "$blocks/$number.masked") in
      nets) where='/net:/,+1' ;;
      *) where='' ;;
      esac
      for side in expected actual; do
        sed "$where{s/[0-9][0-9]*/#/g; s/  */ /g}" "$scratch/$side" >"$scratch/part"
        mv "$scratch/part" "$scratch/$side"
      done
    fi
    if [ -z "$update" ] &&
      ! diff -u "$scratch/expected" "$scratch/actual" >"$scratch/diff"; then
      fail "the output of '$single' is not what it shows (- README, + now):"
      sed '1,2d' "$scratch/diff" >&2
    fi
  fi
  single=""
  case $language in
    sh)
      # Lines joined at trailing backslashes.
      awk -v starts="^$starts" '{
        line = line $0
        if (sub(/\\$/, " ", line)) next
        if (line ~ starts) print line
        line = ""
      }' "$block" >"$scratch/commands"
      while IFS= read -r command; do
        commands=$((commands + 1))
        status=0
        (cd "$work" && sh -c "$command") >"$scratch/stdout" \
          2>"$scratch/stderr" </dev/null || status=$?
        # A check of a session's first minutes knows nothing of its rest yet.
        case "$status $command" in
        "5 errmap check "*) status=0 ;;
        esac
        if [ "$status" -ne 0 ]; then
          fail "'$command' exits with $status:"
          sed 's/^/    /' "$scratch/stderr" >&2
        fi
        single=$command
      done <"$scratch/commands"
      if [ "$(wc -l <"$scratch/commands")" -ne 1 ]; then single=""; fi
      ;;
    cpp)
      programs=$((programs + 1))
      cache=$build/CMakeCache.txt
      [ -f "$cache" ] || die "there is no $cache: configure first"
      compiler=$(sed -n 's/^CMAKE_CXX_COMPILER:[^=]*=//p' "$cache")
      flags=$(sed -n 's/^CMAKE_CXX_FLAGS:[^=]*=//p' "$cache")
      # What errmap itself is linked with; a folder's library may need any.
      libraries=$(awk '
        /^build errmap[: ]/ { inside = 1 }
        inside && /^ *LINK_LIBRARIES = / {
          sub(/^ *LINK_LIBRARIES = /, ""); print; exit
        }' "$build/build.ninja" 2>/dev/null || true)
      if [ -z "$libraries" ]; then
        libraries="-Wl,--start-group"
        for library in "$build"/liberrmap_*.a; do
          libraries="$libraries $library"
        done
        libraries="$libraries -Wl,--end-group -lfmt -ltbb -lcrypto"
      fi
      cp "$block" "$scratch/readme_example.cc"
      status=0
      # shellcheck disable=SC2086 # lists of words
      "${CMAKE_COMMAND:-cmake}" -DERRMAP_SOURCE="$root" \
        -DERRMAP_INCLUDE="$scratch/include" \
        -P "$root/cli/package/install_headers.cmake" >"$scratch/log" 2>&1 ||
        fail "the headers cannot be installed"
      (cd "$build" && "${compiler:-g++}" -std=c++20 $flags -I "$scratch/include" \
        -isystem /usr/include/eigen3 "$scratch/readme_example.cc" \
        -o "$work/readme_example" $libraries) >"$scratch/log" 2>&1 || status=$?
      if [ "$status" -ne 0 ]; then
        fail "the C++ example does not compile and link:"
        sed 's/^/    /' "$scratch/log" >&2
        continue
      fi
      (cd "$work" && ./readme_example) >"$scratch/log" 2>&1 </dev/null ||
        status=$?
      if [ "$status" -ne 0 ]; then
        fail "the C++ example exits with $status:"
        sed 's/^/    /' "$scratch/log" >&2
      fi
      ;;
  esac
done <"$scratch/index"

# The pages again, each output that was seen in its place.
if [ -n "$update" ]; then
  before=0
  for page in $pages; do
    awk -v blocks="$blocks" -v count="$before" '
      /^```/ && !inside {
        print
        inside = 1
        file = sprintf("%s/%03d.new", blocks, ++count)
        replaced = (getline line <file) > 0
        if (replaced) do print line; while ((getline line <file) > 0)
        next
      }
      /^```/ { inside = 0 }
      !inside || !replaced || /^```/ { print }
    ' "$root/$page" >"$scratch/page"
    before=$((before + $(grep -c '^```' "$root/$page") / 2)) || true
    cmp -s "$scratch/page" "$root/$page" || cp "$scratch/page" "$root/$page"
  done
fi

# A test that finds nothing proves nothing.
[ "$commands" -gt 0 ] || fail "has no errmap command in a \`\`\`sh block"
[ "$outputs" -gt 0 ] || fail "shows no output (\`\`\`text after \`\`\`sh)"
[ "$programs" -gt 0 ] || [ "$set" != manual ] ||
  fail "has no C++ example (\`\`\`cpp)"

if [ "$failures" -ne 0 ]; then exit 1; fi
echo "README: $commands commands, $outputs outputs, $programs C++ examples"
