#!/usr/bin/env python3
"""Do tuned nets err less than untuned ones, and at what cost?

    net_tuning.py ERRMAP [SPEC ...] [--seeds 1-3]

Four functions of 2 to 10 inputs, each at 300 random places with noise of 0.002,
0.05 and 0.3 times its standard deviation: every SPEC is fitted to these rows
and judged, without noise, at 4,000 others. A line per case with the errors, in
standard deviations of the function; then their geometric means and the time of
the processor, over those of the first SPEC.
"""

import json
import math
import os
import random
import resource
import statistics
import tempfile

from program_runs import parser_of, run, write

SPECS = ["net:scg", "net:scg:wfactor=cv:path=yes", "net:scg:wfactor=cv",
         "net:scg:wfactor=1e-3"]
NOISES = (0.002, 0.05, 0.3)
ROWS, FURTHER_ROWS = 300, 4000


def friedman(x):
    return (10 * math.sin(math.pi * x[0] * x[1]) + 20 * (x[2] - 0.5) ** 2
            + 10 * x[3] + 5 * x[4])


def impedance(x):
    return math.hypot(100 * x[0], 500 * x[1] * x[2]
                      - 1 / (1 + 300 * x[1] + 10 * x[3]))


def decay(x):
    return math.sin(6 * x[0]) + math.exp(-3 * x[1]) * x[2]


def cubic(x):
    return x[0] - 0.5 * x[0] ** 2 + x[0] * x[1] + 0.3 * x[1] ** 3


# With their numbers of inputs; half of friedman's have no part in it.
FUNCTIONS = {"friedman": (friedman, 10), "impedance": (impedance, 4),
             "decay": (decay, 3), "cubic": (cubic, 2)}


def make_case(folder, name, noise, seed):
    """Writes train.csv and further.csv; errors are in the function's sd."""
    function, inputs = FUNCTIONS[name]
    draw = random.Random(f"{name} {noise} {seed}")
    paths = []
    centre = spread = None
    for part, count in (("train", ROWS), ("further", FURTHER_ROWS)):
        rows = [[draw.random() for _ in range(inputs)] for _ in range(count)]
        values = [function(row) for row in rows]
        if centre is None:
            centre, spread = statistics.fmean(values), statistics.pstdev(values)
        amount = noise if part == "train" else 0.0
        paths.append(os.path.join(folder, part + ".csv"))
        write(paths[-1], ["error", *(f"x{i}" for i in range(inputs))],
              [[(value - centre) / spread + amount * draw.gauss(0, 1), *row]
               for row, value in zip(rows, values)])
    return paths


def child_seconds():
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime


def judge(errmap, spec, folder, train, further):
    """(RMSE at the further places, seconds of the fit)"""
    model = os.path.join(folder, "map.json")
    before = child_seconds()
    run(errmap, "fit", train, "--model", spec, "-o", model, "--no-interval",
        "--quiet")
    seconds = child_seconds() - before
    found = run(errmap, "evaluate", model, further, "--quiet", "--format",
                "json")
    return json.loads(found)["summary"]["rmse"], seconds


def main():
    parser = parser_of(__doc__, "1-3")
    parser.add_argument("specs", nargs="*", default=SPECS, metavar="SPEC")
    given = parser.parse_args()

    print("case", *given.specs)
    logarithms = {spec: [] for spec in given.specs}
    seconds = dict.fromkeys(given.specs, 0.0)
    with tempfile.TemporaryDirectory() as folder:
        for seed in given.seeds:
            for name in FUNCTIONS:
                for noise in NOISES:
                    case = make_case(folder, name, noise, seed)
                    errors = []
                    for spec in given.specs:
                        error, taken = judge(given.errmap, spec, folder, *case)
                        errors.append(error)
                        logarithms[spec].append(math.log(error))
                        seconds[spec] += taken
                    print(f"{name} {noise} {seed}",
                          *(f"{error:.4f}" for error in errors), flush=True)
    means = [math.exp(statistics.fmean(of)) for of in logarithms.values()]
    print("geometric mean", *(f"{mean:.4f}" for mean in means))
    print("over the first", *(f"{mean / means[0]:.3f}" for mean in means))
    times = list(seconds.values())
    print("times its time", *(f"{time / times[0]:.2f}" for time in times))


if __name__ == "__main__":
    main()
