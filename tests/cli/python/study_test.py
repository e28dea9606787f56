"""A study in Python against the same one on the command line."""

import os
import pickle
import signal
import threading
import time
import unittest
import warnings

import common
import errmap
import numpy
import pandas

MODELS = ["mean", "poly:eq8", "poly:ridge:terms=linear", "net:scg:hidden=2:iterations=60"]


def read(path):
    return pandas.read_csv(path, float_precision="round_trip")


class SameBits(unittest.TestCase):
    def data_sets(self, folder):
        common.run("simulate", "turning-centre", "-o", folder, "--days", "2",
                   "--cycles", "3", "--quiet")
        files = sorted(os.path.join(folder, name) for name in os.listdir(folder)
                       if name.startswith(("x_", "z_", "spindle_")))
        return [common.XDOWN] + files[:9]

    def test_ten_data_sets_have_the_command_lines_figures_to_the_bit(self):
        with common.scratch() as folder:
            files = self.data_sets(folder)
            self.assertEqual(len(files), 10)
            for file in files:
                words = [f"--model={model}" for model in MODELS]
                status, printed, _ = common.run(
                    "compare", file, *words, "--format", "json", "--quiet")
                self.assertEqual(status, 0)
                study = errmap.compare(read(file), models=MODELS,
                                       progress=False)
                expected = common.without_times(common.loads(printed))
                found = common.without_times(study.results)
                self.assertEqual(found, expected, file)

    def test_a_table_row_is_the_documents(self):
        study = errmap.compare(read(common.XDOWN), models=MODELS[:2],
                               progress=False)
        table = study.table.set_index(["model", "holdout"])
        for model in study.results["components"][0]["models"]:
            for holdout, result in model["results"].items():
                self.assertEqual(table.loc[(model["name"], holdout), "rmse"],
                                 result["test"]["rmse"])

    def test_jobs_and_seed_change_what_they_change_there(self):
        frame = read(common.XDOWN)
        one, two = (errmap.compare(frame, models=MODELS, jobs=jobs,
                                   progress=False) for jobs in (1, 3))
        self.assertEqual(common.without_times(one.results),
                         common.without_times(two.results))


class Studies(unittest.TestCase):
    def setUp(self):
        self.frame = read(common.XDOWN)
        self.study = errmap.compare(self.frame, models=["mean", "poly:eq8"],
                                    progress=False)

    def test_recommends_with_reasons_and_caveats(self):
        best = self.study.recommendation
        self.assertEqual(best["model"], "poly:position")
        self.assertTrue(best["caveats"])
        # None where neighbouring cycles err too much alike to tell.
        low = best["ci95"][0]
        self.assertTrue(low is None or low < best["rmse"])

    def test_residuals_are_target_minus_predicted(self):
        found = self.study.residuals
        predicted = self.study.predictions
        self.assertGreater(len(found), len(self.frame))
        self.assertEqual(
            predicted["error_mm"].tolist(),
            self.frame["error_mm"][predicted["row"].astype(int)].tolist())
        self.assertEqual(
            found["poly:eq8"].tolist(),
            (predicted["error_mm"] - predicted["poly:eq8"]).tolist())

    def test_writes_the_files_of_compare_out(self):
        with common.scratch() as folder:
            self.study.report(folder)
            names = set(os.listdir(folder))
            self.assertLessEqual({"report.html", "results.json", "models"}, names)
            map = errmap.load(os.path.join(folder, self.map_name(folder)))
            self.assertEqual(map.predict(self.frame).tolist(),
                             self.study.map("poly:eq8").predict(self.frame)
                             .tolist())

    @staticmethod
    def map_name(folder):
        models = common.loads(open(os.path.join(folder, "results.json")).read())
        return next(m["file"] for m in models["components"][0]["models"]
                    if m["name"] == "poly:eq8")

    def test_html_has_verdict_table_and_figure(self):
        html = self.study._repr_html_()
        for part in ("poly:position", "unseen", "<svg"):
            self.assertIn(part, html)
        self.assertIn("<html", self.study.to_html())

    def test_units_by_name_are_those_of_a_header(self):
        plain = self.frame.rename(columns={"error_mm": "error"})
        study = errmap.compare(plain, models=["mean"], units={"error": "mm"},
                               target="error", progress=False)
        self.assertEqual(study.results["components"][0]["data"]["unit"], "mm")

    def test_a_goal_in_its_own_unit(self):
        study = errmap.compare(self.frame, models=["mean"], goal="2um",
                               progress=False)
        self.assertEqual(study.results["components"][0]["goal"], 0.002)

    def test_frames_of_any_kind_are_read_alike(self):
        columns = {name: self.frame[name].to_numpy() for name in self.frame}
        structured = self.frame.to_records(index=False)
        by_index = self.frame.set_index("record")
        strided = pandas.DataFrame(
            numpy.ascontiguousarray(self.frame.to_numpy()),
            columns=self.frame.columns)
        read_only = {name: column.copy() for name, column in columns.items()}
        for column in read_only.values():
            column.flags.writeable = False
        expected = common.without_times(self.study.results)["components"]
        for frame in (columns, structured, by_index, strided, read_only,
                      common.XDOWN):
            found = errmap.compare(frame, models=["mean", "poly:eq8"],
                                   progress=False)
            self.assertEqual(
                common.without_times(found.results)["components"], expected)

    def test_remarks_are_those_of_the_command_line(self):
        _, _, said = common.run("compare", common.XDOWN, "--models",
                                "mean,poly:eq8")
        said = [line.removeprefix("errmap: ").replace("--", "")
                for line in said.splitlines()]
        for remark in self.study.remarks:
            self.assertTrue(any(remark[:20] in line for line in said), remark)


