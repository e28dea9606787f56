"""Files as laboratories have them: kinds of habits over six days of ten cycles.

`draw(seed)` gives the kind's name and a File: texts by name, options that go
with them, and what is true of how it is to be read.
"""

import csv
import datetime
import math
import os
import random

import lab_logs
from lab_logs import AXES, Log, write_table


class File:
    """Texts of files, words of the command line, and the truth."""

    def __init__(self, texts, log, names, *, words=(), encoding="utf-8",
                 **truth):
        self.texts = texts if isinstance(texts, dict) else {"log.csv": texts}
        self.log, self.names, self.encoding = log, names, encoding
        self.options, self.truth = words, truth

    def words(self, folder):
        return [w.replace("FOLDER", folder) for w in self.options]

    def wrong(self, reading, clean):
        """{topic: what differs} of a reading and the columns as read."""
        found = {}
        true = {
            "sessions": self.log.days,
            "cycles": self.log.days * self.log.cycles_a_day,
            "rows": len(self.log),
            "direction": ["down", "up"] if self.log.both_ways else ["up"],
            **self.truth}

        def hold(topic, read, wanted):
            if wanted is not None and read != wanted:
                found[topic] = f"{read}, not {wanted}"

        hold("sessions", reading["sessions"]["count"], true["sessions"])
        hold("cycles", reading["cycles"]["count"], true["cycles"])
        hold("rows", reading["rows"], true["rows"])
        hold("direction", sorted(reading["direction"]["values"]) or ["up"],
             true["direction"])
        hold("order", reading["order"], true.get("order"))
        hold("position", reading["position"]["column"] or "",
             true.get("axis", self.names.get("axis")))
        hold("target", reading["target"]["column"],
             true.get("target", self.names.get("target")))
        for name in true.get("left_out", ()):
            if name in reading["sensors"]:
                found["left_out"] = f"{name} is taken for a sensor"
        for name in true.get("switches", ()):
            if name in reading["sensors"]:
                found["switches"] = f"{name} is taken for a sensor"
        if "step" in true:
            step = reading["time"]["step_s"]
            if step is None or not math.isclose(step, true["step"],
                                                rel_tol=0.01):
                found["time"] = f"{step} s, not {true['step']} s"
        for words in [w for w in (true.get("says"),) if w]:
            if not any(words in remark for remark in reading["remarks"]):
                found["remarks"] = f"no word of {words}"
        # The numbers themselves, by the columns that serve as axis and target.
        for topic, values, unit in (
                ("position", self.log.position, true.get("axis_in_mm", 1.0)),
                ("target", self.log.error, true.get("target_in_um", 1.0))):
            read = clean.get(reading[topic]["column"]) if reading[topic] else None
            if read is None:
                continue
            kept = true.get("keeps", range(len(values)))
            wanted = sum(values[i] for i in kept) / len(kept)
            mean = sum(read) / len(read) * unit
            width = max(values) - min(values)
            if abs(mean - wanted) > 2e-3 * width:
                found[topic] = f"mean {mean:.4g}, not {wanted:.4g}"
        return found


def columns_of(path):
    """{name: numbers} of a CSV file; none where it is not there."""
    if not os.path.exists(path):
        return {}
    with open(path, newline="", encoding="utf-8") as file:
        header, *rows = csv.reader(file)
    columns = {}
    for i, name in enumerate(header):
        try:
            columns[name] = [float(row[i]) for row in rows if row[i] != ""]
        except ValueError:
            pass
    return columns


def write(file, folder):
    """Writes the texts; the paths of those that are measurements."""
    paths = []
    for name, text in file.texts.items():
        path = os.path.join(folder, name)
        with open(path, "wb") as out:
            out.write(text.encode(file.encoding))
        if not name.startswith("with_"):
            paths.append(path)
    return paths


def six(seed, draw, **options):
    options = {"days": 6, "cycles": 10, "both_ways": False, "sensors": 5,
               "positions": draw.choice((9, 13, 17)),
               "step": draw.choice((2.0, 5.0, 10.0)),
               "night_hours": draw.uniform(9.0, 16.0),
               "pause": draw.uniform(100.0, 1500.0), **options}
    return Log(seed, **options)


