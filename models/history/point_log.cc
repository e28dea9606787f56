#include "models/history/point_log.h"

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>

#include "data/measurements/sessions.h"

namespace errmap::models {
namespace {

// A row of the log or of the points.
struct Row {
  Index session = 0;  // into the labels
  double time = 0.0;
  bool is_point = false;
  Index index = 0;  // in its table
};

// The rows of both tables, and the labels of their sessions.
class Timeline {
 public:
  void Add(const data::FoundSessions& found, bool is_point, double later) {
    const bool by_column = !found.sessions.column.empty();
    for (Index i = 0; i < found.time.size(); ++i) {
      const auto code = static_cast<std::size_t>(
          found.sessions.codes[static_cast<std::size_t>(i)]);
      // Cuts by time are made anew when all rows are together.
      rows_.push_back({.session = by_column
                                      ? CodeOf(found.sessions.labels[code])
                                      : CodeOf(""),
                       .time = found.time[i] + later,
                       .is_point = is_point,
                       .index = i});
    }
    column_ = found.sessions.column;
  }

  // Cuts by time are made at pauses of a `night`, s.
  void Sort(double night) {
    KeepSessionsOfPoints();
    std::ranges::stable_sort(rows_, {}, [](const Row& row) {
      return std::tuple(row.session, row.time, row.is_point);
    });
    if (column_.empty()) CutAt(night);
  }

  const std::vector<Row>& rows() const { return rows_; }

  data::Grouping sessions() const {
    data::Grouping sessions{.column = column_, .labels = labels_, .codes = {}};
    for (const Row& row : rows_) sessions.codes.push_back(row.session);
    return sessions;
  }

 private:
  Index CodeOf(const std::string& label) {
    const auto found = std::ranges::find(labels_, label);
    if (found == labels_.end()) {
      labels_.push_back(label);
      return std::ssize(labels_) - 1;
    }
    return found - labels_.begin();
  }

  void KeepSessionsOfPoints() {
    std::vector<Index> kept(labels_.size(), -1);
    std::vector<std::string> labels;
    for (const Row& row : rows_) {
      Index& code = kept[static_cast<std::size_t>(row.session)];
      if (!row.is_point || code >= 0) continue;
      code = std::ssize(labels);
      labels.push_back(labels_[static_cast<std::size_t>(row.session)]);
    }
    labels_ = std::move(labels);
    for (Row& row : rows_) {
      row.session = kept[static_cast<std::size_t>(row.session)];
    }
    std::erase_if(rows_, [](const Row& row) { return row.session < 0; });
  }

  void CutAt(double night) {
    labels_ = {"1"};
    for (std::size_t i = 1; i < rows_.size(); ++i) {
      if (rows_[i].time - rows_[i - 1].time >= night) {
        labels_.push_back(std::to_string(labels_.size() + 1));
      }
      rows_[i].session = std::ssize(labels_) - 1;
    }
  }

  std::string column_;
  std::vector<std::string> labels_;
  std::vector<Row> rows_;
};

Timeline TimelineOf(const History& history,
                    const RowsForMap& points,
                    const RowsForMap* log,
                    const MapDataArguments& arguments) {
  Timeline timeline;
  double later = 0.0;
  if (log != nullptr) {
    timeline.Add(FindSessionsFor(history, log->table, arguments), false, later);
  }
  const data::FoundSessions found =
      FindSessionsFor(history, points.table, arguments);
  // Numbers of rows: the log comes first.
  if (log != nullptr && found.time_unit == "rows") {
    later = static_cast<double>(log->table.num_rows);
  }
  timeline.Add(found, true, later);
  timeline.Sort(history.night());
  return timeline;
}

}  // namespace

PointLog MakePointLog(const History& history,
                      const RowsForMap& points,
                      const RowsForMap* log,
                      const MapDataArguments& arguments) {
  const Timeline timeline = TimelineOf(history, points, log, arguments);
  const std::vector<Row>& rows = timeline.rows();
  const auto n = std::ssize(rows);
  auto merged = std::make_shared<data::SessionLog>();
  merged->sessions = timeline.sessions();
  merged->time_unit = history.time_unit;
  merged->time.resize(n);
  merged->input_values.resize(n, points.inputs.cols());
  PointLog result;
  result.rows.resize(points.table.num_rows);
  for (Index i = 0; i < n; ++i) {
    const Row& row = rows[static_cast<std::size_t>(i)];
    merged->time[i] = row.time;
    merged->input_values.row(i) =
        (row.is_point ? points.inputs : log->inputs).row(row.index);
    if (row.is_point) result.rows[static_cast<std::size_t>(row.index)] = i;
  }
  merged->first_rows = data::FirstRows(
      merged->sessions, merged->input_values(Eigen::all, history.remembered()));
  const std::vector<Missing> missing =
      FindMissing(*merged, history, arguments.from_rest);
  for (const Index row : result.rows) {
    result.missing.push_back(missing[static_cast<std::size_t>(row)]);
  }
  result.log = std::move(merged);
  return result;
}

}  // namespace errmap::models
