#!/usr/bin/env python3
"""Does `errmap when` advise probes that beat a clock of as many?

    when.py ERRMAP [--seeds 7001-7020] [--cycles 20] [--goal 1um]

Each seed is a simulated turning centre of twelve days. A map is fitted to the
first eight; what `when` advises is kept on the other four, beside the clock
that takes as many probes there. A line per seed (um, probes a day), then how
often the advice errs no more than the clock.
"""

import json
import math
import os
import tempfile

from program_runs import FILE, parser_of, read, run, seeds, simulate, write

DAYS, LEARNT = 12, 8


def keep(days, spent):
    """(RMSE, probes a day) where a probe follows each row that has spent 1."""
    squares, rows, probes = 0.0, 0, 0
    for day in days:
        zero = day[0]
        probes += 1
        for row in day[1:]:
            squares += (row["error"] - zero["error"]) ** 2
            rows += 1
            if spent(row["time"] - zero["time"],
                     row["temperature"] - zero["temperature"]) >= 1 - 1e-9:
                zero = row
                probes += 1
    return math.sqrt(squares / rows), probes / len(days)


def clock_of(days, probes):
    """RMSE of the clock of as many probes, between the two nearest to it."""
    below = above = None
    for step in range(400):
        interval = 300.0 * 1.015 ** step
        rmse, taken = keep(days, lambda age, _, i=interval: age / i)
        if taken >= probes and (above is None or taken <= above[1]):
            above = (rmse, taken)
        if taken <= probes and (below is None or taken > below[1]):
            below = (rmse, taken)
    if above is None or below is None or above[1] == below[1]:
        return (below or above)[0]
    share = (probes - below[1]) / (above[1] - below[1])
    return below[0] + share * (above[0] - below[0])


def later_days(errmap, folder, header, rows, temperature):
    path, predicted = (os.path.join(folder, name)
                       for name in ("later.csv", "predicted.csv"))
    write(path, header, rows)
    run(errmap, "predict", os.path.join(folder, "map.json"), path, "-o",
        predicted, "--quiet")
    found_header, found = read(predicted)
    column = found_header.index("predicted")
    days = {}
    for cells, of_map in zip(rows, found):
        row = dict(zip(header, cells))
        days.setdefault(row["day"], []).append({
            "time": float(row["time_s"]),
            "temperature": float(row[temperature]),
            "error": 1000 * (float(row["error_mm"]) - float(of_map[column]))})
    return [sorted(day, key=lambda row: row["time"]) for day in days.values()]


def main():
    parser = parser_of(__doc__, seeds("7001-7020"))
    parser.add_argument("--cycles", default="20")
    parser.add_argument("--goal", default="1um")
    parser.add_argument("--model", default="poly:ridge:view=auto")
    given = parser.parse_args()
    kept = 0
    for seed in given.seeds:
        with tempfile.TemporaryDirectory() as folder:
            simulate(given.errmap, folder, seed, DAYS, "--cycles", given.cycles)
            header, rows = read(os.path.join(folder, FILE))
            day = header.index("day")
            train, model = (os.path.join(folder, name)
                            for name in ("train.csv", "map.json"))
            write(train, header, [r for r in rows if int(r[day]) <= LEARNT])
            run(given.errmap, "fit", train, "--model", given.model, "-o", model,
                "--quiet")
            record = json.loads(run(given.errmap, "when", model, "--goal",
                                    given.goal, "--format", "json"))
            days = later_days(given.errmap, folder, header,
                              [r for r in rows if int(r[day]) > LEARNT],
                              record["temperature"])
        time, change = (record["advised"][n] or math.inf
                        for n in ("time_s", "temperature"))
        rmse, probes = keep(days, lambda age, by: age / time + abs(by) / change)
        clock = rmse if math.isinf(change) else clock_of(days, probes)
        kept += rmse <= clock
        rule = record["rule"]
        print(f"{seed} {'clock' if math.isinf(change) else 'rule'} "
              f"{rmse:.3f} clock {clock:.3f} probes {probes:.1f} held out " +
              (f"{rule['rmse'] / rule['clock_rmse']:.2f} of the clock's"
               if rule else "-"), flush=True)
    print(f"no worse than the clock in {kept} of {len(given.seeds)}")


if __name__ == "__main__":
    main()
