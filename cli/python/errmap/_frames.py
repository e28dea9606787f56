"""Measurements in memory as tables, options as words of a command line."""

from __future__ import annotations

import math
import numbers
import os
import sys
import warnings
from typing import Any, Iterable, Mapping, Union

from errmap import _core

#: A pandas DataFrame, a mapping of names to columns, a structured array, or the
#: path of a CSV file.
Measurements = Any

FRAME = "frame"


def _is_missing(cell: Any) -> bool:
    # None, NaN, NaT and pandas.NA are the values that do not equal themselves.
    if cell is None or type(cell).__name__ in ("NAType", "NaTType"):
        return True
    return isinstance(cell, float) and math.isnan(cell)


def _cell(cell: Any) -> Union[float, str, None]:
    if _is_missing(cell):
        return None
    if isinstance(cell, str):
        return cell
    if isinstance(cell, bool) or type(cell).__name__ == "bool_":
        return str(bool(cell))
    if isinstance(cell, numbers.Real):
        try:
            return float(cell)
        except OverflowError:
            return math.inf if cell > 0 else -math.inf
    if isinstance(cell, bytes):
        return cell.decode("utf-8", "replace")
    return str(cell)


def _add_column(table: _core.Table, name: str, column: Any) -> None:
    kind = getattr(getattr(column, "dtype", None), "kind", "O")
    if kind == "c":
        raise ValueError(f"{FRAME}: column '{name}' has complex numbers")
    if kind in "fiu":
        if hasattr(column, "to_numpy"):
            column = (
                column.to_numpy(dtype="float64", na_value=float("nan"))
                if hasattr(column.dtype, "na_value")  # Int64 with pandas.NA
                else column.to_numpy()
            )
        # Other numbers are converted once; float64 stays where it is.
        values = column.astype("float64", copy=False)
        if values.ndim == 1 and values.dtype.isnative:
            table.add_numbers(name, values)
            return
    if hasattr(column, "tolist"):
        ndim = getattr(column, "ndim", 1)
        if ndim != 1:
            raise ValueError(f"{FRAME}: column '{name}' has {ndim} dimensions")
        if kind == "M":
            column = [None if _is_missing(c) or str(c) == "NaT" else str(c)
                      for c in column]
        else:
            column = column.tolist()
    try:
        cells = [_cell(cell) for cell in column]
    except TypeError:
        raise ValueError(f"{FRAME}: column '{name}' is not a list of cells") from None
    table.add_cells(name, cells)


def _name(label: Any) -> str:
    # Of several levels: "temperature t1".
    if isinstance(label, tuple):
        label = " ".join(str(part) for part in label if str(part))
    # Half a surrogate pair is not a character.
    return str(label).encode("utf-8", "replace").decode()


def columns_of(frame: Measurements) -> Iterable[tuple[str, Any]]:
    """The columns by name."""
    if isinstance(frame, Mapping):
        return [(_name(name), column) for name, column in frame.items()]
    if hasattr(frame, "iloc") and hasattr(frame, "columns"):
        columns = [(_name(label), frame.iloc[:, i])
                   for i, label in enumerate(frame.columns)]
        known = {name for name, _ in columns}
        # Named levels of the index are columns, too.
        levels = [
            (_name(label), frame.index.get_level_values(i))
            for i, label in enumerate(frame.index.names)
            if label is not None and _name(label) not in known
        ]
        return levels + columns
    names = getattr(getattr(frame, "dtype", None), "names", None)
    if names:
        return [(name, frame[name]) for name in names]
    raise ValueError(
        f"{FRAME}: measurements are a DataFrame, a mapping of names to columns, "
        f"a structured array or the path of a CSV file, not "
        f"{type(frame).__name__}"
    )


