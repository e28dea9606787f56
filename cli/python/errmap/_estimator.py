"""Maps as scikit-learn estimators, and hold-outs as its splitters."""

from __future__ import annotations

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
from errmap._frames import FRAME, table_of
from errmap._maps import MapFile


class Map(RegressorMixin, BaseEstimator):
    """A map as a scikit-learn regressor.

    Parameters
    ----------
    spec : str
        The model, such as ``"poly:ridge:view=auto"``.
    session, time : str, optional
        Columns of ``X`` with sessions and times, for maps with a memory; they
        are no inputs. Without ``session`` the sessions are ``groups``.
    seed : int
        Of all random choices.
    interval : bool
        Whether the map is fitted again with sessions held out, to find what it
        may promise (:meth:`predict_interval`).
    jobs : int
        Threads of a fit; they change no figure.

    Attributes
    ----------
    map_ : MapFile
        The fitted map, with all that it can do.
    n_features_in_ : int
    feature_names_in_ : ndarray of str
        Where ``X`` has names.

    Examples
    --------
    >>> import numpy, errmap
    >>> x = numpy.linspace(0, 1, 20).reshape(-1, 1)
    >>> map = errmap.Map("poly:full:degree=2").fit(x, x[:, 0] ** 2)
    >>> float(numpy.round(map.predict([[0.5]])[0], 9))
    0.25
    """

    def __init__(self, spec: str = "poly:ridge", *, session: str | None = None,
                 time: str | None = None, seed: int = 1, interval: bool = False,
                 jobs: int = 1) -> None:
        self.spec = spec
        self.session = session
        self.time = time
        self.seed = seed
        self.interval = interval
        self.jobs = jobs

    def _columns(self, X: Any, *, reset: bool) -> dict[str, Any]:
        """The columns of X by name, those of numbers checked."""
        _note_names(self, X, reset)
        names = getattr(self, "feature_names_in_", None)
        if names is None:
            values = check_array(X, dtype="float64")
            self._check_width(values.shape[1], reset)
            return {f"x{i}": values[:, i] for i in range(values.shape[1])}
        self._check_width(len(names), reset)
        if not hasattr(X, "columns"):  # a frame was fitted, rows are predicted
            X = dict(zip(names, check_array(X, dtype=None).T))
            others = []
        else:
            others = [self.session, self.time]
        inputs = [name for name in names if name not in others]
        frame = X[inputs] if others else numpy.column_stack(
            [X[name] for name in inputs])
        values = check_array(frame, dtype="float64")
        columns = {name: values[:, i] for i, name in enumerate(inputs)}
        columns.update((name, X[name]) for name in others if name is not None)
        return columns

    def _check_width(self, width: int, reset: bool) -> None:
        if reset:
            self.n_features_in_ = width
        elif width != self.n_features_in_:
            raise ValueError(
                f"X has {width} features, but {type(self).__name__} is "
                f"expecting {self.n_features_in_} features as input")

    def fit(self, X: Any, y: Any, groups: Any = None) -> Map:
        """Fit the map to all rows.

        Parameters
        ----------
        X : array or frame (rows x inputs)
            Units are read from the names of a frame's columns.
        y : array (rows)
            The error; its unit is read from the name of a Series.
        groups : array (rows), optional
            The session of each row.

        Returns
        -------
        self
        """
        columns = self._columns(X, reset=True)
        if y is None:
            raise ValueError("requires y to be passed, but the target y is None")
        target = _unused(getattr(y, "name", None) or "target", columns)
        errors = column_or_1d(y, warn=True)
        errors = check_array(errors, dtype="float64", ensure_2d=False)
        check_consistent_length(errors, next(iter(columns.values())))
        if len(errors) < 2:
            raise ValueError("a map needs two rows at least, found 1 sample")
        inputs = [name for name in columns
                  if name not in (self.session, self.time)]
        columns[target] = errors
        session = self.session or "none"
        if groups is not None:
            check_consistent_length(errors, groups)
            session = _unused("session", columns)
            columns[session] = numpy.asarray(groups)
        text = _core.fit(table_of(columns), target, inputs, session,
                         self.time or "none", self.spec, self.seed,
                         self.interval, self.jobs)
        self.map_ = MapFile(text)
        return self

    def predict(self, X: Any) -> Any:
        """Predicted error of every row, in the unit of ``y``."""
        check_is_fitted(self)
        return self.map_.predict(self._columns(X, reset=False), **self._where())

    def predict_interval(self, X: Any, coverage: int = 90) -> Any:
        """Where the error lies with a probability (rows x 2)."""
        check_is_fitted(self)
        return self.map_.interval(self._columns(X, reset=False), coverage,
                                  **self._where())

    def _where(self) -> dict[str, Any]:
        return {name: value for name, value in
                (("session", self.session), ("time", self.time))
                if value is not None}

    def _more_tags(self) -> dict[str, Any]:
        return {"_xfail_checks": {}}

    def __sklearn_tags__(self) -> Any:
        return super().__sklearn_tags__()


def _note_names(estimator: Any, X: Any, reset: bool) -> None:
    """Sets or compares feature_names_in_, as every release has it."""
    check = getattr(estimator, "_check_feature_names", None)
    if check is not None:  # before 1.6
        check(X, reset=reset)
    else:
        from sklearn.utils import validation

        validation._check_feature_names(estimator, X, reset=reset)


def _unused(name: Any, columns: dict[str, Any]) -> str:
    name = str(name)
    while name in columns:
        name += "_"
    return name


class SessionSplit:
    """A splitter that holds whole sessions out, as errmap does.

    Parameters
    ----------
    n_splits : int
        Folds.
    forward : bool
        Whether only earlier sessions are learnt from, as in ``forward:K``.
    gap : int
        With ``forward``: sessions left out before those that judge.

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
        """Indices of the rows learnt from and of those that judge.

        Parameters
        ----------
        X : rows
        y : ignored
        groups : array (rows)
            The session of each row, in the order in which they were measured.
        """
        if groups is None:
            raise ValueError("SessionSplit: say by groups= which session each "
                             "row is of")
        if self.gap and not self.forward:
            raise ValueError("SessionSplit: gap goes with forward=True")
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
