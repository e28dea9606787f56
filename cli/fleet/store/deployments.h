#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "data/files/sqlite.h"
#include "models/fleet/watch.h"

namespace errmap::fleet {

using data::Database;
using data::SqliteError;
using data::Statement;

/// A map deployed on a machine.
struct Deployment {
  std::int64_t id = 0;
  std::string component = {};
  std::string data = {};  // of the component, below the study file's folder
  std::string data_sha256 = {};  // as they were studied last
  std::string since = {};
  std::string map = {};        // SHA-256
  std::string model = {};      // SPEC
  std::string relations = {};  // SHA-256; "": none
  double promised = 0.0;       // RMSE, target's unit; NaN: nothing
  double within_95 = 0.0;
  std::string shown_unit = {};
  double shown_scale = 1.0;
};

/// Returns the current deployments by component, or only that of a named
/// component.
std::vector<Deployment> DeploymentsInUse(Database* store,
                                         const std::string& component = "");

/// Ends the component's current deployment and begins this one.
void WriteDeployment(Database* store, const Deployment& deployment);

/// A session since a map's deployment, with the result of its check.
struct Check {
  models::WatchedSession session;
  std::string rows_sha256;
  std::string begins_sha256 = {};  // of its first row
  std::string file;
  double p_map = 0.0;  // NaN: not judged
  models::WatchStatus status = models::WatchStatus::kNotJudged;

  /// True if `part` is the beginning of this session, which has gone on since.
  bool GoesOnFrom(const Check& part) const {
    return !begins_sha256.empty() && begins_sha256 == part.begins_sha256 &&
           session.rows > part.session.rows;
  }
};

/// Returns the sessions checked so far, oldest first.
std::vector<Check> ChecksOf(Database* store, std::int64_t deployment);

/// Adds checks. A check replaces an earlier one of the same rows, or of the
/// beginning of the same session.
void WriteChecks(Database* store,
                 std::int64_t deployment,
                 const std::vector<Check>& checks,
                 const std::string& at);

/// Returns the current time, UTC: "2026-03-31T08:15:00Z".
std::string NowText();

}  // namespace errmap::fleet
