"""Compare maps, and what a comparison found."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass
from html import escape
from typing import Any, Callable, Mapping, Sequence, Union

from errmap import _core
from errmap._frames import Files, Measurements, frame_of, warn, words_of
from errmap._maps import MapFile


@dataclass(frozen=True)
class Foreign:
    """A regressor of another library that takes part in a study."""

    name: str
    regressor: Any

    def _fit(self, x: Any, y: Any, columns: Sequence[str]) -> Callable[[Any], Any]:
        import numpy
        from sklearn.base import clone

        fitted = clone(self.regressor).fit(
            numpy.array(x, order="C"), numpy.array(y))

        def predict(rows: Any) -> Any:
            predicted = fitted.predict(numpy.array(rows, order="C"))
            return numpy.asarray(predicted, dtype="float64").ravel()

        return predict


def foreign(name: str, regressor: Any) -> Foreign:
    """Let a scikit-learn regressor take part in a study.

    A clone of it is fitted to the training rows of every fold. It appears in
    the same tables and tests as errmap's own maps.

    Parameters
    ----------
    name : str
        Its name in the tables.
    regressor : estimator
        With ``fit`` and ``predict``, such as a pipeline.

    Returns
    -------
    Foreign
        For the list ``models`` of :func:`compare`.
    """
    if not name:
        raise ValueError("foreign: a regressor needs a name")
    for method in ("fit", "predict"):
        if not hasattr(regressor, method):
            raise ValueError(
                f"foreign: {name} must be a regressor with fit and predict, "
                f"found {type(regressor).__name__}")
    return Foreign(name, regressor)


class _Progress:
    """A progress bar, if tqdm is installed."""

    def __init__(self, wanted: bool) -> None:
        self._bar: Any = None
        self._wanted = wanted

    def __call__(self, done: int, all: int, best: str) -> None:
        if not self._wanted or all == 0:
            return
        if self._bar is None:
            try:
                from tqdm.auto import tqdm
            except ImportError:
                self._wanted = False
                return
            self._bar = tqdm(total=all, unit="fit", leave=False)
        self._bar.set_postfix_str(f"best {best}" if best else "", refresh=False)
        self._bar.update(done - self._bar.n)

    def close(self) -> None:
        if self._bar is not None:
            self._bar.close()


class Study:
    """Result of :func:`compare`."""

    def __init__(self, found: _core.Study) -> None:
        self._found = found
        self._results = json.loads(found.json())

    def to_json(self) -> str:
        """The text of ``results.json``, as ``--format json`` prints it."""
        return self._found.json()

    @property
    def results(self) -> dict[str, Any]:
        """The document of :meth:`to_json`."""
        return self._results

    @property
    def components(self) -> list[str]:
        """Names of the components; one, unless a study file has more."""
        return [part["name"] for part in self._results["components"]]

    def _component(self, name: str | None) -> dict[str, Any]:
        parts = self._results["components"]
        if name is None:
            return parts[0]
        for part in parts:
            if part["name"] == name:
                return part
        raise KeyError(name)

    @property
    def interrupted(self) -> bool:
        """Whether Ctrl-C ended it, so that results are incomplete."""
        return self._found.interrupted

    @property
    def remarks(self) -> list[str]:
        """Remarks on the data, one line each."""
        return self._found.messages

    @property
    def recommendation(self) -> dict[str, Any] | None:
        """The map to use: ``"model"``, ``"rmse"`` on unseen rows,
        ``"ci95"``, ``"reasons"``, ``"caveats"``, ``"sentence"`` and more, in the
        target's unit; None if there is none."""
        return self._component(None)["recommendation"]

    @property
    def table(self) -> Any:
        """A row per component, model and hold-out (target's unit).

        The columns are ``component``, ``model``, ``kind``, ``holdout``,
        ``rmse``, ``mean``, ``sd``, ``mae``, ``max`` and ``train_rmse``.
        """
        rows = []
        for part in self._results["components"]:
            for model in part["models"]:
                for holdout, result in model["results"].items():
                    test = result.get("test") or {}
                    train = result.get("train") or {}
                    rows.append({
                        "component": part["name"],
                        "model": model["name"],
                        "kind": model["kind"],
                        "holdout": holdout,
                        **{key: test.get(key)
                           for key in ("rmse", "mean", "sd", "mae", "max")},
                        "train_rmse": train.get("rmse"),
                    })
        names = rows[0] if rows else {}
        return frame_of({name: [row[name] for row in rows] for name in names})

    @property
    def predictions(self) -> Any:
        """Every model's predictions of the held-out rows.

        A row per held-out row: ``holdout``, ``fold``, ``row``, the group, the
        target, ``inside``, and a column per model (target's unit).
        """
        return frame_of(self._predictions(None))

    @property
    def residuals(self) -> Any:
        """The same table with target - predicted instead of predictions."""
        return frame_of(self._residuals(None))

    def _predictions(self, component: str | None) -> dict[str, Any]:
        name = self._component(component)["name"]
        return self._found.predictions(name).columns()

    def _residuals(self, component: str | None) -> dict[str, Any]:
        part = self._component(component)
        columns = self._predictions(component)
        target = columns[part["data"]["target"]]
        for model in part["models"]:
            name = model["name"]
            if name in columns:
                columns[name] = _core.difference(target, columns[name])
        return columns

    def map(self, model: str | None = None,
            component: str | None = None) -> MapFile:
        """The map of a model, fitted to all rows.

        Parameters
        ----------
        model : str, optional
            Its name in the table; the recommended one, if left out.
        component : str, optional
            Needed if the study has several.

        Returns
        -------
        MapFile
        """
        part = self._component(component)
        if model is None:
            if part["recommendation"] is None:
                raise ValueError("no map is recommended; name one")
            model = part["recommendation"]["model"]
        return MapFile(self._found.map(part["name"], model))

    def report(self, folder: str | os.PathLike[str], *,
               force: bool = False) -> None:
        """Write what ``errmap compare --out`` writes: the page, results.json,
        residuals and maps."""
        self._found.write(os.fspath(folder), force)

    def to_html(self) -> str:
        """The report as one HTML page that needs no network."""
        return self._found.html()

    def __str__(self) -> str:
        return self._found.screen()

    def __repr__(self) -> str:
        best = self.recommendation
        return f"<errmap.Study: {best['sentence'] if best else 'no map'}>"

    def _repr_html_(self) -> str:
        return (f"<pre>{escape(self._found.screen())}</pre>"
                f"{self._found.figure()}")


