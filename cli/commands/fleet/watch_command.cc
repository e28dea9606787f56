#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <map>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/commands/data_arguments.h"
#include "cli/commands/fleet/fleet_commands.h"
#include "cli/commands/maps/map_warnings.h"
#include "cli/json_blocks.h"
#include "cli/shell/standard_streams.h"
#include "data/atomic_file.h"
#include "data/measurements/column_match.h"
#include "data/sha256.h"
#include "data/text.h"
#include "models/fleet/store/deployments.h"
#include "models/fleet/store/store.h"
#include "models/fleet/store/watch_report.h"
#include "models/fleet/store/watched_files.h"
#include "models/model_file.h"
#include "models/study_file/provenance.h"

namespace errmap::cli {
namespace {

using Eigen::Index;
using models::WatchStatus;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

struct WatchArguments {
  std::string store;
  std::vector<std::string> data;
  std::string format = "table";
  bool quiet = false;
};

// Rows of one session, in the order of the file.
struct SessionRows {
  std::string label;
  std::vector<Index> rows;  // of the data set
};

std::vector<SessionRows> SessionsOf(const models::FittedModel& fitted,
                                    const models::MapRows& rows) {
  const std::vector<models::Moment> moments =
      models::MomentsOf(fitted, rows.table, rows.dataset.rows(), {});
  std::vector<SessionRows> sessions;
  for (std::size_t i = 0; i < moments.size(); ++i) {
    if (sessions.empty() || sessions.back().label != moments[i].session) {
      sessions.push_back({.label = moments[i].session, .rows = {}});
    }
    sessions.back().rows.push_back(static_cast<Index>(i));
  }
  return sessions;
}

std::string HashOf(const data::Dataset& dataset, const SessionRows& session) {
  data::Sha256Stream hash;
  // The same rows in another unit differ in their last bits.
  const auto add = [&](double value) {
    const auto rounded = static_cast<float>(value);
    hash.Add({reinterpret_cast<const char*>(&rounded), sizeof rounded});
  };
  hash.Add(session.label);
  for (const Index row : session.rows) {
    add(dataset.target_values()[row]);
    for (Index i = 0; i < dataset.num_inputs(); ++i) {
      add(dataset.input_values()(row, i));
    }
  }
  return data::Hexadecimal(hash.Finish());
}

// One component's new measurements by its map: what is recorded of each
// session.
class Examiner {
 public:
  Examiner(const fleet::StorePaths& paths, const fleet::Deployment& deployment)
      : fitted_(models::LoadModel(paths.Map(deployment.map))) {
    if (deployment.relations.empty()) return;
    relations_ = models::SensorRelations::FromJsonText(
        data::ReadFile(paths.Map(deployment.relations)));
  }

  const models::FittedModel& fitted() const { return fitted_; }

  std::vector<fleet::Check> Examine(const std::string& file) const {
    const models::MapRows rows = ReadMapRows(fitted_, file, {}, true);
    const RowsJudged judged = JudgeMapRows(fitted_, rows, true);
    const Eigen::VectorXd residuals =
        rows.dataset.target_values() -
        fitted_.PredictForm(judged.form_inputs).errors;
    const std::vector<const data::CsvColumn*> sensors = SensorsIn(rows.table);
    std::vector<fleet::Check> checks;
    for (const SessionRows& session : SessionsOf(fitted_, rows)) {
      fleet::Check& check = checks.emplace_back();
      check.session = Statistics(session, residuals, judged.flags);
      check.rows_sha256 = HashOf(rows.dataset, session);
      check.file = data::PrintablePath(file);
      check.p_map = kNaN;
      JudgeSensorsOf(session, rows.dataset, sensors, &check.session);
    }
    return checks;
  }

 private:
  static models::WatchedSession Statistics(
      const SessionRows& session,
      const Eigen::VectorXd& residuals,
      const std::vector<models::RowFlag>& flags) {
    const Eigen::VectorXd of_it = residuals(session.rows);
    const auto outside = std::ranges::count_if(session.rows, [&](Index row) {
      return flags[static_cast<std::size_t>(row)].outside();
    });
    const auto n = static_cast<double>(of_it.size());
    return {.label = session.label,
            .rows = of_it.size(),
            .offset = of_it.mean(),
            .mean_square = of_it.squaredNorm() / n,
            .outside_share = static_cast<double>(outside) / n,
            .sensor = "",
            .sensor_shift = kNaN,
            .p_sensor = kNaN};
  }

