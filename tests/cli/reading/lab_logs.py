"""Measurements as laboratories log them, from machines whose truth is known.

A Log holds the rows of a simulated machine in the order of time, with the day,
the cycle and the direction of each; write_table puts them into a file by names,
a form of time and other habits, and `truth` says how that file is to be read.
"""

import csv
import datetime
import io
import math
import random

ORIGIN = datetime.datetime(2026, 3, 2)

AXES = ("position_mm", "x_pos_mm", "X [mm]", "Sollposition [mm]", "pos_mm",
        "nominal (mm)", "axis_x_mm", "Position", "y_mm", "Achse Z [mm]",
        "posizione [mm]", "position (mm)")
CYCLES = ("cycle", "Cycle No.", "Zyklus", "cycle_number")
DAYS = ("day", "Day", "Tag", "session")
TARGETS = ("error_um", "error [um]", "Error (um)", "error_um_mean")
SENSORS = (("t{}_degC", "T{} [degC]", "temp_{}_degC", "Temperatur {} [°C]"))
DIRECTIONS = ("direction", "dir", "Richtung")
TIMES = ("iso", "date and clock", "seconds", "minutes", "hours", "epoch s",
         "epoch ms", "excel", "stamp", "clock", "anew")


class Log:
    """Days of cycles of a linear axis with thermometers.

    Lists of the same length, a row each: day (0, 1, ...), cycle (0, 1, ... on
    through the days), up (True or False), at (seconds since ORIGIN), position
    (mm), temperatures (a list), error (um).
    """

    def __init__(self, seed, *, days=None, cycles=None, both_ways=None,
                 sensors=None, positions=None, step=None, night_hours=None,
                 pause=None):
        draw = random.Random(seed)
        days = days or draw.randint(1, 12)
        cycles = cycles or draw.randint(2, 20)
        if both_ways is None:
            both_ways = draw.random() < 0.3
        sensors = sensors or draw.randint(1, 5)
        positions = positions or draw.randint(5, 20)
        night = 3600.0 * (night_hours or math.exp(
            draw.uniform(math.log(4.0), math.log(60.0))))
        pass_rows = positions * (2 if both_ways else 1)
        # A day of at most 14 h, its pauses at most a quarter of the night.
        day = 3600.0 * draw.uniform(0.5, 14.0)
        self.step = step or draw.choice(
            [s for s in (1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 60.0)
             if s * pass_rows * cycles <= day] or [1.0])
        longest = (day - self.step * pass_rows * cycles) / max(1, cycles - 1)
        self.pause = pause if pause is not None else max(
            3.0 * self.step,
            min(night / 4.0, longest) * draw.uniform(0.1, 1.0))
        uneven = draw.uniform(0.0, 0.2)
        first, width = draw.choice(((0.0, 25.0), (-215.9, 12.7), (10.0, 50.0)))
        self.positions = [round(first + width * i, 4) for i in range(positions)]
        self.both_ways = both_ways
        taus = [3600.0 * draw.uniform(0.3, 3.0) for _ in range(sensors)]
        heats = [draw.uniform(1.0, 9.0) for _ in range(sensors)]
        effects = [draw.uniform(-2.0, 2.0) for _ in range(sensors)]
        slopes = [draw.uniform(-0.01, 0.01) for _ in range(sensors)]
        reversal = draw.uniform(1.5, 4.0)
        kinematic = [draw.uniform(-3.0, 3.0) for _ in range(3)]
        rows = {name: [] for name in
                ("day", "cycle", "up", "at", "position", "temperatures",
                 "error")}
        at = 3600.0 * draw.choice((6.0, 7.5, 8.0, 14.0, 20.5, 22.0))
        span = self.positions[-1] - self.positions[0]
        heat = [0.0] * sensors
        for d in range(days):
            ambient = 21.0 + draw.gauss(0.0, 0.8)
            duty = draw.uniform(0.6, 1.0)
            begin = at
            for c in range(cycles):
                order = list(self.positions)
                ways = [(True, order)]
                if both_ways:
                    ways.append((False, order[::-1]))
                for up, places in ways:
                    for place in places:
                        lag = [1.0 - math.exp(-(at - begin) / tau)
                               for tau in taus]
                        warm = [h + duty * w * l
                                for h, w, l in zip(heat, heats, lag)]
                        u = (place - self.positions[0]) / span - 0.5
                        error = (kinematic[0] * u + kinematic[1] * u * u
                                 + kinematic[2] * math.sin(6.0 * u)
                                 + sum((e + 60.0 * s * u) * w for e, s, w in
                                       zip(effects, slopes, warm))
                                 - (0.0 if up else reversal)
                                 + draw.gauss(0.0, 0.25))
                        rows["day"].append(d)
                        rows["cycle"].append(d * cycles + c)
                        rows["up"].append(up)
                        rows["at"].append(at)
                        rows["position"].append(place)
                        rows["temperatures"].append(
                            [ambient + w + draw.gauss(0.0, 0.04) for w in warm])
                        rows["error"].append(error)
                        at += self.step
                if c < cycles - 1:
                    at += self.pause * (1.0 + uneven * draw.uniform(-1, 1))
            heat = [w * math.exp(-night / tau)
                    for w, tau in zip(warm, taus)]
            heat = [h if h > 0.05 else 0.0 for h in heat]
            at += night * draw.uniform(0.95, 1.2)
        self.__dict__.update(rows)
        self.days, self.cycles_a_day, self.sensors = days, cycles, sensors

    def __len__(self):
        return len(self.at)


