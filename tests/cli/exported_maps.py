"""Maps of the simulated turning centre, exported in every language, and how to
run what was exported; for exports_fail_test.py and exports_hold_test.py.
"""

import atexit
import csv
import functools
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import types

HERE = pathlib.Path(__file__).resolve().parent
READER = HERE / "commands" / "read_structured_text.py"
LONG = 1e6  # s: no rate limits the first error

MAPS = {
    "ridge": ["poly:ridge:view=history+zero", "position_mm,t03_degC,t12_degC,"
              "t15_degC,t30_degC"],
    "net": ["net:scg:iterations=100:hidden=5", "position_mm,t03_degC,t12_degC,"
            "t25_degC"],
    # The one whose dead sensor asked for -166.8 mm.
    "stepwise": ["poly:stepwise", "position_mm,t12_degC,t30_degC,t06_degC,"
                 "t25_degC"],
    # As strict as to mark every kind of row.
    "strict": ["poly:ridge:view=history", "position_mm,t03_degC,t12_degC,"
               "t30_degC,t25_degC"],
    "eq8": ["poly:eq8", "position_mm,t12_degC"],
    "full": ["poly:full:degree=2", "position_mm,t12_degC,t30_degC"],
    "raw": ["poly:ridge:view=raw", "position_mm,t03_degC,t12_degC,t15_degC,"
            "t25_degC,t28_degC,t30_degC"],
    "lasso": ["poly:lasso:view=history", "position_mm,t03_degC,t12_degC,"
              "t30_degC"],
    "blend": ["blend", "position_mm,t03_degC,t12_degC,t30_degC"],
    "zeroed": ["poly:ridge:view=zero", "position_mm,t03_degC,t15_degC,"
               "t30_degC"],
    "cubic": ["poly:full:degree=3", "position_mm,t28_degC"],
    # One map for each direction of motion.
    "pair": ["poly:ridge:view=history", "position_mm,t03_degC,t12_degC,"
             "t30_degC"],
}

DRIVER = """#include <stdio.h>
#include "{0}.h"
int main(void) {{
  double start, dt, saved[{0}_SAVED];
  {0}_real x[{0}_INPUTS], error;
  {0}_state state;
  while (scanf("%lf %lf", &start, &dt) == 2) {{
    int i, status;
    for (i = 0; i < {0}_INPUTS; ++i) if (scanf("%lf", &x[i]) != 1) return 1;
    if (start == 1.0 || start == 3.0) {{ {0}_init(&state); dt = 1e6; }}
    if (start == 1.0) {0}_begin(&state);
    if (start == 4.0) {{
      {0}_get_state(&state, saved);
      {0}_init(&state);
      if ({0}_set_state(&state, saved, dt) != 0) return 1;
      dt = 0.0;
    }}
    status = {0}_step(&state, dt, x, &error);
    printf("%.17g %d\\n", error, status);
  }}
  return 0;
}}
"""

TEXT_DRIVER = """#include <stdio.h>
#include "accessor.h"
#include "iec_std_lib.h"
TIME __CURRENT_TIME;
BOOL __DEBUG;
#include "POUS.h"
#include "POUS.c"
int main(void) {{
  static {0} B;
  double start, dt, x[{1}];
  {0}_init__(&B, 0);
  while (scanf("%lf %lf", &start, &dt) == 2) {{
    int i, status = 0;
    for (i = 0; i < {1}; ++i) if (scanf("%lf", &x[i]) != 1) return 1;
    __SET_VAR((&B)->,START,,start == 1.0);
    __SET_VAR((&B)->,DTSECONDS,,start == 1.0 ? 1e6 : dt);
{2}    {0}_body__(&B);
{3}    printf("%.17g %d\\n", (double)__GET_VAR(B.ERROR), status);
  }}
  return 0;
}}
"""
BITS = ["OUTSIDE", "FAR", "CLIPPED", "INVALID", "DEAD", "FROZEN", "CONTRADICTS",
        "FADED", "LIMITED", "RAMPING", "RELATION", "DISTANCE", "LEVERAGE",
        "SETTLING", "GAP", "PARAMETER", "UNHEALTHY", "JUMPED"]

failures = []
planted = []


