#!/usr/bin/env python3
"""What the program writes is as its schemas say, and they can refuse.

    schemas_test.py ERRMAP FOLDER_OF_SCHEMA_FOLDERS

Real outputs are validated (JSON Schema draft-07); every key in them is
described; and documents spoilt in one place are refused. Exits with 77, which
CTest takes for skipped, where python3-jsonschema is not installed.
"""

import copy
import functools
import json
import math
import pathlib
import subprocess
import sys
import tempfile

try:
    import jsonschema
except ImportError:
    print("skipped: no jsonschema; apt-get install python3-jsonschema")
    sys.exit(77)

BLOCKS = "errmap-blocks-1"
SUFFIX = ".schema.json"
failures = []


def fail(message):
    failures.append(message)
    print("FAILED:", message, file=sys.stderr)


def refuse_constant(text):
    raise ValueError(f"{text} is not JSON")


def parse(text):
    return json.loads(text, parse_constant=refuse_constant)


def redirected(node, old, new):
    """A copy with the references that begin with `old` beginning with `new`."""
    if isinstance(node, list):
        return [redirected(item, old, new) for item in node]
    if not isinstance(node, dict):
        return node
    copied = {key: redirected(item, old, new) for key, item in node.items()}
    if "$ref" in copied and copied["$ref"].startswith(old):
        copied["$ref"] = new + copied["$ref"][len(old) :]
    return copied


class Schemas:
    def __init__(self, folder):
        self.files = {}
        for path in sorted(pathlib.Path(folder).glob("*/*" + SUFFIX)):
            self.files[path.name] = parse(path.read_text(encoding="utf-8"))
            jsonschema.Draft7Validator.check_schema(self.files[path.name])
        if len(self.files) < 4:
            fail(f"only {len(self.files)} schemas in {folder}")

    @functools.lru_cache(maxsize=None)
    def validator(self, name):
        """With all schemas taken in: no resolver, no look at the disk."""
        shared = {}
        for file, schema in self.files.items():
            place = "#/shared/" + file.removesuffix(SUFFIX)
            schema = redirected(schema, "#", place)
            for other in self.files:
                there = "#/shared/" + other.removesuffix(SUFFIX)
                schema = redirected(schema, other + "#", there)
            shared[file.removesuffix(SUFFIX)] = schema
        return jsonschema.Draft7Validator({"$ref": "#/shared/" + name, "shared": shared})

    def errors(self, document):
        validator = self.validator(document["schema"])
        return [
            f"{list(error.absolute_path)}: {error.message[:200]}"
            for error in validator.iter_errors(document)
        ]

    def branches(self, schema, home):
        """The schemas that describe one value, references followed."""
        if "$ref" in schema:
            name, _, pointer = schema["$ref"].partition("#/")
            home = name or home
            target = self.files[home]
            for key in pointer.split("/"):
                target = target[key]
            yield from self.branches(target, home)
            return
        yield schema, home
        for word in ("allOf", "anyOf"):
            for part in schema.get(word, []):
                yield from self.branches(part, home)

    def undescribed(self, value, schema, home, place=""):
        """Keys of `value` that no schema says anything about."""
        branches = list(self.branches(schema, home))
        if isinstance(value, list):
            for branch, its_home in branches:
                if "items" in branch:
                    for item in value:
                        yield from self.undescribed(
                            item, branch["items"], its_home, place + "[]"
                        )
        if not isinstance(value, dict):
            return
        # An object of which nothing is said is meant to be free.
        if not any("properties" in branch for branch, _ in branches):
            return
        for key, item in value.items():
            known = False
            for branch, its_home in branches:
                rule = branch.get("properties", {}).get(key)
                if rule is None and "additionalProperties" in branch:
                    rule = branch["additionalProperties"]
                if isinstance(rule, dict):
                    known = True
                    yield from self.undescribed(
                        item, rule, its_home, f"{place}.{key}"
                    )
            if not known:
                yield f"{place}.{key}"


class Program:
    def __init__(self, binary, folder):
        self.binary = pathlib.Path(binary).resolve()
        self.folder = pathlib.Path(folder)

    def run(self, *words, statuses=(0,)):
        result = subprocess.run(
            [self.binary, *words],
            cwd=self.folder,
            capture_output=True,
            encoding="utf-8",
            check=False,
        )
        if result.returncode not in statuses:
            fail(f"{' '.join(words)}: {result.returncode}: {result.stderr}")
        return result.stdout

    def json(self, *words, statuses=(0,)):
        text = self.run(*words, "--format", "json", statuses=statuses)
        return parse(text)

    def write(self, name, header, rows):
        lines = [header] + [",".join(repr(cell) for cell in row) for row in rows]
        text = "\n".join(lines) + "\n"
        (self.folder / name).write_text(text, encoding="utf-8")

    def read(self, name):
        return parse((self.folder / name).read_text(encoding="utf-8"))


