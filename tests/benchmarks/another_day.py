#!/usr/bin/env python3
"""Does the recommended map hold on days that it never saw?

    another_day.py ERRMAP DATA.csv [--train K] [--session COLUMN] ...
    another_day.py ERRMAP --simulate 1-20 --train K [--later "--duty 1.6"] ...

Of DATA.csv every choice of K of its sessions (default: all but two) is used
for training and the others judge. With --simulate each seed is a turning centre
of K + 2 days, of which the last two judge; --later simulates these with other
options (--component NAME: which of its files, default x_displacement_down).

The training rows are compared with the defaults (or --models, --holdout), the
recommended map is fitted to them and judged on the other rows, beside the best
in hindsight of simple competitors on raw inputs: mean, linear, ridge (its
penalty by leaving sessions out), stepwise quadratic by BIC, lasso quadratic
(--quick: without the last two). A line per choice, as a Markdown table: error
promised, found, that of the best competitor, their ratio, and the share of rows
within the map's 90 % interval with its width over that of the smallest one that
would have held them. Words after -- go to compare and fit.
"""

import argparse
import csv
import itertools
import json
import math
import os
import statistics
import sys
import tempfile

from program_runs import read, run, seeds, simulate, write

COMPETITORS = {
    "mean": "mean",
    "linear": "poly:full:degree=1",
    "ridge": "poly:ridge:view=raw:between=1:terms=linear",
    "stepwise": "poly:stepwise:degree=2:criterion=bic",
    "lasso": "poly:lasso:view=raw:between=1:terms=full:degree=2",
}
SLOW = ("stepwise", "lasso")


def choices_of(given):
    """(name, header, training rows, later rows) of every choice."""
    if given.simulate:
        for seed in given.simulate:
            with tempfile.TemporaryDirectory() as folder:
                days = []
                for options in ("", given.later):
                    simulate(given.errmap, f"{folder}/{len(days)}", seed,
                             given.train + 2, *options.split())
                    days.append(
                        read(f"{folder}/{len(days)}/{given.component}.csv"))
            header = days[0][0]
            day = header.index("day")
            yield (f"seed {seed}", header,
                   [r for r in days[0][1] if int(r[day]) <= given.train],
                   [r for r in days[1][1] if int(r[day]) > given.train])
        return
    header, rows = read(given.data)
    column = header.index(given.session)
    sessions = list(dict.fromkeys(row[column] for row in rows))
    for chosen in itertools.combinations(
            sessions, given.train or len(sessions) - 2):
        yield ("+".join(chosen), header,
               [r for r in rows if r[column] in chosen],
               [r for r in rows if r[column] not in chosen])


class Judge:
    """Fits maps to training.csv and judges them on later.csv."""

    def __init__(self, given, folder):
        self.given = given
        self.training = os.path.join(folder, "training.csv")
        self.later = os.path.join(folder, "later.csv")
        self.model = os.path.join(folder, "model.json")

    def fit(self, spec, *options):
        run(self.given.errmap, "fit", self.training, "--model", spec,
            "-o", self.model, *options, *self.given.options)

    def rmse(self, spec):
        self.fit(spec, "--no-interval")
        return self.rmse_of_file()

    def rmse_of_file(self):
        found = json.loads(run(self.given.errmap, "evaluate", self.model,
                               self.later, "--format", "json"))
        return found["summary"]["rmse"]

    def coverage(self):
        """Share within the 90 % interval, its width over the least one."""
        with open(self.model, encoding="utf-8") as file:
            document = json.load(file)
        if document["interval"] is None:
            return math.nan, math.nan
        half = document["interval"]["90"]
        predicted = csv.DictReader(
            run(self.given.errmap, "predict", self.model, self.later,
                "--quiet").splitlines())
        header, rows = read(self.later)
        target = header.index(document["target"]["name"])
        sizes = sorted(abs(float(row[target]) - float(line["predicted"]))
                       for row, line in zip(rows, predicted))
        least = sizes[math.ceil(0.9 * len(sizes)) - 1]
        return sum(s <= half for s in sizes) / len(sizes), half / least


def spread(values):
    ordered = sorted(values)
    last = len(ordered) - 1
    return (f"{statistics.median(ordered):.2f} "
            f"({ordered[round(0.05 * last)]:.2f} to "
            f"{ordered[round(0.95 * last)]:.2f})")


def main():
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("errmap")
    parser.add_argument("data", nargs="?")
    parser.add_argument("--simulate", type=seeds, metavar="FIRST-LAST")
    parser.add_argument("--later", default="")
    parser.add_argument("--component", default="x_displacement_down")
    parser.add_argument("--train", type=int)
    parser.add_argument("--session", default="session")
    parser.add_argument("--models")
    parser.add_argument("--holdout")
    parser.add_argument("--quick", action="store_true")
    words = sys.argv[1:]
    cut = words.index("--") if "--" in words else len(words)
    given = parser.parse_args(words[:cut])
    given.options = words[cut + 1:]
    if (given.data is None) == (given.simulate is None):
        parser.error("name DATA.csv or --simulate FIRST-LAST")
    study = ["--models", given.models] if given.models else []
    study += ["--holdout", given.holdout] if given.holdout else []
    competitors = {name: spec for name, spec in COMPETITORS.items()
                   if not (given.quick and name in SLOW)}

    lines = []
    print("| trained on | recommended | promised | found | best simple | ratio "
          "| within 90 % | width |")
    print("|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        judge = Judge(given, folder)
        for name, header, training, later in choices_of(given):
            write(judge.training, header, training)
            write(judge.later, header, later)
            results = json.loads(
                run(given.errmap, "compare", judge.training, "--format",
                    "json", "--quiet", *study, *given.options))
            component = results["components"][0]
            advice = component["recommendation"]
            scale = component["display"]["scale"]
            promised = next(
                m["results"][advice["holdout"]]["test"]["rmse"]
                for m in component["models"] if m["name"] == advice["model"])
            judge.fit(advice["model"])
            found = judge.rmse_of_file()
            covered, width = judge.coverage()
            simple = {key: judge.rmse(spec)
                      for key, spec in competitors.items()}
            best = min(simple, key=simple.get)
            lines.append({"ratio": found / simple[best],
                          "promise": found / promised,
                          "mean": found / simple["mean"],
                          "covered": covered, "width": width})
            print(f"| {name} | {advice['model'][:24]} "
                  f"| {promised * scale:.2f} | {found * scale:.2f} "
                  f"| {simple[best] * scale:.2f} ({best}) "
                  f"| {found / simple[best]:.2f} "
                  f"| {covered:.2f} | {width:.2f} |", flush=True)
    of = {key: [line[key] for line in lines] for key in lines[0]}
    mean = statistics.geometric_mean(of["ratio"])
    print(f"\ngeometric mean of the ratios {mean:.3f}, worst "
          f"{max(of['ratio']):.2f}; found / error of the mean at most "
          f"{max(of['mean']):.2f}")
    print(f"found / promised: {spread(of['promise'])} (median, 90 %)")
    print(f"within 90 %: {statistics.fmean(of['covered']):.3f} on average, "
          f"width {spread(of['width'])}")


if __name__ == "__main__":
    main()
