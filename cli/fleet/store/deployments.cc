#include "cli/fleet/store/deployments.h"

#include <array>
#include <ctime>

namespace errmap::fleet {
namespace {

std::optional<std::string> NullIfEmpty(const std::string& text) {
  if (text.empty()) return std::nullopt;
  return text;
}

}  // namespace

std::vector<Deployment> DeploymentsInUse(Database* store,
                                         const std::string& component) {
  Statement rows = store->Prepare(
      "SELECT id, component, data, since, map, model, relations, promised, "
      "within_95, shown_unit, shown_scale, sha256 FROM deployments JOIN "
      "components ON name = component WHERE until IS NULL AND (?1 = '' OR ?1 = "
      "component) ORDER BY component");
  rows.With(component);
  std::vector<Deployment> found;
  while (rows.Next()) {
    found.push_back({.id = rows.Whole(0),
                     .component = rows.Text(1),
                     .data = rows.Text(2),
                     .data_sha256 = rows.Text(11),
                     .since = rows.Text(3),
                     .map = rows.Text(4),
                     .model = rows.Text(5),
                     .relations = rows.Text(6),
                     .promised = rows.Number(7),
                     .within_95 = rows.Number(8),
                     .shown_unit = rows.Text(9),
                     .shown_scale = rows.Number(10)});
  }
  return found;
}

void WriteDeployment(Database* store, const Deployment& deployment) {
  store
      ->Prepare(
          "UPDATE deployments SET until = ? WHERE component = ? AND until IS "
          "NULL")
      .With(deployment.since, deployment.component)
      .Run();
  store
      ->Prepare(
          "INSERT INTO deployments (component, since, map, model, relations, "
          "promised, within_95) VALUES (?,?,?,?,?,?,?)")
      .With(deployment.component,
            deployment.since,
            deployment.map,
            deployment.model,
            NullIfEmpty(deployment.relations),
            deployment.promised,
            deployment.within_95)
      .Run();
}

std::vector<Check> ChecksOf(Database* store, std::int64_t deployment) {
  Statement rows = store->Prepare(
      "SELECT session, rows, offset, mean_square, outside_share, sensor, "
      "sensor_shift, p_sensor, rows_sha256, file, p_map, status, "
      "begins_sha256, expected_offset, expected_square, expected_log_square, "
      "expected_log_spread FROM checks "
      "WHERE deployment = ? ORDER BY number");
  rows.With(deployment);
  std::vector<Check> found;
  while (rows.Next()) {
    const models::WatchStatus status = models::WatchStatusNamed(rows.Text(11));
    found.push_back(
        {.session = {.label = rows.Text(0),
                     .rows = rows.Whole(1),
                     .offset = rows.Number(2),
                     .mean_square = rows.Number(3),
                     .expected = {.offset = rows.Number(13),
                                  .square = rows.Number(14),
                                  .log_square = rows.Number(15),
                                  .log_spread = rows.Number(16)},
                     .too_few = status == models::WatchStatus::kTooFewRows,
                     .outside_share = rows.Number(4),
                     .sensor = rows.Text(5),
                     .sensor_shift = rows.Number(6),
                     .p_sensor = rows.Number(7)},
         .rows_sha256 = rows.Text(8),
         .begins_sha256 = rows.Text(12),
         .file = rows.Text(9),
         .p_map = rows.Number(10),
         .status = status});
  }
  return found;
}

void WriteChecks(Database* store,
                 std::int64_t deployment,
                 const std::vector<Check>& checks,
                 const std::string& at) {
  Statement insert = store->Prepare(
      "INSERT INTO checks VALUES (?1, ?2, (SELECT ifnull(max(number), 0) + 1 "
      "FROM checks WHERE deployment = ?1), ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, "
      "?11, ?12, ?13, ?14, ?15, ?16, ?17, ?18, ?19) ON CONFLICT (deployment, "
      "rows_sha256) DO UPDATE SET at = excluded.at, p_map = excluded.p_map, "
      "status = excluded.status, begins_sha256 = excluded.begins_sha256, "
      "expected_offset = excluded.expected_offset, "
      "expected_square = excluded.expected_square, "
      "expected_log_square = excluded.expected_log_square, "
      "expected_log_spread = excluded.expected_log_spread");
  Statement forget = store->Prepare(
      "DELETE FROM checks WHERE deployment = ? AND begins_sha256 = ? AND rows "
      "< ?");
  for (const Check& check : checks) {
    forget
        .With(deployment,
              check.begins_sha256,
              static_cast<std::int64_t>(check.session.rows))
        .Run();
    insert
        .With(deployment,
              check.rows_sha256,
              check.session.label,
              check.file,
              at,
              static_cast<std::int64_t>(check.session.rows),
              check.session.offset,
              check.session.mean_square,
              check.session.outside_share,
              check.session.sensor,
              check.session.sensor_shift,
              check.session.p_sensor,
              check.p_map,
              ToString(check.status),
              NullIfEmpty(check.begins_sha256),
              check.session.expected.offset,
              check.session.expected.square,
              check.session.expected.log_square,
              check.session.expected.log_spread)
        .Run();
  }
}

std::string NowText() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text.data();
}

}  // namespace errmap::fleet