  // Columns of the relations; none where the file lacks one.
  std::vector<const data::CsvColumn*> SensorsIn(
      const data::CsvTable& table) const {
    std::vector<const data::CsvColumn*> sensors;
    if (!relations_) return sensors;
    for (const data::ColumnInfo& column : relations_->columns) {
      const std::ptrdiff_t found = table.Find(column.name);
      if (found < 0) return {};
      sensors.push_back(&table.At(found));
    }
    return sensors;
  }

  void JudgeSensorsOf(const SessionRows& session,
                      const data::Dataset& dataset,
                      const std::vector<const data::CsvColumn*>& sensors,
                      models::WatchedSession* found) const {
    if (sensors.empty()) return;
    Eigen::MatrixXd values(session.rows.size(), sensors.size());
    Index kept = 0;
    for (const Index row : session.rows) {
      const auto in_file = static_cast<std::size_t>(
          dataset.rows()[static_cast<std::size_t>(row)]);
      for (std::size_t i = 0; i < sensors.size(); ++i) {
        values(kept, static_cast<Index>(i)) = sensors[i]->values[in_file];
      }
      kept += values.row(kept).allFinite() ? 1 : 0;
    }
    if (kept == 0) return;
    models::JudgeSensors(*relations_,
                         models::ShiftsOf(*relations_, values.topRows(kept)),
                         found);
  }

  models::FittedModel fitted_;
  std::optional<models::SensorRelations> relations_;
};

bool HasSessionsHeldOut(const models::FittedModel& fitted) {
  return fitted.held_out != nullptr && fitted.interval &&
         fitted.interval->holdout.starts_with("sessions");
}

// New sessions after those that are known; the same ones are known already.
void Append(std::vector<fleet::Check> found,
            std::vector<fleet::Check>* checks) {
  for (fleet::Check& check : found) {
    const auto known = std::ranges::find(
        *checks, check.rows_sha256, &fleet::Check::rows_sha256);
    if (known == checks->end()) {
      checks->push_back(std::move(check));
    } else {
      *known = std::move(check);
    }
  }
}

class Watcher {
 public:
  Watcher(const WatchArguments& arguments,
          const fleet::FleetRecord& study,
          fleet::Database* store)
      : paths_{arguments.store},
        store_(*store),
        deployments_(fleet::DeploymentsInUse(store)) {
    if (deployments_.empty()) {
      throw data::InputError(
          "no map is deployed in this store; errmap deploy STORE COMPONENT "
          "does that");
    }
    const fleet::WatchedFiles files =
        fleet::FindWatchedFiles(study, deployments_, arguments.data);
    constexpr std::size_t kMostTold = 5;
    for (std::size_t i = 0; i < files.remarks.size(); ++i) {
      if (i == kMostTold) {
        Say(fmt::format("likewise {} more", files.remarks.size() - i));
        break;
      }
      Say(files.remarks[i]);
    }
    if (!files.unknown.empty() && !arguments.quiet) {
      Say(fmt::format("{} of no component with a map deployed",
                      report::Count(std::ssize(files.unknown), "file")));
    }
    if (files.files.empty()) {
      throw data::InputError(
          "no file is of a component with a map deployed: keep the names and "
          "folders of the study, or write COMPONENT=FILE");
    }
    for (const fleet::WatchedFile& file : files.files) Examine(file);
    if (known_ > 0 && !arguments.quiet) {
      Say(fmt::format(
          "{} as they were studied, not measured since: what is found of them "
          "tells nothing of another day",
          report::Count(known_, "file")));
    }
    Judge();
  }

  std::vector<fleet::WatchedComponent>& components() { return components_; }

 private:
  void Examine(const fleet::WatchedFile& file) {
    if (components_.empty() ||
        components_.back().deployment.id != file.deployment->id) {
      fleet::WatchedComponent& component = components_.emplace_back();
      component.deployment = *file.deployment;
      component.checks = fleet::ChecksOf(&store_, file.deployment->id);
    }
    fleet::WatchedComponent& component = components_.back();
    try {
      const Examiner examiner(paths_, component.deployment);
      Append(examiner.Examine(file.file), &component.checks);
      known_ += study_file::HashInput(file.file).sha256 ==
                file.deployment->data_sha256;
      component.file = file.file;
      component.examined = !component.checks.empty();
      JudgeMap(examiner.fitted(), &component);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      component.why_not = error.what();
    }
  }

