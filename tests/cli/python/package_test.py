"""The package as such: its stubs, examples, start, notebook and manual."""

import doctest
import importlib
import importlib.util
import json
import os
import re
import shutil
import subprocess
import sys
import unittest

import common
import errmap

MODULES = ["errmap", "errmap._commands", "errmap._maps", "errmap._study",
           "errmap._estimator"]


def installed(module):
    return importlib.util.find_spec(module) is not None


class Package(unittest.TestCase):
    def test_examples_of_the_docstrings_run(self):
        for name in MODULES:
            failed, tried = doctest.testmod(importlib.import_module(name))
            self.assertEqual(failed, 0, name)
        self.assertGreater(tried, 0)

    def test_everything_public_says_what_it_is(self):
        for name in errmap.__all__:
            thing = getattr(errmap, name)
            self.assertGreater(len(thing.__doc__ or ""), 20, name)
            if not isinstance(thing, type):
                continue
            for member, value in vars(thing).items():
                if not member.startswith("_") and callable(value):
                    self.assertTrue(value.__doc__, f"{name}.{member}")

    def test_starts_in_less_than_0_3_s(self):
        code = ("import sys, time; start = time.perf_counter(); import errmap; "
                "assert 'pandas' not in sys.modules; "
                "print(time.perf_counter() - start)")
        times = [float(subprocess.check_output([sys.executable, "-c", code]))
                 for _ in range(5)]
        self.assertLess(min(times), 0.3)

    @unittest.skipUnless(installed("mypy"), "mypy is not installed")
    def test_stubs_are_those_of_the_module(self):
        with common.scratch() as folder:
            # pybind11's classes have a metaclass of its own.
            allowed = os.path.join(folder, "allowed")
            with open(allowed, "w") as file:
                file.writelines(f"errmap._core.{name}\n"
                                for name in ("Numbers", "Study", "Table"))
            done = subprocess.run(
                [sys.executable, "-m", "mypy.stubtest", "errmap._core",
                 "--ignore-positional-only", "--allowlist", allowed],
                capture_output=True, text=True, cwd=folder,
                env={**os.environ,
                     "MYPYPATH": os.environ["PYTHONPATH"]})
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


class ShippedDays(unittest.TestCase):
    @unittest.skipUnless(installed("pandas"), "pandas is not installed")
    def test_are_those_of_the_simulated_machine(self):
        made = errmap.simulate(days=8, cycles=10, seed=5, components=[
            "x_displacement_up"])["x_displacement_up"]
        folder = os.path.join(common.ROOT, "data/sets/turning_centre")
        six = errmap.read_csv(os.path.join(folder, "six_days.csv"))
        later = errmap.read_csv(os.path.join(folder, "later_days.csv"))
        for days, of in ((six, made["day"] <= 6), (later, made["day"] > 6)):
            self.assertEqual(days.values.tolist(),
                             made.loc[of, list(days)].values.tolist())


class Notebook(unittest.TestCase):
    @unittest.skipUnless(installed("nbclient") and installed("ipykernel")
                         and installed("pandas"), "nbclient is not installed")
    def test_runs(self):
        import nbclient
        import nbformat

        path = os.path.join(common.ROOT, "cli/python/errmap_tour.ipynb")
        notebook = nbformat.read(path, as_version=4)
        code = [cell for cell in notebook.cells if cell.cell_type == "code"]
        self.assertEqual(len(code), 10)
        with common.scratch() as folder:
            nbclient.NotebookClient(
                notebook, timeout=120, kernel_name="python3",
                resources={"metadata": {"path": folder}}).execute()
            self.assertIn("page", os.listdir(folder))
        shown = json.dumps([cell.get("outputs", []) for cell in code])
        self.assertIn("unseen day", shown)
        self.assertIn("<svg", shown)


class Manual(unittest.TestCase):
    @unittest.skipUnless(installed("sklearn") and installed("pandas")
                         and installed("matplotlib"),
                         "scikit-learn or matplotlib is not installed")
    def test_its_python_runs(self):
        with open(os.path.join(common.ROOT, "cli/manual/python.md")) as file:
            blocks = re.findall(r"```python\n(.*?)```", file.read(), re.S)
        self.assertGreater(len(blocks), 3)
        days = os.path.join(common.ROOT, "data/sets/turning_centre")
        with common.scratch() as folder:
            for here, there in (("six", "six_days"), ("later", "later_days")):
                shutil.copy(f"{days}/{there}.csv", f"{folder}/{here}.csv")
            done = subprocess.run(
                [sys.executable, "-W", "ignore", "-c", "\n".join(blocks)],
                cwd=folder, capture_output=True, text=True,
                env={**os.environ, "MPLBACKEND": "Agg"})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stderr, r"compares \d+ models, about \d+ s")


class Vignette(unittest.TestCase):
    @unittest.skipUnless(shutil.which("Rscript"), "R is not installed")
    def test_of_r_runs(self):
        with open(os.path.join(common.ROOT, "cli/manual/r.md")) as file:
            blocks = re.findall(r"```r\n(.*?)```", file.read(), re.S)
        with common.scratch() as folder:
            common.run("simulate", "turning-centre", "-o", folder, "--days",
                       "2", "--cycles", "6", "--quiet")
            data = os.path.join(folder, "two.csv")
            os.rename(os.path.join(folder, "x_displacement_up.csv"), data)
            common.run("fit", data, "--model", "poly:eq8", "-o",
                       os.path.join(folder, "eq8.json"))
            done = subprocess.run(
                ["Rscript", "-e", "\n".join(blocks)], cwd=folder,
                capture_output=True, text=True,
                env={**os.environ, "PATH": os.path.dirname(common.PROGRAM)
                     + os.pathsep + os.environ["PATH"]})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"mine 0\.0\d+")


if __name__ == "__main__":
    unittest.main()
