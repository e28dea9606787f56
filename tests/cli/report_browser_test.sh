#!/bin/sh
# The report as a browser shows it, on a study_setup (1280 px), on a phone (390 px) and
# on paper:
#
#   report_browser_test.sh ERRMAP ROOT [PAGE]
#
# PAGE, of a fleet, is looked at alone.
# No message on the console, nothing fetched, every figure there and described,
# no overflow, no labels on one another, no NaN, one unit of length, the headline's
# error the table's, contrast at least 4.5 to 1, and no longer than is read: 6000 px
# at 1280 before anything is unfolded, 3 pages for a component, 3 and 2 per
# component for six. No quarter of a component's first screen is empty. By keyboard alone everything is reached and opened
# (report_keyboard.py). Exit status 77 where there is no Chromium.
set -eu

errmap=$1
root=$2

browser=""
for candidate in chromium chromium-browser google-chrome; do
  if command -v "$candidate" >/dev/null 2>&1; then
    browser=$candidate
    break
  fi
done
if [ -z "$browser" ]; then
  echo "report_browser: skipped, no Chromium: apt-get install chromium"
  exit 77
fi
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failed=0
complain() {
  echo "report_browser: $*" >&2
  failed=1
}

# run FLAG... URL
run() {
  timeout 60 "$browser" --headless --no-sandbox --disable-gpu \
    --disable-dev-shm-usage --no-first-run --disable-background-networking \
    --disable-component-update --user-data-dir="$scratch/profile" \
    --enable-logging=stderr --host-resolver-rules='MAP * ~NOTFOUND' \
    "$@" </dev/null
}

# browse OUTPUT FLAG... URL: the page's DOM, and its console in OUTPUT.err.
browse() {
  output=$1
  shift
  run --virtual-time-budget=15000 --dump-dom "$@" >"$output" 2>"$output.err"
}

