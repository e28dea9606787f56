"""Maps of machine-tool errors, and how far they hold on another day.

The functions are the commands of ``errmap``: they take the same options, with
``_`` for ``-``, and give the same numbers to the last bit. Measurements are a
pandas ``DataFrame``, a mapping of names to arrays, a structured NumPy array or
the path of a CSV file.

>>> import errmap
>>> day = {"position_mm": list(range(12)),
...        "error_um": [0, 1, 4, 8, 17, 25, 36, 48, 65, 80, 101, 120]}
>>> study = errmap.compare(day, models=["mean", "poly:position"],
...                        holdouts=["every:3"])
>>> study.recommendation["model"]
'poly:position'
"""

from errmap._commands import (
    certify,
    evaluate,
    learn,
    models,
    read_csv,
    residuals,
    simulate,
)
from errmap._core import version as _version
from errmap._frames import ErrmapWarning
from errmap._maps import MapFile, load, loads
from errmap._study import Foreign, Study, compare, foreign

__version__ = _version()

__all__ = [
    "ErrmapWarning",
    "Foreign",
    "Map",
    "MapFile",
    "SessionSplit",
    "Study",
    "certify",
    "compare",
    "evaluate",
    "foreign",
    "learn",
    "load",
    "loads",
    "models",
    "read_csv",
    "residuals",
    "simulate",
]


def __getattr__(name: str):
    # scikit-learn takes a second to load, and not everybody needs it.
    if name in ("Map", "SessionSplit"):
        from errmap import _estimator

        return getattr(_estimator, name)
    raise AttributeError(f"module 'errmap' has no attribute '{name}'")