def compare(frame: Measurements = None, *,
            target: str | None = None,
            inputs: Sequence[str] | None = None,
            exclude: Sequence[str] | None = None,
            groups: str | None = None,
            session: str | None = None,
            time: str | None = None,
            models: Sequence[Union[str, Foreign, Any]] | None = None,
            holdouts: Sequence[str] | None = None,
            goal: Union[float, str, None] = None,
            seed: int = 1,
            jobs: int | None = None,
            units: Mapping[str, str] | None = None,
            progress: bool = True,
            **options: Any) -> Study:
    """Fit several maps to the same rows and judge them on others.

    Parameters
    ----------
    frame : measurements
        One row per reading; leave it out if ``config`` names a study file.
    target : str, optional
        Column of the error (default: the only one named ``error*``).
    inputs, exclude : sequence of str, optional
        Input columns (default: all other numeric ones), and columns to leave
        out.
    groups, session, time : str, optional
        Columns of warm-up cycles, of sessions (days) and of times. If left
        out, their names decide.
    models : sequence, optional
        Models such as ``"poly:eq8"`` and :func:`foreign` regressors; all
        suitable maps, if left out. ``...`` stands for all suitable maps.
    holdouts : sequence of str, optional
        Such as ``"sessions:5"``.
    goal : float or str, optional
        Wanted RMSE, in the target's unit, or with its own: ``"2um"``.
    seed : int
        Seed of all random choices; the same seed gives the same bits.
    jobs : int, optional
        Simultaneous fits (default: one per core); does not change the result.
    units : mapping, optional
        Units of columns whose names have none: ``{"error": "um"}``.
    progress : bool
        Whether to draw a progress bar, if tqdm is installed.
    **options
        Other options of ``errmap compare``: ``rezero``, ``choose``,
        ``prefer``, ``align``, ``weight``, ``missing``, ``faults``,
        ``keep_dead``, ``no_cache``, ...

    Returns
    -------
    Study

    Raises
    ------
    ValueError
        If data or options cannot be used, with errmap's message.

    Notes
    -----
    Python's lock is released while maps are fitted. Ctrl-C ends the study
    early; finished results are returned with a warning.

    Examples
    --------
    >>> import errmap
    >>> rows = {"x": [0, 1, 2, 3, 4, 5], "error": [0, 1, 4, 8, 17, 25]}
    >>> study = errmap.compare(rows, models=["mean", "poly:full:degree=2"],
    ...                        holdouts=["blocks:3"], units={"error": "um"})
    >>> study.components
    ['frame']
    """
    files = Files()
    words: list[str] = []
    if frame is not None:
        words.append(files.data(frame, units))
    words += words_of({"target": target, "inputs": inputs, "exclude": exclude,
                       "group": groups, "session": session, "time": time,
                       "goal": goal, "seed": seed, "jobs": jobs, **options},
                      units)
    words += [f"--holdout={holdout}" for holdout in holdouts or ()]
    others: list[tuple[str, Any]] = []
    beside_defaults = False
    if isinstance(models, str):
        raise ValueError("models: a list is expected; write models=['"
                         f"{models}']")
    for model in models or ():
        if model is ...:
            beside_defaults = True
        elif isinstance(model, Foreign):
            others.append((model.name, model._fit))
        else:
            words.append(f"--model={model}")
    names = [name for name, _ in others] + [m for m in models or ()
                                            if isinstance(m, str)]
    for name in names:
        if names.count(name) > 1:
            raise ValueError(f"two models are named {name}")
    bar = _Progress(progress)
    try:
        found = _core.compare(words, files.tables, files.texts, others,
                              beside_defaults, bar if progress else None)
    finally:
        bar.close()
    if found.interrupted:
        warn(["warning: interrupted; finished results are shown"])
    return Study(found)
