#!/bin/sh
# The manual as HTML: a folder that opens from disk, with a search of its own.
#
#   make_html.sh ROOT CMARK_GFM ERRMAP OUT_DIR
#
# The pages of the project stand in OUT_DIR as they stand in ROOT, so that links
# between them lead where they did; cli/manual/reference.html is the program's.
set -eu

if [ $# -ne 4 ]; then
  echo "usage: make_html.sh ROOT CMARK_GFM ERRMAP OUT_DIR" >&2
  exit 2
fi
root=$(CDPATH='' cd -- "$1" && pwd)
cmark=$2
errmap=$3
rm -rf "$4"
mkdir -p "$4/cli/manual"
out=$(CDPATH='' cd -- "$4" && pwd)
cd "$root"

names=$(sed -n '/^set(manual_pages/,/)/p' cli/manual/pages.cmake |
  sed '1d; s/)//; s/ //g')
{
  "$errmap" __reference
  printf '\n## Files\n\nResults are JSON with published schemas.\n\n'
  printf '| schema | what it describes |\n|---|---|\n'
  mkdir -p "$out/cli/schemas"
  # By name, wherever they are.
  for schema in $(printf '%s\n' cli/*/*.schema.json | sort -t/ -k3); do
    cp "$schema" "$out/cli/schemas/"
    printf '| [%s](../schemas/%s) | %s |\n' "$(basename "$schema" .schema.json)" \
      "$(basename "$schema")" \
      "$(sed -n 's/^  "description": "\(.*\)",$/\1/p' "$schema" | sed 's/\\"/"/g; s/|/\\|/g')"
  done
} >"$out/cli/manual/reference.md"

title_of() { sed -n '1s/^#* *//p' "$1" | sed 's/`//g; s/&/\&amp;/g; s/</\&lt;/g'; }

# Entries of the contents, from the folder @UP@ on, for every page.
contents=$(
  printf '<li><a href="@UP@cli/manual/README.html">The manual</a></li>\n'
  for name in $names; do
    printf '<li><a href="@UP@cli/manual/%s.html">%s</a></li>\n' \
      "$name" "$(title_of "cli/manual/$name.md")"
  done
  printf '<li><a href="@UP@data/sets/examples.html">Gallery</a></li>\n'
  printf '<li><a href="@UP@cli/manual/reference.html">Reference</a></li>\n'
)

# The text of $1, read from $2, as a page of the folder.
page() {
  up=$(dirname "$1" | sed 's|^\.$||; s|[^/][^/]*|..|g; s|.$|&/|')
  html=$out/${1%.md}.html
  mkdir -p "$(dirname "$html")"
  {
    printf '<!doctype html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
    printf '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
    printf '<title>%s - errmap</title>\n' "$(title_of "$2")"
    printf '<link rel="stylesheet" href="%smanual.css">\n</head>\n<body>\n' "$up"
    printf '<a class="skip" href="#text">To the text</a>\n<nav aria-label="Contents">\n'
    printf '<form role="search" onsubmit="return false"><label for="find">Search</label>'
    printf '<input id="find" type="search" autocomplete="off" data-up="%s">' "$up"
    printf '<ul id="found" aria-live="polite"></ul></form>\n<ul>\n'
    printf '%s\n' "$contents" | sed "s|@UP@|$up|"
    printf '</ul>\n</nav>\n<main id="text">\n'
    # Headings get names; links to pages lead to pages.
    "$cmark" -e table -t html "$2" | sed -e \
      's/\(href="[^":]*\)\.md\(["#]\)/\1.html\2/g' |
      awk '/^<h[1-6]>/ {
          name = $0
          gsub(/<[^>]*>/, "", name)
          gsub(/&[a-z]*;/, "", name)
          name = tolower(name)
          gsub(/[^a-z0-9_ -]/, "", name)
          gsub(/ /, "-", name)
          sub(/>/, " id=\"" name "\">")
        }
        { print }'
    printf '</main>\n<script src="%ssearch_words.js"></script>\n' "$up"
    printf '<script src="%ssearch.js"></script>\n</body>\n</html>\n' "$up"
  } >"$html"
}

find . -path ./build -prune -o -name '*.md' -print | sed 's|^\./||' | sort |
  while IFS= read -r source; do page "$source" "$source"; done
page cli/manual/reference.md "$out/cli/manual/reference.md"
rm "$out/cli/manual/reference.md"
mkdir -p "$out/cli/manual/pictures" "$out/cli/report"
cp cli/manual/pictures/*.svg "$out/cli/manual/pictures/"
cp cli/report/page.png "$out/cli/report/"
cp cli/manual/manual.css cli/manual/search.js "$out/"

# What the search looks through: each section of the users' pages.
{
  echo 'const searchWords = ['
  for name in README $names reference ../../data/sets/examples; do
    awk -v page="$name" '
      function flush() {
        gsub(/<[^>]*>/, " ", text)
        gsub(/\\/, "\\\\&", text)
        gsub(/"/, "\\\"", text)
        gsub(/\t/, " ", text)
        if (title != "") {
          printf "[\"%s\", \"%s\", \"%s\", \"%s\"],\n", \
            page, anchor, title, text
        }
        text = ""
      }
      /<main/ { inside = 1 }
      /<\/main>/ { flush(); exit }
      !inside { next }
      /^<h[1-6] id=/ {
        flush()
        anchor = $0
        sub(/^[^"]*"/, "", anchor)
        sub(/".*/, "", anchor)
        title = $0
        gsub(/<[^>]*>/, "", title)
        gsub(/"/, "\\\"", title)
      }
      { text = text " " $0 }
    ' "$out/cli/manual/$name.html"
  done
  echo '];'
} >"$out/search_words.js"

cat >"$out/index.html" <<'HTML'
<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>errmap</title>
<meta http-equiv="refresh" content="0; url=cli/manual/README.html"></head>
<body><a href="cli/manual/README.html">The manual</a></body></html>
HTML
