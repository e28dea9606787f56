"""Maps as scikit-learn estimators, and hold-outs as its splitters."""

from __future__ import annotations

import inspect
import numbers
import os
import sys
from typing import Any, Iterator

import numpy
from sklearn.base import BaseEstimator, RegressorMixin
from sklearn.utils.validation import (
    check_array,
    check_consistent_length,
    check_is_fitted,
    column_or_1d,
)

from errmap import _core
from errmap._frames import FRAME, columns_of, table_of, warn, words_of
from errmap._maps import MapFile, fitted
from errmap._study import compare


#: Options of models; a test holds them to ``errmap models MODEL``.
_OPTIONS = (
    "angles", "between", "bootstrap", "box", "centred", "choose", "clip",
    "criterion", "decay", "degree", "direction", "discrepancy", "egoal",
    "enter", "errdel", "evaluations", "exclude", "gwgoal", "heredity",
    "hidden", "history", "include", "intercept", "iterations",
    "learning_rate", "max_terms", "members", "memory", "method", "momentum",
    "net", "nfreq", "output", "path", "penalty", "position", "precision",
    "remove", "rows", "rule", "scale", "seconds", "select", "sigma2",
    "slope", "starts", "stop", "terms", "variant", "view", "wfactor", "zero")


class Map(RegressorMixin, BaseEstimator):
    """A map as a scikit-learn regressor.

    Parameters
    ----------
    model : str
        ``"auto"``: the map that :func:`errmap.compare` recommends for these
        rows. Inside ``GridSearchCV``, ``cross_val_score`` and the like it is
        the blend, without a comparison in each fold. Otherwise a model such as
        ``"poly:ridge"``, with options after colons.
    session, time : str, optional
        Columns of ``X`` with sessions (days) and times, for maps with a
        memory. If left out, names and values decide, as on the command line.
    seed : int
        Seed of all random choices.
    interval : bool, optional
        Whether to fit again with sessions held out, for
        :meth:`predict_interval`. If left out: yes, but not inside a search.
    jobs : int, optional
        Threads of a fit; they do not change the result. If left out, one per
        core, but only one inside a search.
    budget : float, optional
        Seconds for the comparison of ``"auto"``. The slowest models are left
        out until the rest is expected to take no longer.
    **options
        Options of the model, as ``errmap models MODEL`` lists them:
        ``degree=2``, ``view="auto"``, ``include=["position_mm", "t1_degC"]``.
        ``GridSearchCV`` can vary each of them.

    Attributes
    ----------
    map_ : MapFile
        The fitted map.
    n_features_in_ : int
    feature_names_in_ : ndarray of str
        The names, if ``X`` has them.

    Examples
    --------
    >>> import numpy, errmap
    >>> x = numpy.linspace(0, 1, 20).reshape(-1, 1)
    >>> map = errmap.Map(model="poly:full", degree=2).fit(x, x[:, 0] ** 2)
    >>> float(numpy.round(map.predict([[0.5]])[0], 9))
    0.25
    """

    def __init__(self, model: str = "auto", *, session: str | None = None,
                 time: str | None = None, seed: int = 1,
                 interval: bool | None = None, jobs: int | None = None,
                 budget: float | None = None, **options: Any) -> None:
        self.model = model
        self.session = session
        self.time = time
        self.seed = seed
        self.interval = interval
        self.jobs = jobs
        self.budget = budget
        for name in options:
            if name not in _OPTIONS:
                raise TypeError(f"no model has an option {name!r}")
        for name in _OPTIONS:
            setattr(self, name, options.get(name))

    def _spec(self) -> str:
        options = [name for name in _OPTIONS if getattr(self, name) is not None]
        if self.model == "auto" and options:
            raise ValueError(f"{options[0]} is an option of one model: name it, "
                             "as in errmap.Map(model='poly:ridge')")
        return self.model + "".join(
            f":{name}={_option_text(getattr(self, name))}" for name in options)

    def _columns(self, X: Any, *, reset: bool) -> dict[str, Any]:
        """The columns of X by name; those of an array are checked."""
        _note_names(self, X, reset)
        names = getattr(self, "feature_names_in_", None)
        if names is not None and hasattr(X, "columns"):
            self._check_width(len(X.columns), reset)
            return dict(columns_of(X))
        values = check_array(X, dtype="float64")
        self._check_width(values.shape[1], reset)
        if names is None:
            names = [f"x{i}" for i in range(values.shape[1])]
        return dict(zip(names, values.T))

    def _check_width(self, width: int, reset: bool) -> None:
        if reset:
            self.n_features_in_ = width
        elif width != self.n_features_in_:
            raise ValueError(
                f"X has {width} features, but {type(self).__name__} is "
                f"expecting {self.n_features_in_} features as input")

    def fit(self, X: Any, y: Any, groups: Any = None,
            sample_weight: Any = None) -> Map:
        """Fit the map to all rows.

        With ``model="auto"`` it first prints on stderr how long the comparison
        takes, unless it is short.

        Parameters
        ----------
        X : array or frame (rows x inputs)
            A frame is read like a file on the command line: units, position,
            sessions, times and inputs. All columns of an array are inputs.
        y : array (rows)
            The error; the name of a Series states its unit.
        groups : array (rows), optional
            The session of each row.
        sample_weight : array (rows), optional
            Weights; rows of weight 0 are left out.

        Returns
        -------
        self
        """
        columns = self._columns(X, reset=True)
        if y is None:
            raise ValueError("requires y to be passed, but the target y is None")
        errors = column_or_1d(y, warn=True)
        errors = check_array(errors, dtype="float64", ensure_2d=False)
        check_consistent_length(errors, next(iter(columns.values())))
        if len(errors) < 2:
            raise ValueError("a map needs at least two rows, found 1 sample")
        read = {"session": self.session, "time": self.time, "seed": self.seed}
        if not hasattr(self, "feature_names_in_"):
            read.update(inputs=list(columns), keep_dead=True, session="none",
                        time="none")

        def add(name: str, values: Any) -> str:
            check_consistent_length(errors, values)
            while name in columns:
                name += "_"
            columns[name] = values
            return name

        read["target"] = add(str(getattr(y, "name", None) or "target"), errors)
        if groups is not None:
            read["session"] = add("session", numpy.asarray(groups))
        if sample_weight is not None:
            weights = check_array(sample_weight, dtype="float64",
                                  ensure_2d=False)
            if weights.ndim != 1:
                raise ValueError("Sample weights must be 1D array or scalar")
            read["weight"] = add("weight", weights)
            columns = {name: numpy.asarray(column)[weights != 0]
                       for name, column in columns.items()}
        searched = _is_searched()
        read["jobs"] = self.jobs or (1 if searched else None)
        spec = self._spec()
        if spec == "auto" and not searched:
            self.map_ = self._recommended(columns, read)
        else:
            wanted = not searched if self.interval is None else self.interval
            self.map_ = fitted(columns, "blend" if spec == "auto" else spec,
                               {**read, "no_interval": not wanted})
        return self

    def _recommended(self, columns: dict[str, Any],
                     read: dict[str, Any]) -> MapFile:
        costs = _core.forecast([FRAME, *words_of(read)],
                               {FRAME: table_of(columns)})
        jobs = self.jobs or os.cpu_count() or 1
        kept: list[str] = []
        seconds = 0.0
        for model, cost in sorted(costs, key=lambda pair: pair[1]):
            if self.budget and kept and seconds + cost / jobs > self.budget:
                break
            seconds += cost / jobs
            kept.append(model)
        slow = seconds >= 1
        if slow:
            print(f"errmap: compares {len(kept)} models, about {seconds:.0f} s; "
                  f"budget=SECONDS leaves out the slowest", file=sys.stderr)
        study = compare(columns, models=[m for m, _ in costs if m in kept],
                        progress=slow, **read)
        if len(study.components) > 1:
            raise ValueError("rows go both ways along the axis, and the error "
                             "depends on the direction; fit a map to each")
        if study.recommendation is None:
            warn(["warning: too few rows to recommend a map: this is the blend, "
                  "and its error is not known"])
            return fitted(columns, "blend", {**read, "no_interval": True})
        return study.map()

    @property
    def equation_(self) -> str | None:
        """The map as a formula; None for a net or a blend."""
        check_is_fitted(self)
        return self.map_.equation

    def predict(self, X: Any) -> Any:
        """Predicted error of every row, in the unit of ``y``."""
        check_is_fitted(self)
        return self.map_.predict(self._columns(X, reset=False), **self._where())

    def predict_interval(self, X: Any, coverage: int = 90) -> Any:
        """Interval that contains the error with this probability (rows x 2).

        Warns
        -----
        ErrmapWarning
            Once, if the interval is NaN because the map states none.
        """
        check_is_fitted(self)
        return self.map_.interval(self._columns(X, reset=False), coverage,
                                  **self._where())

    def plot(self, X: Any, y: Any, ax: Any = None) -> Any:
        """Draw the error over the position, before and after compensation.

        See :meth:`MapFile.plot`.
        """
        check_is_fitted(self)
        columns = {**self._columns(X, reset=False),
                   self.map_.target: numpy.asarray(y)}
        return self.map_.plot(columns, ax, **self._where())

    def _where(self) -> dict[str, Any]:
        return {name: value for name, value in
                (("session", self.session), ("time", self.time))
                if value is not None}


