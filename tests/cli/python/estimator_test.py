"""errmap.Map as scikit-learn sees it, and regressors of others in a study."""

import contextlib
import io
import os
import pickle
import re
import sys
import unittest
import warnings
from unittest import mock

try:
    import numpy
    import pandas
    import sklearn
    from sklearn.base import clone
    from sklearn.ensemble import RandomForestRegressor
    from sklearn.linear_model import LinearRegression, RidgeCV
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

SIX_DAYS = os.path.join(common.ROOT, "data/sets/turning_centre/six_days.csv")

#: Checks of scikit-learn that do not hold, and why.
EXCEPTIONS = {}


def six_days():
    return errmap.read_csv(SIX_DAYS)


class Checks(unittest.TestCase):
    """Those of scikit-learn, each a test of its own."""


def add_checks():
    pairs = [pair for map in (errmap.Map("poly:full", degree=1), errmap.Map("poly:ridge"),
                         errmap.Map())
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
        pipe = make_pipeline(StandardScaler(), errmap.Map("poly:full", degree=2))
        scores = cross_val_score(pipe, values, self.y, cv=3)
        self.assertEqual(len(scores), 3)
        search = GridSearchCV(
            errmap.Map("poly:full"), {"degree": [1, 3]},
            cv=GroupKFold(4)).fit(self.x, self.y, groups=self.frame["cycle"])
        self.assertEqual(search.best_params_, {"degree": 3})

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
        x = self.frame.drop(columns="error_mm")
        interval = errmap.Map("poly:eq8").fit(x, self.y).predict_interval(x)
        self.assertTrue((interval[:, 0] < interval[:, 1]).all())

    def test_says_once_that_it_has_no_interval(self):
        map = errmap.Map("poly:eq8", interval=False).fit(self.x, self.y)
        with self.assertWarnsRegex(errmap.ErrmapWarning, "interval=True"):
            self.assertTrue(numpy.isnan(map.predict_interval(self.x)).all())
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            map.predict_interval(self.x)

    def test_has_every_option_of_every_model_as_a_parameter(self):
        models = re.findall(r"^(?:zero|mean|blend|poly:\w+|net:\w+)",
                            errmap.models(), re.M)
        self.assertGreater(len(models), 15)
        models[models.index("poly:formula")] = "poly:formula=x"
        options = {name for model in models
                   for name in re.findall(r"^([a-z_0-9]+) +\S",
                                          common.run("models", model)[1], re.M)}
        own = {"model", "session", "time", "seed", "interval", "jobs", "budget"}
        self.assertEqual(set(errmap.Map().get_params()) - own,
                         options - {"option", "formula"})

    def test_options_are_those_of_a_spec(self):
        by_words = errmap.Map("poly:stepwise", degree=2, criterion="bic",
                              include=["position_mm"]).fit(self.x, self.y)
        by_spec = errmap.Map("poly:stepwise:criterion=bic:degree=2:"
                             "include=position_mm").fit(self.x, self.y)
        self.assertEqual(by_words.predict(self.x).tolist(),
                         by_spec.predict(self.x).tolist())
        with self.assertRaisesRegex(TypeError, "degre"):
            errmap.Map(degre=2)
        with self.assertRaisesRegex(ValueError, "poly:eq8.*degree"):
            errmap.Map("poly:eq8", degree=2).fit(self.x, self.y)
        with self.assertRaisesRegex(ValueError, "degree is an option"):
            errmap.Map(degree=2).fit(self.x, self.y)

    def test_by_default_is_what_compare_recommends(self):
        x = self.frame.drop(columns="error_mm")
        study = errmap.compare(self.frame, progress=False)
        map = errmap.Map().fit(x, self.y)
        self.assertEqual(map.map_.name, study.recommendation["model"])
        self.assertEqual(map.predict(x).tolist(),
                         study.map().predict(self.frame).tolist())

    def test_says_where_rows_are_too_few_to_recommend(self):
        few = self.frame.iloc[:10]
        with self.assertWarnsRegex(errmap.ErrmapWarning, "too few rows"):
            errmap.Map().fit(few.drop(columns="error_mm"), few["error_mm"])

    def test_says_how_long_it_compares_and_keeps_to_a_budget(self):
        days = six_days()
        x = days.drop(columns="error_mm")
        said = io.StringIO()
        with contextlib.redirect_stderr(said):
            errmap.Map(jobs=1).fit(x, days["error_mm"])
        self.assertRegex(said.getvalue(), r"compares \d+ models, about \d+ s")
        said = io.StringIO()
        with contextlib.redirect_stderr(said):
            errmap.Map(budget=0.01).fit(x, days["error_mm"])
        self.assertEqual(said.getvalue(), "")

    def test_compares_nothing_within_a_search(self):
        calls = []
        with mock.patch("errmap._estimator.compare", calls.append):
            scores = cross_val_score(errmap.Map(), self.x, self.y, cv=3,
                                     error_score="raise")
            search = GridSearchCV(
                errmap.Map(), {"model": ["mean", "auto"]}, cv=3,
                error_score="raise").fit(self.x, self.y)
        self.assertEqual((calls, len(scores)), ([], 3))
        self.assertEqual(search.best_estimator_.map_.name, "blend")

    def test_one_warning_a_fit(self):
        days = six_days()
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            cross_val_score(errmap.Map(), days.drop(columns="error_mm"),
                            days["error_mm"], cv=errmap.SessionSplit(5),
                            groups=days["day"])
        self.assertLessEqual(len(told), 5)
        for warning in told:
            self.assertIs(warning.category, errmap.ErrmapWarning)

    def test_reads_a_frame_as_the_command_line_reads_a_file(self):
        days = six_days()
        with common.scratch() as folder:
            path = folder + "/map.json"
            common.run("fit", SIX_DAYS, "--model", "poly:ridge:view=auto", "-o",
                       path)
            by_cli = errmap.load(path)
        x = days.drop(columns="error_mm")
        map = errmap.Map("poly:ridge", view="auto").fit(x, days["error_mm"])
        self.assertEqual(map.map_.inputs, by_cli.inputs)
        self.assertEqual(map.predict(x).tolist(),
                         by_cli.predict(days).tolist())

    def test_refuses_one_map_for_both_ways(self):
        x = numpy.tile(numpy.r_[0:100:10, 90:-10:-10], 8)
        up = numpy.tile(numpy.r_[[1.0] * 10, [0.0] * 10], 8)
        frame = pandas.DataFrame({
            "position_mm": x, "t1_degC": numpy.linspace(20, 25, len(x))})
        error = pandas.Series(x / 50 + 4 * up, name="error_um")
        for map in (errmap.Map(), errmap.Map("poly:eq8")):
            with self.assertRaisesRegex(ValueError, "both ways"):
                map.fit(frame, error)

    def test_weights(self):
        half = self.frame["cycle"] <= 17
        weighted = errmap.Map("poly:full", degree=2).fit(
            self.x, self.y, sample_weight=half.astype(float))
        alone = errmap.Map("poly:full", degree=2).fit(self.x[half],
                                                      self.y[half])
        self.assertEqual(weighted.predict(self.x).tolist(),
                         alone.predict(self.x).tolist())

    def test_equation(self):
        map = errmap.Map("poly:full", degree=1).fit(self.x, self.y)
        self.assertRegex(map.equation_, r"^error_mm = .*\*position_mm")
        self.assertIsNone(errmap.Map("blend").fit(self.x, self.y).equation_)

    def test_plot(self):
        try:
            import matplotlib
        except ImportError:
            self.skipTest("matplotlib is not installed")
        matplotlib.use("Agg")
        map = errmap.Map("poly:eq8").fit(self.x, self.y)
        axes = map.plot(self.x, self.y)
        self.assertEqual((axes.get_xlabel(), axes.get_ylabel()),
                         ("position_mm", "error, um"))
        labels = [text.get_text() for text in axes.get_legend().get_texts()]
        self.assertRegex(labels[1], r"poly:eq8: RMSE \d.* um")

    def test_a_pickle_predicts_the_same(self):
        map = errmap.Map("poly:eq8").fit(self.x, self.y)
        again = pickle.loads(pickle.dumps(map))
        self.assertEqual(again.predict(self.x).tolist(),
                         map.predict(self.x).tolist())

    def test_a_wrong_spec_is_told_when_it_is_fitted(self):
        map = errmap.Map("poly:eq99")
        with self.assertRaisesRegex(ValueError, "poly:eq99"):
            map.fit(self.x, self.y)


def ten_sets():
    """(name, columns, error, units held out) of measurements as users have."""
    def sets(name):
        return errmap.read_csv(os.path.join(common.ROOT, "data/sets", name))

    frames = [("nistir5367_xdisp_down.csv", sets("nistir5367_xdisp_down.csv"))]
    for name in ("six_days", "x_displacement_up", "x_displacement_down"):
        frames.append((name, sets(f"turning_centre/{name}.csv")))
    for seed, days, cycles, name in (
            (11, 4, 8, "z_displacement_forward"), (12, 5, 6, "x_yaw"),
            (13, 6, 8, "x_displacement_down"), (14, 8, 5, "spindle_axial"),
            (15, 3, 12, "z_straightness"), (16, 10, 4, "x_displacement_up")):
        made = errmap.simulate(seed=seed, days=days, cycles=cycles,
                               components=[name])[name]
        frames.append((f"{name}, seed {seed}", made[[
            column for column in made if not column.endswith("_degC")
            or column[:3] in ("t00", "t03", "t13", "t28", "t32")]]))
    for name, frame in frames:
        target = next(c for c in frame if c.startswith("error"))
        units = frame["day" if "day" in frame else "cycle"]
        yield name, frame.drop(columns=[target, "record", "truth_mm"],
                               errors="ignore"), frame[target], units


class Defaults(unittest.TestCase):
    def test_err_less_than_those_of_scikit_learn_on_ten_sets(self):
        ratios = {"ridge": [], "forest": []}
        for name, x, y, units in ten_sets():
            cv = list(errmap.SessionSplit(min(5, units.nunique())).split(
                x, groups=units))
            inputs = x.drop(columns=["day", "cycle", "time_s"],
                            errors="ignore").to_numpy()

            def rmse(regressor, x):
                predicted = cross_val_predict(regressor, x, y, cv=cv)
                return numpy.sqrt(numpy.mean((predicted - y) ** 2))

            with warnings.catch_warnings():
                warnings.simplefilter("ignore", errmap.ErrmapWarning)
                own = rmse(errmap.Map(), x)
            for rival, regressor in (
                    ("ridge", make_pipeline(
                        StandardScaler(), RidgeCV(numpy.logspace(-3, 3, 13)))),
                    ("forest", RandomForestRegressor(random_state=1))):
                ratios[rival].append(own / rmse(regressor, inputs))
        self.assertEqual(len(ratios["ridge"]), 10)
        for rival, values in ratios.items():
            mean = numpy.exp(numpy.mean(numpy.log(values)))
            print(f"errmap.Map() errs {mean:.2f} of {rival}'s")
            self.assertLessEqual(mean, 1.0, rival)


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