class BadInput(unittest.TestCase):
    def refused(self, *args, **options):
        with self.assertRaises(ValueError) as caught:
            errmap.compare(*args, progress=False, **options)
        return str(caught.exception)

    def test_a_wrong_option_has_the_command_lines_line(self):
        for option, words in (
                ({"holdouts": ["groupz:5"]}, ["--holdout", "groupz:5"]),
                ({"models": ["poly:eq99"]}, ["--model", "poly:eq99"]),
                ({"goal": "2parsec"}, ["--goal", "2parsec"]),
                ({"target": "no_such"}, ["--target", "no_such"])):
            expected = common.error_line("compare", common.XDOWN, *words)
            found = self.refused(common.XDOWN, **option)
            self.assertEqual(found.replace("target", "--target")
                             if "target" in option else found,
                             expected if "target" not in option else
                             found.replace("target", "--target"))

    def test_a_bad_cell_is_named_by_row_and_column(self):
        frame = read(common.XDOWN).astype({"position_mm": object})
        frame.loc[16, "position_mm"] = "beam lost"
        line = self.refused(frame)
        self.assertIn("frame: row 16, column 'position_mm'", line)
        self.assertIn("beam lost", line)

    def test_missing_cells_and_infinities(self):
        frame = read(common.XDOWN)
        frame.loc[3, "error_mm"] = float("nan")
        self.assertIn("row 3, column 'error_mm'", self.refused(frame))
        study = errmap.compare(frame, models=["mean"], missing="drop-rows",
                               progress=False)
        self.assertEqual(study.results["components"][0]["data"]["rows"], 396)
        frame.loc[3, "error_mm"] = float("inf")
        self.assertIn("inf", self.refused(frame))

    def test_what_is_no_table(self):
        self.assertIn("DataFrame", self.refused(5))
        self.assertIn("no columns", self.refused({}))
        self.assertIn("no rows", self.refused({"x": [], "error": []}))
        self.assertIn("two columns", self.refused(
            pandas.DataFrame([[1.0, 2.0]], columns=["x", "x"])))
        self.assertIn("rows", self.refused({"x": [1.0, 2.0], "error": [1.0]}))


class Interrupts(unittest.TestCase):
    def test_ctrl_c_keeps_what_is_done_and_the_lock_is_free(self):
        frame = read(common.XDOWN)
        ticks = []
        running = True

        def tick():
            while running:
                ticks.append(time.monotonic())
                time.sleep(0.01)

        def interrupt():
            time.sleep(0.7)
            os.kill(os.getpid(), signal.SIGINT)

        threads = [threading.Thread(target=work) for work in (tick, interrupt)]
        for thread in threads:
            thread.start()
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            study = errmap.compare(
                frame, models=["mean", "net:lm:hidden=60:iterations=100000"],
                jobs=1, progress=False)
        running = False
        for thread in threads:
            thread.join()
        self.assertTrue(study.interrupted)
        self.assertTrue(any("interrupted" in str(w.message) for w in caught))
        self.assertIn("mean", list(study.table["model"]))
        self.assertGreater(len(ticks), 20)


