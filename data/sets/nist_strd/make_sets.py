#!/usr/bin/env python3
"""Writes the files of this folder from the sources of two Debian packages:

    apt-get source ceres-solver gsl     # deb-src line of Debian 12
    python3 make_sets.py CERES_FOLDER GSL_FOLDER

Nonlinear problems: CERES_FOLDER/data/nist/*.dat (NIST's own files). Norris,
Longley, Filip, Pontius and the univariate sets: the tables in gsl's tests.
Wampler1-5 and NoInt1-2: NIST's formulas and certified figures, below.
"""

import re
import sys
from pathlib import Path

FOLDER = Path(__file__).resolve().parent

# One copy in circulation has 1.20196866396E-0, which is not a minimum.
CORRECTIONS = {("Roszman1", "b1"): "2.0196866396E-01"}

LEVELS = {
    "lower": "Misra1a Chwirut2 Chwirut1 Lanczos3 Gauss1 Gauss2 DanWood Misra1b "
             "Norris Pontius Lew Lottery Mavro Michelso NumAcc1 PiDigits",
    "average": "Kirby2 Hahn1 Nelson MGH17 Lanczos1 Lanczos2 Gauss3 Misra1c "
               "Misra1d Roszman1 ENSO NoInt1 NoInt2 NumAcc2 NumAcc3",
    "higher": "MGH09 Thurber BoxBOD Rat42 MGH10 Eckerle4 Rat43 Bennett5 "
              "Longley Filip Wampler1 Wampler2 Wampler3 Wampler4 Wampler5 "
              "NumAcc4",
}


def level(name):
    return next(key for key, names in LEVELS.items() if name in names.split())


def write(kind, name, head, columns, rows):
    lines = [f"set {kind} {name}", f"level {level(name)}", *head,
             "columns " + " ".join(columns), "data"]
    lines += [" ".join(row) for row in rows]
    (FOLDER / f"{name}.txt").write_text("\n".join(lines) + "\n")


def nonlinear(path):
    lines = path.read_text().splitlines()
    head = []
    for line in lines[:60]:
        found = re.match(r"\s*(b\d)\s*=\s*(\S+)\s+(\S+)\s+(\S+)\s+(\S+)", line)
        if found:
            name, start1, start2, certified, sd = found.groups()
            certified = CORRECTIONS.get((path.stem, name), certified)
            head.append(f"parameter {name} {start1} {start2} {certified} {sd}")
        found = re.match(r"Residual Sum of Squares:\s+(\S+)", line)
        if found:
            head.append(f"rss {found[1]}")
        found = re.match(r"Degrees of Freedom:\s+(\d+)", line)
        if found:
            head.append(f"dof {found[1]}")
    start = max(i for i, line in enumerate(lines) if line.startswith("Data:"))
    columns = lines[start].replace("Data:", "").split()
    rows = [line.split() for line in lines[start + 1:] if line.strip()]
    write("nonlinear", path.stem, head, columns, rows)


def numbers(text, name):
    body = re.search(re.escape(name) + r"\s*\[\s*\d*\s*\]\s*=\s*\{(.*?)\}",
                     text, re.S)[1]
    return [word.strip() for word in body.split(",") if word.strip()]


def powers(low, high, certified, sds, rss, dof):
    return ([f"powers {low} {high}"] +
            [f"parameter B{low + i} {c} {s}"
             for i, (c, s) in enumerate(zip(certified, sds))] +
            [f"rss {rss}", f"dof {dof}"])


def gsl_expected(text):
    """Coefficients, standard deviations and sum of squares of a gsl test."""
    values = numbers(text, "expected_c"), numbers(text, "expected_sd")
    rss = re.search(r"expected_chisq\s*=\s*([^;]+);", text)[1].strip()
    return *values, rss