  static void JudgeMap(const models::FittedModel& fitted,
                       fleet::WatchedComponent* component) {
    if (component->checks.empty()) return;
    component->found = std::sqrt(component->checks.back().session.mean_square);
    if (!HasSessionsHeldOut(fitted)) {
      component->why_not =
          "its map was not judged on whole sessions: it promises nothing for "
          "another one";
      return;
    }
    std::vector<models::WatchedSession> sessions;
    for (const fleet::Check& check : component->checks) {
      sessions.push_back(check.session);
    }
    const auto judgement = models::JudgeSessions(*fitted.held_out, sessions);
    if (!judgement) return;
    component->p_map = judgement->p;
    component->found = judgement->found;
  }

  // One family of tests: every map, and every component's sensors.
  void Judge() {
    std::vector<double> p;
    for (const fleet::WatchedComponent& component : components_) {
      if (std::isfinite(component.p_map)) p.push_back(component.p_map);
      if (const double sensor = SensorP(component); std::isfinite(sensor)) {
        p.push_back(sensor);
      }
    }
    const std::vector<double> rates = models::FalseDiscoveryRates(p);
    std::size_t next = 0;
    for (fleet::WatchedComponent& component : components_) {
      component.rate_map =
          std::isfinite(component.p_map) ? rates[next++] : kNaN;
      component.rate_sensor =
          std::isfinite(SensorP(component)) ? rates[next++] : kNaN;
      component.status = StatusOf(component);
      if (!component.examined) continue;
      component.checks.back().p_map = component.p_map;
      component.checks.back().status = component.status;
    }
  }

  static double SensorP(const fleet::WatchedComponent& component) {
    return component.examined ? component.checks.back().session.p_sensor : kNaN;
  }

  static WatchStatus StatusOf(const fleet::WatchedComponent& component) {
    if (!component.examined) return WatchStatus::kNotJudged;
    if (component.rate_map < models::kFalseDiscoveries &&
        component.found > component.deployment.promised) {
      return WatchStatus::kWorse;
    }
    if (component.rate_sensor < models::kFalseDiscoveries) {
      return WatchStatus::kSensorChanged;
    }
    if (component.checks.back().session.outside_share >
        models::kMostlyOutside) {
      return WatchStatus::kOutside;
    }
    return std::isfinite(component.p_map) ? WatchStatus::kAsPromised
                                          : WatchStatus::kNotJudged;
  }

