"""What exported maps cost a controller: the figures of `errmap cost`.

  export_cost.py ERRMAP

The limits are those that a servo period of 1 ms leaves aside easily: 20 ns for
a polynomial of 10 terms, 250 ns for a net of 37 inputs and 10 hidden nodes,
200 ns for a step of a linear map of 40 filtered sensors (gcc -O2, double).
Ends with status 1 where one is missed.
"""

import json
import pathlib
import random
import subprocess
import sys
import tempfile


def inputs(names):
    return [{"name": name, "unit": "degC", "min": 18.0, "max": 30.0,
             "mean": 24.0, "sd": 3.0} for name in names]


def model(name, kind, names, parameters, form, history=None):
    return {"schema": "errmap-model-1", "version": "0", "name": name,
            "kind": kind, "target": {"name": "error_um", "unit": "um"},
            "inputs": inputs(names), "parameters": parameters, kind: form,
            "history": history, "guards": None, "interval": None}


def polynomial(count, terms, intercept=0.1):
    return {"input_offset": [24.0] * count, "input_scale": [0.2] * count,
            "intercept": intercept, "equation": "",
            "terms": [{"powers": powers,
                       "coefficient": random.uniform(-1.0, 1.0)}
                      for powers in terms]}


def cubic():
    """The full cubic of position and one temperature: 10 terms."""
    terms = [[i, j] for i in range(4) for j in range(4 - i) if i + j > 0]
    return model("cubic in 2 inputs, 10 terms", "polynomial",
                 ["x_degC", "t_degC"], len(terms) + 1, polynomial(2, terms))


def net(count, hidden):
    names = [f"t{i}_degC" for i in range(count)]
    form = {"nodes": [count, hidden, 1], "output": "sigmoid",
            "input_offset": [24.0] * count, "input_scale": [0.2] * count,
            "target_slope": [0.02], "target_offset": [0.5],
            "w1": [[random.uniform(-0.5, 0.5) for _ in range(count + 1)]
                   for _ in range(hidden)],
            "w2": [[random.uniform(-0.5, 0.5) for _ in range(hidden + 1)]]}
    return model(f"net {count}-{hidden}-1", "net", names,
                 hidden * (count + 1) + hidden + 1, form)


def filtered(count, taus):
    names = [f"t{i}_degC" for i in range(count)]
    derived = [{"name": f"f{i}", "unit": "degC", "of": name, "filter": "ema", "between": "linear",
                "tau": taus[i % len(taus)]} for i, name in enumerate(names)]
    terms = [[int(i == j) for j in range(count)] for i in range(count)]
    history = {"time_unit": "s", "session": "day", "latest_start": None,
               "derived": derived,
               "form_inputs": [entry["name"] for entry in derived]}
    return model(f"{count} filtered sensors, {len(taus)} time constants",
                 "polynomial", names, count + 1, polynomial(count, terms),
                 history)


def main():
    random.seed(1)
    missed = False
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "map.json"
        for limit, made in ((20.0, cubic()), (250.0, net(37, 10)),
                            (200.0, filtered(40, [600.0, 1800.0, 5400.0])),
                            (None, net(37, 60)),
                            (None, filtered(40, [300.0 + 100.0 * i
                                                 for i in range(40)]))):
            path.write_text(json.dumps(made), encoding="utf-8")
            cost = json.loads(subprocess.run(
                [sys.argv[1], "cost", path, "--format", "json"], check=True,
                capture_output=True, text=True).stdout)
            late = limit is not None and cost["median_ns"] > limit
            missed = missed or late
            print("%-44s %7.1f ns median, 99.9 %% below %5.0f ns, %6d bytes of code%s"
                  % (made["name"], cost["median_ns"], cost["p999_ns"],
                     cost["bytes"]["code"],
                     "" if limit is None else
                     ", limit %.0f ns: %s" % (limit, "MISSED" if late
                                              else "kept")))
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
