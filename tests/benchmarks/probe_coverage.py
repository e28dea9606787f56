#!/usr/bin/env python3
"""Do the intervals of `errmap predict --probes` hold, whatever is wrong today?

    probe_coverage.py ERRMAP [--seeds 1-20] [--model poly:ridge] [--cycles 10]

Each seed is a simulated turning centre; a map of six days is judged on the next
five, as they are (well), with an offset of 2 to 5 times the promised error,
with one or three thermometers that read 2 to 6 degC off, and with errors 0.5 to
1.5 times as large (gain). Probes are drawn evenly from the first hour, or from
the session. Printed: the share of the rows after the first probe within the
90 % interval, and its width over that without probes (median of the days).
"""

import csv
import io
import json
import os
import random
import statistics
import tempfile

from program_runs import FILE, parser_of, read, run, simulate, write

KINDS = ("well", "offset", "one moved", "three moved", "gain")
NUMBERS = (1, 2, 3, 5)
TRAINED = 6
LATER = range(TRAINED + 1, TRAINED + 6)
HOUR = 3600.0


def disturb(kind, rows, target, thermometers, promised, draw):
    gain, shift, moved = 1.0, 0.0, {}
    if kind == "offset":
        shift = draw.choice([-1, 1]) * draw.uniform(2.0, 5.0) * promised
    if kind == "gain":
        gain = draw.uniform(0.5, 1.5)
    if kind.endswith("moved"):
        for column in draw.sample(thermometers, 1 if kind == "one moved" else 3):
            moved[column] = draw.choice([-1, 1]) * draw.uniform(2.0, 6.0)
    for row in rows:
        row[target] = repr(gain * float(row[target]) + shift)
        for column, change in moved.items():
            row[column] = repr(float(row[column]) + change)


def probes_of(rows, time, number, span, draw):
    chosen = set()
    for part in range(number):
        inside = [i for i, row in enumerate(rows) if i not in chosen and
                  part * span / number
                  <= float(row[time]) - float(rows[0][time])
                  <= (part + 1) * span / number]
        chosen.add(draw.choice(inside or [max(chosen, default=-1) + 1]))
    return sorted(chosen)


def main():
    parser = parser_of(__doc__, "1-20")
    parser.add_argument("--model", default="poly:ridge")
    parser.add_argument("--cycles", default="10")
    given = parser.parse_args()
    found = {}
    for seed in given.seeds:
        draw = random.Random(seed)
        with tempfile.TemporaryDirectory() as folder:
            path = lambda name: os.path.join(folder, name)
            simulate(given.errmap, folder, seed, LATER[-1], "--cycles",
                     given.cycles)
            header, rows = read(path(FILE))
            day, time, target = map(header.index, ("day", "time_s", "error_mm"))
            live = [i for i, name in enumerate(header)
                    if name.endswith("_degC") and any(float(r[i]) for r in rows)]
            write(path("train.csv"), header,
                  [r for r in rows if int(r[day]) <= TRAINED])
            run(given.errmap, "fit", path("train.csv"), "--model", given.model,
                "-o", path("map.json"), "--quiet")
            with open(path("map.json"), encoding="utf-8") as file:
                fitted = json.load(file)
            for kind in KINDS:
                days = [[list(r) for r in rows if int(r[day]) == d] for d in LATER]
                for session in days:
                    disturb(kind, session, target, live,
                            fitted["held_out"]["rmse"], draw)
                write(path("today.csv"), header, [r for s in days for r in s])
                for where in ("hour", "day"):
                    for number in NUMBERS:
                        spans = [HOUR if where == "hour" else
                                 float(s[-1][time]) - float(s[0][time])
                                 for s in days]
                        chosen = [probes_of(s, time, number, span, draw)
                                  for s, span in zip(days, spans)]
                        # Rows between probes stay, for maps with a memory.
                        write(path("probes.csv"), header, [
                            r[:target] + ([r[target]] if i in c else [""]) +
                            r[target + 1:]
                            for s, c in zip(days, chosen)
                            for i, r in enumerate(s)])
                        lines = iter(csv.DictReader(io.StringIO(run(
                            given.errmap, "predict", path("map.json"),
                            path("today.csv"), "--probes", path("probes.csv"),
                            "--quiet"))))
                        for session, c in zip(days, chosen):
                            told = [(float(row[target]), next(lines))
                                    for row in session]
                            later = [t for i, t in enumerate(told)
                                     if i > c[0] and i not in c]
                            if not later:
                                continue
                            held = statistics.fmean(
                                float(t["lower_90"]) <= e <= float(t["upper_90"])
                                for e, t in later)
                            width = statistics.fmean(
                                (float(t["upper_90"]) - float(t["lower_90"])) / 2
                                for _, t in later)
                            found.setdefault((kind, where, number), []).append(
                                (held, width / fitted["interval"]["90"]))
        print(f"seed {seed}", flush=True)
    for kind in KINDS:
        for where in ("hour", "day"):
            print(f"{kind:12} {where:5}" + "".join(
                f"  {number}: {statistics.fmean(h for h, _ in days):.2f} "
                f"({statistics.median(w for _, w in days):.1f})"
                for (k, w0, number), days in found.items()
                if (k, w0) == (kind, where)), flush=True)


if __name__ == "__main__":
    main()