  fleet::StorePaths paths_;
  fleet::Database& store_;
  std::vector<fleet::Deployment> deployments_;
  std::vector<fleet::WatchedComponent> components_;
  std::ptrdiff_t known_ = 0;  // files that are those of the study
};

Json NumberOrNull(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

Json WatchJson(const std::string& store,
               const std::vector<fleet::WatchedComponent>& components) {
  Json list = Json::array();
  for (const fleet::WatchedComponent& component : components) {
    Json json = {{"name", component.deployment.component},
                 {"status", ToString(component.status)},
                 {"since", component.deployment.since},
                 {"model", component.deployment.model},
                 {"sessions", component.checks.size()},
                 {"found", NumberOrNull(component.found)},
                 {"promised", NumberOrNull(component.deployment.promised)},
                 {"p_map", NumberOrNull(component.p_map)},
                 {"false_discovery_rate_map", NumberOrNull(component.rate_map)},
                 {"proposal", component.Proposal(store)}};
    if (component.examined) {
      const models::WatchedSession& newest = component.checks.back().session;
      json["session"] = newest.label;
      json["offset"] = newest.offset;
      json["outside_share"] = newest.outside_share;
      json["sensor"] = newest.sensor;
      json["sensor_shift"] = NumberOrNull(newest.sensor_shift);
      json["p_sensor"] = NumberOrNull(newest.p_sensor);
      json["false_discovery_rate_sensor"] = NumberOrNull(component.rate_sensor);
    }
    list.push_back(std::move(json));
  }
  return {{"schema", "errmap-watch-1"}, {"components", std::move(list)}};
}

std::string WatchText(const std::string& store,
                      const std::vector<fleet::WatchedComponent>& components) {
  std::map<std::string, int> counts;
  std::vector<fleet::WatchedComponent> told;
  std::string proposals;
  for (const fleet::WatchedComponent& component : components) {
    ++counts[std::string(ToString(component.status))];
    if (component.status != WatchStatus::kAsPromised) told.push_back(component);
    const std::string proposal = component.Proposal(store);
    if (proposal.empty()) continue;
    const std::string& name = component.deployment.component;
    proposals += data::Printable(name, name.size()) + ": " + proposal + "\n";
  }
  std::string text = report::Count(std::ssize(components), "component");
  for (const auto& [status, count] : counts) {
    text += fmt::format(", {} {}", count, status);
  }
  text += fmt::format(
      "; at most {:g} % of those named worse or changed are so by chance "
      "(Benjamini-Hochberg)\n",
      100.0 * models::kFalseDiscoveries);
  if (!told.empty()) text += report::TerminalTable(fleet::WatchTable(told));
  return text + proposals;
}

int RunWatch(const WatchArguments& arguments) {
  const fleet::StorePaths paths{arguments.store};
  const fleet::FleetRecord study =
      fleet::ReadFleet(paths);  // before a lock is left there
  const fleet::StoreLock lock(paths);
  fleet::Database store = fleet::OpenStore(paths);
  Watcher watcher(arguments, study, &store);
  const std::vector<fleet::WatchedComponent>& components = watcher.components();
  const std::string now = fleet::NowText();
  fleet::ChangeStore(paths, lock, [&](fleet::Database* copy) {
    for (const fleet::WatchedComponent& component : components) {
      if (!component.examined) continue;
      fleet::WriteChecks(copy, component.deployment.id, component.checks, now);
    }
  });
  data::WriteFileAtomically(paths.Watch(),
                            fleet::WatchHtml(arguments.store, components));
  if (arguments.format == "json") {
    PrintResult(DumpJson(WatchJson(arguments.store, components)));
  } else if (arguments.format == "csv") {
    PrintResult(report::CsvTable(fleet::WatchTable(components)));
  } else {
    PrintResult(WatchText(arguments.store, components));
  }
  if (std::ranges::any_of(components,
                          [](const fleet::WatchedComponent& component) {
                            return component.status == WatchStatus::kWorse;
                          })) {
    return kEveryFitFailed;
  }
  // Silence would be taken for health.
  const bool all_examined =
      std::ranges::all_of(components, &fleet::WatchedComponent::examined);
  return all_examined ? kDone : kUnusableInput;
}

}  // namespace

void AddWatchCommand(CLI::App* app, Run* run) {
  auto arguments = std::make_shared<WatchArguments>();
  CLI::App* command = app->add_subcommand(
      "watch", "Tell by new measurements which deployed maps still hold");
  command->add_option("STORE", arguments->store, "Folder with an errmap.sqlite")
      ->required()
      ->type_name("DIR");
  command
      ->add_option("DATA",
                   arguments->data,
                   "New measurements: CSV files named as those of the study, "
                   "folders of such, or COMPONENT=FILE")
      ->required()
      ->type_name("FILE|DIR");
  command
      ->add_option("--format",
                   arguments->format,
                   "What to print; csv and json have every component")
      ->check(CLI::IsMember({"table", "json", "csv"}))
      ->type_name("table|json|csv")
      ->capture_default_str();
  command->add_flag("--quiet", arguments->quiet, "No remarks on stderr");
  command->footer(
      "Each session's offset and RMS are held against the sessions held out "
      "when the map was made\n(t statistics), each sensor against what "
      "the others tell of it; over all components at most\n5 % of those named "
      "worse or changed are so by chance. Sessions are kept in the store, "
      "watch.html\ndraws them. A file is of the component whose data have its "
      "name and the most of its folders.\nExit status: 0 none is worse, 3 no "
      "store, one of a newer errmap, nothing deployed, no data of\nwhat is or "
      "data that cannot be judged, 4 some map is worse than promised.\n"
      "Example: errmap watch fleet september/");
  command->callback([arguments, run] { run->status = RunWatch(*arguments); });
}

}  // namespace errmap::cli