# Each option is a parameter, as scikit-learn wants to see it.
_signature = inspect.signature(Map.__init__)
Map.__init__.__signature__ = _signature.replace(parameters=[  # type: ignore
    *list(_signature.parameters.values())[:-1],
    *(inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None)
      for name in _OPTIONS)])


def _option_text(value: Any) -> str:
    if isinstance(value, (bool, numpy.bool_)):
        return "yes" if value else "no"
    if isinstance(value, (list, tuple)):
        return "+".join(map(_option_text, value))
    if isinstance(value, numbers.Real):
        return repr(int(value) if isinstance(value, numbers.Integral)
                    else float(value))
    return str(value)


def _is_searched() -> bool:
    """Whether the caller is a search or cross-validation of scikit-learn."""
    frame = sys._getframe(1)
    while frame is not None:
        if frame.f_globals.get("__name__", "").startswith(
                "sklearn.model_selection."):
            return True
        frame = frame.f_back
    return False


def _note_names(estimator: Any, X: Any, reset: bool) -> None:
    """Set or compare feature_names_in_ in a way that all releases have."""
    check = getattr(estimator, "_check_feature_names", None)
    if check is not None:  # before 1.6
        check(X, reset=reset)
    else:
        from sklearn.utils import validation

        validation._check_feature_names(estimator, X, reset=reset)


