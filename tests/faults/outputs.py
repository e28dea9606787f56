"""What a run of errmap left in a folder, and whether it is whole."""

import contextlib
import gzip
import json
import sqlite3
import sys

LEFT_BEHIND = "left behind"
failures = []


def fail(what, message):
    failures.append(f"{what}: {message}")
    print("FAILED:", what, message, file=sys.stderr)


def without_times(node):
    if isinstance(node, dict):
        return {
            key: without_times(value)
            for key, value in node.items()
            if "seconds" not in key and not key.endswith("_ns")
        }
    return [without_times(item) for item in node] if isinstance(node, list) else node


def rows_of(path):
    """Of a store every table, less what says when something was done."""
    when = ("at", "since", "until")
    found = {}
    try:
        with contextlib.closing(sqlite3.connect(f"file:{path}?mode=ro", uri=True)) as store:
            tables = "SELECT name FROM sqlite_master WHERE type = 'table' ORDER BY name"
            for (table,) in store.execute(tables).fetchall():
                cursor = store.execute(f"SELECT * FROM {table}")
                kept = [
                    i
                    for i, (column, *_) in enumerate(cursor.description)
                    if column not in when and "seconds" not in column
                ]
                found[table] = [[row[i] for i in kept] for row in cursor]
    except sqlite3.DatabaseError as error:
        raise ValueError(f"{path.name}: {error}") from error
    return found


def contents(folder):
    """Outputs by name, times apart, the journal left out; what was in the making
    is LEFT_BEHIND. Raises ValueError where a file is not whole."""
    found = {}
    for path in sorted(folder.rglob("*")):
        name = str(path.relative_to(folder))
        if path.is_dir() or path.name.startswith("fits.sqlite"):
            continue
        kinds = (".json", ".html", ".csv", ".md", ".gz", ".sqlite")
        if ".tmp" in name or path.suffix not in kinds:
            found[name] = LEFT_BEHIND
            continue
        if path.suffix == ".sqlite":
            found[name] = rows_of(path)
            continue
        if path.suffix == ".gz":
            try:
                found[name] = without_times(json.loads(gzip.decompress(path.read_bytes())))
            except (EOFError, OSError) as error:
                raise ValueError(f"{name}: {error}") from error
            continue
        text = path.read_text(encoding="utf-8")
        if path.name == "errmap-files.json":
            found[name] = sorted(file["name"] for file in json.loads(text)["files"])
        elif path.suffix == ".json":
            found[name] = without_times(json.loads(text))
        elif path.stem in ("report", "watch"):  # holds times
            is_page = path.suffix == ".html"
            if not text.rstrip(" \n" if is_page else " ").endswith(
                "</html>" if is_page else "\n"
            ):
                raise ValueError(f"{name} has no end")
            found[name] = "whole"
        else:
            found[name] = text
    return found
