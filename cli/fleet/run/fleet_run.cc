#include "cli/fleet/run/fleet_run.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <mutex>
#include <new>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "cli/study_setup/plan/run_files.h"
#include "cli/study_setup/plan/study_run.h"
#include "cli/study_setup/provenance.h"
#include "data/files/atomic_file.h"
#include "data/files/prepare_folder.h"
#include "data/files/shown_path.h"
#include "data/input_error.h"
#include "data/sha256.h"
#include "data/tables/text/gzip.h"
#include "data/text.h"
#include "fitting/parallel_for.h"
#include "models/file_recipe.h"
#include "models/fleet/watch.h"
#include "models/record_json.h"
#include "models/version.h"
#include "stats/holdout.h"

namespace errmap::fleet {

using study_setup::ComponentConfig;
using study_setup::StudyConfig;
using study_setup::StudyRun;

namespace {

StudyConfig StudyOf(const StudyConfig& fleet,
                    const ComponentConfig& component) {
  StudyConfig study = fleet;
  study.components = {component};
  return study;
}

// Short, since there are many of them.
std::string HashOf(const std::string& text) {
  constexpr std::size_t kDigits = 32;
  return data::Sha256(text).substr(0, kDigits);
}

// Wherever the program was started: the data as the study file names them.
std::string AskedOf(const StudyConfig& fleet,
                    ComponentConfig component,
                    const ComponentSource& source) {
  component.data = source.path;
  return HashOf(
      std::string(models::Version()) + "\n" +
      models::JsonText(
          study_setup::EffectiveConfiguration(StudyOf(fleet, component)), -1));
}

std::string Replaced(std::string text,
                     const std::string& old,
                     const std::string& by) {
  for (std::size_t at = 0; (at = text.find(old, at)) != text.npos;) {
    text.replace(at, old.size(), by);
    at += by.size();
  }
  return text;
}

// The run as if its data had been named as the study file does, so that
// results do not depend on the folder that the program was started in.
void NameDataAsAsked(const std::string& path,
                     const ComponentSource& source,
                     StudyRun* run) {
  run->components.front().files.front().file = data::ShownPath(source.path);
  run->components.front().data.reading.files.front() =
      data::ShownPath(source.path);
  run->config.components.front().data = source.path;
  for (study_setup::InputFile& input : run->inputs) {
    if (input.file == path) input.file = source.path;
  }
}

// With the content of every file that the study reads; one that cannot be read
// is nothing.
std::string KeyOf(const std::string& asked,
                  const StudyConfig& fleet,
                  const ComponentConfig& component) {
  std::vector<std::string> files = component.AllData();
  for (const std::string& holdout : fleet.holdouts) {
    files.push_back(stats::ParseHoldout(holdout).file);
  }
  for (const std::string& model : fleet.models) {
    files.push_back(models::FileOfSpec(model));
  }
  std::string text = asked;
  for (const std::string& file : files) {
    if (file.empty()) continue;
    try {
      text += "\n" + study_setup::HashInput(file).sha256;
    } catch (const data::InputError&) {
      text += "\nnone";
    }
  }
  return HashOf(text);
}

// The recommended map as compare --out would write it, "" if there is none.
std::string MapOf(const StudyRun& run) {
  const models::ComponentStudy& component = run.components.front();
  if (!component.judgement.recommendation) return "";
  const auto& model =
      component.study.models[component.judgement.recommendation->model];
  if (!model.final_fit) return "";
  return study_setup::MapFileText(run, component, model);
}

class FleetRunner {
 public:
  FleetRunner(const FleetStudy& study,
              const StorePaths& store,
              const FleetRunOptions& options)
      : config_(study.config),
        sources_(study.sources),
        store_(store),
        options_(options) {}