DATED = ("iso", "date and clock", "epoch s", "excel")


def axis_names(seed, draw):
    log = six(seed, draw)
    text, names = write_table(log, draw, form=draw.choice(DATED),
                              axis=draw.choice(AXES), day=True, cycle=True)
    return File(text, log, names)


def nights(seed, draw):
    log = six(seed, draw)
    text, names = write_table(log, draw, form=draw.choice(
        ("iso", "seconds", "clock", "date and clock")))
    return File(text, log, names)


def units_of_time(seed, draw):
    log = six(seed, draw)
    text, names = write_table(log, draw, day=True, form=draw.choice(
        ("epoch ms", "epoch s", "excel", "stamp", "minutes", "hours")))
    return File(text, log, names, step=log.step)


def german(seed, draw):
    log = six(seed, draw)
    text, names = write_table(
        log, draw, form="date and clock", cycle=True, delimiter=";",
        axis=draw.choice(("Sollposition [mm]", "Achse X [mm]")),
        target=draw.choice(("Abweichung [µm]", "Fehler [µm]",
                            "Positionsabweichung (µm)")),
        sensor="Temperatur {} [°C]")
    head, _, body = text.partition("\n")
    rows = [";".join(cell if cell.count(".") == 2 else cell.replace(".", ",")
                     for cell in line.split(";"))
            for line in body.splitlines()]
    return File("\n".join([head, *rows]) + "\n", log, names,
                encoding=draw.choice(("utf-8", "latin-1", "utf-8-sig")))


def romance(seed, draw):
    log = six(seed, draw)
    words = draw.choice((
        ("erreur [µm]", "position [mm]", "température {} [°C]"),
        ("errore [um]", "posizione [mm]", "temperatura {} [°C]"),
        ("desviación [um]", "posición [mm]", "temperatura {} [°C]"),
        ("scostamento (um)", "posizione (mm)", "temp {} [°C]"),
        ("écart [µm]", "position [mm]", "temp {} [°C]")))
    text, names = write_table(log, draw, form="iso", target=words[0],
                              axis=words[1], sensor=words[2])
    return File(text, log, names)


def cycles_anew(seed, draw):
    log = six(seed, draw)
    text, names = write_table(log, draw, form=None, cycle=True,
                              cycle_anew=True)
    return File(text, log, names)


def title_lines(seed, draw):
    log = six(seed, draw)
    text, names = write_table(log, draw, day=True, cycle=True)
    titles = ["Laser linear test", "Machine: Mill 3", "Operator: 7",
              "File: run_2.rtl", "Date: 04/03/2026 08:12"]
    count = draw.randint(1, 5)
    block = "\n".join(titles[:count]) + draw.choice(("\n", "\n\n"))
    return File(block + text, log, names)


def folded(seed, draw):
    log = six(seed, draw)
    pattern = draw.choice(("e@{}mm_um", "error {} mm [um]", "{} mm"))
    header = ["day", "cycle", "t1_degC", "t2_degC"] + [
        pattern.format(f"{p:g}") for p in log.positions]
    size = len(log.positions)
    lines = [",".join(header)]
    for i in range(0, len(log), size):
        lines.append(",".join(
            [str(log.day[i] + 1), str(log.cycle[i] + 1)]
            + [f"{t:.2f}" for t in log.temperatures[i][:2]]
            + [f"{e:.3f}" for e in log.error[i:i + size]]))
    return File("\n".join(lines) + "\n", log, {}, axis=None, target=None)


def two_logs(seed, draw):
    log = six(seed, draw)
    text, names = write_table(log, draw, form="seconds", sensor="gone{}")
    keep = [i for i, name in enumerate(names["header"])
            if not name.startswith("gone")]
    errors = "\n".join(",".join(line.split(",")[i] for i in keep)
                       for line in text.splitlines()) + "\n"
    lines = [f"{names['time'][0]},bed_degC,spindle_degC"]
    shift = draw.uniform(-2.0, 2.0)
    unit = {"s": 1.0}[names["unit"]]
    for i in range(0, len(log), 3):
        t = log.temperatures[i]
        lines.append(f"{(log.at[i] + shift) / unit:.3f},{t[0]:.2f},{t[1]:.2f}")
    return File({"log.csv": errors, "with_t.csv": "\n".join(lines) + "\n"},
                log, names, words=("--with", "FOLDER/with_t.csv"))


