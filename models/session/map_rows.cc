#include "models/session/map_rows.h"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "data/measurements/column_checks.h"
#include "data/measurements/row_filters.h"
#include "data/measurements/sessions.h"
#include "models/history/rows_made_for.h"
#include "stats/indices.h"

namespace errmap::models {
namespace {

data::DatasetSelection SelectionFor(const FittedModel& fitted,
                                    const data::CsvTable& table,
                                    const MapRowsOptions& options) {
  data::DatasetSelection selection{
      .target = fitted.target.name,
      .inputs = {},
      .exclude = {},
      .group = "",
      .time = options.log.time,
      .session = options.log.session,
      .weight = "",
      .align = fitted.align,
      .missing = options.missing,
      .faults = options.faults,
      .keep_dead = true,
      .where = FiltersFor(fitted, table),
      .only_to_judge = true,
      .with_log = fitted.align != data::Alignment::kNone};
  for (const TrainedInput& input : fitted.inputs) {
    selection.inputs.push_back(input.column.name);
  }
  return selection;
}

data::Dataset WithMapLog(const data::Dataset& dataset, const MapLog& map) {
  if (map.log == nullptr) return dataset;
  std::vector<Index> log_rows;
  for (const Index row : dataset.rows()) {
    log_rows.push_back(map.first_row + row);
  }
  return dataset.WithLog(map.log, std::move(log_rows));
}

}  // namespace

std::string MadeForText(const FittedModel& fitted,
                        const data::CsvTable& table) {
  const std::vector<bool> made_for = RowsMadeFor(fitted, table);
  const auto count = std::ranges::count(made_for, true);
  if (count == std::ssize(made_for)) return "";
  return fmt::format("{} of {} rows have {}, for which the map is made",
                     count,
                     made_for.size(),
                     data::FiltersText(FiltersFor(fitted, table)));
}

MomentsOfRows MomentsOf(const FittedModel& fitted,
                        const data::CsvTable& table,
                        const std::vector<Index>& rows,
                        const MapDataArguments& arguments) {
  const data::FoundSessions found = data::FindSessions(
      table, SelectionOfRows(fitted.history.get(), table, arguments), rows);
  const bool has_times = found.time_column >= 0;
  MomentsOfRows moments{
      .at = {}, .session_column = found.sessions.column, .dated = {}};
  if (has_times) moments.dated = found.dated;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto session = static_cast<std::size_t>(found.sessions.codes[i]);
    moments.at.push_back(
        {.session = found.sessions.labels[session],
         .time = has_times ? found.time[static_cast<Index>(i)] : 0.0});
  }
  return moments;
}

VectorXd ElapsedSinceStart(const FittedModel& fitted,
                           const MapRows& rows,
                           const MapDataArguments& arguments) {
  const std::vector<Index> all =
      stats::AllIndices(static_cast<Index>(rows.table.num_rows));
  const std::vector<Moment> moments =
      MomentsOf(fitted, rows.table, all, arguments).at;
  std::map<std::string, double> start;
  const auto begin = [&](const std::string& session, double time) {
    const auto [at, is_new] = start.try_emplace(session, time);
    if (!is_new) at->second = std::min(at->second, time);
  };
  for (const Moment& moment : moments) {
    begin(moment.session, moment.time);
  }
  // The log of a map with a memory holds the rows before these, too.
  if (const data::SessionLog* log = rows.dataset.log().get();
      log != nullptr && log->time_unit == "s") {
    for (std::size_t row = 0; row < log->sessions.codes.size(); ++row) {
      const auto session = static_cast<std::size_t>(log->sessions.codes[row]);
      begin(log->sessions.labels[session], log->time[static_cast<Index>(row)]);
    }
  }
  VectorXd elapsed(rows.dataset.num_rows());
  for (Index i = 0; i < elapsed.size(); ++i) {
    const Index row = rows.dataset.rows()[static_cast<std::size_t>(i)];
    const Moment& moment = moments[static_cast<std::size_t>(row)];
    elapsed[i] = moment.time - start.at(moment.session);
  }
  return elapsed;
}

VectorXd PositionsOf(const FittedModel& fitted, const MapRows& rows) {
  if (fitted.held_out == nullptr) return {};
  const std::string& name = fitted.held_out->position;
  const std::ptrdiff_t column = name.empty() ? -1 : rows.table.Find(name);
  if (column < 0) return {};
  const VectorXd positions =
      data::ValuesOfRows(rows.table.At(column), rows.dataset.rows());
  return positions.allFinite() ? positions : VectorXd{};
}

MapRows MakeMapRows(const FittedModel& fitted,
                    data::CsvTable table,
                    const MapRowsOptions& options) {
  data::PreparedDataset prepared =
      data::MakeDataset(table, SelectionFor(fitted, table, options));
  if (std::string made_for = MadeForText(fitted, table); !made_for.empty()) {
    prepared.remarks.push_back(std::move(made_for));
  }
  MapLog map =
      options.with_memory ? MakeMapLog(fitted, table, options.log) : MapLog{};
  data::Dataset dataset = WithMapLog(prepared.dataset, map);
  Missing missing = Missing::kNothing;
  std::vector<Missing> missing_before(
      static_cast<std::size_t>(dataset.num_rows()), Missing::kNothing);
  if (map.log != nullptr) {
    std::size_t at = 0;
    for (const Index row : dataset.log_rows()) {
      const Missing here = map.missing[static_cast<std::size_t>(row)];
      missing_before[at++] = here;
      if (here == Missing::kStart || missing == Missing::kNothing) {
        missing = here;
      }
    }
  }
  return {.table = std::move(table),
          .prepared = std::move(prepared),
          .dataset = std::move(dataset),
          .missing = missing,
          .missing_before = std::move(missing_before),
          .warnings = std::move(map.warnings)};
}

}  // namespace errmap::models
