#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/report/report.h"
#include "data/csv.h"
#include "data/formula_text.h"
#include "models/study/judgement/extrapolated_rows.h"

namespace errmap::report {

std::string ResidualsCsv(const models::ComponentStudy& study) {
  const data::Dataset& dataset = study.data.dataset;
  std::string text = "holdout,fold,row";
  if (dataset.has_groups()) {
    text += "," + data::CsvField(dataset.groups().column);
  }
  text += "," + data::CsvField(dataset.target().name) + ",inside";
  for (const models::ModelResult& model : study.study.models) {
    text += "," + data::CsvField(model.name);
  }
  text += "\n";
  const auto& advice = study.judgement.recommendation;
  for (std::size_t h = 0; h < study.holdouts.size(); ++h) {
    const models::Holdout& holdout = study.holdouts[h];
    std::vector<Eigen::Array<bool, Eigen::Dynamic, 1>> outside;
    if (advice) {
      outside = models::ExtrapolatedRows(
          dataset, holdout, *study.study.models[advice->model].final_fit);
    }
    const data::Dataset& source =
        holdout.test_data != nullptr ? *holdout.test_data : dataset;
    for (std::size_t fold = 0; fold < holdout.folds.size(); ++fold) {
      const Index size = holdout.test_data != nullptr
                             ? source.num_rows()
                             : std::ssize(holdout.folds[fold].test);
      for (Index i = 0; i < size; ++i) {
        const Index index =
            holdout.test_data != nullptr
                ? i
                : holdout.folds[fold].test[static_cast<std::size_t>(i)];
        const auto row = static_cast<std::size_t>(index);
        text += fmt::format(
            "{},{},{}", data::CsvField(holdout.name), fold, source.rows()[row]);
        if (dataset.has_groups()) {
          const data::Grouping& groups = source.groups();
          text +=
              "," +
              data::CsvField(
                  groups.labels[static_cast<std::size_t>(groups.codes[row])]);
        }
        text += "," + data::CsvNumber(source.target_values()[index]) + ",";
        if (!outside.empty()) text += outside[fold][i] ? "0" : "1";
        for (const models::ModelResult& model : study.study.models) {
          const models::HoldoutResult& result = model.holdouts[h];
          text += ",";
          if (result.ok()) {
            text += data::CsvNumber(result.folds[fold].test_predictions[i]);
          }
        }
        text += "\n";
      }
    }
  }
  return data::MarkedCsv(std::move(text));
}

}  // namespace errmap::report