class Maps(unittest.TestCase):
    def setUp(self):
        self.frame = read(common.XDOWN)
        study = errmap.compare(self.frame, models=["poly:eq8"], progress=False)
        self.map = study.map()

    def test_predicts_the_command_lines_bits(self):
        with common.scratch() as folder:
            path = os.path.join(folder, "map.json")
            self.map.save(path)
            _, printed, _ = common.run("predict", path, common.XDOWN)
            lines = [line.split(",") for line in printed.splitlines()]
            at = lines[0].index("predicted")
            by_cli = [line[at] for line in lines[1:]]
            self.assertEqual(self.map.predict(self.frame).tolist(),
                             [float(cell) for cell in by_cli])
            self.assertEqual(errmap.load(path), self.map)

    def test_interval_inside_and_check(self):
        interval = self.map.interval(self.frame, 95)
        self.assertEqual(interval.shape, (397, 2))
        self.assertTrue((interval[:, 0] < interval[:, 1]).all())
        self.assertTrue(self.map.inside(self.frame).any())
        far = self.frame.assign(position_mm=1e4)
        self.assertFalse(self.map.inside(far).any())
        check = self.map.check(self.frame.head(12))
        self.assertIn(check["status"], ("holds", "off", "unknown"))

    def test_a_pickle_is_the_text(self):
        again = pickle.loads(pickle.dumps(self.map))
        self.assertEqual(again, self.map)
        self.assertEqual(again.text, self.map.text)

    def test_maps_of_every_released_version_load(self):
        folder = os.path.join(common.ROOT, "tests/cli/python/maps")
        for name in sorted(os.listdir(folder)):
            map = errmap.load(os.path.join(folder, name))
            self.assertTrue(numpy.isfinite(map.predict(self.frame)).all(), name)

    def test_tells_when_to_probe_and_takes_new_sessions(self):
        days = errmap.simulate(days=6, cycles=3, points=12, dead=[3, 4],
                               components=["x_displacement_up"])
        days = days["x_displacement_up"]
        options = dict(models=["poly:ridge"], progress=False)
        old, new = days[days["day"] < 5], days[days["day"] >= 5]
        map = errmap.compare(old, **options).map()
        self.assertGreater(len(map.when("5um")["clocks"]), 0)
        updated, why = map.update(new, old)
        self.assertEqual(why["schema"], "errmap-update-1")
        self.assertEqual(updated.inputs, map.inputs)
        with common.scratch() as folder:
            map.save(os.path.join(folder, "m.json"))
            _, printed, _ = common.run("when", os.path.join(folder, "m.json"),
                                       "--goal", "5um", "--format", "json")
            self.assertEqual(common.without_times(map.when("5um")),
                             common.without_times(common.loads(printed)))

    def test_exports(self):
        with common.scratch() as folder:
            self.map.export(folder, "c", "python", name="xdown")
            self.assertLessEqual({"xdown.c", "xdown.h", "xdown.py"},
                                 set(os.listdir(folder)))

    def test_what_is_no_map(self):
        with self.assertRaises(ValueError):
            errmap.loads("{}")


class Commands(unittest.TestCase):
    def test_documents_are_the_command_lines(self):
        frame = read(common.XDOWN)
        for found, words in (
                (errmap.residuals(frame, "error_mm"),
                 ["residuals", common.XDOWN, "--column", "error_mm"]),
                (errmap.learn(frame, "cycles", models=["poly:eq8"]),
                 ["learn", common.XDOWN, "--by", "cycles", "--models",
                  "poly:eq8"]),
                (errmap.certify("gradients"), ["certify", "gradients"])):
            _, printed, _ = common.run(*words, "--format", "json")
            self.assertEqual(common.without_times(found),
                             common.without_times(common.loads(printed)))

    def test_simulates(self):
        machine = errmap.simulate(days=1, cycles=2)
        self.assertIn("error_mm", machine["x_displacement_up"].columns)


if __name__ == "__main__":
    unittest.main()
