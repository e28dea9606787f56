#!/usr/bin/env python3
"""Fuzzes the readers from their kept corpus.

    fuzz.py PROGRAM [--seconds N] [--jobs N] [--into FOLDER] [--coverage]
            [READER...]

PROGRAM: fuzz_readers of the preset `fuzz`. Each reader (default: all) is run
for --seconds (20) with its dictionary; prints executions, seconds and edges
reached. --into keeps what is new in FOLDER/READER, crashes in FOLDER/crashes;
without it both are in a temporary folder, and a crash is printed as base64.
--coverage says what share of the edges of the reader's own sources the corpus
reaches, in place of fuzzing. Exit status 1 where a reader has a finding.

A finding is mended and its input, made small by `-minimize_crash=1`, goes into
corpus/READER, which fuzz_corpus replays in every build. What long runs found
is put into the corpus by `fuzz_readers -merge=1 corpus/READER FOLDER/READER`.
"""

import argparse
import base64
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent

RECORD = "models/study/record/"
PARTS = "data figure judgement machine model probe provenance recommendation regression remark residual study"
RECORDS = " ".join([RECORD + "record", *(f"{RECORD}{part}_record" for part in PARTS.split())])

# Dictionary, longest input in bytes, sources whose edges count.
READERS = {
    "csv": ("csv", 4096, "data/tables/csv data/tables/cells/csv data/measurements/column_ data/measurements/faults/column_ data/measurements/builders/idle_inputs data/measurements/builders/make_dataset data/measurements/session data/tables/text/text data/text"),
    "patterns": ("numbers", 4096, "data/formats/pattern_file data/formats/record_reader data/formats/fortran_format"),
    "holdout": ("spec", 128, "stats/holdout"),
    "spec": ("spec", 512, "models/model_spec models/recipe_catalog models/polynomial/formula"),
    "model": ("json", 8192, "models/file/model_reader models/file/model_form_json models/file/model_json models/blend/form_to_model data/formats/nesting"),
    "results": ("json", 8192, RECORDS),
    "journal": (None, 8192, "models/study/journal/fit_record"),
    "study": ("toml", 4096, "cli/study_setup/toml"),
    "netcg": ("numbers", 4096, "cli/netcg/run_file data/formats/record_reader"),
    "weights": ("numbers", 4096, "cli/netcg/weights_file data/formats/record_reader"),
    "split": ("csv", 4096, "models/study/split_file"),
    "predictions": ("csv", 4096, "models/study/given_predictions"),
    "machine": ("toml", 4096, "cli/machine/machine_file models/kinematics/machine models/kinematics/iso230"),
    "file_list": ("json", 2048, "cli/output/claimed_folder"),
    "header": ("csv", 128, "data/units data/measurements/clock/date_time"),
    "arguments": ("arguments", 512, "cli/commands cli/shell cli/application"),
    "compare": (None, 512, "models/study models/polynomial stats"),
}  # fmt: skip
# Of its own, not of the machine's load.
MOST_SECONDS_PER_INPUT = 20


def words_of(program, reader, folder):
    dictionary, longest, _ = READERS[reader]
    words = [
        program, f"-max_len={longest}", f"-timeout={MOST_SECONDS_PER_INPUT}",
        "-rss_limit_mb=4096", "-print_final_stats=1", "-close_fd_mask=3",
        f"-artifact_prefix={folder}/crashes/{reader}-",
    ]  # fmt: skip
    if dictionary:
        words.append(f"-dict={HERE}/dictionaries/{dictionary}.dict")
    return words


def run(words, reader):
    environment = dict(os.environ, ERRMAP_FUZZ=reader)
    # OpenBLAS' threads would only wait for each other.
    environment.setdefault("OPENBLAS_NUM_THREADS", "1")
    return subprocess.run(
        words, env=environment, capture_output=True, text=True, errors="replace", check=False
    )


def fuzz(program, reader, folder, seconds):
    """(Whether it held, line to print)"""
    (folder / "crashes").mkdir(parents=True, exist_ok=True)
    (folder / reader).mkdir(exist_ok=True)
    words = words_of(program, reader, folder)
    words += [f"-max_total_time={seconds}", str(folder / reader), str(HERE / "corpus" / reader)]
    begin = time.monotonic()
    outcome = run(words, reader)
    took = time.monotonic() - begin
    executions = re.findall(r"stat::number_of_executed_units:\s*(\d+)", outcome.stderr)
    edges = re.findall(r"\bcov: (\d+)", outcome.stderr)
    line = (
        f"{reader}: {executions[-1] if executions else '?'} executions, {took:.0f} s, "
        f"{edges[-1] if edges else '?'} edges"
    )
    if outcome.returncode == 0:
        return True, line
    line += f"\nFINDING, status {outcome.returncode}:\n{outcome.stderr[-6000:]}"
    for crash in sorted((folder / "crashes").glob(f"{reader}-*")):
        line += f"\n{crash.name}: {base64.b64encode(crash.read_bytes()).decode()}"
    return False, line


def coverage(program, reader, folder):
    words = words_of(program, reader, folder)
    words += ["-runs=0", "-print_coverage=1", str(folder / reader), str(HERE / "corpus" / reader)]
    (folder / reader).mkdir(parents=True, exist_ok=True)
    outcome = run(words, reader)
    reached = edges = functions = called = 0
    sources = tuple(READERS[reader][2].split())
    for hit, of, place in re.findall(
        r"COVERED_FUNC: hits: \d+ edges: (\d+)/(\d+) \S.* (\S+):\d+$", outcome.stderr, re.M
    ):
        name = place.split(str(HERE.parent.parent) + "/")[-1]
        if name.startswith(sources):
            reached += int(hit)
            edges += int(of)
            called += 1
    for of, place in re.findall(
        r"UNCOVERED_FUNC: hits: 0 edges: 0/(\d+) \S.* (\S+):\d+$", outcome.stderr, re.M
    ):
        name = place.split(str(HERE.parent.parent) + "/")[-1]
        if name.startswith(sources):
            edges += int(of)
            functions += 1
    share = f"{100 * reached / edges:.0f} %" if edges else "none"
    return outcome.returncode == 0, (
        f"{reader}: {reached} of {edges} edges ({share}) of {READERS[reader][2]}; "
        f"{called} of {called + functions} functions"
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("readers", nargs="*", default=[])
    parser.add_argument("--seconds", type=int, default=20)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--into", type=pathlib.Path)
    parser.add_argument("--coverage", action="store_true")
    arguments = parser.parse_intermixed_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder = (arguments.into or pathlib.Path(scratch)).resolve()
        with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:

            def one(reader):
                if arguments.coverage:
                    held, line = coverage(arguments.program, reader, folder)
                else:
                    held, line = fuzz(arguments.program, reader, folder, arguments.seconds)
                print(line, flush=True)
                return held

            return 0 if all(list(pool.map(one, arguments.readers or READERS))) else 1


if __name__ == "__main__":
    sys.exit(main())