def linear_from_gsl(gsl):
    for name in ["filip", "pontius"]:
        text = (gsl / f"multifit/test_{name}.c").read_text()
        x, y = numbers(text, f"{name}_x"), numbers(text, f"{name}_y")
        c, sd, rss = gsl_expected(text)
        write("linear", name.title(),
              powers(0, len(c) - 1, c, sd, rss, len(y) - len(c)),
              ["y", "x"], zip(y, x))
    text = (gsl / "multifit/test_longley.c").read_text()
    x, y = numbers(text, "longley_x "), numbers(text, "longley_y")
    c, sd, rss = gsl_expected(text)
    head = ["intercept"] + [f"parameter B{i} {a} {b}"
                            for i, (a, b) in enumerate(zip(c, sd))]
    rows = [[y[i]] + x[7 * i + 1:7 * i + 7] for i in range(16)]
    write("linear", "Longley", head + [f"rss {rss}", "dof 9"],
          ["y"] + [f"x{i}" for i in range(1, 7)], rows)
    text = (gsl / "fit/test.c").read_text()
    x, y = numbers(text, "norris_x"), numbers(text, "norris_y")
    # gsl states the variances; NIST the standard deviations.
    write("linear", "Norris",
          powers(0, 1, ["-0.262323073774029", "1.00211681802045"],
                 ["0.232818234301152", "0.429796848199937E-03"],
                 "26.6173985294224", 34), ["y", "x"], zip(y, x))


WAMPLER_NOISE = [759, -2048, 2048, -2048, 2523, -2048, 2048, -2048, 1838,
                 -2048, 2048]
WAMPLER_SD = ["2152.32624678170", "2363.55173469681", "779.343524331583",
              "101.475507550350", "5.64566512170752", "0.112324854679312"]


def shift(decimal, digits):
    return f"{decimal}E+{digits:02d}" if digits else decimal


def linear_from_formulas():
    noise = WAMPLER_NOISE + WAMPLER_NOISE[-2::-1]
    zeros = ["0"] * 6
    exact = [sum(x**k for k in range(6)) for x in range(21)]
    write("linear", "Wampler1", powers(0, 5, ["1"] * 6, zeros, "0", 15),
          ["y", "x"], [[str(y), str(x)] for x, y in enumerate(exact)])
    tenths = []
    for x in range(21):
        scaled = sum(x**k * 10**(5 - k) for k in range(6))
        tenths.append([f"{scaled // 10**5}.{scaled % 10**5:05d}", str(x)])
    write("linear", "Wampler2",
          powers(0, 5, [f"1E-{k:02d}" for k in range(6)], zeros, "0", 15),
          ["y", "x"], tenths)
    for set_number, digits in [(3, 0), (4, 2), (5, 4)]:
        rows = [[str(y + e * 10**digits), str(x)]
                for x, (y, e) in enumerate(zip(exact, noise))]
        write("linear", f"Wampler{set_number}",
              powers(0, 5, ["1"] * 6, [shift(s, digits) for s in WAMPLER_SD],
                     shift("83554268.0000000", 2 * digits), 15),
              ["y", "x"], rows)
    write("linear", "NoInt1",
          powers(1, 1, ["2.07438016528926"], ["0.165289256198347E-01"],
                 "127.272727272727", 10),
          ["y", "x"], [[str(130 + i), str(60 + i)] for i in range(11)])
    write("linear", "NoInt2",
          powers(1, 1, ["0.727272727272727"], ["0.420827318078432E-01"],
                 "0.272727272727273", 2),
          ["y", "x"], [["3", "4"], ["4", "5"], ["4", "6"]])


def univariate(gsl):
    text = (gsl / "statistics/test_nist.c").read_text()
    names = {"lew": "Lew", "lottery": "Lottery", "mavro": "Mavro",
             "michelson": "Michelso", "pidigits": "PiDigits"}
    values = {name: numbers(text, name) for name in names}
    names |= {f"numacc{i}": f"NumAcc{i}" for i in range(1, 5)}
    values["numacc1"] = ["10000001", "10000003", "10000002"]
    for i, whole in [(2, "1"), (3, "1000000"), (4, "10000000")]:
        values[f"numacc{i}"] = ([f"{whole}.2"] +
                                [f"{whole}.1", f"{whole}.3"] * 500)
    for key, name in names.items():
        block = text[text.index(f"gsl_stats_mean ({key},"):]
        figure = {what: re.search(
            rf"expected_{what}\s*=\s*([^;]+);", block)[1].strip()
            for what in ["mean", "sd", "lag1"]}
        head = [f"mean {figure['mean']}", f"sd {figure['sd']}",
                f"autocorrelation {figure['lag1']}"]
        data = values[key]
        width = 40 if name == "PiDigits" else 10
        write("univariate", name, head, ["y"],
              [data[i:i + width] for i in range(0, len(data), width)])


def main():
    ceres, gsl = Path(sys.argv[1]), Path(sys.argv[2])
    for path in sorted((ceres / "data/nist").glob("*.dat")):
        nonlinear(path)
    linear_from_gsl(gsl)
    linear_from_formulas()
    univariate(gsl)


if __name__ == "__main__":
    main()
