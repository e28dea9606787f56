
#include <mutex>
#include <utility>

#include <pybind11/stl.h>

#include "cli/commands/data_arguments.h"
#include "cli/commands/studies/compare_arguments.h"
#include "cli/output/claimed_folder.h"
#include "cli/output/report_files.h"
#include "cli/python/module.h"
#include "cli/report/documents/study_table.h"
#include "cli/report/figures/figures.h"
#include "cli/report/report.h"
#include "cli/study_setup/plan/run_files.h"
#include "cli/study_setup/plan/study_forecast.h"
#include "cli/study_setup/plan/study_run.h"
#include "models/model_file.h"
#include "models/version.h"
#include "stats/holdout.h"

namespace errmap::python {
namespace {

using Words = std::vector<std::string>;

/// A finished study: what was run, and its record.
struct Study {
  study_setup::StudyRun run;
  models::StudyRecord record;
  std::vector<std::string> outputs;
  std::vector<std::string> messages;

  const models::ComponentStudy& Component(const std::string& name) const {
    for (const models::ComponentStudy& component : run.components) {
      if (component.name == name) return component;
    }
    throw py::key_error(name);
  }

  std::string Json() const { return models::ToJsonText(record); }

  std::string Screen(bool all, bool details) const {
    return report::StudyTable(
               record, {.all = all, .details = details, .next_steps = false})
        .text;
  }

  std::string Figure() const {
    const report::FigureSet figures = report::MakeFigures(record);
    for (const report::ComponentFigures& component : figures.components) {
      for (const report::Figure& figure : component.figures) {
        if (figure.missing.empty()) return report::FigureSvg(figure);
      }
    }
    return "";
  }

  void Write(const std::string& folder, bool force) const {
    cli::ClaimedFolder claimed(folder, outputs, {}, force);
    models::StudyRecord named = record;
    study_setup::NameMaps(run, &named);
    cli::WriteOutputs(run, named, &claimed);
  }

  Table Predictions(const std::string& component) const {
    return Table::OfCsv(report::ResidualsCsv(Component(component)), component);
  }

  std::string Map(const std::string& component,
                  const std::string& model) const {
    const models::ComponentStudy& of = Component(component);
    for (const models::ModelResult& result : of.study.models) {
      if (result.name != model) continue;
      if (!result.final_fit) break;
      return study_setup::MapFileText(run, of, result);
    }
    throw py::key_error(model);
  }
};

// Where a run stands, told by its threads and asked by Python's.
class Standing {
 public:
  void Set(int done, int all, std::string best) {
    const std::lock_guard lock(mutex_);
    if (done < done_) return;
    done_ = done;
    all_ = all;
    best_ = std::move(best);
  }
  py::tuple Get() const {
    const std::lock_guard lock(mutex_);
    return py::make_tuple(done_, all_, best_);
  }

 private:
  mutable std::mutex mutex_;
  int done_ = 0;
  int all_ = 0;
  std::string best_;
};

using Foreign = std::vector<std::pair<std::string, py::object>>;

Study Compare(const Words& words,
              const std::map<std::string, Table>& tables,
              const std::map<std::string, std::string>& texts,
              const Foreign& foreign,
              bool beside_defaults,
              const py::object& progress) {
  std::atomic<bool> stop{false};
  cli::Host host{.stop = &stop};
  Study study;
  Standing standing;
  const auto own = [&] {
    models::OwnRecipes given{.recipes = {}, .beside_defaults = beside_defaults};
    const py::gil_scoped_acquire gil;
    for (const auto& [name, fit] : foreign) {
      given.recipes.push_back(ForeignRecipe(name, fit));
    }
    return given;
  };
  const auto work = [&] {
    const cli::CompareArguments arguments = cli::ReadCompareArguments(words);
    const int jobs = cli::JobsOf(arguments.jobs);
    study_setup::StudyPlan plan = cli::PlanOf(arguments, own);
    study.outputs = cli::OutputNames(plan);
    study_setup::StudyForecast forecast(plan, jobs);
    const auto note = [&](std::size_t component,
                          const models::FitProgress& fit) {
      forecast.Note(component, fit);
      standing.Set(fit.done, fit.all, forecast.BestSoFar().map);
    };
    std::string command = "errmap compare";
    for (const std::string& word : words) command += " " + word;
    study.run = study_setup::RunPlan(std::move(plan),
                                     command,
                                     {.jobs = jobs,
                                      .stop = &stop,
                                      .cache = arguments.cache,
                                      .progress = note});
    study.record = study_setup::RecordOf(study.run, jobs);
  };
  const auto tell = [&] {
    if (!progress.is_none()) progress(*standing.Get());
  };
  if (RunHostedWork({tables, texts}, &host, &stop, work, tell)) {
    const py::error_already_set interrupt;
    // What is finished is kept, where anything is.
    if (study.run.components.empty()) throw interrupt;
  }
  tell();
  study.messages = std::move(host.messages);
  return study;
}

// (model, rough seconds) of each that compare would fit.
py::list Forecast(const Words& words,
                  const std::map<std::string, Table>& tables) {
  std::vector<std::pair<std::string, double>> seconds;
  std::atomic<bool> stop{false};
  cli::Host host{.stop = &stop};
  const auto work = [&] {
    const cli::CompareArguments arguments = cli::ReadCompareArguments(words);
    const study_setup::StudyPlan plan = cli::PlanOf(arguments);
    seconds = study_setup::RoughSecondsOfModels(plan.components.front());
  };
  if (RunHostedWork({tables, {}}, &host, &stop, work, {})) {
    throw py::error_already_set();
  }
  return py::cast(seconds);
}

// (train, test) of each fold.
py::list Folds(const std::string& holdout,
               Index rows,
               const std::vector<Index>& codes,
               std::uint64_t seed) {
  py::list folds;
  for (const stats::Fold& fold :
       stats::MakeFolds(stats::ParseHoldout(holdout), rows, codes, seed)) {
    folds.append(py::make_tuple(fold.train, fold.test));
  }
  return folds;
}

}  // namespace

void DefineStudies(py::module_* module) {
  py::class_<Study>(*module, "Study", "What a comparison found.")
      .def("json", &Study::Json)
      .def("screen",
           &Study::Screen,
           py::arg("all") = false,
           py::arg("details") = false)
      .def("figure", &Study::Figure)
      .def("html",
           [](const Study& study) { return report::ReportHtml(study.record); })
      .def("write", &Study::Write, py::arg("folder"), py::arg("force"))
      .def("predictions", &Study::Predictions, py::arg("component"))
      .def("map", &Study::Map, py::arg("component"), py::arg("model"))
      .def_readonly("messages", &Study::messages)
      .def_property_readonly("interrupted", [](const Study& study) {
        return study.run.interrupted;
      });
  module->def("compare",
              &Compare,
              py::arg("words"),
              py::arg("tables"),
              py::arg("texts"),
              py::arg("foreign"),
              py::arg("beside_defaults"),
              py::arg("progress"));
  module->def("forecast", &Forecast, py::arg("words"), py::arg("tables"));
  module->def("folds",
              &Folds,
              py::arg("holdout"),
              py::arg("rows"),
              py::arg("codes"),
              py::arg("seed"));
  module->def(
      "require_map",
      [](const std::string& text) { models::ModelFromJson(text, "map.json"); },
      py::arg("text"),
      "Raise ValueError unless this is the text of a model file.");
  module->def("version", &models::Version);
}

}  // namespace errmap::python
