#!/usr/bin/env python3
"""The same tuned study by errmap and by scikit-learn, on the same folds.

    peer_study.py ERRMAP DATA.csv [--target NAME] [--group NAME] [--seed N]

Outside, groups:5 (errmap deals whole groups, in order; the same folds are given
to scikit-learn by --save-split); inside, each choice by whole groups of the
training rows, as a practitioner would: GridSearchCV over usual grids of
penalties, for Ridge on standardised inputs, for Ridge and Lasso on them and
their squares and products, for MLPRegressor of 10 nodes by L-BFGS; and
SequentialFeatureSelector. One core each; CPU seconds of both and their ratio,
and the held-out RMSE of each family with the ratio of errmap's to its peer's.
"""

import argparse
import csv
import json
import math
import os
import resource
import subprocess
import tempfile
import time
import warnings

for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ[name] = "1"

import numpy as np
from sklearn.compose import TransformedTargetRegressor
from sklearn.feature_selection import SequentialFeatureSelector
from sklearn.linear_model import Lasso, LinearRegression, Ridge
from sklearn.model_selection import GridSearchCV, GroupKFold
from sklearn.neural_network import MLPRegressor
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import PolynomialFeatures, StandardScaler

os.environ["XDG_CACHE_HOME"] = "/dev/null"  # every fit is made

FAMILIES = {
    "ridge1": "poly:ridge:view=raw:terms=full:degree=1",
    "ridge2": "poly:ridge:view=raw:terms=full:degree=2",
    "lasso2": "poly:lasso:view=raw:terms=full:degree=2",
    "net": "net:scg:hidden=10:output=linear:wfactor=cv:decay=weights",
    "forward": "poly:stepwise:degree=1",
}


def cpu_of_children():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def by_errmap(errmap, given, folder, model):
    words = [errmap, "compare", given.data, "--models", model, "--holdout",
             "groups:5", "--jobs", "1", "--quiet", "--seed", str(given.seed),
             "--out", f"{folder}/out", "--force",
             "--save-split", f"{folder}/split.csv"]
    for option in ("target", "group"):
        if getattr(given, option):
            words += [f"--{option}", getattr(given, option)]
    before = cpu_of_children()
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    seconds = cpu_of_children() - before
    if done.returncode != 0:
        raise SystemExit(done.stderr)
    with open(f"{folder}/out/results.json", encoding="utf-8") as file:
        component = json.load(file)["components"][0]
    result = next(m for m in component["models"] if m["name"] == model)
    return seconds, result["results"]["groups:5"]["test"]["rmse"], component


def read(given, component, folder):
    """Inputs, target, groups and the fold of every row that errmap used."""
    with open(given.data, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(r for r in file if not r.startswith("#")))
    data = component["data"]
    x = np.array([[float(r[n]) for n in data["inputs"]] for r in rows])
    y = np.array([float(r[data["target"]]) for r in rows])
    # A cycle of another day is another one, though it has the same number.
    labels = np.array([r[data["group"]] for r in rows])
    groups = np.cumsum(np.append(0, labels[1:] != labels[:-1]))
    fold = np.empty(len(y), dtype=int)
    with open(f"{folder}/split.csv", newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            if row["role"] == "test":
                fold[int(row["row"])] = int(row["fold"])
    return x, y, groups, fold


def forward(x, y, cv):
    return make_pipeline(
        StandardScaler(),
        SequentialFeatureSelector(LinearRegression(), tol=1e-6 * np.var(y),
                                  n_features_to_select="auto",
                                  scoring="neg_mean_squared_error", cv=cv),
        LinearRegression())


def searched(steps, alphas, cv):
    """The alpha of the last step by GridSearchCV, for a target of variance 1."""
    name = type(steps[-1]).__name__.lower()
    return GridSearchCV(
        TransformedTargetRegressor(make_pipeline(*steps),
                                   transformer=StandardScaler()),
        {f"regressor__{name}__alpha": alphas}, cv=cv,
        scoring="neg_mean_squared_error")


def peer(family, x, y, groups, seed):
    """A fitted estimator, tuned on whole groups of these rows."""
    few = min(5, len(set(groups)))
    cv = list(GroupKFold(few).split(x, y, groups))
    if family == "forward":
        return forward(x, y, cv).fit(x, y)
    steps, alphas = [StandardScaler()], np.logspace(-6, 4, 21)
    if family.endswith("2"):
        steps.append(PolynomialFeatures(2, include_bias=False))
    if family == "lasso2":
        steps.append(Lasso())
        alphas = np.logspace(-5, 0, 11)
    elif family == "net":
        steps.append(MLPRegressor((10,), activation="logistic", solver="lbfgs",
                                  max_iter=1500, max_fun=10 ** 6,
                                  random_state=seed))
        alphas = np.logspace(-5, 2, 15)
    else:
        steps.append(Ridge())
    return searched(steps, alphas, cv).fit(x, y)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("errmap")
    parser.add_argument("data")
    parser.add_argument("--target")
    parser.add_argument("--group")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--families", default=",".join(FAMILIES))
    given = parser.parse_args()
    warnings.filterwarnings("ignore")
    ours, theirs, errors = 0.0, 0.0, []
    print("| family | errmap s | scikit-learn s | ratio | errmap RMSE | "
          "scikit-learn RMSE | ratio |\n|---|---|---|---|---|---|---|")
    for family in given.families.split(","):
        with tempfile.TemporaryDirectory() as folder:
            seconds, rmse, component = by_errmap(
                given.errmap, given, folder, FAMILIES[family])
            x, y, groups, fold = read(given, component, folder)
        start = time.process_time()
        residuals = np.empty(len(y))
        for k in np.unique(fold):
            train = fold != k
            fitted = peer(family, x[train], y[train], groups[train],
                          given.seed)
            residuals[~train] = y[~train] - fitted.predict(x[~train])
        peer(family, x, y, groups, given.seed)  # the map that is handed over
        of_peer = time.process_time() - start
        peer_rmse = math.sqrt(np.mean(residuals ** 2))
        ours, theirs = ours + seconds, theirs + of_peer
        errors.append(rmse / peer_rmse)
        print(f"| {family} | {seconds:.2f} | {of_peer:.2f} | "
              f"{of_peer / seconds:.1f} | {rmse:.4g} | {peer_rmse:.4g} | "
              f"{rmse / peer_rmse:.2f} |", flush=True)
    mean = math.exp(sum(map(math.log, errors)) / len(errors))
    print(f"\n{theirs / ours:.1f} times as quick in all; geometric mean of the "
          f"errors' ratios {mean:.2f}")


if __name__ == "__main__":
    main()
