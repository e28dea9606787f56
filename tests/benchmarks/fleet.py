#!/usr/bin/env python3
"""A fleet of simulated components in shares: the same results whatever the
shares, what sharing costs, and what a merge of very many summaries takes.

    fleet.py ERRMAP [--components 60] [--merge 0] [--speed 0] [--keep DIR]

Simulates turning centres (seed by seed, --days and --cycles each), studies
their components with three models unsharded, in 8 shares in a drawn order, and
in 8 shares of which three are killed at drawn moments and begun again, and ends
with status 1 unless tables and results are the same but for times. What sharing
costs is the processor time of all that is not a fit: the 8 shares begun once more,
when nothing is left to fit, and the merge. --speed N prints components per
second for one and two workers, of N components. --merge N copies the summaries
to N components and puts them together: time, memory, sizes, and how a Chromium
opens their page where there is one. What is simulated in the folder of --keep is
used again.

Seen on 2 busy cores of an AMD EPYC, 2026-11-22: of 200 components (4 days of 6
cycles) fits take 0.10 s each, with all that belongs to them; sharing and merging
1.6 % of that (2.5 % with 60: starting 8 programs does not grow with the fleet); 110
kB of the disk a component; 1.7 components a second with one worker and 3.3 with
two, ratio 1.91. Of 2,000 all 2,010 tables and results are the same in the three
ways, 2.9 % beside three other programs. --merge 10000: 2.6 s of
processor time (5.6 s of the clock), 127 MiB, a database of 48 MB; the page 1.3 s
(2.3 s), 0.74 MB, drawn by Chromium 156 in 0.2 s, the answer ends at 524 px of 900.
"""

import argparse
import gzip
import hashlib
import json
import pathlib
import random
import re
import resource
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time

MODELS = ["mean", "poly:eq9", "poly:ridge:view=raw:terms=linear"]
TABLES = ("runs components fields holdouts models metrics verdicts recommendations "
          "sensors maps").split()
SHARES = 8
SUMMARY_LIMIT = 20000
COMPONENT_LIMIT = 300000
FEWEST_TIMED = 200  # of fewer the starts of 8 programs are not a small part
failures = []


def fail(text):
    failures.append(text)
    print("FAILED:", text, file=sys.stderr)


def say(text):
    print(text, flush=True)


def processor_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


class Fleet:
    def __init__(self, arguments, folder):
        self.errmap = str(pathlib.Path(arguments.errmap).resolve())
        self.folder = folder
        self.arguments = arguments

    def command(self, *words):
        return [self.errmap, *map(str, words)]

    def run(self, *words, status=0):
        """Seconds of processor time, of the clock, and what was printed."""
        before = processor_seconds()
        begin = time.monotonic()
        done = subprocess.run(self.command(*words), cwd=self.folder, capture_output=True, text=True)
        if done.returncode != status:
            fail(f"{' '.join(map(str, words))}: status {done.returncode}: {done.stderr[-300:]}")
        return processor_seconds() - before, time.monotonic() - begin, done.stdout

    def simulate(self):
        """Machines until there are enough components; files left out of the pattern."""
        made = 0
        seed = 0
        while made < self.arguments.components:
            seed += 1
            machine = f"data/m{seed:03}"
            if not (self.folder / machine / "x_yaw.csv").exists():
                self.run("simulate", "turning-centre", "-o", machine, "--seed", seed, "--days",
                         self.arguments.days, "--cycles", self.arguments.cycles, "--points", 0,
                         "--quiet", "--force")
            for file in sorted((self.folder / machine).iterdir()):
                usable = file.suffix == ".csv" and file.stem not in ("tool_tip", "diagonals", "temperatures")
                if usable and made < self.arguments.components:
                    made += 1
                else:
                    file.unlink()
        self.write_study("fleet.toml", "{machine}")

    def write_study(self, file, machines):
        (self.folder / file).write_text(
            f"models = {json.dumps(MODELS)}\n[[component]]\nname = \"{{machine}}/{{component}}\"\n"
            f'data = "data/{machines}/{{component}}.csv"\n')

    def study(self, store, *more, config="fleet.toml"):
        return self.run("compare", "--config", config, "--out", store, "--quiet", *more)[0]

    def shares(self, store, order):
        return sum(self.study(store, "--jobs", 1, "--shard", f"{i}/{SHARES}") for i in order)

    def query(self, store, sql):
        with sqlite3.connect(self.folder / store / "errmap.sqlite") as database:
            asked = database.execute(sql)
            return {"columns": [c[0] for c in asked.description],
                    "rows": [list(row) for row in asked.fetchall()]}

    def contents(self, store):
        """All tables and full results, times apart."""
        found = {}
        for table in TABLES:
            document = self.query(store, f"SELECT * FROM {table}")
            kept = [i for i, name in enumerate(document["columns"]) if "seconds" not in name]
            found[table] = digest([[row[i] for i in kept] for row in document["rows"]])
        for path in sorted((self.folder / store / "components").rglob("results.json.gz")):
            found[str(path.relative_to(self.folder / store))] = digest(without_times(
                json.loads(gzip.decompress(path.read_bytes()))))
        return found

    def killed_shares(self, store, generator, seconds):
        """8 shares one by one; three are killed within `seconds` and begun again."""
        kills = set(generator.sample(range(SHARES), 3))
        for share in range(SHARES):
            words = self.command("compare", "--config", "fleet.toml", "--out", store, "--quiet",
                                 "--jobs", 1, "--shard", f"{share}/{SHARES}")
            if share in kills:
                process = subprocess.Popen(words, cwd=self.folder)
                time.sleep(generator.uniform(0.02, seconds))
                process.send_signal(signal.SIGKILL)
                process.wait()
                left = list((self.folder / store).rglob("summary.json"))
                say(f"share {share} killed, {len(left)} components are done so far")
            subprocess.run(words, cwd=self.folder, check=True)
        self.run("merge", store)