  FleetRunResult Run() {
    for (std::size_t i = 0; i < sources_.size(); ++i) {
      if (options_.share.Has(config_.components[i].name)) share_.push_back(i);
    }
    const int workers = static_cast<int>(
        std::clamp<std::ptrdiff_t>(std::ssize(share_), 1, options_.jobs));
    jobs_each_ = std::max(1, options_.jobs / workers);
    fitting::ParallelFor(workers, share_.size(), [&](std::size_t i) {
      if (IsStopped()) return;
      Study(config_.components[share_[i]], sources_[share_[i]]);
    });
    result_.interrupted = IsStopped();
    result_.components = static_cast<int>(share_.size());
    return result_;
  }

 private:
  bool IsStopped() const {
    return options_.stop != nullptr && options_.stop->load();
  }

  void Write(const std::string& name,
             const char* file,
             const std::string& content) const {
    const std::string path = store_.InFolder(name, file);
    data::PrepareFolder(std::filesystem::path(path).parent_path().string());
    data::WriteFileAtomically(path, content);
  }

  void Remove(const std::string& name, const char* file) const {
    std::error_code ignored;
    std::filesystem::remove(store_.InFolder(name, file), ignored);
  }

  void RemoveResults(const std::string& name) const {
    for (const char* file : {kResultsFile, kMapFile, kRelationsFile}) {
      Remove(name, file);
    }
  }

  bool IsKept(const std::string& name, const std::string& key) const {
    const auto earlier = FindSummary(store_, name);
    if (!earlier || earlier->key != key ||
        earlier->status != models::ModelStatus::kOk) {
      return false;
    }
    return !earlier->ways ||
           std::ranges::all_of(*earlier->ways, [&](const std::string& way) {
             return !IsNamed(way) && IsKept(way, key);
           });
  }

  // Whether a component of the study is called so; "x, up" may be a direction
  // of x.csv, and the file x_up.csv.
  bool IsNamed(const std::string& name) const {
    return std::ranges::find(
               config_.components, name, &ComponentConfig::name) !=
           config_.components.end();
  }

  // A number of the result, which one more is counted in; null where it was
  // interrupted.
  using Counted = int FleetRunResult::*;

  void Study(const ComponentConfig& component, const ComponentSource& source) {
    if (const Counted number = Studied(component, source)) Count(number);
  }

  // Rows that go both ways along the axis are two components.
  Counted Studied(const ComponentConfig& component,
                  const ComponentSource& source) {
    ComponentSummary summary;
    summary.asked = AskedOf(config_, component, source);
    summary.key = KeyOf(summary.asked, config_, component);
    if (IsKept(component.name, summary.key)) return &FleetRunResult::kept;
    std::vector<ComponentConfig> ways =
        study_setup::PartedByDirection(StudyOf(config_, component)).components;
    if (ways.size() == 1) {
      return StudyWay(component, source, summary.asked, summary.key);
    }
    summary.version = models::Version();
    summary.name = component.name;
    summary.status = models::ModelStatus::kOk;
    std::vector<std::string> names;
    for (ComponentConfig& way : ways) {
      if (IsNamed(way.name)) way.name += " of " + source.path;
      names.push_back(way.name);
      const Counted number = StudyWay(way, source, summary.asked, summary.key);
      if (number == nullptr) return nullptr;
      if (number == &FleetRunResult::failed) {
        summary.status = models::ModelStatus::kFailed;
      }
    }
    summary.ways = std::move(names);
    RemoveResults(component.name);
    const bool failed = summary.status == models::ModelStatus::kFailed;
    Write(component.name, kSummaryFile, ToJsonText(std::move(summary)));
    return failed ? &FleetRunResult::failed : &FleetRunResult::fitted;
  }

