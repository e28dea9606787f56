#!/usr/bin/env python3
"""Does `errmap check` give wrong orders on the mornings that people have?

    mornings.py ERRMAP [--seeds 1-20] [--train 6] [--days 10] [--share 1.0]

Each seed is a simulated turning centre of which 5 to 9 thermometers are read: a
blend learns six days and is checked on later ones, as they are and disturbed in
16 ways, by 1, 3, 5 and 20 probes within the first 20 s, 10 min and hour and over
the whole session. --share draws so much of all these checks.

An order is wrong where acting on it leaves 10 % more than leaving all as it is
(re-zero, gain and sign on the rows after the last probe, on all rows where none
are left), or where "holds" is said of a session that errs more than 1.5 times
the promise. Printed: orders that are wrong and answers "not known", of all and
of each cell, those of cut logs apart, which are not known until the map's memory
is full; of sensors at fault that move the map by more than the promise, how many
are named; of sessions that hold, how many are said not to; of sound sensors how
many are accused.
"""

import collections
import json
import math
import os
import random
import subprocess
import tempfile

from program_runs import FILE, parser_of, read, run, simulate, write

HOUR = 3600.0
WINDOWS = {"20 s": 20.0, "10 min": 600.0, "1 h": HOUR, "whole": math.inf}
PROBES = (1, 3, 5, 20)
KINDS = ("healthy", "offset 3", "offset 10", "gain 1.5", "sign", "shape",
         "dead", "frozen", "3 degC", "10 degC", "swapped", "spike", "cut 1/3",
         "cut 2/3", "duty", "warmer", "elsewhere")
SENSOR_KINDS = ("dead", "frozen", "3 degC", "10 degC", "swapped", "spike")
OFF = 1.5  # times the promise


def rms(values):
    values = list(values)
    return math.sqrt(sum(value * value for value in values) / len(values))