# Runs in a copy of the page and tells the page around it what it found.
cat >"$scratch/check.js" <<'END'
(function () {
  var found = [];
  function say(what) { if (found.length < 20) found.push(what); }
  function place(e) {
    return e.tagName + '.' + (e.getAttribute('class') || '') + ' "' +
      (e.textContent || '').trim().slice(0, 40) + '"';
  }
  var length = document.documentElement.scrollHeight;
  [0, 1, 2, 3].forEach(function (quarter) {
    if (innerWidth < 1200 || !document.querySelector('main > section .answer')) return;
    var drawn = 0;
    for (var i = 0; i < 400; ++i) {
      var e = document.elementFromPoint(
        (quarter % 2 + (i % 20 + .5) / 20) * innerWidth / 2,
        (Math.floor(quarter / 2) + (Math.floor(i / 20) + .5) / 20) * 400);
      if (e && !/^(HTML|BODY|MAIN|SECTION|DIV)$/.test(e.tagName)) drawn += 1;
    }
    if (drawn < 40) say('quarter ' + quarter + ' of the first screen is empty: ' + drawn);
  });
  document.querySelectorAll('details').forEach(function (d) { d.open = true; });
  var number = document.querySelector('section .number');
  var marked = document.querySelector('section tr.mark td:nth-child(2)');
  if (number && marked &&
      number.textContent.split(' ')[0] !== marked.textContent.split(' ')[0]) {
    say('the headline says ' + number.textContent + ', the table ' + marked.textContent);
  }
  var width = document.documentElement.clientWidth;
  if (document.documentElement.scrollWidth > width) {
    say('the page is ' + document.documentElement.scrollWidth + ' px wide');
  }
  document.querySelectorAll('main *').forEach(function (e) {
    if (e.closest('.scroll') && !e.classList.contains('scroll')) return;
    if (e.closest('svg') && e.tagName !== 'svg') return;
    if (e.getBoundingClientRect().right > width + 1) say('overflow: ' + place(e));
  });
  var figures = document.querySelectorAll('figure');
  var drawn = 0;
  figures.forEach(function (f) {
    var svg = f.querySelector('svg');
    if (!svg) {
      say('empty panel: ' + place(f));
      return;
    }
    drawn += 1;
    var box = svg.getBoundingClientRect();
    if (box.width < 100 || box.height < 80) say('small figure: ' + place(f));
    if (svg.getAttribute('role') !== 'img') say('no role: ' + place(f));
    ['title', 'desc'].forEach(function (name) {
      var e = svg.querySelector(name);
      if (!e || e.textContent.trim().length < 3) say('no ' + name + ': ' + place(f));
    });
    if (svg.querySelectorAll('path,polygon,circle').length < 3) say('nothing drawn: ' + place(f));
    if (svg.querySelectorAll('text').length < 4) say('no labels: ' + place(f));
    var level = Array.from(svg.querySelectorAll('text')).filter(function (t) {
      return !t.getAttribute('transform');
    }).map(function (t) { return [t, t.getBoundingClientRect()]; });
    level.forEach(function (one, i) {
      level.slice(i + 1).forEach(function (other) {
        var a = one[1], b = other[1];
        if (a.left < b.right - 1 && b.left < a.right - 1 &&
            a.top < b.bottom - 3 && b.top < a.bottom - 3) {
          say('"' + one[0].textContent + '" on "' + other[0].textContent + '" of ' + place(f));
        }
      });
    });
    var frame = svg.getBoundingClientRect();
    svg.querySelectorAll('text').forEach(function (t) {
      var b = t.getBoundingClientRect();
      if (b.left < frame.left - 2 || b.right > frame.right + 2 ||
          b.bottom > frame.bottom + 2) {
        say('label cut off: "' + t.textContent + '" of ' + place(f));
      }
    });
  });
  var ids = {};
  document.querySelectorAll('[id]').forEach(function (e) {
    if (ids[e.id]) say('id twice: ' + e.id);
    ids[e.id] = true;
  });
  document.querySelectorAll('[aria-labelledby]').forEach(function (e) {
    e.getAttribute('aria-labelledby').split(' ').forEach(function (id) {
      if (!ids[id]) say('no such id: ' + id);
    });
  });
  function channels(colour) {
    var m = colour.match(/[\d.]+/g);
    return m ? m.map(Number) : [0, 0, 0, 0];
  }
  function luminance(c) {
    return [0.2126, 0.7152, 0.0722].reduce(function (sum, weight, i) {
      var v = c[i] / 255;
      return sum + weight * (v <= 0.03928 ? v / 12.92 : Math.pow((v + 0.055) / 1.055, 2.4));
    }, 0);
  }
  function background(e) {
    for (; e; e = e.parentElement) {
      var c = channels(getComputedStyle(e).backgroundColor);
      if (c.length < 4 || c[3] > 0) return c;
    }
    return [255, 255, 255];
  }
  var walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  var texts = 0;
  while (walker.nextNode()) {
    var text = walker.currentNode.nodeValue.trim();
    var holder = walker.currentNode.parentElement;
    if (!text || /^(SCRIPT|STYLE|TITLE|DESC)$/i.test(holder.tagName)) continue;
    texts += 1;
    if (/(^|[^A-Za-z])(nan|NaN|null|undefined|inf|Infinity)($|[^A-Za-z])/.test(text)) {
      say('not a figure: "' + text.slice(0, 60) + '"');
    }
    if (/[0-9,] um($|[^A-Za-z_])/.test(text)) say('um beside µm: "' + text.slice(0, 60) + '"');
    var style = getComputedStyle(holder);
    var ink = channels(holder.closest('svg') ? style.fill : style.color);
    var a = luminance(ink), b = luminance(background(holder));
    var ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
    if (ratio < 4.5) say('contrast ' + ratio.toFixed(2) + ': ' + place(holder));
  }
  performance.getEntriesByType('resource').forEach(function (r) { say('fetched ' + r.name); });
  window.top.postMessage({width: width, length: length, figures: figures.length, drawn: drawn,
                      texts: texts, found: found}, '*');
})();
END

