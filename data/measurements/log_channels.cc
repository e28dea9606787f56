#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "data/column_header.h"
#include "data/columns.h"
#include "data/measurements/clock/text_times.h"
#include "data/measurements/column_roles.h"
#include "data/measurements/merged_log.h"
#include "data/text.h"

namespace errmap::data {
namespace {

using Eigen::Index;

constexpr std::size_t kMostChannels = 64;
constexpr std::size_t kFewestOfEach = 3;

class PartFinder {
 public:
  PartFinder(const CsvTable& log,
             const Eigen::VectorXd& time,
             const std::vector<bool>& known)
      : log_(log) {
    std::vector<std::pair<double, Index>> in_order;
    std::set<double> moments;
    for (Index row = 0; row < time.size(); ++row) {
      if (!known[row]) continue;
      in_order.emplace_back(time[row], row);
      moments.insert(time[row]);
    }
    std::ranges::stable_sort(in_order, {}, &std::pair<double, Index>::first);
    for (const auto& [at, row] : in_order) rows_.push_back(row);
    num_moments_ = moments.size();
  }

  std::vector<LogPart> Find(const std::vector<std::ptrdiff_t>& clock) {
    for (std::size_t i = 0; i < log_.columns.size(); ++i) {
      const CsvColumn& column = log_.columns[i];
      if (std::ranges::count(clock, static_cast<std::ptrdiff_t>(i)) == 0 &&
          !KeepsRecord(column) && !HoldsTimes(column) &&
          !CountsRows(TakeRows(column, rows_))) {
        columns_.push_back(i);
      }
    }
    for (const std::size_t i : columns_) {
      if (std::vector<LogPart> parts = PartsBy(i); !parts.empty()) return parts;
    }
    LogPart all{.rows = rows_};
    for (const std::size_t i : columns_) {
      all.columns.push_back({.column = i, .name = log_.columns[i].name});
    }
    return {std::move(all)};
  }

 private:
  // A part for each label of a column that tells channels, else nothing: the
  // moments come again, once for each channel, or the label changes with most
  // rows, as that of a state does not.
  std::vector<LogPart> PartsBy(std::size_t column) const {
    const std::optional<std::size_t> value = ValueBeside(column);
    const LabelsOfRows found =
        LabelsOf(log_, log_.columns[column], rows_, kMostChannels);
    const std::size_t num = found.labels.size();
    const bool is_text = log_.columns[column].is_text();
    if (!value || num < (is_text ? 1U : 2U) || num > kMostChannels) return {};
    std::vector<LogPart> parts(num);
    std::size_t changes = 0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      parts[found.codes[i]].rows.push_back(rows_[i]);
      changes += i > 0 && found.codes[i] != found.codes[i - 1] ? 1 : 0;
    }
    const bool comes_again = 4 * num_moments_ <= 3 * rows_.size();
    if (num < 2 || !(comes_again || (is_text && 2 * changes > rows_.size())) ||
        std::ranges::any_of(parts, [](const LogPart& part) {
          return part.rows.size() < kFewestOfEach;
        })) {
      return {};
    }
    for (std::size_t k = 0; k < num; ++k) {
      parts[k].columns.push_back(
          {.column = *value,
           .name = NameOfChannel(column, found.labels[k], *value, parts[k])});
    }
    return parts;
  }

  // The only column of numbers beside one that might tell channels: words, or
  // whole numbers without a unit.
  std::optional<std::size_t> ValueBeside(std::size_t column) const {
    const CsvColumn& labels = log_.columns[column];
    if (!labels.is_text() && !UnitOfColumn(labels.name).symbol.empty())
      return {};
    if (!labels.is_text() &&
        !std::ranges::all_of(std::vector<double>(labels.values),
                             [](double v) { return v == std::floor(v); })) {
      return {};
    }
    std::optional<std::size_t> value;
    for (const std::size_t i : columns_) {
      if (i == column || log_.columns[i].is_text()) continue;
      if (value) return {};
      value = i;
    }
    return value;
  }

  // In the unit of the values, or of a column of units.
  std::string NameOfChannel(std::size_t column,
                            const std::string& label,
                            std::size_t value,
                            const LogPart& part) const {
    const Header header = ReadHeader(log_.columns[value].name);
    std::string name =
        log_.columns[column].is_text() ? label : header.base + " " + label;
    if (ReadHeader(name).source == UnitSource::kStated) return name;
    std::string unit = header.unit_text;
    for (const std::size_t i : columns_) {
      if (i == column || !log_.columns[i].is_text()) continue;
      const std::string& text = log_.CellText(
          log_.columns[i], static_cast<std::size_t>(part.rows.front()));
      if (ReadHeader("x [" + text + "]").source == UnitSource::kStated) {
        unit = text;
      }
    }
    if (!unit.empty()) name += " [" + unit + "]";
    return name;
  }

  const CsvTable& log_;
  std::vector<Index> rows_;  // in order of time
  std::size_t num_moments_ = 0;
  std::vector<std::size_t> columns_;
};

}  // namespace

std::vector<LogPart> PartsOfLog(const CsvTable& log,
                                const Eigen::VectorXd& time,
                                const std::vector<bool>& known,
                                const std::vector<std::ptrdiff_t>& clock) {
  return PartFinder(log, time, known).Find(clock);
}

}  // namespace errmap::data