def open_cells(seed, draw):
    log = six(seed, draw)
    text, names = write_table(log, draw, day=True)
    word = draw.choice(("OPEN", "OL", "OVER", "ERR", "FAULT", "NC", "---",
                        "n.a.", "#N/A"))
    at = names["header"].index(names["sensors"][1])
    lines = text.splitlines()
    dropped = draw.sample(range(1, len(lines)), 7)
    for i in dropped:
        cells = lines[i].split(",")
        cells[at] = word
        lines[i] = ",".join(cells)
    keeps = [i for i in range(len(log)) if i + 1 not in dropped]
    return File("\n".join(lines) + "\n", log, names,
                words=("--missing", "drop-rows"), rows=len(keeps), keeps=keeps,
                cycles=None)


def both_ways(seed, draw):
    log = six(seed, draw, both_ways=True, positions=draw.choice((8, 11)))
    text, names = write_table(log, draw, day=True, cycle=True,
                              form=draw.choice(DATED),
                              direction=draw.random() < 0.5)
    return File(text, log, names)


def sorted_without_clock(seed, draw):
    log = six(seed, draw)
    rows = sorted(range(len(log)), key=lambda i: (log.position[i], i))
    text, names = write_table(log, draw, form=None, day=True, cycle=True,
                              rows=rows)
    return File(text, log, names, order="none")


def shuffled_with_clock(seed, draw):
    log = six(seed, draw)
    rows = list(range(len(log)))
    if draw.random() < 0.5:
        rows.sort(key=lambda i: (log.position[i], i))
    else:
        draw.shuffle(rows)
    text, names = write_table(log, draw, form=draw.choice(DATED), rows=rows,
                              day=draw.random() < 0.5)
    return File(text, log, names, order="time")


def measured_beside(seed, draw):
    log = six(seed, draw)
    name = draw.choice(("actual_mm", "Istposition [mm]", "measured (mm)",
                        "encoder_mm"))
    actual = [f"{p + e / 1000.0:.6f}" for p, e in zip(log.position, log.error)]
    text, names = write_table(log, draw, day=True, extra=[(name, actual)])
    return File(text, log, names, left_out=[name])


def running_number(seed, draw):
    log = six(seed, draw)
    name = draw.choice(("scan", "shot", "seq_no", "epoch", "channel", "point",
                        "nr", "frame", "line"))
    begin, step = draw.randint(0, 40000), draw.choice((1, 1, 2, 3))
    numbers = [str(begin + step * i) for i in range(len(log))]
    text, names = write_table(log, draw, day=True, extra=[(name, numbers)])
    return File(text, log, names, left_out=[name])


def switches(seed, draw):
    log = six(seed, draw)
    words = draw.choice((("on", "off"), ("1", "0"), ("ein", "aus"),
                         ("True", "False")))
    name = draw.choice(("fan", "coolant", "Kühlung", "door", "pump"))
    cells, state = [], 0
    for i in range(len(log)):
        if draw.random() < 0.02:
            state = 1 - state
        cells.append(words[state])
    text, names = write_table(log, draw, day=True, extra=[(name, cells)])
    return File(text, log, names, switches=[name])


def power_up(seed, draw):
    log = six(seed, draw)
    value = draw.choice(("85.00", "-127.00"))
    text, names = write_table(log, draw, day=True, cycle=True)
    at = names["header"].index(names["sensors"][0])
    lines = text.splitlines()
    for i in lab_logs.first_rows(log.day):
        cells = lines[i + 1].split(",")
        cells[at] = value
        lines[i + 1] = ",".join(cells)
    return File("\n".join(lines) + "\n", log, names, says=value.rstrip("0").rstrip("."))


def sign(seed, draw):
    log = six(seed, draw)
    name = draw.choice(("correction_um", "compensation_um", "Korrektur [um]",
                        "compensation [um]"))
    text, names = write_table(log, draw, day=True, target=name)
    return File(text, log, names, must_ask=True, target="(asked)")