# look PAGE LEAST LONGEST PAGES: LEAST is how many figures there must be, LONGEST
# the px at 1280, PAGES the pages of paper (0: nobody prints that).
look() {
  page=$1
  least=$2
  longest=$3
  pages=$4
  # The page's own policy forbids the scripts of this test; nothing else goes.
  {
    sed -e 's/<meta http-equiv="Content-Security-Policy"[^>]*>//' \
      -e '/<\/body>/,$d' "$page"
    echo "<script>"
    cat "$scratch/check.js"
    echo "</script></body></html>"
  } >"$scratch/copy.html"
  cat >"$scratch/frames.html" <<'END'
<!DOCTYPE html><html><head><meta charset="utf-8"><link rel="icon" href="data:,"></head><body>
<ol id="out"></ol><script>
addEventListener('message', function (e) {
  var li = document.createElement('li');
  li.textContent = 'SEEN ' + JSON.stringify(e.data);
  document.getElementById('out').appendChild(li);
});
</script>
<iframe src="copy.html" style="width:1280px;height:900px;border:0"></iframe>
<iframe src="copy.html" style="width:390px;height:800px;border:0"></iframe>
</body></html>
END
  if ! browse "$scratch/dom" --window-size=1700,1000 \
    "file://$scratch/frames.html"; then
    complain "$browser failed on $page"
    tail -5 "$scratch/dom.err" >&2
    return 0
  fi
  grep -o 'SEEN {[^<]*' "$scratch/dom" >"$scratch/seen" || :
  if [ "$(wc -l <"$scratch/seen")" -ne 2 ]; then
    complain "$page was not looked at in both widths"
    tail -5 "$scratch/dom.err" >&2
  fi
  while IFS= read -r line; do
    case $line in
      *'"found":[]'*) ;;
      *) complain "$page: $line" ;;
    esac
    drawn=$(printf '%s\n' "$line" | sed 's/.*"drawn":\([0-9]*\).*/\1/')
    if [ "$drawn" -lt "$least" ]; then
      complain "$page: $drawn figures, at least $least are needed"
    fi
    length=$(printf '%s\n' "$line" | sed 's/.*"length":\([0-9]*\).*/\1/')
    case $line in
      *'"width":1280'* | *'"width":126'*)
        if [ "$length" -gt "$longest" ]; then
          complain "$page is $length px long, at most $longest are read"
        fi
        ;;
    esac
  done <"$scratch/seen"
  if [ "$pages" -gt 0 ]; then
    run --no-pdf-header-footer --print-to-pdf="$scratch/page.pdf" \
      "file://$page" >/dev/null 2>&1 || complain "$browser cannot print $page"
    printed=$(LC_ALL=C grep -a -o '/Count [0-9]*' "$scratch/page.pdf" |
      sed -n '1s/.* //p')
    if [ "${printed:-0}" -lt 1 ] || [ "$printed" -gt "$pages" ]; then
      complain "$page prints on $printed pages, at most $pages are carried about"
    fi
  fi
  python3 "$root/tests/cli/report_keyboard.py" "$browser" "$page" >/dev/null ||
    complain "$page cannot be read by keyboard"
  # The page itself, with its own policy.
  browse "$scratch/plain" --window-size=1280,900 "file://$page" ||
    complain "$browser failed on $page itself"
  if grep CONSOLE "$scratch/plain.err" >&2; then
    complain "$page wrote to the console"
  fi
}