def measured(cycles, positions, scale):
    """Rows cycle, position, temperature, error of a made-up slide."""
    for cycle in range(1, cycles + 1):
        for step in range(positions):
            x = 40.0 * step
            t = 20.0 + 5.0 * (1.0 - math.exp(-cycle / 4.0))
            wiggle = math.sin(12.9898 * (cycle * positions + step))
            error = 0.001 * (0.02 * x + 0.004 * x * (t - 20.0) + 0.3 * wiggle)
            yield cycle, x, t, scale * error


def documents(program):
    """Every kind of document that the program writes, as (label, document)."""
    rows = list(measured(cycles=8, positions=9, scale=1.0))
    header = "cycle,position_mm,t1_degC,error_mm"
    program.write("grouped.csv", header, rows)
    program.write("angle.csv", "cycle,position_mm,t1_degC,error_arcsec", rows)
    program.write("plain.csv", "position_mm,error_mm", [(r[1], r[3]) for r in rows])

    models = ",".join(
        [
            "zero",
            "mean",
            "poly:eq8",
            "poly:stepwise",
            "poly:ridge:degree=2",
            "net:scg:hidden=2:iterations=20:starts=2",
            "poly:eq8:T=no_such_column",  # fails, and says why
        ]
    )
    program.run("compare", "grouped.csv", "--models", models, "--out", "grouped")
    yield "grouped", program.read("grouped/results.json")
    files = sorted((program.folder / "grouped" / "models").iterdir())
    if len(files) < 6:
        fail(f"only {len(files)} model files")
    for path in files:
        yield path.name, program.read(path)
    simple = "mean,poly:position"
    yield "rezeroed", program.json(
        "compare", "grouped.csv", "--models", "zero,poly:eq8", "--rezero",
        "session:noise=0.1um"
    )
    yield "angle", program.json("compare", "angle.csv", "--models", simple)
    yield "no groups", program.json("compare", "plain.csv", "--models", simple)
    program.run(
        *"simulate turning-centre -o sim --days 3 --cycles 3 --points 9".split(),
        *"--dead 3,4,16,19 --quiet".split(),
    )
    yield "machine", program.json(
        "compare", "--machine", "sim/machine.toml", "sim", "--models", "poly:ridge:view=raw"
    )
    yield "nothing fits", program.json(
        "compare", "plain.csv", "--models", "poly:eq8:T=no_such_column", statuses=(4,)
    )

    fits = {
        "stepwise": ["--model", "poly:stepwise:degree=2", "--correlations"],
        "lasso": ["--model", "poly:lasso:degree=2"],
        "mean": ["--model", "mean"],
        "starts": ["--model", "net:scg:hidden=2:iterations=20:starts=3"],
        "cv": ["--model", "net:lm:hidden=2:iterations=5:wfactor=cv"],
    }
    for label, words in fits.items():
        name = label + ".json"
        yield "fit " + label, program.json("fit", "grouped.csv", *words, "-o", name)
        yield "map " + label, program.read(name)
    yield "evaluate", program.json("evaluate", "stepwise.json", "grouped.csv")
    yield "cost", program.json("cost", "stepwise.json")
    yield "iso230", program.json("iso230", "grouped.csv", "--map", "stepwise.json")

    yield "check", program.json("check", "stepwise.json", "grouped.csv", statuses=(0, 4, 5))
    days = [(d, 600 * i, 20.0 + i % 5, 0.01 * i + d) for d in range(4)
            for i in range(50)]
    program.write("days.csv", "day,time_s,t1_degC,error_um", days)
    program.run("fit", "days.csv", "--model", "mean", "-o", "days.json")
    yield "when", program.json("when", "days.json", "--goal", "0.1um", "--after",
                               "days.csv", "--session", "day", statuses=(0, 4))

    yield "learn", program.json(
        "learn", "grouped.csv", "--by", "cycles", "--models", "mean,poly:eq8",
        "--next", "grouped.csv"
    )
    warm = "day,position_mm,t1_degC,t2_degC,error_mm"
    program.write("days.csv", warm, [(*r[:3], r[2] + 0.1 * r[0], r[3]) for r in rows])
    yield "learn sensors", program.json("learn", "days.csv", "--by", "sensors")
    program.run("fit", "days.csv", "--model", "poly:eq8", "-o", "days.json")
    yield "update", program.json("update", "days.json", "days.csv", "-o", "new.json")

    residuals = ["residuals", "grouped.csv", "--column", "error_mm"]
    yield "residuals", program.json(*residuals)
    yield "residuals, all", program.json(
        *residuals,
        *["--monte-carlo", "200", "--as-printed-1995", "--fitted", "t1_degC"],
    )
    program.write("few.csv", "r_mm", [(0.5,), (0.5,), (0.5,)])
    yield "residuals, constant", program.json("residuals", "few.csv", "--column", "r_mm")

    certify = program.json("certify", statuses=(0, 4))
    for block in ("nonlinear", "nonlinear_summary", "linear", "univariate"):
        if not certify[block]:
            fail(f"certify: no {block}")
    yield "certify", certify

    (program.folder / "four.tab").write_text(
        "4 1 1 1\nx error_mm\n1 0.1\n2 0.3\n3 0.2\n4 0.4\n", encoding="utf-8"
    )
    names = ["report", "four.tab", "none", "weights", "curve", "w1", "w2", "errors"]
    (program.folder / "netcg.in").write_text(
        "\n".join(["1", "'four'", *names, "4 1 2 1 0 7", "5 0 0 1 1", "20*1", "21*1"])
        + "\n",
        encoding="utf-8",
    )
    yield "netcg", program.json("netcg", "netcg.in")
    program.run("simulate", "turning-centre", "-o", "sim", "--days", "1")
    yield "netcg study", program.json("netcg", "--study", "sim", "--iterations", "2")