def table_of(frame: Measurements, units: Mapping[str, str] | None = None,
             name: str = FRAME) -> _core.Table:
    """The frame in errmap's form, with units in the columns' names."""
    columns = list(columns_of(frame))
    units = dict(units or {})
    unknown = set(units) - {column for column, _ in columns}
    if unknown:
        raise ValueError(f"units: no column '{sorted(unknown)[0]}'")
    rows = len(columns[0][1]) if columns and hasattr(columns[0][1], "__len__") \
        else 0
    table = _core.Table(name, rows)
    for column, values in columns:
        if column in units:
            column = f"{column} [{units[column]}]"
        _add_column(table, column, values)
    if not columns:
        raise ValueError(f"{name}: has no columns")
    if rows == 0:
        raise ValueError(f"{name}: has no rows")
    return table


def _list_word(values: Iterable[Any], units: Mapping[str, str]) -> str:
    def quoted(name: str) -> str:
        if any(c in name for c in ',"'):
            return '"' + name.replace('"', '""') + '"'
        return name

    return ",".join(quoted(_in_units(v, units)) for v in values)


def _in_units(value: Any, units: Mapping[str, str]) -> str:
    text = _name(value)
    return f"{text} [{units[text]}]" if text in units else text


#: Options that name columns, and so may have a unit in their name.
_OF_COLUMNS = {"target", "inputs", "exclude", "group", "session", "time",
               "weight", "column", "order", "position", "fitted"}


def words_of(options: Mapping[str, Any],
             units: Mapping[str, str] | None = None) -> list[str]:
    """Options as words: ``keep_dead=True`` is ``--keep-dead``."""
    words: list[str] = []
    for name, value in options.items():
        if value is None or value is False:
            continue
        flag = "--" + name.replace("_", "-")
        of = units or {} if name in _OF_COLUMNS else {}
        if value is True:
            words.append(flag)
        elif isinstance(value, (list, tuple, set)):
            words.append(f"{flag}={_list_word(value, of)}")
        elif isinstance(value, float):
            words.append(f"{flag}={value!r}")
        else:
            words.append(f"{flag}={_in_units(value, of)}")
    return words


class Files:
    """Frames that serve as files in one call."""

    def __init__(self) -> None:
        self.tables: dict[str, _core.Table] = {}
        self.texts: dict[str, str] = {}

    def data(self, frame: Measurements, units: Mapping[str, str] | None = None,
             name: str = FRAME) -> str:
        """The file name by which a command reads the measurements."""
        if isinstance(frame, (str, os.PathLike)):
            if units:
                raise ValueError("units: a file has them in its header")
            return os.fspath(frame)
        self.tables[name] = table_of(frame, units, name)
        return name

    def text(self, name: str, text: str) -> str:
        self.texts[name] = text
        return name

    def run(self, *words: str, accept: tuple[int, ...] = (0,)) \
            -> tuple[int, str, list[str]]:
        """Run a command; return its exit status, output and messages."""
        status, printed, messages = _core.run(
            list(words), self.tables, self.texts)
        if status in accept:
            return status, printed, messages
        line = messages[-1] if messages else f"exit status {status}"
        if status == 130:
            raise KeyboardInterrupt(line)
        raise (ValueError if status in (2, 3, 4) else RuntimeError)(line)


def frame_of(columns: Mapping[str, Any]) -> Any:
    """A DataFrame; a dict of arrays or lists if pandas is missing."""
    arrays = {name: column if isinstance(column, list) else _array(column)
              for name, column in columns.items()}
    try:
        import pandas
    except ImportError:
        return arrays
    return pandas.DataFrame(arrays)


def _array(column: Any) -> Any:
    try:
        import numpy
    except ImportError:
        return list(memoryview(column))
    return numpy.asarray(column)


class ErrmapWarning(UserWarning):
    """A warning of errmap: rows unlike the training data, an interrupted study.

    If a map with a memory gets rows that begin inside a session, give the
    earlier rows with ``after``. Say ``from_rest=True`` if the machine was at
    rest before the first row.
    """


def warn(messages: Iterable[str]) -> bool:
    """Issue errmap's warnings as one; return False if there are none."""
    lines = [line[len("warning: "):] for line in messages
             if line.startswith("warning: ")]
    if lines:
        depth = 1
        while sys._getframe(depth).f_globals["__name__"].startswith("errmap"):
            depth += 1
        warnings.warn("; ".join(lines), ErrmapWarning, stacklevel=depth + 1)
    return bool(lines)
