"""The manual as people open it.

    python3 manual_test.py ERRMAP ROOT

The pictures of its words can be drawn again by the program. The HTML pages are
made; every link in them leads to a page and a heading that are there. A browser
shows each page at 390 and 1280 px without anything running out at the side,
its search finds, Tab reaches every link in a place where the focus is seen, and
on paper the contents are left out. What needs cmark-gfm or a browser that is
absent is skipped (status 77 where nothing else failed).
"""

import html.parser
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import urllib.parse

SKIPPED = 77
WIDTHS = (390, 1280)


def title_of(svg):
    """The words of a picture's title, without figures of the study."""
    return re.sub(r"[\d.]+", "#", re.search(r"<title[^>]*>(.*?)</title>",
                                            svg, flags=re.S).group(1))


def check_pictures(errmap, root, scratch, problems):
    drawn = scratch / "pictures"
    subprocess.run(["sh", root / "cli/manual/pictures.sh", errmap, drawn],
                   check=True)
    kept = root / "cli/manual/pictures"
    for picture in sorted(kept.glob("*.svg")):
        again = drawn / picture.name
        if not again.exists():
            problems.append(f"pictures.sh does not draw {picture.name}")
        elif title_of(again.read_text()) != title_of(picture.read_text()):
            problems.append(f"{picture.name} is another picture now: run "
                            "cli/manual/pictures.sh")
    for picture in drawn.glob("*.svg"):
        if not (kept / picture.name).exists():
            problems.append(f"{picture.name} is not in cli/manual/pictures")


class Page(html.parser.HTMLParser):
    """Links and names of a page."""

    def __init__(self, path):
        super().__init__()
        self.links = []
        self.names = set()
        self.feed(path.read_text())

    def handle_starttag(self, tag, attrs):
        attrs = dict(attrs)
        if "id" in attrs:
            self.names.add(attrs["id"])
        for key in ("href", "src"):
            if key in attrs:
                self.links.append(attrs[key])


def check_links(folder, problems):
    pages = {p: Page(p) for p in folder.rglob("*.html")}
    if len(pages) < 40:
        problems.append(f"only {len(pages)} pages")
    checked = 0
    for path, page in pages.items():
        for link in page.links:
            if re.match(r"[a-z]+:", link):
                continue
            checked += 1
            file, _, part = urllib.parse.unquote(link).partition("#")
            target = (path.parent / file).resolve() if file else path
            name = path.relative_to(folder)
            if not target.exists():
                problems.append(f"{name}: no {link}")
            elif part and target in pages and part not in pages[target].names:
                problems.append(f"{name}: no heading {link}")
    entries = json.loads(re.sub(
        r",\s*\];\s*$", "]",
        (folder / "search_words.js").read_text().replace(
            "const searchWords = ", "", 1)))
    for page, anchor, *_ in entries:
        path = (folder / "cli/manual" / f"{page}.html").resolve()
        if anchor not in pages[path].names:
            problems.append(f"the search leads to {page}#{anchor}")
    return checked


HARNESS = """<!doctype html><body><script>
const pages = %s, widths = %s, found = [];
function load(page, width) {
  return new Promise(done => {
    const frame = document.createElement('iframe');
    frame.style.width = width + 'px';
    frame.style.height = '800px';
    frame.onload = () => done(frame);
    frame.src = page;
    document.body.appendChild(frame);
  });
}
(async () => {
  let shown = 0;
  for (const page of pages) for (const width of widths) {
    const frame = await load(page, width);
    const d = frame.contentDocument;
    const say = what => found.push(page + ' at ' + width + ' px: ' + what);
    const wide = d.documentElement.scrollWidth;
    if (wide > d.documentElement.clientWidth) say('is ' + wide + ' px wide');
    for (const e of d.querySelectorAll('main *')) {
      if (e.closest('pre, table') && !e.matches('pre, table')) continue;
      if (e.getBoundingClientRect().right > width + 1) say('overflow: ' + e.tagName);
    }
    for (const i of d.querySelectorAll('img'))
      if (!i.complete || !i.naturalWidth || i.alt.length < 10) say('no picture: ' + i.src);
    if (d.querySelectorAll('main h1').length !== 1) say('not one heading');
    const input = d.getElementById('find');
    for (const [word, some] of [['promise', true], ['zzqx', false]]) {
      input.value = word;
      input.dispatchEvent(new frame.contentWindow.Event('input'));
      const links = d.querySelectorAll('#found a').length;
      if ((links > 0) !== some) say('the search for ' + word + ' finds ' + links);
    }
    shown += 1;
    frame.remove();
  }
  document.title = JSON.stringify({ shown, found });
})();
</script></body>"""


