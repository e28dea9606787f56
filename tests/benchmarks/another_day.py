#!/usr/bin/env python3
"""Does the recommended map hold on days that it never saw?

    another_day.py ERRMAP DATA.csv [--train K | --first K] [--sessions A,B,...]
                   [--session COLUMN] [--models LIST] [--all-models]
                   [-- options of compare and fit, such as --target]

Every choice of K sessions (default: all but two; --first: the first K and no
other choice) is compared with the
defaults; the map that errmap recommends is fitted to them and judged on the
other sessions, beside the best in hindsight of simple competitors on raw
inputs, their penalties chosen by leaving sessions out of the training days:
mean, linear, ridge, stepwise quadratic by BIC, lasso quadratic. A line per
choice: the map, the error promised, found, that of the best competitor, the
ratio, and the best of all default models in hindsight; then the geometric
mean and the worst of the ratios. Prints a Markdown table.
"""

import argparse
import csv
import itertools
import json
import math
import os
import subprocess
import sys
import tempfile

COMPETITORS = {
    "mean": "mean",
    "linear": "poly:full:degree=1",
    "ridge": "poly:ridge:view=raw:terms=linear",
    "stepwise": "poly:stepwise:degree=2:criterion=bic",
    "lasso": "poly:lasso:view=raw:terms=full:degree=2",
}


def run(*words):
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(words)}\n{done.stderr}")
    return done.stdout


def rmse_on(errmap, spec, training, later, options, folder):
    model = os.path.join(folder, "model.json")
    run(errmap, "fit", training, "--model", spec, "-o", model, *options)
    found = json.loads(run(errmap, "evaluate", model, later, "--format", "json"))
    return found["summary"]["rmse"]


def geometric_mean(values):
    return math.exp(sum(map(math.log, values)) / len(values))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("errmap")
    parser.add_argument("data")
    parser.add_argument("--train", type=int)
    parser.add_argument("--first", type=int)
    parser.add_argument("--sessions")
    parser.add_argument("--session", default="session")
    parser.add_argument("--all-models", action="store_true")
    parser.add_argument("--models")
    words = sys.argv[1:]
    cut = words.index("--") if "--" in words else len(words)
    given = parser.parse_args(words[:cut])
    given.options = words[cut + 1 :]
    models = ["--models", given.models] if given.models else []
    with open(given.data, newline="") as file:
        header, *rows = list(csv.reader(file))
    column = header.index(given.session)
    sessions = list(dict.fromkeys(row[column] for row in rows))
    if given.sessions:
        sessions = given.sessions.split(",")
    size = given.train or len(sessions) - 2
    choices = list(itertools.combinations(sessions, size))
    if given.first:
        choices = [tuple(sessions[: given.first])]

    ratios, promises, hindsight = [], [], []
    print("| trained on | recommended | promised | found | best simple | ratio |")
    print("|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        training = os.path.join(folder, "training.csv")
        later = os.path.join(folder, "later.csv")
        for chosen in choices:
            for path, wanted in (
                (training, chosen),
                (later, [s for s in sessions if s not in chosen]),
            ):
                with open(path, "w", newline="") as file:
                    writer = csv.writer(file)
                    writer.writerow(header)
                    writer.writerows(r for r in rows if r[column] in wanted)
            results = json.loads(
                run(given.errmap, "compare", training, "--format", "json",
                    "--quiet", *models, *given.options)
            )
            component = results["components"][0]
            advice = component["recommendation"]
            promised = next(
                m["results"][advice["holdout"]]["test"]["rmse"]
                for m in component["models"]
                if m["name"] == advice["model"]
            )
            found = rmse_on(given.errmap, advice["model"], training, later,
                            given.options, folder)
            simple = {
                name: rmse_on(given.errmap, spec, training, later,
                              given.options, folder)
                for name, spec in COMPETITORS.items()
            }
            best = min(simple, key=simple.get)
            ratios.append(found / simple[best])
            promises.append(found / promised)
            print(f"| {'+'.join(chosen)} | {advice['model'][:24]} "
                  f"| {promised:.2f} | {found:.2f} "
                  f"| {simple[best]:.2f} ({best}) | {ratios[-1]:.2f} |",
                  flush=True)
            if given.all_models:
                errors = {
                    m["name"]: rmse_on(given.errmap, m["name"], training,
                                       later, given.options, folder)
                    for m in component["models"] if m["status"] == "ok"
                }
                print("   ", {k[:22]: round(v, 2) for k, v in errors.items()})
                hindsight.append(min(errors.values()) / simple[best])
    print(f"\ngeometric mean {geometric_mean(ratios):.3f}, "
          f"worst {max(ratios):.2f}; found / promised "
          f"{geometric_mean(promises):.2f} "
          f"({min(promises):.2f} to {max(promises):.2f})")
    if hindsight:
        print(f"best default model in hindsight {geometric_mean(hindsight):.3f}")


if __name__ == "__main__":
    main()
