"""What the tests of the Python package share: where things are."""

import json
import os
import subprocess
import tempfile

ROOT = os.environ["ERRMAP_ROOT"]
PROGRAM = os.environ["ERRMAP_PROGRAM"]
XDOWN = os.path.join(ROOT, "data/sets/nistir5367_xdisp_down.csv")


def run(*words):
    """What the command line prints; its messages where it fails."""
    done = subprocess.run([PROGRAM, *words], capture_output=True, text=True)
    return done.returncode, done.stdout, done.stderr


def error_line(*words):
    """The line by which the command line refuses, less its own name."""
    _, _, messages = run(*words)
    return messages.strip().splitlines()[-1].removeprefix("errmap: ")


def without_times(value):
    """A document less measured times and what tells where it was made."""
    if isinstance(value, list):
        return [without_times(item) for item in value]
    if not isinstance(value, dict):
        return value
    return {
        key: without_times(item)
        for key, item in value.items()
        if "seconds" not in key and not key.endswith("_ns")
        and key not in ("provenance", "file", "files", "sha256", "name")
    }


def scratch():
    return tempfile.TemporaryDirectory(prefix="errmap-python-")


def loads(text):
    return json.loads(text)
