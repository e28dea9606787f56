"""The commands that need no class of their own."""

from __future__ import annotations

import json
import os
import tempfile
from typing import Any, Mapping, Sequence

from errmap import _core
from errmap._frames import Files, Measurements, frame_of, warn, words_of

Json = dict[str, Any]


def read_csv(path: str | os.PathLike[str]) -> Any:
    """Read a table like errmap, which finds delimiter and decimal comma.

    Parameters
    ----------
    path : str or path
        A CSV file, which may be gzipped, or a sheet: ``"book.xlsx:Monday"``.

    Returns
    -------
    pandas.DataFrame
        A dict of arrays (numbers) and lists (texts) if pandas is missing.

    Raises
    ------
    ValueError
        If the file is not a table; the message names line and column.
    """
    name = os.fspath(path)
    file_name, colon, _ = name.rpartition(":")
    is_sheet = colon and file_name.lower().endswith((".xlsx", ".xlsm"))
    with open(file_name if is_sheet else name, "rb") as file:
        return frame_of(_core.Table.of_csv(file.read(), name).columns())


def residuals(frame: Measurements, column: str, *,
              units: Mapping[str, str] | None = None, **options: Any) -> Json:
    """Statistics of a column of residuals, or of any numbers.

    Parameters
    ----------
    frame : measurements
    column : str
        The column to examine.
    units : mapping, optional
        Units of columns, such as ``{"error": "um"}``.
    **options
        Those of ``errmap residuals``: ``order``, ``group``, ``position``,
        ``fitted``, ``monte_carlo``, ``seed``, ``bins``, ``missing``,
        ``as_printed_1995``.

    Returns
    -------
    dict
        The document of ``--format json``; lengths in the column's unit.

    Examples
    --------
    >>> import errmap
    >>> found = errmap.residuals({"r_um": [1.0, 2.0, 3.0, 4.0]}, "r_um")
    >>> found["summary"]["mean"]
    2.5
    """
    files = Files()
    data = files.data(frame, units)
    words = words_of({"column": column, **options}, units)
    _, printed, _ = files.run("residuals", data, "--format=json", *words)
    return json.loads(printed)


def learn(frame: Measurements, by: str | None = None, *,
          next: Measurements | None = None,
          units: Mapping[str, str] | None = None, **options: Any) -> Json:
    """Show what more days, more cycles or fewer sensors do to the error.

    Parameters
    ----------
    frame : measurements
    by : {"sessions", "cycles", "sensors"}, optional
    next : measurements, optional
        States that could be measured next: one row of inputs each.
    units : mapping, optional
        Units of columns.
    **options
        Those of ``errmap learn``: ``target``, ``inputs``, ``session``,
        ``time``, ``models``, ``goal``, ``seed``, ``jobs``, ...

    Returns
    -------
    dict
        The document of ``--format json``.
    """
    files = Files()
    words = [files.data(frame, units), *words_of({"by": by, **options}, units)]
    if next is not None:
        words.append("--next=" + files.data(next, units, "next"))
    _, printed, messages = files.run("learn", *words, "--format=json")
    warn(messages)
    return json.loads(printed)


def evaluate(map: Any, frame: Measurements, **options: Any) -> Json:
    """Judge a map on other measurements.

    See :meth:`errmap.MapFile.evaluate`.
    """
    return map.evaluate(frame, **options)


def certify(part: str = "all") -> Json:
    """Test solvers and statistics on problems with known answers.

    Parameters
    ----------
    part : {"nist", "gradients", "agreement", "all"}

    Returns
    -------
    dict
        The document of ``--format json``; ``"passed"`` says whether every
        floor is reached.
    """
    _, printed, _ = Files().run("certify", part, "--format=json", accept=(0, 4))
    return json.loads(printed)


def models() -> str:
    """The models by name, with their options."""
    return Files().run("models")[1]


def simulate(machine: str = "turning-centre", *,
             out: str | os.PathLike[str] | None = None,
             components: Sequence[str] | None = None,
             **options: Any) -> dict[str, Any]:
    """Simulate measurements of a machine with known errors.

    Parameters
    ----------
    machine : str
        ``"turning-centre"``.
    out : path, optional
        A folder for the files; if left out, no files are kept.
    components : sequence of str, optional
        Names of the wanted components; all, if left out.
    **options
        Those of ``errmap simulate``: ``days``, ``cycles``, ``seed``, ``noise``,
        ``dead``, ``drifting``, ``truth``, ...

    Returns
    -------
    dict
        A frame for each component, by the name of its file.

    Examples
    --------
    >>> import errmap
    >>> machine = errmap.simulate(days=1, cycles=2, components=["x_displacement_up"])
    >>> "error_mm" in machine["x_displacement_up"]
    True
    """
    words = ["simulate", machine, "--quiet", *words_of(options)]
    with tempfile.TemporaryDirectory() as scratch:
        folder = os.fspath(out) if out is not None else scratch
        Files().run(*words, f"--output={folder}")
        names = sorted(name[:-4] for name in os.listdir(folder)
                       if name.endswith(".csv"))
        if components is not None:
            unknown = set(components) - set(names)
            if unknown:
                raise ValueError(f"no component '{sorted(unknown)[0]}'; there "
                                 f"are {', '.join(names)}")
            names = list(components)
        return {name: read_csv(os.path.join(folder, name + ".csv"))
                for name in names}
