"""Machines that are healthy, by day and night, for exports_hold_test.py: none of
their sensors may be called anything else.
"""

import math
import random
import re

from exported_maps import check, run

DRIVER = """#include <stdio.h>
#include "{0}.h"
int main(void) {{
  double start, dt, max_error, max_rate;
  {0}_real x[{0}_INPUTS], error;
  {0}_state state;
  while (scanf("%lf %lf %lf %lf", &start, &dt, &max_error, &max_rate) == 4) {{
    int i, status;
    for (i = 0; i < {0}_INPUTS; ++i) if (scanf("%lf", &x[i]) != 1) return 1;
    if (start == 1.0) {{ {0}_init(&state); {0}_begin(&state); }}
    state.max_error = max_error;
    state.max_rate = max_rate;
    status = {0}_step(&state, dt, x, &error);
    printf("%.17g %d\\n", error, status);
  }}
  return 0;
}}
"""


def answers(out):
    return [(float(error), int(status)) for error, status in
            (line.split() for line in out.splitlines())]


class Machine:
    """A bed, a column and a spindle that warm by their own time constants, days
    and nights; thermometers in steps, one of them coarse and slow."""

    TAUS = (900.0, 3600.0, 7200.0, 14400.0)
    STEP = 60.0

    def __init__(self, seed):
        self.chance = random.Random(seed)
        self.noise = self.chance.choice([0.0, 0.02])
        self.steps = [0.01, 0.01, 0.05, 0.1]
        self.gains = [self.chance.uniform(2.0, 8.0) for _ in self.TAUS]
        self.states = [0.0] * len(self.TAUS)

    def rows(self, days):
        """(day, second of it, position, readings, error)."""
        chance = self.chance
        today = chance.uniform(18.0, 24.0)
        for day in range(days):
            before, today, load = today, chance.uniform(18.0, 24.0), 0.0
            for k in range(int(86400 / self.STEP)):
                hour = k * self.STEP / 3600.0
                works = 7.0 <= hour < 17.0
                if k % 30 == 0:
                    load = chance.uniform(0.3, 1.0) if works else 0.0
                # A hall takes six hours to another day's temperature.
                room = before + (today - before) * min(1.0, hour / 6.0)
                swing = room + 1.5 * math.sin(2 * math.pi * (hour - 9.0) / 24.0)
                for i, tau in enumerate(self.TAUS):
                    share = 1.0 - math.exp(-self.STEP / tau)
                    self.states[i] += share * (
                        self.gains[i] * load - self.states[i])
                readings = [
                    round((swing + state + chance.gauss(0.0, self.noise))
                          / step) * step
                    for state, step in zip(self.states, self.steps)]
                position = 100.0 * (k % 9) / 8.0
                error = (1e-3 * self.states[0] + 2e-3 * self.states[2]
                         + 5e-5 * position * self.states[1])
                yield day, k * self.STEP, position, readings, error


def write_training(file, machine, names):
    """Four days of work, a row each five minutes."""
    with open(file, "w", encoding="utf-8") as text:
        text.write("day,time_s,position_mm," + ",".join(names) + ",error_mm\n")
        for day, second, position, readings, error in machine.rows(4):
            if 7 * 3600 <= second < 17 * 3600 and second % 300 == 0:
                text.write(f"{day},{second!r},{position!r},"
                           + ",".join(f"{x:.2f}" for x in readings)
                           + f",{error:.6f}\n")


def check_healthy_machines(folder, errmap, machines, days):
    said, steps = {"FROZEN": 0, "JUMPED": 0, "CONTRADICTS": 0}, 0
    for seed in range(machines):
        home = folder / f"healthy{seed}"
        home.mkdir()
        machine = Machine(seed)
        names = [f"t{i}_degC" for i in range(len(machine.TAUS))]
        write_training(home / "train.csv", machine, names)
        # Some maps go by the slow sensor of coarse steps alone.
        mine = names if seed % 4 < 3 else names[3:]
        run(errmap, "fit", "train.csv", "--model", "poly:ridge", "--inputs",
            ",".join(["position_mm"] + mine), "-o", "m.json", "--quiet",
            folder=home)
        run(errmap, "export", "m.json", "--c", "--python", "--name", "m", "-o",
            ".", "--quiet", folder=home)
        (home / "hold.c").write_text(DRIVER.format("m"))
        run("cc", "-O1", "hold.c", "m.c", "-o", "m.hold", "-lm", folder=home)
        text = (home / "m.py").read_text()
        limits = re.findall(r"self\.max_\w+ = ([0-9.e+-]+)", text)
        inputs = re.findall(r'^    "(\w+)",$', text, re.M)
        lines = []
        for k, (_, _, position, readings, _) in enumerate(machine.rows(days)):
            values = dict(zip(["position_mm"] + names, [position] + readings))
            row = [int(k == 0), machine.STEP, *limits,
                   *(repr(values[name]) for name in inputs)]
            lines.append(" ".join(map(str, row)) + "\n")
        found = answers(run(str(home / "m.hold"), text="".join(lines)))
        steps += len(found)
        for name in said:
            bit = int(re.search(rf"^{name} = (\d+)", text, re.M)[1])
            said[name] += sum(bool(status & bit) for _, status in found)
    print(f"{machines} healthy machines, {days} days: {steps} steps, {said}")
    check("no healthy sensor hangs", said["FROZEN"] == 0, said)
    check("no healthy sensor jumps", said["JUMPED"] == 0, said)
    check("a healthy sensor contradicts in one step of 10^4 at most",
          said["CONTRADICTS"] <= steps * 1e-4, said)