def no_header(seed, draw):
    log = six(seed, draw)
    text, names = write_table(log, draw, form="seconds", day=True)
    header = names["header"]
    target = f"column_{header.index(names['target']) + 1}"
    axis = f"column_{header.index(names['axis']) + 1}"
    return File(text.partition("\n")[2], log, {}, target=target, axis=axis,
                words=("--target", target, "--position", axis), cycles=None,
                sessions=None)


def names_twice(seed, draw):
    log = six(seed, draw)
    again = [f"{t[0] + 1.0:.2f}" for t in log.temperatures]
    text, names = write_table(log, draw, day=True)
    text, names = write_table(log, random.Random(seed), day=True, extra=[
        (names["sensors"][0], again)], sensor=None)
    return File(text, log, names)


def names_in_comment(seed, draw):
    log = six(seed, draw)
    text, names = write_table(log, draw, form="seconds", day=True)
    return File(draw.choice(("# ", "#", "## ")) + text, log, names)


def units_below(seed, draw):
    log = six(seed, draw)
    text, names = write_table(log, draw, form="seconds", axis="position_mm",
                              target="error_um", sensor="t{}_degC")
    units = ",".join({"s": "s", "mm": "mm", "um": "um", "degC": "degC"}.get(
        name.rsplit("_", 1)[-1].strip("[]() "), "") for name in names["header"])
    head, _, body = text.partition("\n")
    return File(f"{head}\n{units}\n{body}", log, names)


def thousands(seed, draw):
    log = six(seed, draw)
    log.position[:] = [round(150.0 * log.positions.index(p))
                       for p in log.position]
    log.positions[:] = sorted(set(log.position))
    text, names = write_table(log, draw, form="date and clock", delimiter=";",
                              axis="Sollposition [mm]")
    at = names["header"].index(names["axis"])
    lines = text.splitlines()
    for i in range(1, len(lines)):
        cells = lines[i].split(";")
        cells[at] = f"{int(cells[at]):,}".replace(",", ".")
        lines[i] = ";".join(cells)
    return File("\n".join(lines) + "\n", log, names)