def times(log, form, draw):
    """(names, cells a row, unit) of a form of time."""
    at = log.at
    dates = [ORIGIN + datetime.timedelta(seconds=round(t)) for t in at]
    if form == "iso":
        name = draw.choice(("DateTime", "timestamp", "Zeitstempel"))
        return [name], [[d.isoformat(" ")] for d in dates], "date"
    if form == "date and clock":
        names = draw.choice((["Datum", "Uhrzeit"], ["date", "time"]))
        return names, [[d.strftime("%d.%m.%Y"), d.strftime("%H:%M:%S")]
                       for d in dates], "date"
    if form == "clock":
        return ["time"], [[d.strftime("%H:%M:%S")] for d in dates], "clock"
    if form == "stamp":
        return ["timestamp"], [[d.strftime("%Y%m%d%H%M%S")] for d in dates], \
            "YYYYMMDDhhmmss"
    if form == "excel":
        zero = datetime.datetime(1899, 12, 30)
        return ["Time"], [[f"{(d - zero).total_seconds() / 86400.0:.7f}"]
                          for d in dates], "days"
    epoch = [int((d - datetime.datetime(1970, 1, 1)).total_seconds())
             for d in dates]
    if form == "epoch s":
        return ["timestamp"], [[str(e)] for e in epoch], "s"
    if form == "epoch ms":
        return ["timestamp"], [[str(1000 * e)] for e in epoch], "ms"
    begun = list(at)
    if form == "anew":  # the clock starts at 0 each day
        begins = {}
        for d, t in zip(log.day, at):
            begins.setdefault(d, t)
        begun = [t - begins[d] for d, t in zip(log.day, at)]
        return ["time_s"], [[f"{t:.10g}"] for t in begun], "s"
    unit, size = {"seconds": ("s", 1.0), "minutes": ("min", 60.0),
                  "hours": ("h", 3600.0)}[form]
    name = draw.choice((f"time_{unit}", f"Time [{unit}]", f"t ({unit})",
                        f"Zeit [{unit}]"))
    return [name], [[f"{t / size:.10g}"] for t in begun], unit


def write_table(log, draw, *, form="iso", day=False, cycle=False,
                cycle_anew=False, direction=False, axis=None, target=None,
                sensor=None, delimiter=",", rows=None, extra=()):
    """The text of a CSV file of these rows (default: all, in time) and names.

    `extra` are further columns: (name, cells). Returns text and the names.
    """
    names, cells, unit = times(log, form, draw) if form else ([], None, None)
    names = list(names)
    used = {"axis": axis or draw.choice(AXES), "unit": unit,
            "target": target or draw.choice(TARGETS),
            "day": draw.choice(DAYS), "cycle": draw.choice(CYCLES),
            "direction": draw.choice(DIRECTIONS), "time": names}
    sensor = sensor or draw.choice(SENSORS)
    header = ([used["day"]] if day else []) + (
        [used["cycle"]] if cycle else []) + names + [used["axis"]] + (
        [used["direction"]] if direction else []) + [
        sensor.format(i + 1) for i in range(log.sensors)] + [
        used["target"]] + [name for name, _ in extra]
    used["sensors"] = [sensor.format(i + 1) for i in range(log.sensors)]
    used["header"] = header
    out = io.StringIO()
    table = csv.writer(out, delimiter=delimiter, lineterminator="\n")
    table.writerow(header)
    words = draw.choice((("up", "down"), ("+", "-"), ("1", "-1")))
    for i in (range(len(log)) if rows is None else rows):
        number = log.cycle[i] % log.cycles_a_day if cycle_anew else log.cycle[i]
        table.writerow(
            ([log.day[i] + 1] if day else []) + ([number + 1] if cycle else [])
            + (cells[i] if cells else []) + [f"{log.position[i]:.10g}"]
            + ([words[0 if log.up[i] else 1]] if direction else [])
            + [f"{t:.2f}" for t in log.temperatures[i]]
            + [f"{log.error[i]:.3f}"] + [column[i] for _, column in extra])
    return out.getvalue(), used


def first_rows(codes):
    """Rows at which a list of codes, in order, begins another."""
    return [i for i, code in enumerate(codes) if i == 0 or code != codes[i - 1]]
