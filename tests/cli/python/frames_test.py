"""Frames of every kind, at random: none may end the process."""

import os
import random
import unittest
import warnings

import common
import errmap
import numpy
import pandas

FRAMES = int(os.environ.get("ERRMAP_FRAMES", "1500"))
NAMES = ["error_um", "error_mm", "position_mm", "t1_degC", "t2_K", "cycle",
         "day", "time_s", "x", "", "ä µ", "a,b", 'q"q', "=1+1", 7, None,
         ("t", 1), "\ud800", "a\x00b", "row"]


def column(draw, rows):
    kind = draw.randrange(16)
    numbers = numpy.array([draw.gauss(0, 1) for _ in range(rows)])
    if kind < 5:
        return numbers
    if kind == 5:
        numbers[[i for i in range(rows) if draw.random() < 0.2]] = numpy.nan
        return numbers
    if kind == 6:
        return numbers * draw.choice([1e308, 1e-320, numpy.inf, -0.0])
    if kind == 7:
        return (10 * numbers).astype(
            draw.choice(["int8", "int64", "uint16", "float16", "float32", "bool",
                         ">f8", "longdouble", "complex128"]))
    if kind == 8:
        return numpy.repeat(numbers, 2)[::2]
    if kind == 9:
        return numbers[::-1]
    if kind == 10:
        return numpy.array(["2026-11-%02d" % (1 + i % 28) for i in range(rows)],
                           dtype="datetime64[ns]")
    if kind == 11:
        return pandas.array([None if draw.random() < 0.2 else int(10 * n)
                             for n in numbers], dtype="Int64")
    if kind == 12:
        return pandas.Categorical([draw.choice("+-") for _ in range(rows)])
    if kind == 13:
        return [draw.choice([1.5, "2.5", None, "down", b"x", float("nan"),
                             pandas.NaT, 10**400, True, object(), [1]])
                for _ in range(rows)]
    if kind == 14:
        return numpy.full(rows, draw.choice([0.0, 85.0, 9999.0]))
    return pandas.to_timedelta(numpy.arange(rows), unit="s")


def frame(draw):
    rows = draw.choice([0, 1, 2, 3, 8, 20, 40])
    width = draw.randrange(0, 8)
    names = [draw.choice(NAMES) for _ in range(width)]
    if draw.random() < 0.5:
        names[:3] = ["error_um", "position_mm", "t1_degC"][:width]
    if draw.random() < 0.6:
        names = list(dict.fromkeys(names))
    columns = [column(draw, rows) for _ in names]
    shape = draw.randrange(6)
    if shape == 0:
        return dict(zip(names, columns))
    if shape == 1:  # lengths that differ
        return {name: c[:draw.randrange(rows + 1)]
                for name, c in zip(names, columns)}
    parts = [pandas.Series(c, dtype=object if isinstance(c, list) else None)
             for c in columns]
    table = pandas.concat(parts, axis=1) if parts else pandas.DataFrame()
    table.columns = names
    if shape == 2:
        table = table.iloc[::2]
    if shape == 3:
        table.index = pandas.MultiIndex.from_arrays(
            [["a"] * len(table), range(len(table))], names=["day", None])
    if shape == 4:
        table.columns = pandas.MultiIndex.from_tuples(
            [("m", str(name)) for name in names] or [("m", "x")])[:len(names)]
    return table


class RandomFrames(unittest.TestCase):
    def test_each_is_studied_or_refused_in_one_line(self):
        warnings.simplefilter("ignore")
        draw = random.Random(41)
        studied = refused = 0
        for number in range(FRAMES):
            measured = frame(draw)
            try:
                errmap.compare(measured, models=["mean", "poly:position"],
                               holdouts=["blocks:2"], progress=False, jobs=1,
                               keep_dead=draw.random() < 0.5,
                               missing=draw.choice(["error", "drop-rows"]))
                studied += 1
            except ValueError as error:
                self.assertTrue(str(error), number)
                self.assertNotIn("\n", str(error), number)
                refused += 1
        # The test would say nothing if all went one way.
        self.assertGreater(studied, FRAMES / 50)
        self.assertGreater(refused, FRAMES / 50)


class Memory(unittest.TestCase):
    def test_float64_is_read_where_it_lies(self):
        from errmap import _core
        values = numpy.arange(1e6)
        before = resident()
        table = _core.Table("t", len(values))
        for i in range(20):
            table.add_numbers(f"x{i}", values)
        self.assertLess(resident() - before, 8e6)
        del values
        self.assertEqual(numpy.asarray(table.columns()["x3"])[77], 77.0)

    def test_strided_columns_have_their_own_numbers(self):
        block = numpy.arange(12.0).reshape(4, 3)
        table = __import__("errmap._frames").  _frames.table_of(
            {"a": block[:, 1], "b": block[::-1, 2]})
        found = {k: numpy.asarray(v).tolist() for k, v in table.columns().items()}
        self.assertEqual(found, {"a": [1.0, 4.0, 7.0, 10.0],
                                 "b": [11.0, 8.0, 5.0, 2.0]})


def resident():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGESIZE")


if __name__ == "__main__":
    unittest.main()
