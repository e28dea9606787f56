"""errmap.Map as scikit-learn sees it, and regressors of others in a study."""

import pickle
import sys
import unittest

try:
    import numpy
    import pandas
    import sklearn
    from sklearn.base import clone
    from sklearn.linear_model import LinearRegression
    from sklearn.model_selection import (GridSearchCV, GroupKFold,
                                         cross_val_predict, cross_val_score)
    from sklearn.pipeline import make_pipeline
    from sklearn.preprocessing import StandardScaler
    from sklearn.svm import SVR
    from sklearn.utils.estimator_checks import check_estimator
except ImportError as missing:
    print("skipped:", missing)
    sys.exit(77)

import common
import errmap

#: Checks of scikit-learn that do not hold, and why.
EXCEPTIONS = {}


class Checks(unittest.TestCase):
    """Those of scikit-learn, each a test of its own."""


def add_checks():
    pairs = [pair for map in (errmap.Map("poly:full:degree=1"), errmap.Map())
             for pair in check_estimator(map, generate_only=True)]
    for number, (estimator, check) in enumerate(pairs):
        name = getattr(check, "func", check).__name__
        if name in EXCEPTIONS:
            continue

        def test(self, estimator=estimator, check=check):
            check(estimator)

        setattr(Checks, f"test_{number:03}_{name}", test)


add_checks()


class Estimator(unittest.TestCase):
    def setUp(self):
        self.frame = errmap.read_csv(common.XDOWN)
        self.x = self.frame[["position_mm", "elapsed_cycles"]]
        self.y = self.frame["error_mm"]

    def test_fits_the_map_of_the_command_line(self):
        map = errmap.Map("poly:eq8").fit(self.x, self.y)
        with common.scratch() as folder:
            path = folder + "/map.json"
            common.run("fit", common.XDOWN, "--model", "poly:eq8", "-o", path)
            by_cli = errmap.load(path)
        self.assertEqual(map.predict(self.x).tolist(),
                         by_cli.predict(self.frame).tolist())
        self.assertEqual(map.map_.unit, "mm")
        self.assertEqual(map.feature_names_in_.tolist(), list(self.x))

    def test_keeps_its_parameters_as_they_are_given(self):
        map = errmap.Map("poly:eq8", session="day", seed=3)
        self.assertEqual(clone(map).get_params(), map.get_params())
        self.assertEqual(map.get_params()["seed"], 3)

    def test_in_pipelines_searches_and_scores(self):
        values = self.x.to_numpy()
        pipe = make_pipeline(StandardScaler(), errmap.Map("poly:full:degree=2"))
        scores = cross_val_score(pipe, values, self.y, cv=3)
        self.assertEqual(len(scores), 3)
        search = GridSearchCV(
            errmap.Map(), {"spec": ["mean", "poly:full:degree=3"]},
            cv=GroupKFold(4)).fit(self.x, self.y, groups=self.frame["cycle"])
        self.assertEqual(search.best_params_, {"spec": "poly:full:degree=3"})

    def test_sessions_and_times_for_maps_with_a_memory(self):
        machine = errmap.simulate(days=2, cycles=4,
                                  components=["x_displacement_up"])
        frame = machine["x_displacement_up"]
        x = frame[["position_mm", "t00_degC", "t03_degC", "day", "time_s"]]
        map = errmap.Map("poly:ridge:view=history", session="day",
                         time="time_s").fit(x, frame["error_mm"])
        self.assertEqual(map.map_.inputs,
                         ["position_mm", "t00_degC", "t03_degC"])
        self.assertLess(numpy.std(map.predict(x) - frame["error_mm"]),
                        0.5 * numpy.std(frame["error_mm"]))

    def test_intervals(self):
        map = errmap.Map("poly:eq8", interval=True).fit(
            self.x, self.y, groups=self.frame["cycle"])
        interval = map.predict_interval(self.x)
        self.assertTrue((interval[:, 0] < interval[:, 1]).all())

    def test_a_pickle_predicts_the_same(self):
        map = errmap.Map("poly:eq8").fit(self.x, self.y)
        again = pickle.loads(pickle.dumps(map))
        self.assertEqual(again.predict(self.x).tolist(),
                         map.predict(self.x).tolist())

    def test_a_wrong_spec_is_told_when_it_is_fitted(self):
        map = errmap.Map("poly:eq99")
        with self.assertRaisesRegex(ValueError, "poly:eq99"):
            map.fit(self.x, self.y)