def check(what, holds, found=None):
    if not holds:
        failures.append(what)
        if len(failures) <= 20 and not planted:
            print(f"FAILED {what} (found {found})")


def run(*words, text=None, folder=None):
    return subprocess.run(words, capture_output=True, text=True, check=True,
                          cwd=folder, input=text).stdout


def write_days(file, ways, keeps=lambda at: True):
    """Writes the rows of these directions of motion beside `file`, each day in
    the order of time, which begins with it: those whose place in it `keeps`."""
    rows = []
    for way in ways:
        with open(file.parent / f"x_displacement_{way}.csv",
                  encoding="utf-8") as text:
            rows += csv.DictReader(text)
    rows.sort(key=lambda row: (int(row["day"]), float(row["time_s"])))
    at, begin, day = 0, 0.0, ""
    with open(file, "w", encoding="utf-8") as text:
        writer = csv.DictWriter(text, rows[0].keys())
        writer.writeheader()
        for row in rows:
            if row["day"] != day:
                at, begin, day = 0, float(row["time_s"]), row["day"]
            if keeps(at):
                writer.writerow(
                    {**row, "time_s": repr(float(row["time_s"]) - begin)})
            at += 1
    return str(file)


def split_days(folder, count):
    """Folders of the days up to `count` and of those after it."""
    parts = []
    for name, is_in in (("known", lambda day: day <= count),
                        ("further", lambda day: day > count)):
        part = folder.parent / name / "sim"
        part.mkdir(parents=True)
        for way in ("up", "down"):
            file = f"x_displacement_{way}.csv"
            with open(folder / file, encoding="utf-8") as text, \
                    open(part / file, "w", encoding="utf-8") as out:
                rows = csv.DictReader(text)
                writer = csv.DictWriter(out, rows.fieldnames)
                writer.writeheader()
                writer.writerows(row for row in rows if is_in(int(row["day"])))
        parts.append(part)
    return parts[0].parent, parts[1]


def make_strict(file):
    """Limits so near that rows lie beyond them in every way."""
    model = json.loads(file.read_text())
    del model["checksum"]  # errmap would see the change
    trained = model["applicability"]
    trained["distance_limit"] *= 0.05
    trained["leverage_limit"] *= 0.1
    trained["relation_limit"] = [0.8 * x for x in trained["relation_limit"]]
    file.write_text(json.dumps(model))


