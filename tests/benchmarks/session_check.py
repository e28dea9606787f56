#!/usr/bin/env python3
"""Does `errmap check` tell sessions in which a map is off?

    session_check.py ERRMAP [--seeds 1-10] [--train 8] [--model poly:ridge]

Each seed is a simulated turning centre: a map is fitted to K days, and 20 later
sessions are checked with three probes, spread over the session and in its first
hour. 14 of them are days of like duty; 2 have three thermocouples that moved
(off by 2 to 6 degC), 2 an offset of 2 to 5 times the promised error, 2 days of
harder duty. A session is off where its RMSE is above 1.5 times the promised
one, whatever was done to it. Prints the shares caught and of false alarms, and
how often offset and shape are told apart among those caught (offset: the sd
about the session's mean is within 1.5 times the promise).
"""

import collections
import json
import math
import os
import random
import statistics
import tempfile

from program_runs import FILE, parser_of, read, run, simulate, write

HOUR = 3600.0


class Table:
    def __init__(self, path):
        self.header, rows = read(path)
        self.rows = [[float(cell) for cell in row] for row in rows]

    def at(self, name):
        return self.header.index(name)

    def day(self, day):
        column = self.at("day")
        return [list(row) for row in self.rows if row[column] == day]

    def write(self, path, rows):
        write(path, self.header, rows)


def simulated(errmap, folder, seed, days, *options):
    simulate(errmap, folder, seed, days, *options)
    return Table(os.path.join(folder, FILE))


def disturbed(table, harder, day, kind, promised, draw):
    rows = (harder if kind == "duty" else table).day(day)
    if kind == "sensors":
        live = [i for i, name in enumerate(table.header)
                if name.endswith("_degC") and any(row[i] for row in rows)]
        for column in draw.sample(live, 3):
            shift = draw.choice([-1, 1]) * draw.uniform(2.0, 6.0)
            for row in rows:
                row[column] += shift
    if kind == "offset":
        shift = draw.choice([-1, 1]) * draw.uniform(2.0, 5.0) * promised
        for row in rows:
            row[table.at("error_mm")] += shift
    return rows


def probes_of(rows, time, where, draw):
    start = rows[0][time]
    last = rows[-1][time] - start if where == "spread" else HOUR
    chosen = set()
    for part in range(3):
        lower, upper = last * part / 3, last * (part + 1) / 3
        inside = [i for i, row in enumerate(rows)
                  if lower <= row[time] - start <= upper and i not in chosen]
        # A quarter of an hour may go by between two sweeps.
        inside = inside or [i for i, row in enumerate(rows)
                            if row[time] - start <= last and i not in chosen]
        chosen.add(draw.choice(inside))
    return chosen


def main():
    parser = parser_of(__doc__, "1-10")
    parser.add_argument("--train", type=int, default=8)
    parser.add_argument("--model", default="poly:ridge")
    given = parser.parse_args()
    kinds = ["well"] * 14 + ["sensors", "offset", "duty"] * 2
    found = collections.defaultdict(list)
    for seed in given.seeds:
        draw = random.Random(seed)
        with tempfile.TemporaryDirectory() as folder:
            path = lambda name: os.path.join(folder, name)
            days = given.train + len(kinds)
            table = simulated(given.errmap, path("as"), seed, days)
            harder = simulated(given.errmap, path("hard"), seed, days,
                               "--duty", "1.7", "--speed", "1.5")
            column = table.at("day")
            table.write(path("train.csv"),
                        [r for r in table.rows if r[column] <= given.train])
            run(given.errmap, "fit", path("train.csv"), "--model", given.model,
                "-o", path("map.json"), "--quiet")
            with open(path("map.json"), encoding="utf-8") as file:
                promised = json.load(file)["held_out"]["rmse"]
            target, time = table.at("error_mm"), table.at("time_s")
            for number, kind in enumerate(kinds):
                rows = disturbed(table, harder, given.train + 1 + number, kind,
                                 promised, draw)
                table.write(path("whole.csv"), rows)
                judged = json.loads(run(given.errmap, "evaluate",
                                        path("map.json"), path("whole.csv"),
                                        "--quiet", "--format", "json"))
                rmse = judged["summary"]["rmse"] / promised
                scatter = math.sqrt(max(
                    0.0, rmse ** 2 - (judged["promise"]["mean"] / promised) ** 2))
                for where in ("spread", "first hour"):
                    chosen = probes_of(rows, time, where, draw)
                    table.write(path("probes.csv"), [
                        row[:target] + [row[target] if i in chosen else ""] +
                        row[target + 1:] for i, row in enumerate(rows)
                        if i <= max(chosen)])
                    check = json.loads(run(
                        given.errmap, "check", path("map.json"),
                        path("probes.csv"), "--quiet", "--format", "json",
                        statuses=(0, 4)))
                    found[where].append((kind, rmse, scatter, check))
        print(f"seed {seed}: promised {1000 * promised:.2f} um", flush=True)
    for where, sessions in found.items():
        off = [s for s in sessions if s[1] > 1.5]
        well = [s for s in sessions if s[1] <= 1.5]
        caught = [s for s in off if s[3]["status"] == "off"]
        alarms = [s for s in well if s[3]["status"] == "off"]
        apart = [s for s in caught
                 if (s[3]["remedy"] == "re-zero") == (s[2] <= 1.5)]
        unknown = [s for s in sessions if s[3]["status"] == "unknown"]
        print(f"{where}: {len(off)} of {len(sessions)} sessions are off; "
              f"caught {len(caught) / max(1, len(off)):.3f}, false alarms "
              f"{len(alarms) / max(1, len(well)):.3f}, told apart "
              f"{len(apart) / max(1, len(caught)):.3f}, not yet known "
              f"{len(unknown) / len(sessions):.3f}")
        for kind in dict.fromkeys(kinds):
            ratios = [s[1] for s in sessions if s[0] == kind]
            print(f"  {kind}: RMSE / promised {statistics.median(ratios):.2f} "
                  f"(median), {min(ratios):.2f} to {max(ratios):.2f}")


if __name__ == "__main__":
    main()