def browse(browser, scratch, *flags):
    return subprocess.run(
        [browser, "--headless", "--no-sandbox", "--disable-gpu",
         "--disable-dev-shm-usage", "--no-first-run",
         "--allow-file-access-from-files",
         "--host-resolver-rules=MAP * ~NOTFOUND",
         f"--user-data-dir={scratch}/profile", *flags],
        stdin=subprocess.DEVNULL, capture_output=True, timeout=200)


def check_in_browser(browser, folder, root, scratch, problems):
    pages = sorted((folder / "cli/manual").glob("*.html"))
    pages += sorted((folder / "cli/fleet").glob("machines.html"))
    pages.append(folder / "data/sets/examples.html")
    harness = scratch / "harness.html"
    harness.write_text(HARNESS % (json.dumps([p.as_uri() for p in pages]),
                                  json.dumps(WIDTHS)))
    seen = browse(browser, scratch, "--virtual-time-budget=60000",
                  "--window-size=1400,900", "--dump-dom", harness.as_uri())
    title = re.search(r"<title>(.*?)</title>", seen.stdout.decode(), re.S)
    if title is None:
        problems.append("the browser showed nothing")
        return
    told = json.loads(title.group(1).replace("&amp;", "&").replace(
        "&lt;", "<").replace("&gt;", ">"))
    problems.extend(told["found"])
    if told["shown"] != len(pages) * len(WIDTHS):
        problems.append(f"the browser showed {told['shown']} pages only")
    pdf = scratch / "tutorial.pdf"
    browse(browser, scratch, f"--print-to-pdf={pdf}",
           (folder / "cli/manual/tutorial.html").as_uri())
    printed = pdf.read_bytes() if pdf.exists() else b""
    sheets = len(re.findall(rb"/Type\s*/Page\b", printed))
    if not 2 <= sheets <= 12:
        problems.append(f"the tutorial prints on {sheets} sheets")
    keyboard = subprocess.run(
        [sys.executable, "-B", root / "tests/cli/report_keyboard.py", browser,
         folder / "cli/manual/which-map.html"], capture_output=True, text=True)
    if keyboard.returncode != 0:
        problems.append("by keyboard: " + keyboard.stdout + keyboard.stderr)


def main(errmap, root):
    problems = []
    skipped = ""
    with tempfile.TemporaryDirectory() as folder:
        scratch = pathlib.Path(folder)
        check_pictures(errmap, root, scratch, problems)
        cmark = shutil.which("cmark-gfm")
        browser = next(filter(None, map(shutil.which, (
            "chromium", "chromium-browser", "google-chrome"))), None)
        if cmark is None:
            skipped = "apt-get install cmark-gfm"
        else:
            pages = scratch / "manual"
            subprocess.run(["sh", root / "cli/manual/make_html.sh", root, cmark,
                            errmap, pages], check=True)
            pages = pages.resolve()
            links = check_links(pages, problems)
            print(f"{links} links lead somewhere")
            if browser is None:
                skipped = "apt-get install chromium"
            else:
                check_in_browser(browser, pages, root, scratch, problems)
    for problem in problems:
        print("manual:", problem, file=sys.stderr)
    if problems:
        return 1
    if skipped:
        print("manual: skipped in part:", skipped)
        return SKIPPED
    return 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(),
                  pathlib.Path(sys.argv[2]).resolve()))