  Counted StudyWay(const ComponentConfig& component,
                   const ComponentSource& source,
                   const std::string& asked,
                   const std::string& key) {
    if (IsKept(component.name, key)) return &FleetRunResult::kept;
    ComponentSummary summary;
    bool is_final = true;
    try {
      StudyRun run = study_setup::RunPlan(
          study_setup::PlanStudy(StudyOf(config_, component)),
          options_.command_line,
          {.jobs = jobs_each_, .stop = options_.stop});
      if (run.interrupted) return nullptr;  // begun anew by the next run
      is_final = run.components.front().study.short_of_memory == 0;
      NameDataAsAsked(component.data, source, &run);
      models::StudyRecord record = study_setup::RecordOf(run, jobs_each_);
      for (auto& table : record.components.front().figures.tables) {
        if (table.file == data::ShownPath(component.data)) {
          table.file = data::ShownPath(source.path);
        }
      }
      summary = Summarise(record.components.front());
      if (summary.status == models::ModelStatus::kOk) {
        WriteResults(run, record, &summary);
      }
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::system_error&) {
      throw;  // the store cannot be written
    } catch (const std::exception& error) {
      summary = {};
      summary.name = component.name;
      summary.file = std::filesystem::path(component.data).filename().string();
      summary.why = Replaced(error.what(), component.data, source.path);
    }
    summary.version = models::Version();
    summary.asked = asked;
    // Without its key, the next run studies the component again.
    if (is_final) summary.key = key;
    summary.fields = source.fields;
    const bool failed = summary.status != models::ModelStatus::kOk;
    if (failed) {
      // Of an earlier run: they are not this component's any more.
      RemoveResults(component.name);
      if (options_.remark) {
        const std::lock_guard lock(mutex_);
        options_.remark(fmt::format(
            "{} failed: {}", data::Printable(summary.name), *summary.why));
      }
    }
    Write(component.name, kSummaryFile, ToJsonText(std::move(summary)));
    return failed ? &FleetRunResult::failed : &FleetRunResult::fitted;
  }

  // The summary last, by the caller.
  void WriteResults(const StudyRun& run,
                    const models::StudyRecord& record,
                    ComponentSummary* summary) const {
    const std::string& name = summary->name;
    const std::string map = MapOf(run);
    if (map.empty()) {
      Remove(name, kMapFile);
    } else {
      summary->map = SummaryMapRecord{.sha256 = data::Sha256(map),
                                      .bytes = std::ssize(map)};
      Write(name, kMapFile, data::Gzip(map));
    }
    const auto relations =
        models::LearnRelations(run.components.front().data.dataset);
    if (relations) {
      Write(name, kRelationsFile, data::Gzip(relations->ToJsonText()));
    } else {
      Remove(name, kRelationsFile);
    }
    Write(name, kResultsFile, data::Gzip(models::ToJsonLine(record)));
  }

  void Count(Counted number) {
    const std::lock_guard lock(mutex_);
    ++(result_.*number);
    if (options_.progress) {
      options_.progress(result_.fitted + result_.kept + result_.failed,
                        static_cast<int>(share_.size()));
    }
  }

  const StudyConfig& config_;
  const std::vector<ComponentSource>& sources_;
  const StorePaths& store_;
  const FleetRunOptions& options_;
  std::vector<std::size_t> share_;  // index into the components
  int jobs_each_ = 1;
  std::mutex mutex_;  // of all that follows, and of options_.remark
  FleetRunResult result_;
};

}  // namespace

bool Share::Has(std::string_view name) const {
  constexpr std::size_t kDigits = 16;
  const std::uint64_t hash =
      std::stoull(data::Sha256(name).substr(0, kDigits), nullptr, 16);
  return hash % static_cast<std::uint64_t>(count) ==
         static_cast<std::uint64_t>(index);
}

FleetRecord FleetOf(const FleetStudy& study, const std::string& command_line) {
  FleetRecord fleet;
  fleet.version = models::Version();
  fleet.file = std::filesystem::path(study.file.file).filename().string();
  fleet.sha256 = study.file.sha256;
  fleet.seed = study.config.seed;
  fleet.command_line = command_line;
  for (std::size_t i = 0; i < study.sources.size(); ++i) {
    const ComponentConfig& component = study.config.components[i];
    fleet.components.push_back(
        {.name = component.name,
         .data = study.sources[i].path,
         .asked = AskedOf(study.config, component, study.sources[i])});
  }
  std::ranges::sort(fleet.components, {}, &FleetComponentRecord::name);
  return fleet;
}

FleetRunResult RunFleet(const FleetStudy& study,
                        const StorePaths& store,
                        const FleetRunOptions& options) {
  return FleetRunner(study, store, options).Run();
}

}  // namespace errmap::fleet
