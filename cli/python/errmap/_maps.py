"""Maps that were fitted: the model file, and what it can do."""

from __future__ import annotations

import json
import os
import tempfile
from typing import Any, Iterable, Mapping

from errmap import _core
from errmap._frames import Files, Measurements, columns_of, frame_of, warn, words_of


class MapFile:
    """A fitted map, made from the text of its model file.

    Two maps are equal if their texts are. A pickle contains that text.

    Parameters
    ----------
    text : str
        The content of a model file.

    Raises
    ------
    ValueError
        Where it is not a model file.
    """

    _FILE = "map.json"

    def __init__(self, text: str) -> None:
        self.text = text
        _core.require_map(text)
        self._document = json.loads(text)
        self._told: set[str] = set()

    def _warn_once(self, what: str, messages: Iterable[str]) -> None:
        """Warn once for each kind."""
        if what not in self._told and warn(messages):
            self._told.add(what)

    def _files(self) -> Files:
        files = Files()
        files.text(self._FILE, self.text)
        return files

    def __reduce__(self) -> Any:
        return MapFile, (self.text,)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, MapFile) and other.text == self.text

    def __hash__(self) -> int:
        return hash(self.text)

    def __repr__(self) -> str:
        return f"<errmap.MapFile {self.name}: {', '.join(self.inputs)} -> {self.target}>"

    @property
    def name(self) -> str:
        """The model's SPEC, such as ``"poly:eq8"``."""
        return self._document["name"]

    @property
    def inputs(self) -> list[str]:
        """Names of the columns that the map reads."""
        return [column["name"] for column in self._document["inputs"]]

    @property
    def target(self) -> str:
        """Name of the error that it predicts."""
        return self._document["target"]["name"]

    @property
    def unit(self) -> str:
        """Unit of the predicted error."""
        return self._document["target"]["unit"]

    @property
    def equation(self) -> str | None:
        """The map as a formula; None for a net or a blend."""
        return self._document.get("polynomial", {}).get("equation")

    def predictions(self, frame: Measurements, *,
                    after: Measurements | None = None,
                    probes: Measurements | None = None,
                    **options: Any) -> Any:
        """Predict every row, with intervals and how it differs from training.

        Parameters
        ----------
        frame : measurements
            The inputs; columns in another unit are converted.
        after : measurements, optional
            Earlier rows of the session, for a map with a memory.
        probes : measurements, optional
            Measurements of the same session, which correct the map's offset.
        **options
            ``time`` and ``session``: names of columns; ``from_rest=True``: the
            machine was at rest before the first row.

        Returns
        -------
        pandas.DataFrame
            The columns of ``errmap predict``: cycle, time and position if the
            rows have them, ``predicted``, ``lower_90``, ``upper_90``,
            ``lower_95``, ``upper_95`` (target's unit), ``inside`` (1 or 0),
            ``why``, ``offender`` and ``unit``.

        Warns
        -----
        ErrmapWarning
            Once per map, if rows are unlike the training rows, or begin inside
            a session, so that the map's memory is incomplete.
        """
        columns = self._predict(frame, after, probes, options)
        for name in ("why", "offender", "unit"):
            if not isinstance(columns[name], list):
                columns[name] = [""] * len(memoryview(columns[name]))
        return frame_of(columns)

    def _predict(self, frame: Measurements, after: Measurements | None = None,
                 probes: Measurements | None = None,
                 options: Mapping[str, Any] = {}) -> dict[str, Any]:
        files = self._files()
        words = [files.data(frame), *words_of(options)]
        for name, more in (("after", after), ("probes", probes)):
            if more is not None:
                words.append(f"--{name}={files.data(more, None, name)}")
        _, printed, messages = files.run(
            "predict", self._FILE, *words, accept=(0, 4))
        lines = [line for line in messages if line.startswith("warning: ")]
        if len(lines) > 1:
            lines[1:] = [f"warning: predictions() says more ({len(lines) - 1} "
                         "lines) row by row"]
        self._warn_once("rows", lines)
        return _core.Table.of_csv(printed, "predictions").columns()

    def predict(self, frame: Measurements, **options: Any) -> Any:
        """Predicted error of every row, in the target's unit.

        The compensation is minus that. See :meth:`predictions`.

        Returns
        -------
        numpy.ndarray
            (rows) float64.
        """
        import numpy

        return numpy.asarray(self._predict(frame, options=options)["predicted"])

    def interval(self, frame: Measurements, coverage: int = 90,
                 **options: Any) -> Any:
        """Interval that contains the error with this probability.

        Parameters
        ----------
        frame : measurements
        coverage : {90, 95}
            In per cent.

        Returns
        -------
        numpy.ndarray
            (rows x 2): lower and upper, in the target's unit; NaN if the map
            states none.
        """
        import numpy

        if coverage not in (90, 95):
            raise ValueError(f"coverage must be 90 or 95, found {coverage}")
        columns = self._predict(frame, options=options)
        bounds = numpy.column_stack([columns[f"lower_{coverage}"],
                                     columns[f"upper_{coverage}"]])
        if numpy.isnan(bounds).any():
            self._warn_once("interval", [
                "warning: NaN where the map states no interval; it was fitted "
                "without one (errmap.Map(interval=True) asks for it), or to too "
                "few rows"])
        return bounds

    def inside(self, frame: Measurements, **options: Any) -> Any:
        """Whether each row is like the training rows.

        Returns
        -------
        numpy.ndarray
            (rows) bool.
        """
        import numpy

        columns = self._predict(frame, options=options)
        return numpy.asarray(columns["inside"]) == 1.0

    def check(self, probes: Measurements, *, after: Measurements | None = None,
              **options: Any) -> dict[str, Any]:
        """Check with a few probes whether the map holds in this session.

        Parameters
        ----------
        probes : measurements
            A few measurements of one session: inputs and target.
        after : measurements, optional
            The readings before the first probe.
        **options
            Those of ``errmap check``: ``missing``, ``faults``, ``time``,
            ``session``.

        Returns
        -------
        dict
            ``"status"``, ``"off_probability"``, ``"remedy"`` and more.
        """
        return self._judged("check", probes, after, options)

    def evaluate(self, frame: Measurements, *,
                 after: Measurements | None = None,
                 **options: Any) -> dict[str, Any]:
        """Judge the map on other measurements.

        Returns
        -------
        dict
            The document of ``errmap evaluate --format json``.
        """
        return self._judged("evaluate", frame, after, options)

    def _judged(self, command: str, frame: Measurements,
                after: Measurements | None,
                options: Mapping[str, Any]) -> dict[str, Any]:
        files = self._files()
        words = [files.data(frame), "--format=json", *words_of(options)]
        if after is not None:
            words.append(f"--after={files.data(after, None, 'after')}")
        accept = (0, 4, 5) if command == "check" else (0,)
        _, printed, messages = files.run(command, self._FILE, *words,
                                         accept=accept)
        if not printed:
            raise ValueError(messages[-1])
        warn(messages)
        return json.loads(printed)

    def when(self, goal: float | str | None = None, *,
             after: Measurements | None = None,
             **options: Any) -> dict[str, Any]:
        """Say when the map needs its next probe.

        Parameters
        ----------
        goal : float or str, optional
            Limit for 90 % of the errors, in the target's unit, or with its
            own: ``"2um"``.
        after : measurements, optional
            Readings from the last probe to now.
        **options
            ``time`` and ``session``: names of columns.

        Returns
        -------
        dict
            The document of ``errmap when --format json``.
        """
        files = self._files()
        words = words_of({"goal": goal, **options})
        if after is not None:
            words.append(f"--after={files.data(after, None, 'after')}")
        _, printed, messages = files.run(
            "when", self._FILE, *words, "--format=json", accept=(0, 4))
        if not printed:
            raise ValueError(messages[-1])
        warn(messages)
        return json.loads(printed)

    def update(self, frame: Measurements, *known: Measurements,
               **options: Any) -> tuple[MapFile, dict[str, Any]]:
        """Fit the map again with new sessions, if that makes it better.

        Parameters
        ----------
        frame : measurements
            At least two new sessions.
        *known : measurements
            The rows that the map was fitted to. If left out: the files that it
            names.
        **options
            Those of ``errmap update``: ``time``, ``session``, ``seed``, ...

        Returns
        -------
        MapFile
            The new map, or this one.
        dict
            The document of ``errmap update --format json``, with the reason.
        """
        files = self._files()
        words = [files.data(frame), *words_of(options)]
        for number, rows in enumerate(known):
            words.append(f"--known={files.data(rows, None, f'known{number}')}")
        with tempfile.TemporaryDirectory() as scratch:
            path = os.path.join(scratch, self._FILE)
            _, printed, messages = files.run(
                "update", self._FILE, *words, f"--output={path}",
                "--format=json")
            warn(messages)
            return load(path), json.loads(printed)

    def export(self, folder: str | os.PathLike[str], *languages: str,
               **options: Any) -> list[str]:
        """Write the map as a program that a controller runs.

        Parameters
        ----------
        folder : path
            Where the files go.
        *languages : {"c", "st", "scl", "plcopen", "python", "hal", "table"}
        **options
            Those of ``errmap export``: ``name``, ``float``, ``units``,
            ``joint``, ``at``, ``force``, ...

        Returns
        -------
        list of str
            errmap's messages about the files.
        """
        flags = words_of({language: True for language in languages})
        _, _, messages = self._files().run(
            "export", self._FILE, *flags, *words_of(options),
            f"--output={os.fspath(folder)}")
        return messages

    def plot(self, frame: Measurements, ax: Any = None, **options: Any) -> Any:
        """Draw the error over the position, before and after compensation.

        Needs matplotlib.

        Parameters
        ----------
        frame : measurements
            Inputs and target.
        ax : matplotlib.axes.Axes, optional
            The axes to draw on; a new figure, if left out.
        **options
            Those of :meth:`predictions`.

        Returns
        -------
        matplotlib.axes.Axes
        """
        import numpy
        from matplotlib import pyplot

        if isinstance(frame, (str, os.PathLike)):
            raise ValueError("plot: read the file first, by errmap.read_csv")
        columns = dict(columns_of(frame))
        reading = self._document.get("reading") or {}
        axis = (reading.get("position") or {}).get("column") or self.inputs[0]
        per_unit, unit = {"mm": (1e3, "um"), "m": (1e6, "um")}.get(
            self.unit, (1.0, self.unit))
        before = per_unit * numpy.asarray(columns[self.target], dtype="float64")
        after = before - per_unit * self.predict(frame, **options)
        if ax is None:
            ax = pyplot.subplots()[1]
        ax.axhline(0.0, color="0.8", linewidth=1, zorder=0)
        for errors, color, what in ((before, "0.6", "without a map"),
                                    (after, "C0", self.name)):
            rmse = numpy.sqrt(numpy.mean(errors ** 2))
            ax.plot(columns[axis], errors, ".", color=color,
                    label=f"{what}: RMSE {rmse:.3g} {unit}".rstrip())
        ax.set_xlabel(axis)
        ax.set_ylabel(f"error, {unit}" if unit else "error")
        ax.legend()
        return ax

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the model file."""
        with open(path, "w", encoding="utf-8", newline="") as file:
            file.write(self.text)


def fitted(frame: Measurements, model: str,
           options: Mapping[str, Any]) -> MapFile:
    """What ``errmap fit`` writes."""
    files = Files()
    with tempfile.TemporaryDirectory() as scratch:
        path = os.path.join(scratch, "map.json")
        _, _, messages = files.run(
            "fit", files.data(frame), f"--model={model}", f"--output={path}",
            *words_of(options))
        warn(messages)
        return load(path)


def loads(text: str) -> MapFile:
    """Return the map in the text of a model file."""
    return MapFile(text)


def load(path: str | os.PathLike[str]) -> MapFile:
    """Read a map from its model file.

    Parameters
    ----------
    path : path
        A file written by ``errmap fit`` or ``errmap compare --out``.

    Returns
    -------
    MapFile

    Raises
    ------
    ValueError
        If it is not a model file; OSError if it cannot be read.
    """
    with open(path, encoding="utf-8", newline="") as file:
        return MapFile(file.read())