# One of each type: a value of another type than the right one is wrong.
WRONG = [{"no": "such"}, [["no such"]], "no such", -1.5, True]


def spoilt(schema, document):
    """Copies of the document with one top-level key missing or wrong."""
    for key in schema["required"]:
        copied = copy.deepcopy(document)
        del copied[key]
        yield f"without {key}", copied
    for key, value in document.items():
        for wrong in WRONG:
            if value is None or type(wrong) is type(value):
                continue
            copied = copy.deepcopy(document)
            copied[key] = wrong
            yield f"{key} = {wrong!r}", copied


def put(*path):
    """Spoils a document: path, then the value; ... takes the key away."""
    *keys, last, value = path

    def apply(document):
        for key in keys:
            document = document[key]
        if value is ...:
            del document[last]
        else:
            document[last] = value

    return apply


MODEL = ("components", 0, "models", 2)
RESULT = (*MODEL, "results", "every:3")
DEEP = {
    "grouped": [
        put("components", []),
        put("components", 0, "data", "sha256", "5a"),
        put("components", 0, "data", "rows", -1),
        put("components", 0, "data", "unit", None),
        put("components", 0, "holdouts", 0, "train_rows", 0, 0, "1"),
        put("components", 0, "recommendation", "why", ""),
        put("components", 0, "verdict", 0, "choice", "net"),
        put("components", 0, "tiers", "every:3", ["mean"]),
        put(*MODEL, "kind", "poly"),
        put(*MODEL, "status", "fine"),
        put(*MODEL, "status", "failed"),  # why is null
        put(*MODEL, "why", "it is not failed"),
        put(*MODEL, "parameters", 4.5),
        put(*MODEL, "options", {"T": ["a"]}),
        put(*MODEL, "sensors", ["t1_degC", 2]),
        put(*MODEL, "predict_ns", "85"),
        put(*RESULT, "test", "rmse", "0.1"),
        put(*RESULT, "test", "rmse", -0.1),
        put(*RESULT, "test", "n", None),
        put(*RESULT, "test", "mae", ...),
        put(*RESULT, "train", "r2", 1.5),
        put(*RESULT, "folds", []),
        put(*RESULT, "folds", 0, "stop", "tired"),
        put(*RESULT, "folds", 0, "iterations", 1.5),
        put(*RESULT, "folds", 0, "converged", "yes"),
        put(*RESULT, "folds", 0, "test_rmse", ...),
        put(*RESULT, "normality", "ks", "p_given", 1.5),
        put(*RESULT, "normality", "shapiro_wilk", "w", ...),
        put(*RESULT, "randomness", "in_order", "runs", "p", "small"),
        put(*RESULT, "ci95", [0.1]),
        put(*RESULT, "meets_goal", "yes"),
        put(*RESULT, "goal_standing", "nearly"),
        put("components", 0, "comparisons", [{"a": "mean", "b": "zero"}]),
        put("components", 0, "display", {"unit": "um", "scale": 0}),
        put("provenance", "inputs", 0, "sha256", "not a hash"),
        put("provenance", "libraries", ["Eigen"]),
    ],
    "map stepwise": [
        put("kind", "net"),
        put("kind", "file"),
        put("net", {}),
        put("polynomial", ...),
        put("polynomial", "offset", 1.0),
        put("polynomial", "intercept", None),
        put("polynomial", "terms", 0, "powers", 0, -1),
        put("polynomial", "terms", 0, "powers", 0, 65),
        put("polynomial", "terms", 0, "coefficient", None),
        put("polynomial", "input_scale", ["1"]),
        put("inputs", 0, "sd", -1.0),
        put("inputs", 0, "min", None),
        put("inputs", 0, "name", ""),
        put("parameters", -1),
    ],
    "map starts": [
        put("kind", "polynomial"),
        put("net", "nodes", [1, 2]),
        put("net", "nodes", [1, 0, 1]),
        put("net", "output", "tanh"),
        put("net", "w1", ...),
        put("net", "w1", []),
        put("net", "w2", 0, 0, None),
        put("net", "bias", 1.0),
    ],
    "fit starts": [
        put("starts", "table", 0, "chosen", 1),
        put("starts", "spread", "sd", "none"),
        put("stop", "tired"),
        put("trace", 0, [1, 2]),
    ],
    "fit stepwise": [
        put("regression", "coefficients", 0, "p", 1.1),
        put("regression", "steps", 0, "entered", None),
        put("correlations", "matrix", 0, 0, "1"),
    ],
    "residuals": [
        put("summary", "sd", "0"),
        put("plots", "histogram", "counts", 0, -1),
        put("randomness", "by_group", "levels", 0, "level", 1),
    ],
    "certify": [
        put("nonlinear", 0, "lre_parameters", 11.5),
        put("nonlinear", 0, "start", 3),
        put("nonlinear", 0, "solver", ...),
        put("linear", 0, "lre_coefficients", -1),
        put("univariate", 0, "lre_mean", "15"),
        put("gradients", 0, "worst_relative_error", ...),
        put("nonlinear", 0, "claims_minimum", "yes"),
        put("floors", "linear_lre_sd", "10"),
    ],
    "cost": [put("operations", "copies", -1), put("bytes", "state", None)],
    "iso230": [put("measured", "A", -1.0), put("points", "measured", 0, "up", "runs", 0.5)],
    "evaluate": [put("summary", "rmse", ...), put("normality", "ppcc", ...)],
}