class Machine:
    """A map, and days that it has not seen as lists of rows of numbers."""

    def __init__(self, errmap, folder, seed, given):
        self.errmap, self.folder = errmap, folder
        self.draw = random.Random(seed)
        days = given.train + given.days
        header, table = self.simulated("as", seed, days)
        _, harder = self.simulated("hard", seed, days, "--duty", "1.7",
                                   "--speed", "1.5")
        live = [i for i, name in enumerate(header) if name.endswith("_degC")
                and any(float(row[i]) for row in table)]
        self.sensors = sorted(self.draw.sample(live, self.draw.randint(5, 9)))
        self.kept = [i for i, name in enumerate(header)
                     if name in ("day", "cycle", "time_s", "position_mm",
                                 "error_mm") or i in self.sensors]
        self.header = [header[i] for i in self.kept]
        self.sensors = [i for i, name in enumerate(self.header)
                        if name.endswith("_degC")]
        self.time = self.header.index("time_s")
        self.position = self.header.index("position_mm")
        self.target = self.header.index("error_mm")
        self.days = {"as": self.cut(table, given), "hard": self.cut(harder, given)}
        day = header.index("day")
        write(self.path("train.csv"), self.header,
              [[row[i] for i in self.kept] for row in table
               if int(row[day]) <= given.train])
        self.map = self.path("map.json")
        run(errmap, "fit", self.path("train.csv"), "--model", given.model,
            "-o", self.map, "--quiet")
        with open(self.map, encoding="utf-8") as file:
            self.promised = json.load(file)["held_out"]["rmse"]

    def path(self, name):
        return os.path.join(self.folder, name)

    def simulated(self, name, seed, days, *options):
        simulate(self.errmap, self.path(name), seed, days, *options)
        return read(os.path.join(self.path(name), FILE))

    def cut(self, table, given):
        days = collections.defaultdict(list)
        for row in table:
            days[int(row[1])].append([float(row[i]) for i in self.kept])
        return [days[day] for day in sorted(days) if day > given.train]

    def disturbed(self, day, kind):
        """Rows, and the sensors that are at fault."""
        rows = [list(row) for row in
                self.days["hard" if kind == "duty" else "as"][day]]
        draw, target = self.draw, self.target
        faulty = []
        if kind.startswith("offset"):
            shift = draw.choice((-1, 1)) * float(kind.split()[1]) * 1e-3
            for row in rows:
                row[target] += shift
        elif kind in ("gain 1.5", "sign"):
            for row in rows:
                row[target] *= 1.5 if kind == "gain 1.5" else -1.0
        elif kind == "shape":
            size = draw.choice((-1, 1)) * draw.uniform(3e-3, 8e-3)
            form = draw.choice(("parabola", "tilt that grows", "wave"))
            places = [row[self.position] for row in rows]
            low, high = min(places), max(places)
            for i, row in enumerate(rows):
                at = 2.0 * (row[self.position] - low) / (high - low) - 1.0
                row[target] += size * {
                    "parabola": at * at - 0.3, "tilt that grows":
                    at * i / len(rows), "wave": math.sin(4.0 * at)}[form]
        elif kind in SENSOR_KINDS:
            faulty = draw.sample(self.sensors, 2 if kind == "swapped" else 1)
            at = faulty[0]
            if kind == "swapped":
                for row in rows:
                    row[at], row[faulty[1]] = row[faulty[1]], row[at]
            elif kind == "frozen":
                begins = draw.randrange(len(rows) // 3)
                for row in rows[begins:]:
                    row[at] = rows[begins][at]
            elif kind == "spike":
                rows[draw.randrange(min(5, len(rows)))][at] = -127.0
            else:
                shift = draw.choice((-1, 1)) * (
                    float(kind.split()[0]) if kind != "dead" else 0.0)
                for row in rows:
                    row[at] = row[at] + shift if shift else 0.0
        elif kind in ("warmer", "elsewhere"):
            for row in rows:
                for i in self.sensors if kind == "warmer" else []:
                    row[i] += 10.0
                row[self.position] += 300.0 if kind == "elsewhere" else 0.0
        elif kind.startswith("cut"):
            rows = rows[len(rows) * int(kind[4]) // 3:]
        return rows, faulty

    def write(self, name, rows, measured=None):
        write(self.path(name), self.header, [
            row if measured is None or i in measured else
            row[:self.target] + [""] + row[self.target + 1:]
            for i, row in enumerate(rows)])
        return self.path(name)

    def predictions(self, rows):
        text = run(self.errmap, "predict", self.map,
                   self.write("day.csv", rows), "--quiet", statuses=(0, 4))
        header, *lines = [line.split(",") for line in text.split("\n") if line
                          and not line.startswith("#")]
        at = [i for i, name in enumerate(header)
              if name.startswith("predicted")][0]
        return [float(line[at]) for line in lines]


def probes_within(rows, time, window, number, draw):
    inside = [i for i, row in enumerate(rows) if row[time] - rows[0][time] <= window]
    if len(inside) < number:
        return None
    return {draw.choice(inside[len(inside) * k // number:
                               len(inside) * (k + 1) // number])
            for k in range(number)}


def check(machine, rows, chosen):
    path = machine.write("probes.csv", rows[:max(chosen) + 1], chosen)
    done = subprocess.run(
        [machine.errmap, "check", machine.map, path, "--quiet", "--format",
         "json"], capture_output=True, text=True, check=False)
    if done.returncode not in (0, 4, 5):
        raise SystemExit(done.stderr)
    return json.loads(done.stdout)


def judge(machine, rows, predicted, chosen, answer):
    """What the answer orders, and whether that is wrong."""
    errors = [row[machine.target] - p for row, p in zip(rows, predicted)]
    last = max(chosen) + 1
    rest = range(last, len(rows)) if last < len(rows) else range(len(rows))
    order = answer["remedy"] if answer["status"] == "off" else answer["status"]
    if answer["status"] == "sensor":
        order = "sensor"
    left = [errors[i] for i in rest]
    wrong = False
    if order == "holds":
        wrong = rms(errors) > OFF * machine.promised
    elif order == "re-zero":
        wrong = rms(e - answer["probes"]["mean"] for e in left) > 1.1 * rms(left)
    elif order in ("gain", "sign"):
        gain = answer["gain"] if order == "gain" else -1.0
        wrong = rms(errors[i] + (1.0 - gain) * predicted[i]
                    for i in rest) > 1.1 * rms(left)
    return order, wrong, rms(errors) / machine.promised


def study(machine, given, found):
    draw = random.Random(machine.draw.random())
    for day in range(given.days):
        sound = {kind: machine.predictions(machine.days[kind][day])
                 for kind in ("as",)}
        for kind in given.kinds.split(",") if given.kinds else KINDS:
            cells = [(n, w) for n in PROBES for w in WINDOWS
                     if draw.random() < given.share]
            if not cells:
                continue
            rows, faulty = machine.disturbed(day, kind)
            predicted = machine.predictions(rows)
            for number, window in cells:
                chosen = probes_within(rows, machine.time, WINDOWS[window],
                                       number, draw)
                if chosen is None:
                    continue
                answer = check(machine, rows, chosen)
                order, wrong, ratio = judge(machine, rows, predicted, chosen,
                                            answer)
                moved = 0.0
                if faulty:
                    moved = rms(predicted[i] - sound["as"][i]
                                for i in chosen) / machine.promised
                named = answer.get("sensors", [])
                found.append({
                    "seed": machine.seed, "day": day, "kind": kind,
                    "probes": number, "window": window, "order": order,
                    "wrong": wrong, "ratio": ratio, "moved": moved,
                    "off": answer["status"] in ("off", "sensor"),
                    "known": order not in ("unknown", "not known"),
                    "named": bool(named) and any(
                        machine.header[i] in named for i in faulty),
                    "accused": bool(named) and not any(
                        machine.header[i] in named for i in faulty)})


def share(part, whole):
    return f"{len(part)}/{len(whole)}" + (
        f" {100.0 * len(part) / len(whole):.1f} %" if whole else "")


def report(found):
    def of(**wanted):
        return [c for c in found
                if all(c[key] == value for key, value in wanted.items())]

    print(f"\nwrong in all: {share([c for c in found if c['wrong']], found)}")
    print("a cell: wrong | not known | orders, over the four numbers of probes")
    for kind in dict.fromkeys(c["kind"] for c in found):
        for window in WINDOWS:
            cells = of(kind=kind, window=window)
            if not cells:
                continue
            orders = collections.Counter(c["order"] for c in cells)
            print(f"  {kind:10} {window:7} "
                  f"{share([c for c in cells if c['wrong']], cells):>14} "
                  f"{share([c for c in cells if not c['known']], cells):>14}  "
                  + ", ".join(f"{o} {n}" for o, n in orders.most_common()))
    worst = []
    for kind in KINDS:
        for window in WINDOWS:
            for number in PROBES:
                cells = of(kind=kind, window=window, probes=number)
                wrong = [c for c in cells if c["wrong"]]
                if wrong:
                    worst.append((len(wrong) / len(cells), kind, window, number,
                                  share(wrong, cells)))
    print("worst cells (kind, window, probes):")
    for _, kind, window, number, text in sorted(worst, reverse=True)[:12]:
        print(f"  {kind:10} {window:7} {number:3} {text}")
    many = [c for c in found if c["probes"] >= 5 and
            c["window"] in ("1 h", "whole")]
    for text, of_cut in (("", False), (", of cut logs", True)):
        some = [c for c in many if c["kind"].startswith("cut") == of_cut]
        print(f"not known with five probes or more over an hour or more{text}: "
              f"{share([c for c in some if not c['known']], some)}")
    for kind in SENSOR_KINDS:
        moved = [c for c in of(kind=kind) if c["moved"] > 1.0]
        print(f"{kind}: named where it moves the map by more than the promise "
              f"{share([c for c in moved if c['named']], moved)}")
    well = [c for c in found if c["ratio"] <= OFF and
            c["kind"] in ("healthy", "duty")]
    print("sessions that hold, said not to: "
          f"{share([c for c in well if c['off']], well)}")
    print(f"sound sensors accused: {share([c for c in found if c['accused']], found)}")


def main():
    parser = parser_of(__doc__, range(1, 21))
    parser.add_argument("--train", type=int, default=6)
    parser.add_argument("--days", type=int, default=10)
    parser.add_argument("--share", type=float, default=1.0)
    parser.add_argument("--model", default="blend")
    parser.add_argument("--kinds", default="")
    parser.add_argument("--dump", default="")
    given = parser.parse_args()
    found = []
    for seed in given.seeds:
        with tempfile.TemporaryDirectory() as folder:
            machine = Machine(given.errmap, folder, seed, given)
            machine.seed = seed
            study(machine, given, found)
        print(f"seed {seed}: promised {1000 * machine.promised:.2f} um, "
              f"{len(machine.sensors)} thermometers", flush=True)
    if given.dump:
        with open(given.dump, "w", encoding="utf-8") as file:
            json.dump(found, file)
    report(found)


if __name__ == "__main__":
    main()
