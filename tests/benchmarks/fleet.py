#!/usr/bin/env python3
"""A fleet of simulated components in shares: the same results whatever the
shares, what sharing costs, and what a merge of very many summaries takes.

    fleet.py ERRMAP [--components 60] [--merge 0] [--speed] [--keep DIR]

Simulates turning centres (seed by seed, --days and --cycles each), studies
their components with three models unsharded, in 8 shares in a drawn order, and
in 8 shares of which three are killed at drawn moments and begun again, and ends
with status 1 unless tables and results are the same but for times. --speed
prints components per second for one and two workers. --merge N copies the
summaries to N components and puts them together: time, memory, sizes.
"""

import argparse
import gzip
import json
import pathlib
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

MODELS = ["mean", "poly:eq9", "poly:ridge"]
TABLES = ("runs components fields holdouts models metrics verdicts recommendations "
          "sensors maps").split()
SHARES = 8
SUMMARY_LIMIT = 20000
failures = []


def fail(text):
    failures.append(text)
    print("FAILED:", text, file=sys.stderr)


class Fleet:
    def __init__(self, arguments, folder):
        self.errmap = str(pathlib.Path(arguments.errmap).resolve())
        self.folder = folder
        self.arguments = arguments

    def command(self, *words):
        return [self.errmap, *map(str, words)]

    def run(self, *words, status=0):
        begin = time.monotonic()
        done = subprocess.run(self.command(*words), cwd=self.folder, capture_output=True, text=True)
        if done.returncode != status:
            fail(f"{' '.join(map(str, words))}: status {done.returncode}: {done.stderr[-300:]}")
        return time.monotonic() - begin, done.stdout

    def simulate(self):
        """Machines until there are enough components; files left out of the pattern."""
        made = 0
        seed = 0
        while made < self.arguments.components:
            seed += 1
            machine = f"data/m{seed:03}"
            self.run("simulate", "turning-centre", "-o", machine, "--seed", seed, "--days",
                     self.arguments.days, "--cycles", self.arguments.cycles, "--points", 0,
                     "--quiet")
            for file in sorted((self.folder / machine).iterdir()):
                usable = file.suffix == ".csv" and file.stem not in ("tool_tip", "temperatures")
                if usable and made < self.arguments.components:
                    made += 1
                else:
                    file.unlink()
        (self.folder / "fleet.toml").write_text(
            f"models = {json.dumps(MODELS)}\n[[component]]\nname = \"{{machine}}/{{component}}\"\n"
            'data = "data/{machine}/{component}.csv"\n')

    def study(self, store, *more):
        return self.run("compare", "--config", "fleet.toml", "--out", store, "--quiet", *more)[0]

    def query(self, store, sql):
        return json.loads(self.run("query", store, sql, "--format", "json")[1])

    def contents(self, store):
        """All tables and full results, times apart."""
        found = {}
        for table in TABLES:
            document = self.query(store, f"SELECT * FROM {table}")
            kept = [i for i, name in enumerate(document["columns"]) if "seconds" not in name]
            found[table] = [[row[i] for i in kept] for row in document["rows"]]
        for path in sorted((self.folder / store / "components").rglob("results.json.gz")):
            found[str(path.relative_to(self.folder / store))] = without_times(
                json.loads(gzip.decompress(path.read_bytes())))
        return found

    def killed_shares(self, store, generator):
        """8 shares at once, two at a time; three are killed and begun again."""
        kills = set(generator.sample(range(SHARES), 3))
        for share in range(SHARES):
            words = self.command("compare", "--config", "fleet.toml", "--out", store, "--quiet",
                                 "--jobs", 1, "--shard", f"{share}/{SHARES}")
            if share in kills:
                process = subprocess.Popen(words, cwd=self.folder)
                time.sleep(generator.uniform(0.02, 1.0))
                process.send_signal(signal.SIGKILL)
                process.wait()
            subprocess.run(words, cwd=self.folder, check=True)
        self.run("merge", store)


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
    whole = fleet.study("whole", "--jobs", 1)
    reference = fleet.contents("whole")
    fits = fleet.query("whole", "SELECT sum(fits_seconds), count(*), sum(status = 'ok') "
                                "FROM components")["rows"][0]
    print(f"{fits[1]} components, {fits[2]} with a map; fits {fits[0]:.1f} s, one run with one "
          f"job {whole:.1f} s")
    order = list(range(SHARES))
    generator.shuffle(order)
    seconds = sum(fleet.study("shares", "--jobs", 1, "--shard", f"{i}/{SHARES}") for i in order)
    seconds += fleet.run("merge", "shares")[0]
    fleet.killed_shares("killed", generator)
    for store in ("shares", "killed"):
        found = differences(reference, fleet.contents(store))
        if found:
            fail(f"{store} differs from one run in {found[:5]}")
        else:
            print(f"{store}: as one run")
    print(f"8 shares in order {order} and the merge: {seconds:.1f} s, {seconds - whole:+.1f} s or "
          f"{100 * (seconds - whole) / fits[0]:+.1f} % of the fits' time against one run")
    store = fleet.folder / "whole"
    summaries = [p.stat().st_size for p in store.rglob("summary.json")]
    print(f"disk {size_of(store) / len(summaries) / 1000:.0f} kB a component, largest summary "
          f"{max(summaries)} bytes")
    if max(summaries) > SUMMARY_LIMIT:
        fail("a summary is too long")