def check(schemas, label, document):
    for error in schemas.errors(document)[:5]:
        fail(f"{label}: {error}")
    schema = schemas.files[document["schema"] + SUFFIX]
    home = document["schema"] + SUFFIX
    for key in sorted(set(schemas.undescribed(document, schema, home))):
        fail(f"{label}: {document['schema']} does not describe {key}")
    extended = {**document, "another": 2}
    if ".another" not in schemas.undescribed(extended, schema, home):
        fail(f"{label}: a key that is not described goes unseen")


def check_teeth(schemas, label, document):
    count = 0
    schema = schemas.files[document["schema"] + SUFFIX]
    for what, copied in spoilt(schema, document):
        count += 1
        if schemas.validator(document["schema"]).is_valid(copied):
            fail(f"{label}: {what} is not refused")
    for number, spoil in enumerate(DEEP.get(label, [])):
        count += 1
        copied = copy.deepcopy(document)
        spoil(copied)
        if schemas.validator(document["schema"]).is_valid(copied):
            fail(f"{label}: spoilt document {number} is not refused")
    return count


def main():
    if len(sys.argv) != 3:
        print("usage: schemas_test.py ERRMAP FOLDER_OF_SCHEMA_FOLDERS", file=sys.stderr)
        return 2
    schemas = Schemas(sys.argv[2])
    used = {BLOCKS}
    labels = set()
    refused = 0
    with tempfile.TemporaryDirectory() as folder:
        for label, document in documents(Program(sys.argv[1], folder)):
            labels.add(label)
            check(schemas, label, document)
            if document["schema"] not in used or label in DEEP:
                refused += check_teeth(schemas, label, document)
            used.add(document["schema"])
    for name in schemas.files:
        if name[: -len(SUFFIX)] not in used:
            fail(f"no document was held against {name}")
    for label in DEEP.keys() - labels:
        fail(f"no document {label} to spoil")
    print(f"schemas: {len(labels)} documents, {refused} spoilt ones refused")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