def digest(value):
    return hashlib.sha256(json.dumps(value).encode()).hexdigest()


def without_times(node):
    if isinstance(node, dict):
        return {k: without_times(v) for k, v in node.items()
                if "seconds" not in k and not k.endswith("_ns")}
    if isinstance(node, list):
        return [without_times(v) for v in node]
    return node


def differences(a, b):
    return [key for key in sorted(set(a) | set(b)) if a.get(key) != b.get(key)]


def size_of(folder):
    return sum(p.stat().st_size for p in folder.rglob("*") if p.is_file())


def check_shares(fleet, arguments):
    generator = random.Random(arguments.seed)
    for store in ("whole", "shares", "killed"):
        shutil.rmtree(fleet.folder / store, ignore_errors=True)
    whole = fleet.study("whole", "--jobs", 1)
    reference = fleet.contents("whole")
    fits = fleet.query("whole", "SELECT sum(fits_seconds), count(*), sum(status = 'ok') "
                                "FROM components")["rows"][0]
    say(f"{fits[1]} components, {fits[2]} with a map; fits {fits[0]:.1f} s, one run with one "
        f"job {whole:.1f} s of processor time")
    order = list(range(SHARES))
    generator.shuffle(order)
    shared = fleet.shares("shares", order)
    merge = fleet.run("merge", "shares")[0]
    fleet.killed_shares("killed", generator, 0.7 * whole / SHARES)
    for store in ("shares", "killed"):
        found = differences(reference, fleet.contents(store))
        if found:
            fail(f"{store} differs from one run in {found[:5]}")
        else:
            say(f"{store}: as one run in all {len(reference)} tables and results")
    nothing_left = fleet.shares("shares", order)
    share = (nothing_left + merge) / (shared - nothing_left)
    say(f"8 shares in order {order} {shared:.1f} s, the merge {merge:.2f} s; the shares with nothing "
        f"left to fit {nothing_left:.2f} s: {100 * share:.2f} % of the fits' time are not fits; "
        f"{100 * (shared + merge - whole) / whole:+.1f} % against one run")
    if share > 0.03 and arguments.components >= FEWEST_TIMED:
        fail("sharing and merging take more than 3 % of the fits' time")
    store = fleet.folder / "whole"
    summaries = [p.stat().st_size for p in store.rglob("summary.json")]
    each = size_of(store) / len(summaries)
    say(f"disk {each / 1000:.1f} kB a component, largest summary {max(summaries)} bytes")
    if max(summaries) > SUMMARY_LIMIT or each > COMPONENT_LIMIT:
        fail("a component takes too much of the disk")