class Exported:
    def __init__(self, name, folder, errmap, interval=False):
        spec, inputs = MAPS[name]
        self.name = name
        self.folder = folder
        self.errmap = errmap
        ways = ["up", "down"] if name == "pair" else ["down"]
        data = write_days(folder / "sim" / (name + ".csv"), ways)
        files = self.files = [f"{name}_{way}.json" for way in ways]
        for way, file in zip(ways, files):
            run(errmap, "fit",
                write_days(folder / "sim" / (way + ".csv"), [way]), "--model",
                spec, "--inputs", inputs, "-o", file, "--quiet",
                *([] if interval else ["--no-interval"]), folder=folder)
        if name == "strict":
            make_strict(folder / files[0])
        maps = (files if len(files) == 1 else
                ["--increasing", files[0], "--decreasing", files[1]])
        for forms, where in ((["--c", "--python", "--st", "--scl", "--plcopen"],
                              "."),
                             (["--st", "--plcopen", "--float"], "single")):
            run(errmap, "export", *maps, *forms, "--name", name, "-o", where,
                "--quiet", folder=folder)
        (folder / "driver.c").write_text(DRIVER.format(name))
        run("cc", "-std=c99", "-O2", "driver.c", name + ".c", "-o",
            name + ".exe", "-lm", folder=folder)
        self.load((folder / (name + ".py")).read_text())
        head = (folder / (name + ".h")).read_text()
        of_head = lambda words: float(re.search(words, head)[1])
        self.slope = 1.01 * of_head(  # of three digits
            r"Motion of the axis adds up to (\S+) mm")
        self.reversal, self.band = 0.0, math.inf
        if name == "pair":
            self.band = of_head(r"has come back by (\S+);")
            self.reversal = 1.01 * of_head(r"then change by (\S+) at once")
        self.position = self.map.INPUTS.index("position_mm")
        travels = [json.loads((folder / file).read_text())["inputs"]
                   [self.position] for file in files]
        self.ends = (min(one["min"] for one in travels),
                     max(one["max"] for one in travels))
        self.days = self.read_days(data)
        self.predicted = [[float(row["predicted"]) for row in rows]
                          for rows in self.predict(data)]

    def load(self, text):
        self.map = types.ModuleType(self.name)
        exec(compile(text, self.name + ".py", "exec"), self.map.__dict__)

    def in_python(self, rows, begins=True, restart=None):
        session = self.map.Map()
        if begins:
            session.begin()
        found = []
        for i, (dt, *inputs) in enumerate(rows):
            if i == restart:
                saved = json.loads(json.dumps(session.get_state()))
                session = self.map.Map()
                check(self.name + ": its own state is taken",
                      session.set_state(saved, dt))
                dt = 0.0
            found.append(session.step(LONG if i == 0 else dt, inputs))
        return found

    @staticmethod
    def lines(rows, begins=True, restart=None):
        flags = {0: 1 if begins else 3, restart: 4}
        return "".join(
            f"{flags.get(i, 0)} " + " ".join(map(repr, row)) + "\n"
            for i, row in enumerate(rows))

    def in_c(self, rows, **how):
        out = run(str(self.folder / (self.name + ".exe")),
                  text=self.lines(rows, **how))
        return [(float(error), int(status)) for error, status in
                (line.split() for line in out.splitlines())]

    def in_structured_text(self, rows, where=".", **how):
        out = run(sys.executable, "-B", str(READER),
                  str(self.folder / where / (self.name + ".st")),
                  text=self.lines(rows, **how))
        return [(float(line.split()[0]), int(line.split()[6]))
                for line in out.splitlines()]

    def in_compiled_text(self, rows):
        """By matiec, a real compiler of IEC 61131-3, where there is one."""
        exe = self.folder / (self.name + ".st.exe")
        if not exe.exists():
            iec2c = pathlib.Path(compiler_of_text()).resolve()
            out = self.folder / (self.name + "_st")
            out.mkdir()
            run(str(iec2c), "-I", str(iec2c.parent / "lib"), "-T", str(out),
                self.name + ".st", folder=self.folder)
            text = (self.folder / (self.name + ".st")).read_text()
            inputs = re.findall(r"^  (In_\w+) : LREAL;", text, re.M)
            (out / "driver.c").write_text(TEXT_DRIVER.format(
                self.name.upper() + "_MAP", len(inputs), "".join(
                    f"    __SET_VAR((&B)->,{name.upper()},,x[{i}]);\n"
                    for i, name in enumerate(inputs)), "".join(
                    f"    if (__GET_VAR(B.{bit})) status |= "
                    f"{getattr(self.map, bit)};\n" for bit in BITS)))
            run("cc", "-O1", "-w", "-I", str(iec2c.parent / "lib" / "C"), "-I",
                str(out), str(out / "driver.c"), "-o", str(exe), "-lm")
        out = run(str(exe), text=self.lines(rows))
        return [(float(error), int(status)) for error, status in
                (line.split() for line in out.splitlines())]

    def predict(self, file):
        """Of each map, its row for each row of a file."""
        return [list(csv.DictReader(
            run(self.errmap, "predict", name, file, "--quiet",
                folder=self.folder).splitlines())) for name in self.files]

    def read_days(self, file):
        days = {}
        with open(self.folder / file, encoding="utf-8") as text:
            for row in csv.DictReader(text):
                days.setdefault(row["day"], []).append(
                    [float(row["time_s"])]
                    + [float(row[column]) for column in self.map.INPUTS])
        return days


@functools.cache
def compiler_of_text():
    """matiec's, built where there is only its source, MATIEC_SOURCE.tar.gz."""
    found = os.environ.get("IEC2C") or shutil.which("iec2c")
    source = os.environ.get("MATIEC_SOURCE")
    if found or not source:
        return found
    folder = tempfile.mkdtemp(prefix="errmap_matiec_")
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    run("tar", "xzf", source, "-C", folder)
    for words in (["autoreconf", "-i"], ["./configure", "CXXFLAGS=-O0 -w"],
                  ["make", "-j2"]):
        run(*words, folder=folder)
    return folder + "/iec2c"


def has_compiler():
    return compiler_of_text() is not None
