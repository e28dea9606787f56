#include "cli/study_setup/plan/run_files.h"

#include <set>
#include <utility>

#include <fmt/format.h>

#include "cli/report/report.h"
#include "cli/study_setup/plan/component_names.h"
#include "cli/study_setup/provenance.h"
#include "models/model_file.h"

namespace errmap::study_setup {
namespace {

constexpr const char* kResults = "results.json";

// A file name of a SPEC or component less its ending.
std::string FileNameOf(const std::string& text, std::set<std::string>* taken) {
  const std::string stem = SafeName(text);
  std::string name = stem;
  for (int copy = 2; !taken->insert(name).second; ++copy) {
    name = fmt::format("{}_{}", stem, copy);
  }
  return name;
}

// Names of the files of a component, relative to the output folder.
struct ComponentFiles {
  std::string residuals;
  std::vector<std::string> models;  // as many as the models
};

// `names`: of the components; `models`: of the models of each. Whether a model
// failed does not matter, so that the names are known before the work.
std::vector<ComponentFiles> FilesOf(
    const std::vector<std::string>& names,
    const std::vector<std::vector<std::string>>& models,
    bool has_several) {
  std::set<std::string> taken;
  std::vector<ComponentFiles> all;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string folder =
        has_several ? FileNameOf(names[i], &taken) : std::string();
    ComponentFiles& files = all.emplace_back();
    files.residuals =
        has_several ? "residuals/" + folder + ".csv" : "residuals.csv";
    std::set<std::string> models_taken;
    for (const std::string& model : models[i]) {
      files.models.push_back("models/" + folder + (has_several ? "/" : "") +
                             FileNameOf(model, &models_taken) + ".json");
    }
  }
  return all;
}

std::vector<ComponentFiles> FilesOf(const StudyRun& run) {
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> models;
  for (const models::ComponentStudy& component : run.components) {
    names.push_back(component.name);
    std::vector<std::string>& of_component = models.emplace_back();
    for (const models::ModelResult& model : component.study.models) {
      of_component.push_back(model.name);
    }
  }
  return FilesOf(names, models, run.has_several());
}

void WriteModels(const StudyRun& run,
                 const models::ComponentStudy& component,
                 const std::vector<std::string>& names,
                 const WriteFile& write) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    const models::ModelResult& model = component.study.models[i];
    if (!model.final_fit) continue;
    write(names[i], MapFileText(run, component, model));
  }
}

}  // namespace

std::string MapFileText(const StudyRun& run,
                        const models::ComponentStudy& component,
                        const models::ModelResult& model) {
  models::FittedModel map = *model.final_fit;
  map.where = component.data.where;
  map.reading = std::make_shared<const data::Reading>(component.data.reading);
  return models::ModelToJson(map,
                             ModelProvenance(run.command_line,
                                             component.files,
                                             component.data.dataset.num_rows(),
                                             run.seed));
}

std::vector<std::string> RunFileNames(const StudyPlan& plan) {
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> models;
  for (const models::ComponentPlan& component : plan.components) {
    names.push_back(component.comparison.name);
    models.push_back(component.ModelNames());
  }
  std::vector<std::string> all = {kResults};
  for (ComponentFiles& files :
       FilesOf(names, models, plan.components.size() > 1)) {
    all.push_back(std::move(files.residuals));
    all.insert(all.end(), files.models.begin(), files.models.end());
  }
  return all;
}

void NameMaps(const StudyRun& run, models::StudyRecord* record) {
  const std::vector<ComponentFiles> files = FilesOf(run);
  for (std::size_t i = 0; i < files.size(); ++i) {
    std::vector<models::ModelRecord>& models = record->components[i].models;
    for (std::size_t j = 0; j < models.size(); ++j) {
      if (run.components[i].study.models[j].final_fit) {
        models[j].file = files[i].models[j];
      }
    }
  }
}

void WriteRunFiles(const StudyRun& run,
                   const models::StudyRecord& record,
                   const WriteFile& write) {
  const std::vector<ComponentFiles> files = FilesOf(run);
  write(kResults, models::ToJsonText(record));
  for (std::size_t i = 0; i < files.size(); ++i) {
    write(files[i].residuals, report::ResidualsCsv(run.components[i]));
    WriteModels(run, run.components[i], files[i].models, write);
  }
}

}  // namespace errmap::study_setup