def check_speed(fleet, count):
    machines = sorted(p.name for p in (fleet.folder / "data").iterdir())
    chosen = machines[:max(1, count // 15)]
    fleet.write_study("speed.toml", "{machine:" + "|".join(chosen) + "}")
    rates = {}
    for jobs in (1, 2):
        shutil.rmtree(fleet.folder / "speed", ignore_errors=True)
        begin = time.monotonic()
        fleet.study("speed", "--jobs", jobs, config="speed.toml")
        made = len(list((fleet.folder / "speed").rglob("summary.json")))
        rates[jobs] = made / (time.monotonic() - begin)
        say(f"{jobs} worker{'s' if jobs > 1 else ''}: {rates[jobs]:.2f} components a second")
    say(f"ratio {rates[2] / rates[1]:.2f}")


def check_merge(fleet, count):
    """Copies of the summaries under other names and machines."""
    source = fleet.folder / "whole"
    target = fleet.folder / "large"
    shutil.rmtree(target, ignore_errors=True)
    plan = json.loads((source / "fleet.json").read_text())
    folders = dict(fleet.query("whole", "SELECT name, folder FROM components")["rows"])
    base = [(c, json.loads((source / folders[c["name"]] / "summary.json").read_text()))
            for c in plan["components"]]
    components = []
    for i in range(count):
        component, summary = base[i % len(base)]
        machine = f"c{i // 20:04}"
        name = f"{machine}-{i % 20:02}"  # a plain file name: the folder's own
        components.append({**component, "name": name})
        summary = {**summary, "name": name,
                   "fields": {"machine": machine, "component": f"error {i % 20:02}"}}
        folder = target / "components" / name
        folder.mkdir(parents=True)
        (folder / "summary.json").write_text(json.dumps(summary))
    plan["components"] = components
    (target / "fleet.json").write_text(json.dumps(plan))
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
    used, seconds, _ = fleet.run("merge", "large")
    memory = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
    drawn, report, _ = fleet.run("report", "large")
    page = (target / "report.html").stat().st_size
    say(f"merge of {count}: {seconds:.1f} s ({used:.1f} s of processor time), "
        f"{'' if memory > before else 'at most '}{memory / 1024:.0f} MiB, database "
        f"{(target / 'errmap.sqlite').stat().st_size / 1e6:.1f} MB; its page {report:.1f} s "
        f"({drawn:.1f} s), {page / 1e6:.2f} MB")
    if seconds > 60 or memory > 1024 * 1024 or report > 60 or page > 3e6:
        fail("the merge or its page takes too much")
    open_page(target / "report.html")


# What the page tells of itself once it stands.
TOLD = """<script>addEventListener('load', function () { requestAnimationFrame(function () {
setTimeout(function () { var p = document.createElement('p');
p.textContent = 'SEEN ' + [performance.now(), document.querySelector('.answer')
.getBoundingClientRect().bottom, document.documentElement.scrollHeight].join(' ');
document.body.appendChild(p); }, 0); }); });</script></body>"""


def open_page(page):
    """How long Chromium needs until all of it is drawn, and what it complains of."""
    browser = next(filter(None, map(shutil.which, ("chromium", "chromium-browser",
                                                   "google-chrome"))), None)
    if browser is None:
        say("no Chromium: the page was not opened")
        return
    # Its own policy forbids the script that tells of it.
    text = re.sub('<meta http-equiv="Content-Security-Policy"[^>]*>', "", page.read_text())
    copy = page.with_name("copy.html")
    copy.write_text(text.replace("</body>", TOLD))
    words = [browser, "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
             "--no-first-run", "--enable-logging=stderr", "--window-size=1280,900"]
    with tempfile.TemporaryDirectory() as profile:
        words.append(f"--user-data-dir={profile}")
        seen = [subprocess.run([*words, "--timeout=20000", "--dump-dom", f"file://{name}"],
                               capture_output=True, text=True, timeout=120)
                for name in (copy.resolve(), page.resolve(), copy.resolve())]
    times = []
    for run in (seen[0], seen[2]):
        told = re.search("SEEN ([0-9.]+) ([0-9.]+) ([0-9.]+)", run.stdout)
        if not told:
            fail("Chromium did not open the page")
            return
        times.append(float(told[1]) / 1000)
    complaints = [line for line in seen[1].stderr.splitlines() if "CONSOLE" in line]
    say(f"Chromium draws all of it in {times[0]:.2f} s, again in {times[1]:.2f} s; the answer ends at "
        f"{told[2]} px of 900, the page at {told[3]}; {len(complaints)} messages on the console")
    if min(times) > 2 or float(told[2]) > 900 or complaints:
        fail("the page is slow to open, or does not begin with its answer, or complains")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("errmap")
    parser.add_argument("--components", type=int, default=60)
    parser.add_argument("--days", type=int, default=4)
    parser.add_argument("--cycles", type=int, default=6)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--merge", type=int, default=0)
    parser.add_argument("--speed", type=int, default=0)
    parser.add_argument("--keep", type=pathlib.Path)
    arguments = parser.parse_args()
    folder = arguments.keep or pathlib.Path(tempfile.mkdtemp(prefix="errmap_fleet_"))
    folder.mkdir(parents=True, exist_ok=True)
    try:
        fleet = Fleet(arguments, folder)
        fleet.simulate()
        check_shares(fleet, arguments)
        if arguments.speed:
            check_speed(fleet, arguments.speed)
        if arguments.merge:
            check_merge(fleet, arguments.merge)
    finally:
        if not arguments.keep:
            shutil.rmtree(folder, ignore_errors=True)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