def day_files(seed, draw):
    log = six(seed, draw)
    half = draw.random() < 0.5
    state = draw.getstate()
    texts = {}
    names = None
    for d in range(log.days):
        for part in ((0, 1) if half else (None,)):
            rows = [i for i in range(len(log)) if log.day[i] == d and (
                part is None or part == (log.cycle[i] % 10) // 5)]
            draw.setstate(state)
            text, names = write_table(log, draw, form="iso", day=half,
                                      rows=rows, axis="position_mm")
            date = f"2026-03-{2 + d:02d}" + ("" if part is None else f"_{part}")
            texts[f"x_{date}.csv"] = text
    return File(texts, log, names)


def pass_counter(seed, draw):
    log = six(seed, draw)
    name = draw.choice(("pass", "traverse", "Durchgang", "sweep_id", "loop"))
    anew = draw.random() < 0.5
    begin = draw.choice((0, 1))
    numbers = [str(begin + (c % log.cycles_a_day if anew else c))
               for c in log.cycle]
    text, names = write_table(log, draw, day=True, extra=[(name, numbers)])
    return File(text, log, names)


def read_in_one_place(seed, draw):
    log = six(seed, draw)
    inch = draw.random() < 0.5
    name = draw.choice(("position_in", "pos_in") if inch else
                       ("position_mm", "X [mm]", "Istposition [mm]"))
    place = draw.choice((50.0, 100.0, 412.5))
    log.position[:] = [place + e / 1000.0 for e in log.error]
    if inch:
        log.position[:] = [p / 25.4 for p in log.position]
    text, names = write_table(log, draw, day=True, axis=name)
    return File(text, log, names, axis="", cycles=None, left_out=[name])


def twice(seed, draw):
    log = six(seed, draw)
    text, names = write_table(log, draw, form="iso")
    return File({"monday.csv": text, "monday (1).csv": text}, log, names)


def retold(log, draw, cells, name="time", **options):
    """A table whose column of times is called `name` and has these cells."""
    text, names = write_table(log, draw, form=None, extra=[(name, cells)],
                              **options)
    return text, names


def dates(log):
    return [lab_logs.ORIGIN + datetime.timedelta(seconds=round(t))
            for t in log.at]


def forms_of_dates(seed, draw):
    log = six(seed, draw)
    form = draw.choice(("%d-%b-%Y %H:%M:%S", "%a %d %b %Y %H:%M:%S",
                        "%m/%d/%Y %I:%M:%S %p", "%Y-%m-%d %H:%M:%S CET",
                        "%Y-%m-%dT%H:%M:%S.250Z", "%d.%m.%y %H:%M:%S",
                        "%Y/%m/%d %H.%M.%S"))
    text, names = retold(log, draw, [d.strftime(form) for d in dates(log)],
                         draw.choice(("When", "Zeitpunkt", "stamp")))
    return File(text, log, names, step=log.step)


def elapsed(seed, draw):
    log = six(seed, draw)
    since = [round(t - log.at[0]) for t in log.at]
    cells, name = draw.choice((
        ([f"{s // 3600}:{s // 60 % 60:02d}:{s % 60:02d}" for s in since],
         "elapsed"),
        ([f"{s // 86400} {s // 3600 % 24:02d}:{s // 60 % 60:02d}:{s % 60:02d}"
          for s in since], "Elapsed time"),
        ([str(1000 * s) for s in since], "ms"),
        ([str(s) for s in since], "t"),
        ([str(10_000_000 * s) for s in since], "Time [100ns]")))
    text, names = retold(log, draw, cells, name)
    return File(text, log, names, step=log.step)


LANGUAGES = (
    ("Afwijking [µm]", "Positie [mm]", "Temperatuur {} [°C]"),
    ("Odchyłka [µm]", "Pozycja [mm]", "Temperatura {} [°C]"),
    ("Błąd [µm]", "Położenie [mm]", "Czujnik {} [°C]"),
    ("Avvikelse [µm]", "Läge [mm]", "Temp {} [°C]"),
    ("Erro [µm]", "Posição nominal [mm]", "Sensor {} [Grad C]"),
    ("Odchylka [µm]", "Poloha [mm]", "Teplota {} [°C]"),
    ("Virhe [µm]", "Asema [mm]", "Lämpötila {} [°C]"),
    ("Hata [µm]", "Konum [mm]", "Sıcaklık {} [°C]"),
    ("gosa [um]", "ichi [mm]", "ondo {} [degC]"),
    ("誤差 [µm]", "位置 [mm]", "温度 {} [°C]"),
    ("Abw. (µm)", "Soll (mm)", "Fühler {} (°C)"),
    ("EXX [µm]", "X [mm]", "T{} [C]"))


def languages(seed, draw):
    log = six(seed, draw)
    target, axis, sensor = draw.choice(LANGUAGES)
    text, names = write_table(log, draw, form="iso", target=target, axis=axis,
                              sensor=sensor)
    return File(text, log, names)


def opposite_signs(seed, draw):
    log = six(seed, draw)
    name = draw.choice(("minus error [um]", "Soll-Ist [um]", "offset_um",
                        "error (nom - act) [um]", "error_correction_um",
                        "value [um]"))
    text, names = write_table(log, draw, day=True, target=name)
    return File(text, log, names, target="(asked)")


def difference(seed, draw):
    log = six(seed, draw)
    target = "Istposition [mm]-Sollposition [mm]"
    actual = [f"{p + e / 1000.0:.7f}" for p, e in zip(log.position, log.error)]
    text, names = write_table(log, draw, day=True, axis="Sollposition [mm]",
                              target="gone", extra=[("Istposition [mm]",
                                                     actual)])
    at = names["header"].index("gone")
    text = "\n".join(",".join(c for i, c in enumerate(line.split(","))
                              if i != at) for line in text.splitlines()) + "\n"
    asks = draw.random() < 0.5
    return File(text, log, names, words=() if asks else ("--target", target),
                target=target, target_in_um=1000.0,
                left_out=["Istposition [mm]"])


def numbers_of_positions(seed, draw):
    log = six(seed, draw)
    name = draw.choice(("point", "pos no", "Target", "k", "Messstelle", "step"))
    begin = draw.choice((0, 1))
    text, names = write_table(log, draw, day=True, extra=[(name, [
        str(begin + log.positions.index(p)) for p in log.position])])
    return File(text, log, names, left_out=[name])


def encoder_and_laser(seed, draw):
    log = six(seed, draw)
    extra = [("X_enc_mm", [f"{p + draw.gauss(0, 4e-4):.5f}"
                           for p in log.position]),
             ("laser_mm", [f"{p + e / 1000.0:.6f}"
                           for p, e in zip(log.position, log.error)])]
    draw.shuffle(extra)
    text, names = write_table(log, draw, day=True, axis="X_cmd_mm",
                              extra=extra)
    return File(text, log, names, left_out=["X_enc_mm", "laser_mm"])


def words_of_directions(seed, draw):
    log = six(seed, draw, both_ways=True, positions=8)
    words = draw.choice((("F", "R"), ("1", "2"), ("vor", "rück"), ("A", "B"),
                         ("aller", "retour"), ("+1", "-1"), (">", "<")))
    name = draw.choice(("dir", "way", "Sign", "pass type", "Verfahrrichtung"))
    text, names = write_table(log, draw, day=True, form="iso", extra=[
        (name, [words[0 if up else 1] for up in log.up])])
    return File(text, log, names, left_out=[name], switches=[name])


def runs_beside(seed, draw):
    log = six(seed, draw, days=1, both_ways=draw.random() < 0.5)
    size = len(log.positions)
    header, columns = ["Position [mm]"], [[f"{p:g}" for p in log.positions]]
    for begin in range(0, len(log), size):
        errors = [f"{e:.3f}" for e in log.error[begin:begin + size]]
        up = log.up[begin]
        way = (" up" if up else " down") if log.both_ways else ""
        header.append(f"Run {log.cycle[begin] + 1}{way} [um]")
        columns.append(errors if up else errors[::-1])
    lines = [",".join(header)] + [",".join(row) for row in zip(*columns)]
    return File("\n".join(lines) + "\n", log, {"axis": "Position [mm]",
                                               "target": "error [um]"})


def footers(seed, draw):
    log = six(seed, draw)
    text, names = write_table(log, draw, day=True, cycle=True)
    if draw.random() < 0.5:
        return File(text + "\nEnd of measurement\nOperator: NN\n", log, names)
    word = draw.choice(("Mean", "Max", "Mittelwert"))
    first = text.splitlines()[1].split(",")
    means = ["" if ":" in cell or cell.count(".") == 2 else "1.5"
             for cell in first[1:]]
    return File(text + ",".join([word] + means) + "\n", log, names, words=(
        "--missing", "drop-rows"), rows=None, keeps=range(len(log)))


def lines_between_days(seed, draw):
    log = six(seed, draw)
    text, names = write_table(log, draw, form="iso")
    head, *rows = text.splitlines()
    between = draw.choice(((), ("",), ("", "Day {}: cold start"), (head,),
                           ("Day {} of the test", head)))
    lines = [head]
    for i, row in enumerate(rows):
        if i > 0 and log.day[i] != log.day[i - 1]:
            lines += [line.format(log.day[i] + 1) for line in between]
        lines.append(row)
    return File("\n".join(lines) + "\n", log, names)


def numbers_for_people(seed, draw):
    log = six(seed, draw)
    text, names = write_table(log, draw, day=True, axis="position_um",
                              delimiter=";")
    axis = names["header"].index("position_um")
    target = names["header"].index(names["target"])
    mark = draw.choice((" ", "'", "\u00a0"))
    habit = draw.choice(("marks", "units", "minus", "remark"))
    lines = text.splitlines()
    for i in range(1, len(lines)):
        cells = lines[i].split(";")
        cells[axis] = f"{1000.0 * log.position[i - 1]:,.0f}".replace(",", mark)
        if habit == "units":
            cells[target] += " µm"
        if habit == "minus":
            cells[target] = cells[target].replace("-", "\u2212")
        if habit == "remark" and i % 20 == 0:
            cells[-1] += " # door open"
        lines[i] = ";".join(cells)
    name = names["target"]
    return File("\n".join(lines) + "\n", log, names, axis_in_mm=1e-3,
                target=name)


def quotes_and_blanks(seed, draw):
    log = six(seed, draw)
    text, names = write_table(log, draw, form="seconds", delimiter=";",
                              axis="Position [mm]", target="Error [um]",
                              sensor="Temp {} [degC]")
    rows = [line.split(";") for line in text.splitlines()]
    habit = draw.choice(("single", "double", "apart", "bars"))
    if habit == "apart":
        lines = ["   ".join(c.rjust(14) for c in row) for row in rows]
    elif habit == "bars":
        lines = ["| " + " | ".join(row) + " |" for row in rows]
        lines.insert(1, "|" + "---|" * len(rows[0]))
    elif habit == "single":
        lines = [";".join(f"'{c}'" for c in row) for row in rows]
    else:
        lines = [",".join(f'"{c}"' for c in rows[0])] + [
            ",".join('"' + c.replace(".", ",") + '"' for c in row)
            for row in rows[1:]]
    return File("\n".join(lines) + "\n", log, names)


def words_for_days(seed, draw):
    log = six(seed, draw, days=5)
    name, words = draw.choice((
        ("Wochentag", ["Mo", "Di", "Mi", "Do", "Fr"]),
        ("file", [f"meas_{d:02d}.dat" for d in range(5)]),
        ("Messreihe", list("ABCDE")), ("setup", list("PQRST"))))
    text, names = write_table(log, draw, form=None, extra=[
        (name, [words[d] for d in log.day])])
    return File(text, log, names)


def shuffled_without_clock(seed, draw):
    log = six(seed, draw)
    rows = list(range(len(log)))
    draw.shuffle(rows)
    text, names = write_table(log, draw, form=None, day=True, cycle=True,
                              rows=rows)
    return File(text, log, names, order="none")


def sorted_in_days(seed, draw):
    log = six(seed, draw)
    rows = sorted(range(len(log)),
                  key=lambda i: (log.day[i], log.position[i], i))
    clock = draw.random() < 0.5
    text, names = write_table(log, draw, form="iso" if clock else None,
                              day=not clock, cycle=not clock, rows=rows,
                              cycle_anew=draw.random() < 0.5)
    return File(text, log, names, order="time" if clock else "none")


def numbers_of_days(seed, draw):
    log = six(seed, draw)
    text, names = write_table(log, draw, form="clock", extra=[
        (draw.choice(("DOY", "folder", "k")),
         [str(61 + d) for d in log.day])])
    return File(text, log, names, left_out=[names["header"][-1]])


def two_clocks(seed, draw):
    log = six(seed, draw)
    name, cells = draw.choice((
        ("end_time", [str(d + datetime.timedelta(seconds=2))
                      for d in dates(log)]),
        ("ms", [str(37 * i % 1000) for i in range(len(log))])))
    text, names = write_table(log, draw, form="iso", extra=[(name, cells)])
    return File(text, log, names, left_out=[name])


def switched_off(seed, draw):
    log = six(seed, draw)
    begin = draw.randrange(20, len(log) - 60)
    for i in range(begin, begin + 40):
        log.temperatures[i][0] = 0.0
    text, names = write_table(log, draw, day=True)
    return File(text, log, names, says=names["sensors"][0] + " 0 degC")


KINDS = (axis_names, nights, units_of_time, german, romance, cycles_anew,
         title_lines, folded, two_logs, open_cells, both_ways,
         sorted_without_clock, shuffled_with_clock, measured_beside,
         running_number, switches, power_up, sign, no_header, names_twice,
         names_in_comment, units_below, thousands, day_files, twice,
         pass_counter, read_in_one_place, forms_of_dates, elapsed, languages,
         opposite_signs, difference, numbers_of_positions, encoder_and_laser,
         words_of_directions, runs_beside, footers, lines_between_days,
         numbers_for_people, quotes_and_blanks, words_for_days,
         shuffled_without_clock, switched_off, sorted_in_days, numbers_of_days,
         two_clocks)


def draw(seed):
    """(name of the kind, File) of a seed; the kinds take turns."""
    kind = KINDS[seed % len(KINDS)]
    return kind.__name__, kind(seed, random.Random(1000 + seed))