class SessionSplit:
    """A splitter that holds out whole sessions, like errmap.

    Parameters
    ----------
    n_splits : int
        Folds.
    forward : bool
        Whether to train only on earlier sessions, as in ``forward:K``.
    gap : int
        With ``forward``: sessions left out just before the test sessions.

    Examples
    --------
    >>> import errmap
    >>> days = ["mon", "mon", "tue", "tue", "wed", "wed"]
    >>> [(train.tolist(), test.tolist()) for train, test in
    ...  errmap.SessionSplit(2, forward=True).split(days, groups=days)]
    [([0, 1], [2, 3]), ([0, 1, 2, 3], [4, 5])]
    """

    def __init__(self, n_splits: int = 5, *, forward: bool = False,
                 gap: int = 0) -> None:
        self.n_splits = n_splits
        self.forward = forward
        self.gap = gap

    def get_n_splits(self, X: Any = None, y: Any = None,
                     groups: Any = None) -> int:
        """The number of folds."""
        return self.n_splits

    def split(self, X: Any, y: Any = None,
              groups: Any = None) -> Iterator[tuple[Any, Any]]:
        """Indices of training and test rows.

        Parameters
        ----------
        X : rows
        y : ignored
        groups : array (rows)
            The session of each row, in the order of measurement.
        """
        if groups is None:
            raise ValueError("SessionSplit: give the session of each row as "
                             "groups=")
        if self.gap and not self.forward:
            raise ValueError("SessionSplit: gap needs forward=True")
        codes: dict[Any, int] = {}
        labels = numpy.asarray(groups)
        try:
            order = sorted(set(labels.tolist())) \
                if labels.dtype.kind in "fiu" else labels.tolist()
        except TypeError:
            order = labels.tolist()
        for label in order:
            codes.setdefault(label, len(codes))
        rows = [codes[label] for label in labels.tolist()]
        spec = f"forward:{self.n_splits}" + (f":gap={self.gap}" if self.gap else "") \
            if self.forward else f"groups:{self.n_splits}"
        for train, test in _core.folds(spec, len(rows), rows, 1):
            yield numpy.array(train), numpy.array(test)

    def __repr__(self) -> str:
        return (f"SessionSplit({self.n_splits}, forward={self.forward}, "
                f"gap={self.gap})")
