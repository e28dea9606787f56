"""What the benchmarks in Python share: runs of errmap, tables, simulated
turning centres of which a few thermocouples are dead, seeds FIRST-LAST."""

import argparse
import csv
import os
import re
import subprocess

os.environ["XDG_CACHE_HOME"] = "/dev/null"  # every fit is made

FILE = "x_displacement_down.csv"  # of the components of a turning centre


def run(*words, statuses=(0,)):
    """Standard output; ends the benchmark at any other exit status."""
    words = [str(word) for word in words]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    if done.returncode not in statuses:
        raise SystemExit(f"{' '.join(words)}\n{done.stderr}")
    return done.stdout


def read(path):
    with open(path, newline="", encoding="utf-8") as file:
        header, *rows = csv.reader(file)
    return header, rows


def write(path, header, rows):
    with open(path, "w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows([header, *rows])


def simulate(errmap, folder, seed, days, *options):
    run(errmap, "simulate", "turning-centre", "--quiet", "-o", folder, "--seed",
        seed, "--days", days, "--dead", "3,4,16,19", *options)


def seeds(text):
    if not re.fullmatch(r"\d+-\d+", text):
        raise argparse.ArgumentTypeError(f"{text}: write FIRST-LAST")
    first, last = map(int, text.split("-"))
    return range(first, last + 1)


def parser_of(description, default_seeds):
    """Of a benchmark ERRMAP --seeds FIRST-LAST."""
    parser = argparse.ArgumentParser(
        description=description,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("errmap")
    parser.add_argument("--seeds", type=seeds, default=default_seeds,
                        metavar="FIRST-LAST")
    return parser
