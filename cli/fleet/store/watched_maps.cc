#include "cli/fleet/store/watched_maps.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <new>
#include <optional>
#include <utility>

#include "data/atomic_file.h"
#include "data/sha256.h"
#include "data/text.h"
#include "models/model_file.h"
#include "models/promise/applicability.h"
#include "models/promise/map_rows.h"

namespace errmap::fleet {
namespace {

using Eigen::Index;
using models::WatchStatus;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

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
  Examiner(const StorePaths& paths, const Deployment& deployment)
      : fitted_(models::LoadModel(paths.Map(deployment.map))) {
    if (deployment.relations.empty()) return;
    relations_ = models::SensorRelations::FromJsonText(
        data::ReadFile(paths.Map(deployment.relations)));
  }

  const models::FittedModel& fitted() const { return fitted_; }

  std::vector<Check> Examine(const std::string& file) const {
    const models::MapRows rows = models::MakeMapRows(
        fitted_,
        models::ReadForMap(fitted_, file, models::MapColumns::kInputsAndTarget)
            .table,
        {});
    const Eigen::MatrixXd form_inputs = fitted_.FormInputs(rows.dataset);
    const std::vector<models::RowFlag> flags =
        models::FlagRows(fitted_, rows.dataset.input_values(), form_inputs);
    const Eigen::VectorXd residuals =
        rows.dataset.target_values() - fitted_.PredictForm(form_inputs).errors;
    const std::vector<const data::CsvColumn*> sensors = SensorsIn(rows.table);
    std::vector<Check> checks;
    for (const SessionRows& session : SessionsOf(fitted_, rows)) {
      Check& check = checks.emplace_back();
      check.session = Statistics(session, residuals, flags);
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
void Append(std::vector<Check> found, std::vector<Check>* checks) {
  for (Check& check : found) {
    const auto known =
        std::ranges::find(*checks, check.rows_sha256, &Check::rows_sha256);
    if (known == checks->end()) {
      checks->push_back(std::move(check));
    } else {
      *known = std::move(check);
    }
  }
}

class Watcher {
 public:
  Watcher(const StorePaths& paths, Database* store)
      : paths_(paths), store_(*store) {}

  WatchedMaps Watch(const std::vector<WatchedFile>& files) {
    for (const WatchedFile& file : files) Examine(file);
    Judge();
    return std::move(found_);
  }

 private:
  void Examine(const WatchedFile& file) {
    if (found_.components.empty() ||
        found_.components.back().deployment.id != file.deployment->id) {
      WatchedComponent& component = found_.components.emplace_back();
      component.deployment = *file.deployment;
      component.checks = ChecksOf(&store_, file.deployment->id);
    }
    WatchedComponent& component = found_.components.back();
    try {
      const Examiner examiner(paths_, component.deployment);
      Append(examiner.Examine(file.file), &component.checks);
      found_.as_studied += data::Sha256(data::ReadFile(file.file)) ==
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
                       WatchedComponent* component) {
    if (component->checks.empty()) return;
    component->found = std::sqrt(component->checks.back().session.mean_square);
    if (!HasSessionsHeldOut(fitted)) {
      component->why_not =
          "its map was not judged on whole sessions: it promises nothing for "
          "another one";
      return;
    }
    std::vector<models::WatchedSession> sessions;
    for (const Check& check : component->checks) {
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
    for (const WatchedComponent& component : found_.components) {
      if (std::isfinite(component.p_map)) p.push_back(component.p_map);
      if (const double sensor = SensorP(component); std::isfinite(sensor)) {
        p.push_back(sensor);
      }
    }
    const std::vector<double> rates = models::FalseDiscoveryRates(p);
    std::size_t next = 0;
    for (WatchedComponent& component : found_.components) {
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

  static double SensorP(const WatchedComponent& component) {
    return component.examined ? component.checks.back().session.p_sensor : kNaN;
  }

  static WatchStatus StatusOf(const WatchedComponent& component) {
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

  const StorePaths& paths_;
  Database& store_;
  WatchedMaps found_;
};

}  // namespace

WatchedMaps WatchMaps(const StorePaths& paths,
                      Database* store,
                      const std::vector<WatchedFile>& files) {
  return Watcher(paths, store).Watch(files);
}

}  // namespace errmap::fleet