def check_speed(fleet, count):
    times = {}
    for jobs in (1, 2):
        shutil.rmtree(fleet.folder / "speed", ignore_errors=True)
        times[jobs] = fleet.study("speed", "--jobs", jobs)
        print(f"{jobs} worker{'s' if jobs > 1 else ''}: {count / times[jobs]:.2f} components a second")
    print(f"ratio {times[1] / times[2]:.2f}")


def check_merge(fleet, count):
    """Copies of the summaries under other names and machines."""
    source = fleet.folder / "whole"
    target = fleet.folder / "large"
    plan = json.loads((source / "fleet.json").read_text())
    base = []
    for component in plan["components"]:
        folder = fleet.query("whole", "SELECT folder FROM components WHERE name = "
                                      f"'{component['name']}'")["rows"][0][0]
        base.append((component, json.loads((source / folder / "summary.json").read_text())))
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
    seconds = fleet.run("merge", "large")[0]
    memory = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
    report = fleet.run("report", "large")[0]
    page = (target / "report.html").stat().st_size
    print(f"merge of {count}: {seconds:.1f} s, {'' if memory > before else 'at most '}"
          f"{memory / 1024:.0f} MiB, database {(target / 'errmap.sqlite').stat().st_size / 1e6:.1f}"
          f" MB; its page {report:.1f} s, {page / 1e6:.2f} MB")
    if seconds > 60 or memory > 1024 * 1024 or report > 60 or page > 3e6:
        fail("the merge or its page takes too much")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("errmap")
    parser.add_argument("--components", type=int, default=60)
    parser.add_argument("--days", type=int, default=4)
    parser.add_argument("--cycles", type=int, default=6)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--merge", type=int, default=0)
    parser.add_argument("--speed", action="store_true")
    parser.add_argument("--keep", type=pathlib.Path)
    arguments = parser.parse_args()
    folder = arguments.keep or pathlib.Path(tempfile.mkdtemp(prefix="errmap_fleet_"))
    folder.mkdir(parents=True, exist_ok=True)
    try:
        fleet = Fleet(arguments, folder)
        fleet.simulate()
        check_shares(fleet, arguments)
        if arguments.speed:
            check_speed(fleet, arguments.components)
        if arguments.merge:
            check_merge(fleet, arguments.merge)
    finally:
        if not arguments.keep:
            shutil.rmtree(folder, ignore_errors=True)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
