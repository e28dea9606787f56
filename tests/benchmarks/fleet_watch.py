#!/usr/bin/env python3
"""Does `errmap watch` find what goes wrong after maps were handed over?

    fleet_watch.py ERRMAP [--pool 400] [--machines 200] [--faulty 10] [--seeds 20]

Each machine of the pool is a simulated turning centre of a seed of its own, from
--first-seed on: a map of its X displacement is made of ten days and deployed. Per
seed so many machines are drawn from the pool; --faulty of them, drawn anew, get a
sensor (drawn once for each machine) that drifts by 0.04 degC an hour from day 11
on, and as many a scale that slips by 2 um; the others stay as they are. watch is
given day 11 and then days 11 and 12. Prints the share found by the end of day 12,
and of the healthy that are accused per check.

Before that, with all machines healthy: how many have p below 0.05, 0.01 and 0.001.
--calibrate stops there. The constants of models/fleet/watch.cc were chosen by such
counts on seeds 10001 to 10086 (sensors) and 10001 to 10018 (maps); the seeds that
judge, from 2001 on, had no part in it.

The folder of --keep is gone on with: maps that are made there stay.
"""

import argparse
import csv
import json
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
from collections import Counter

TRAINED = 10
NEW = 2
SENSORS = 40
FILE = "x_displacement_down.csv"
MODELS = ["mean", "poly:ridge:view=history:terms=linear"]


