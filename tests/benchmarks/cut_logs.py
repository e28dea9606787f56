#!/usr/bin/env python3
"""Is a log that begins inside a session known for one?

    cut_logs.py ERRMAP [--seeds 1-20] [--train 6] [--cuts 10] [--model blend]

Each seed is a simulated turning centre: a map with a memory learns six days, and
later days are cut at random, their times in seconds, as dates with clocks, since
1970 and by the number of the row, in turn. Counted: of rows before the map's
memory is full again those that count as inside, by how much of the day was cut
off; whole days that are called cut; and how many errors of all other rows lie
within the 90 % interval.
"""

import collections
import datetime
import json
import math
import os
import random
import tempfile

from program_runs import FILE, parser_of, read, run, simulate, write

CLOCKS = ("seconds", "dates", "since 1970", "rows")
BEGINS = datetime.datetime(2026, 3, 2)


def with_clock(header, rows, clock):
    time = header.index("time_s")
    if clock == "rows":
        return ([name for name in header if name != "time_s"],
                [row[:time] + row[time + 1:] for row in rows])
    name = {"seconds": "time_s", "dates": "time", "since 1970": "time_s"}[clock]
    told = {
        "seconds": lambda t: t,
        "dates": lambda t: (BEGINS + datetime.timedelta(seconds=float(t)))
        .isoformat(timespec="seconds"),
        "since 1970": lambda t: str(int((BEGINS - datetime.datetime(1970, 1, 1))
                                        .total_seconds() + float(t)))}[clock]
    return (header[:time] + [name] + header[time + 1:],
            [row[:time] + [told(row[time])] + row[time + 1:] for row in rows])


def memory_of(path):
    with open(path, encoding="utf-8") as file:
        history = json.load(file)["history"]
    if not history:
        return 0.0
    if any(d["filter"] == "zero" for d in history["derived"]):
        return math.inf
    return 4.0 * max((d["tau"] for d in history["derived"] if "tau" in d),
                     default=0.0)


def predicted(given, path, model):
    text = run(given.errmap, "predict", model, path, "--quiet")
    header, *lines = [line.split(",") for line in text.split("\n")
                      if line and not line.startswith("#")]
    return [dict(zip(header, line)) for line in lines]


def main():
    parser = parser_of(__doc__, range(1, 21))
    parser.add_argument("--train", type=int, default=6)
    parser.add_argument("--cuts", type=int, default=10)
    parser.add_argument("--model", default="blend")
    given = parser.parse_args()
    missed = collections.defaultdict(lambda: [0, 0])
    called = collections.defaultdict(lambda: [0, 0])
    held = []
    for seed in given.seeds:
        draw = random.Random(seed)
        clock = CLOCKS[seed % 4]
        with tempfile.TemporaryDirectory() as folder:
            path = lambda name: os.path.join(folder, name)
            simulate(given.errmap, path("m"), seed, given.train + given.cuts)
            header, rows = read(os.path.join(path("m"), FILE))
            live = [i for i, name in enumerate(header) if name.endswith("_degC")
                    and any(float(row[i]) for row in rows)]
            sensors = draw.sample(live, draw.randint(5, 9))
            kept = [i for i, name in enumerate(header)
                    if name in ("day", "time_s", "position_mm", "error_mm")
                    or i in sensors]
            day = header.index("day")
            time = [float(row[header.index("time_s")]) for row in rows]
            target = header.index("error_mm")
            header, days = [header[i] for i in kept], collections.defaultdict(list)
            for row, at in zip(rows, time):
                days[int(row[day])].append(([row[i] for i in kept], at,
                                            float(row[target])))
            def put(name, chosen):
                write(path(name), *with_clock(header, [r for r, _, _ in chosen],
                                              clock))
            put("train.csv", [r for d in days if d <= given.train
                              for r in days[d]])
            run(given.errmap, "fit", path("train.csv"), "--model", given.model,
                "-o", path("map.json"), "--quiet")
            memory = memory_of(path("map.json"))
            if not memory:
                continue
            for number in range(given.train + 1, given.train + given.cuts + 1):
                whole = days[number]
                put("whole.csv", whole)
                found = predicted(given, path("whole.csv"), path("map.json"))
                called[clock][0] += found[0]["why"] == "start"
                called[clock][1] += 1
                share = draw.random() * 0.9
                cut = whole[int(share * len(whole)):]
                put("cut.csv", cut)
                found = predicted(given, path("cut.csv"), path("map.json"))
                for i, (row, (_, at, error)) in enumerate(zip(found, cut)):
                    since = i if clock == "rows" else at - cut[0][1]
                    if since < memory and i >= 0:
                        part = missed[min(int(share * 10), 8)]
                        part[0] += row["inside"] == "1"
                        part[1] += 1
                    else:
                        held.append(float(row["lower_90"]) <= error <=
                                    float(row["upper_90"]))
        print(f"seed {seed}: {clock}, memory {memory / 60:.0f} "
              f"{'min' if clock != 'rows' else '/60 rows'}", flush=True)
    total = [sum(v[k] for v in missed.values()) for k in (0, 1)]
    print(f"rows whose memory is not full, inside: {total[0]} of {total[1]}")
    for part in sorted(missed):
        print(f"  cut at {part * 10} to {part * 10 + 10} %: {missed[part][0]} of "
              f"{missed[part][1]}")
    print("whole days called cut: " + ", ".join(
        f"{clock} {n} of {of}" for clock, (n, of) in called.items()))
    if held:
        print(f"within the 90 % interval of all other rows: "
              f"{sum(held) / len(held):.3f} of {len(held)}")


if __name__ == "__main__":
    main()
