#include "cli/fleet/store/watched_maps.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>
#include <optional>
#include <span>
#include <utility>

#include "data/files/atomic_file.h"
#include "data/sha256.h"
#include "data/text.h"
#include "models/fleet/watch.h"
#include "models/model_file.h"
#include "models/session/map_rows.h"
#include "models/study/study_defaults.h"

namespace errmap::fleet {
namespace {

using models::WatchStatus;

// Of the session's first `count` rows.
std::string HashOf(const data::Dataset& dataset,
                   const models::MeasuredSession& session,
                   std::size_t count) {
  data::Sha256Stream hash;
  // The same rows in another unit differ in their last bits.
  const auto add = [&](double value) {
    const auto rounded = static_cast<float>(value);
    hash.Add({reinterpret_cast<const char*>(&rounded), sizeof rounded});
  };
  hash.Add(session.session.label);
  for (const Index row : std::span(session.rows).first(count)) {
    add(dataset.target_values()[row]);
    for (Index i = 0; i < dataset.num_inputs(); ++i) {
      add(dataset.input_values()(row, i));
    }
  }
  return data::Hexadecimal(hash.Finish());
}

// What is recorded of each session of a file of new measurements.
std::vector<Check> ChecksIn(const std::string& file,
                            const models::FittedModel& fitted,
                            const models::SensorRelations* relations) {
  const models::MapRows rows = models::MakeMapRows(
      fitted,
      models::ReadForMap(
          fitted, {file}, models::MapColumns::kInputsAndTarget, {})
          .table,
      {});
  std::vector<Check> checks;
  for (const models::MeasuredSession& measured :
       models::MeasureSessions(fitted, rows, relations)) {
    checks.push_back(
        {.session = measured.session,
         .rows_sha256 = HashOf(rows.dataset, measured, measured.rows.size()),
         .begins_sha256 = HashOf(rows.dataset, measured, 1),
         .file = data::PrintablePath(file),
         .p_map = stats::kNaN});
  }
  return checks;
}

// New sessions after those that are known. The same one is known already; one
// that went on since takes the place of its part.
void Append(std::vector<Check> found, std::vector<Check>* checks) {
  for (Check& check : found) {
    const auto known = std::ranges::find_if(*checks, [&](const Check& old) {
      return old.rows_sha256 == check.rows_sha256 || check.GoesOnFrom(old);
    });
    if (known == checks->end()) {
      checks->push_back(std::move(check));
    } else {
      *known = std::move(check);
    }
  }
}

void JudgeMap(const models::FittedModel& fitted, WatchedComponent* component) {
  if (component->checks.empty()) return;
  const models::WatchedSession& newest = component->checks.back().session;
  component->found = std::sqrt(newest.mean_square);
  component->indifference = models::DefaultIndifference(fitted.target.unit);
  component->why_not = models::WhyNotWatched(fitted);
  if (!component->why_not.empty()) return;
  if (newest.begins_inside) {
    component->why_not =
        "its log begins inside the session, which the map's memory "
        "needs from the start: give all readings since then";
    return;
  }
  std::vector<models::WatchedSession> sessions;
  for (const Check& check : component->checks) {
    sessions.push_back(check.session);
  }
  component->judgement = models::JudgeSessions(*fitted.held_out, sessions);
  if (!component->judgement) return;
  component->p_map = component->judgement->p;
  component->found = component->judgement->found;
}

void ExamineFile(const StorePaths& paths,
                 Database* store,
                 const WatchedFile& file,
                 WatchedMaps* all) {
  if (all->components.empty() ||
      all->components.back().deployment.id != file.deployment->id) {
    WatchedComponent& component = all->components.emplace_back();
    component.deployment = *file.deployment;
    component.checks = ChecksOf(store, file.deployment->id);
  }
  WatchedComponent& component = all->components.back();
  try {
    const Deployment& deployment = component.deployment;
    const models::FittedModel fitted =
        models::LoadModel(paths.Map(deployment.map));
    std::optional<models::SensorRelations> relations;
    if (!deployment.relations.empty()) {
      relations = models::SensorRelations::FromJsonText(
          data::ReadFile(paths.Map(deployment.relations)));
    }
    std::vector<Check> found =
        ChecksIn(file.file, fitted, relations ? &*relations : nullptr);
    component.file_sessions = std::ssize(found);
    Append(std::move(found), &component.checks);
    all->as_studied +=
        data::Sha256(data::ReadFile(file.file)) == file.deployment->data_sha256;
    component.file = file.file;
    component.examined = !component.checks.empty();
    JudgeMap(fitted, &component);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    component.why_not = error.what();
  }
}

// By the component alone: what is found of it does not depend on who else is
// watched.
WatchStatus StatusOf(const WatchedComponent& component) {
  if (!component.examined) return WatchStatus::kNotJudged;
  const models::WatchedSession& newest = component.checks.back().session;
  if (newest.begins_inside) return WatchStatus::kNotJudged;
  if (newest.too_few) return WatchStatus::kTooFewRows;
  if (const auto& judgement = component.judgement) {
    if (IsWorse(*judgement, component.indifference)) return WatchStatus::kWorse;
    if (IsDoubtful(*judgement, component.indifference)) {
      return WatchStatus::kDoubtful;
    }
  }
  if (newest.p_sensor < models::kSurelyChanged) {
    return WatchStatus::kSensorChanged;
  }
  if (newest.outside_share > models::kMostlyOutside) {
    return WatchStatus::kOutside;
  }
  return std::isfinite(component.p_map) ? WatchStatus::kAsPromised
                                        : WatchStatus::kNotJudged;
}

}  // namespace

WatchedMaps WatchMaps(const StorePaths& paths,
                      Database* store,
                      const std::vector<WatchedFile>& files) {
  WatchedMaps all;
  for (const WatchedFile& file : files) ExamineFile(paths, store, file, &all);
  for (WatchedComponent& component : all.components) {
    component.status = StatusOf(component);
    if (!component.examined) continue;
    component.checks.back().p_map = component.p_map;
    component.checks.back().status = component.status;
  }
  return all;
}

}  // namespace errmap::fleet
