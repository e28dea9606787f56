"""What a run of errmap left in a folder, and whether it is whole."""

import json
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


def contents(folder):
    """Outputs by name, times apart, the journal left out; what was in the making
    is LEFT_BEHIND. Raises ValueError where a file is not whole."""
    found = {}
    for path in sorted(folder.rglob("*")):
        name = str(path.relative_to(folder))
        if path.is_dir() or path.name.startswith("journal."):
            continue
        if ".tmp" in name or path.suffix not in (".json", ".html", ".csv", ".md"):
            found[name] = LEFT_BEHIND
            continue
        text = path.read_text(encoding="utf-8")
        if path.name == "errmap-files.json":
            found[name] = sorted(file["name"] for file in json.loads(text)["files"])
        elif path.suffix == ".json":
            found[name] = without_times(json.loads(text))
        elif path.stem == "report":  # holds measured times
            is_page = path.suffix == ".html"
            if not text.rstrip(" \n" if is_page else " ").endswith(
                "</html>" if is_page else "\n"
            ):
                raise ValueError(f"{name} has no end")
            found[name] = "whole"
        else:
            found[name] = text
    return found