class Study:
    def __init__(self, arguments, folder):
        self.errmap = str(pathlib.Path(arguments.errmap).resolve())
        self.arguments = arguments
        self.folder = folder
        first = arguments.first_seed
        self.seeds = {f"m{seed}": seed for seed in range(first, first + arguments.pool)}
        self.machines = list(self.seeds)
        self.sensor = {machine: random.Random(seed).randrange(SENSORS)
                       for machine, seed in self.seeds.items()}

    def run(self, *words, statuses=(0,)):
        done = subprocess.run([self.errmap, *map(str, words)], cwd=self.folder,
                              capture_output=True, text=True)
        if done.returncode not in statuses:
            raise SystemExit(f"{words}: status {done.returncode}: {done.stderr[-500:]}")
        return done.stdout

    def simulate(self, seed, *more):
        """Rows of each day of one machine."""
        self.run("simulate", "turning-centre", "-o", "simulated", "--seed", seed, "--days",
                 TRAINED + NEW, "--cycles", self.arguments.cycles, "--points", 0, "--quiet",
                 "--force", *more)
        days = {}
        with open(self.folder / "simulated" / FILE, newline="") as file:
            header, *rows = csv.reader(file)
        for row in rows:
            days.setdefault(int(row[1]), []).append(row)
        return header, days

    def write(self, path, header, days, chosen):
        path.parent.mkdir(parents=True, exist_ok=True)
        with open(path, "w", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows(
                [header, *(row for day in chosen for row in days[day])])

    def kinds_of(self, machine):
        kinds = {"healthy": ()}
        if not self.arguments.calibrate:
            kinds["drift"] = ("--from-day", TRAINED + 1, "--drifting", self.sensor[machine])
            kinds["shift"] = ("--from-day", TRAINED + 1, "--shift-um", 2)
        return kinds

    def make_data(self):
        for machine, seed in self.seeds.items():
            trained = self.folder / "data" / machine / FILE
            if trained.exists():
                continue
            for kind, more in self.kinds_of(machine).items():
                header, days = self.simulate(seed, *more)
                for count in range(1, NEW + 1):
                    self.write(self.folder / "new" / f"{kind}{count}" / machine / FILE, header,
                               days, range(TRAINED + 1, TRAINED + 1 + count))
                if kind == "healthy":
                    healthy = header, days
            self.write(trained, *healthy, range(1, TRAINED + 1))
        (self.folder / "fleet.toml").write_text(
            f'models = {json.dumps(MODELS)}\nholdouts = ["sessions:{TRAINED}"]\n[[component]]\n'
            f'name = "{{machine}}"\ndata = "data/{{machine}}/{FILE}"\n')
        self.run("compare", "--config", "fleet.toml", "--out", "made", "--quiet", "--jobs", 1)
        rows = json.loads(self.run("query", "made", "SELECT component FROM deployments",
                                   "--format", "json"))["rows"]
        for machine in self.machines:
            if [machine] not in rows:
                self.run("deploy", "made", machine)

    def watch(self, store, count, kind_of):
        """Status and p of each machine from the days so far."""
        folder = self.folder / "given"
        shutil.rmtree(folder, ignore_errors=True)
        for machine, kind in kind_of.items():
            (folder / machine).mkdir(parents=True)
            (folder / machine / FILE).symlink_to(
                self.folder / "new" / f"{kind}{count}" / machine / FILE)
        text = self.run("watch", store, "given", "--format", "json", "--quiet", statuses=(0, 4))
        return {c["name"]: c for c in json.loads(text)["components"]}

    def fresh_store(self):
        """What watch reads of the store."""
        store = self.folder / "store"
        shutil.rmtree(store, ignore_errors=True)
        store.mkdir()
        for name in ("fleet.json", "errmap.sqlite"):
            shutil.copy(self.folder / "made" / name, store / name)
        (store / "maps").symlink_to(self.folder / "made" / "maps")
        return "store"


def accused(component):
    return component["status"] in ("worse", "sensor changed")


def calibrate(study):
    store = study.fresh_store()
    healthy = {machine: "healthy" for machine in study.machines}
    for count in range(1, NEW + 1):
        found = study.watch(store, count, healthy)
        for key in ("p_map", "p_sensor"):
            p = [c[key] for c in found.values() if c[key] is not None]
            shares = ", ".join(f"{sum(x < at for x in p)} below {at}" for at in (0.05, 0.01, 0.001))
            print(f"all healthy, day {count}, {key}: of {len(p)} {shares}; least {min(p):.2g}",
                  flush=True)


def judge(study, arguments):
    """Of each kind (found, of), seed by seed."""
    totals = {"drift": [0, 0], "shift": [0, 0], "healthy": [0, 0]}
    missed = Counter()
    statuses = Counter()
    for seed in range(1, arguments.seeds + 1):
        drawn = random.Random(seed).sample(study.machines, arguments.machines)
        kind_of = {machine: "healthy" for machine in drawn}
        kind_of.update({m: "drift" for m in drawn[:arguments.faulty]})
        kind_of.update({m: "shift" for m in drawn[arguments.faulty:2 * arguments.faulty]})
        store = study.fresh_store()
        found = set()
        for count in range(1, NEW + 1):
            for name, component in study.watch(store, count, kind_of).items():
                if kind_of[name] == "healthy":
                    totals["healthy"][0] += accused(component)
                    totals["healthy"][1] += 1
                if accused(component):
                    found.add(name)
                    statuses[kind_of[name], component["status"]] += 1
        for name, kind in kind_of.items():
            if kind == "healthy":
                continue
            totals[kind][0] += name in found
            totals[kind][1] += 1
            if name not in found:
                missed[f"t{study.sensor[name]:02}" if kind == "drift" else name] += 1
    for (kind, status), times in sorted(statuses.items()):
        print(f"{kind}, {status}: {times} checks")
    print("missed:", ", ".join(f"{what} {times}" for what, times in missed.most_common()) or "none")
    return totals


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("errmap")
    parser.add_argument("--pool", type=int, default=400)
    parser.add_argument("--machines", type=int, default=200)
    parser.add_argument("--faulty", type=int, default=10)
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--first-seed", type=int, default=2001)
    parser.add_argument("--cycles", type=int, default=16)
    parser.add_argument("--calibrate", action="store_true")
    parser.add_argument("--keep", type=pathlib.Path)
    arguments = parser.parse_args()
    folder = arguments.keep or pathlib.Path(tempfile.mkdtemp(prefix="errmap_watch_"))
    folder.mkdir(parents=True, exist_ok=True)
    study = Study(arguments, folder.resolve())
    try:
        study.make_data()
        calibrate(study)
        if arguments.calibrate:
            return 0
        totals = judge(study, arguments)
        for kind, (count, of) in totals.items():
            print(f"{kind}: {count} of {of} named, {100 * count / max(of, 1):.1f} %")
    finally:
        if not arguments.keep:
            shutil.rmtree(folder, ignore_errors=True)
    good = all(totals[k][0] >= 0.9 * totals[k][1] for k in ("drift", "shift"))
    return 0 if good and totals["healthy"][0] < 0.02 * totals["healthy"][1] else 1


if __name__ == "__main__":
    sys.exit(main())
