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

/// A map on a machine.
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

/// Those in use, by component; of one component where it is named.
std::vector<Deployment> DeploymentsInUse(Database* store,
                                         const std::string& component = "");

/// Ends what is in use on the component and begins this.
void WriteDeployment(Database* store, const Deployment& deployment);

/// A session of a deployment with what was found of it.
struct Check {
  models::WatchedSession session;
  std::string rows_sha256;
  std::string begins_sha256 = {};  // of its first row
  std::string file;
  double p_map = 0.0;  // NaN: not judged
  models::WatchStatus status = models::WatchStatus::kNotJudged;

  /// Whether this is the session of `part` when more of it was measured.
  bool GoesOnFrom(const Check& part) const {
    return !begins_sha256.empty() && begins_sha256 == part.begins_sha256 &&
           session.rows > part.session.rows;
  }
};

/// The sessions checked so far, oldest first.
std::vector<Check> ChecksOf(Database* store, std::int64_t deployment);

/// Adds checks, or puts them in the place of those of the same rows, and of
/// those that they go on from.
void WriteChecks(Database* store,
                 std::int64_t deployment,
                 const std::vector<Check>& checks,
                 const std::string& at);

/// This moment, UTC: "2026-03-31T08:15:00Z".
std::string NowText();

}  // namespace errmap::fleet