class Splits(unittest.TestCase):
    def test_are_errmaps_own(self):
        frame = errmap.read_csv(common.XDOWN)
        study = errmap.compare(frame, models=["mean"], progress=False,
                               holdouts=["groups:5", "forward:3:gap=1"])
        holdouts = study.results["components"][0]["holdouts"]
        for split, holdout in zip(
                (errmap.SessionSplit(5),
                 errmap.SessionSplit(3, forward=True, gap=1)), holdouts):
            folds = list(split.split(frame, groups=frame["cycle"]))
            self.assertEqual(len(folds), split.get_n_splits())
            self.assertEqual([test.tolist() for _, test in folds],
                             holdout["test_rows"])
            self.assertEqual([train.tolist() for train, _ in folds],
                             holdout["train_rows"])

    def test_needs_to_know_the_sessions(self):
        with self.assertRaisesRegex(ValueError, "groups="):
            next(errmap.SessionSplit().split([1, 2, 3]))
        with self.assertRaisesRegex(ValueError, "groups"):
            next(errmap.SessionSplit(5).split([1, 2], groups=[1, 2]))


class ForeignRegressors(unittest.TestCase):
    def setUp(self):
        self.frame = errmap.read_csv(common.XDOWN)

    def compare(self, models, **options):
        return errmap.compare(self.frame, models=models, progress=False,
                              **options)

    def test_held_out_predictions_are_those_of_cross_val_predict(self):
        for regressor in (LinearRegression(),
                          make_pipeline(StandardScaler(),
                                        SVR(C=1e-2, epsilon=1e-4))):
            study = self.compare(["mean", errmap.foreign("mine", regressor)],
                                 holdouts=["groups:5"])
            part = study.results["components"][0]
            x = self.frame[part["data"]["inputs"]].to_numpy()
            y = self.frame["error_mm"].to_numpy()
            holdout = part["holdouts"][0]
            expected = cross_val_predict(
                regressor, x, y,
                cv=list(zip(holdout["train_rows"], holdout["test_rows"])))
            found = study.predictions.sort_values("row")
            self.assertEqual(found["mine"].tolist(), expected.tolist())

    def test_are_judged_in_the_same_tables(self):
        study = self.compare([errmap.foreign("plane", LinearRegression()),
                              "poly:eq8"])
        names = set(study.table["model"])
        self.assertLessEqual({"plane", "poly:eq8", "mean"}, names)
        pairs = study.results["components"][0]["comparisons"]
        self.assertTrue(any("plane" in (p["a"], p["b"]) for p in pairs))

    def test_beside_all_that_suit(self):
        study = self.compare([..., errmap.foreign("plane", LinearRegression())],
                             holdouts=["blocks:2"])
        names = set(study.table["model"])
        self.assertLessEqual({"plane", "blend", "net:scg"}, names)

    def test_what_it_raises_is_why_the_fit_failed(self):
        class Broken(LinearRegression):
            def fit(self, x, y):
                raise RuntimeError("no memory of warm days")

        study = self.compare(["mean", errmap.foreign("broken", Broken())])
        model = next(m for m in study.results["components"][0]["models"]
                     if m["name"] == "broken")
        self.assertEqual(model["status"], "failed")
        self.assertIn("no memory of warm days", model["why"])

    def test_must_be_a_regressor_with_a_name_of_its_own(self):
        with self.assertRaisesRegex(ValueError, "fit and predict"):
            errmap.foreign("mine", 5)
        with self.assertRaisesRegex(ValueError, "two models"):
            self.compare([errmap.foreign("mean", LinearRegression()), "mean"])


if __name__ == "__main__":
    unittest.main()