if [ $# -gt 2 ]; then
  look "$3" 1 6000 15
  exit "$failed"
fi

data="$root/data/sets/nistir5367_xdisp_down.csv"
"$errmap" compare "$data" --quiet --out "$scratch/study" \
  --models zero,mean,poly:position,poly:eq8,poly:full:degree=3,net:scg:iterations=60 \
  >"$scratch/table"
"$errmap" report "$scratch/study"
look "$scratch/study/report.html" 12 6000 3

# With the curves of errmap learn on it.
"$errmap" learn "$data" --by cycles --repeats 1 --models mean,poly:eq8 --quiet \
  --out "$scratch/study" >"$scratch/learnt"
"$errmap" report "$scratch/study"
look "$scratch/study/report.html" 13 6000 3
if [ "$(wc -c <"$scratch/study/report.html")" -gt 600000 ]; then
  complain "the page of a component is larger than 600 kB"
fi

# Six components, of 40 thermocouples and 1190 rows each.
mkdir "$scratch/six"
{
  echo 'models = ["mean", "poly:eq8", "poly:full:degree=1"]'
  for i in 1 2 3 4 5 6; do
    cp "$root/data/sets/turning_centre/x_displacement_down.csv" \
      "$scratch/six/c$i.csv"
    printf '[[component]]\nname = "component %s"\ndata = "c%s.csv"\n' "$i" "$i"
  done
} >"$scratch/six/study.toml"
(
  cd "$scratch/six"
  "$errmap" compare --config study.toml --quiet --out study >table
)
look "$scratch/six/study/report.html" 18 6000 15
if [ "$(wc -c <"$scratch/six/study/report.html")" -gt 2000000 ]; then
  complain "the page of six components is larger than 2 MB"
fi

# A hundred components, of which most is folded.
mkdir "$scratch/hundred"
{
  echo 'models = ["mean", "poly:eq8"]'
  i=0
  while [ "$i" -lt 100 ]; do
    i=$((i + 1))
    printf '[[component]]\nname = "component %s"\ndata = "c.csv"\n' "$i"
  done
} >"$scratch/hundred/study.toml"
cp "$data" "$scratch/hundred/c.csv"
(
  cd "$scratch/hundred"
  "$errmap" compare --config study.toml --quiet --out study >table
)
look "$scratch/hundred/study/report.html" 100 12000 0
if [ "$(wc -c <"$scratch/hundred/study/report.html")" -gt 5000000 ]; then
  complain "the page of a hundred components is larger than 5 MB"
fi
if [ "$(grep -c 'aria-label="RMSE by cycle: ' \
  "$scratch/hundred/study/report.html")" -lt 100 ]; then
  complain "the overview of a hundred components has no line of each"
fi

# A fleet of two machines.
mkdir -p "$scratch/fleet/m1" "$scratch/fleet/m2"
for machine in m1 m2; do
  for component in x y; do
    cp "$data" "$scratch/fleet/$machine/$component.csv"
  done
done
cat >"$scratch/fleet/fleet.toml" <<'END'
models = ["mean", "poly:eq8", "poly:full:degree=3"]
[[component]]
name = "{machine}/{component}"
data = "{machine}/{component}.csv"
END
(
  cd "$scratch/fleet"
  "$errmap" compare --config fleet.toml --quiet --out store >table
)
look "$scratch/fleet/store/report.html" 1 6000 3

# Names that try to become something else, in a table of their own.
mkdir "$scratch/hostile"
long=$(printf '%0200d' 0 | tr 0 n)
{
  printf 'cycle,"position<script>alert(1)</script>",'
  printf '"t1""; system(""touch pwned""); ""`touch pwned`",%s,error_mm\n' "$long"
  i=0
  while [ "$i" -lt 120 ]; do
    echo "$((i / 12)) <b>,$((i % 12 * 20)),$((20 + i / 7)),$((i * 7 % 31)),0.00$((10 + i * 13 % 89))"
    i=$((i + 1))
  done
} >"$scratch/hostile/<script>alert(1)<_script>.csv"
(
  cd "$scratch/hostile"
  "$errmap" compare '<script>alert(1)<_script>.csv' --quiet --out study \
    --models mean,poly:eq8,poly:full:degree=2 >table
  "$errmap" report study
)
look "$scratch/hostile/study/report.html" 12 6000 4
if [ -n "$(find "$scratch" -name 'pwned*')" ]; then
  complain "a name was run as a command"
fi

if [ "$failed" -ne 0 ]; then exit 1; fi
echo "report_browser: looked at six reports in two widths and on paper, nothing amiss"
