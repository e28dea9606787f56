#include "cli/report/output_folder.h"

#include <cctype>
#include <cerrno>
#include <filesystem>
#include <set>
#include <system_error>
#include <unistd.h>

#include <fmt/format.h>

#include "cli/report/report_files.h"
#include "cli/study_file/provenance.h"
#include "data/atomic_file.h"
#include "data/csv.h"
#include "models/model_file.h"

namespace errmap::cli {
namespace {

// A file name of a SPEC or component less its ending: what is safe stays, the
// rest becomes '_'.
std::string FileNameOf(const std::string& text, std::set<std::string>* taken) {
  constexpr std::size_t kMostLength = 100;
  std::string stem;
  for (const char c : text.substr(0, kMostLength)) {
    const bool safe = std::isalnum(static_cast<unsigned char>(c)) != 0 ||
                      c == '.' || c == '=' || c == '+' || c == '-' || c == '_';
    stem += safe ? c : '_';
  }
  std::string name = stem;
  for (int copy = 2; !taken->insert(name).second; ++copy) {
    name = fmt::format("{}_{}", stem, copy);
  }
  return name;
}

void WriteModels(const StudyRun& run,
                 const Comparison& component,
                 const std::filesystem::path& folder) {
  const models::Provenance provenance =
      ModelProvenance(run.command_line,
                      {component.file, component.sha256},
                      component.data.dataset.num_rows(),
                      run.seed);
  std::set<std::string> taken;
  for (const models::ModelResult& model : component.study.models) {
    if (!model.final_fit) continue;
    models::SaveModel(
        *model.final_fit,
        provenance,
        (folder / (FileNameOf(model.name, &taken) + ".json")).string());
  }
}

}  // namespace

void PrepareFolder(const std::string& path) {
  std::filesystem::create_directories(path);
  if (access(path.c_str(), W_OK | X_OK) != 0) {
    throw std::system_error(errno, std::generic_category(), path);
  }
}

void RemoveAbandoned(const std::string& folder) {
  data::RemoveAbandonedFiles(folder);
  data::RemoveAbandonedFiles(
      (std::filesystem::path(folder) / "models").string());
}

std::string ResidualsCsv(const Comparison& comparison) {
  const data::Dataset& dataset = comparison.data.dataset;
  std::string text = "holdout,fold,row";
  if (dataset.has_groups()) {
    text += "," + data::CsvField(dataset.groups().column);
  }
  text += "," + data::CsvField(dataset.target().name);
  for (const models::ModelResult& model : comparison.study.models) {
    text += "," + data::CsvField(model.name);
  }
  text += "\n";
  for (std::size_t h = 0; h < comparison.holdouts.size(); ++h) {
    const models::Holdout& holdout = comparison.holdouts[h];
    const data::Dataset& source =
        holdout.test_data != nullptr ? *holdout.test_data : dataset;
    for (std::size_t fold = 0; fold < holdout.folds.size(); ++fold) {
      const Eigen::Index size =
          holdout.test_data != nullptr
              ? source.num_rows()
              : static_cast<Eigen::Index>(holdout.folds[fold].test.size());
      for (Eigen::Index i = 0; i < size; ++i) {
        const Eigen::Index index =
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
        text += "," + data::CsvNumber(source.target_values()[index]);
        for (const models::ModelResult& model : comparison.study.models) {
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
  return text;
}

void WriteOutputs(const StudyRun& run,
                  const models::StudyRecord& record,
                  const std::string& folder) {
  const std::filesystem::path root(folder);
  PrepareFolder((root / "models").string());
  data::WriteFileAtomically((root / "results.json").string(),
                            models::ToJsonText(record));
  std::set<std::string> taken;
  for (const Comparison& component : run.components) {
    std::filesystem::path residuals = root / "residuals.csv";
    std::filesystem::path models = root / "models";
    if (run.has_several()) {
      const std::string name = FileNameOf(component.name, &taken);
      PrepareFolder((root / "residuals").string());
      residuals = root / "residuals" / (name + ".csv");
      models /= name;
      PrepareFolder(models.string());
    }
    data::WriteFileAtomically(residuals.string(), ResidualsCsv(component));
    WriteModels(run, component, models);
  }
  WriteReport(record, folder);
}

}  // namespace errmap::cli
