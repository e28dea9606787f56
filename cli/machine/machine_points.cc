#include "cli/machine/machine_points.h"

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "cli/report/number_text.h"
#include "data/argument_name.h"
#include "data/column_header.h"
#include "data/input_error.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/column_match.h"
#include "data/measurements/dataset.h"
#include "data/text.h"
#include "models/history/point_log.h"
#include "models/map_experience.h"
#include "models/trained_range.h"
#include "stats/distributions.h"
#include "stats/not_a_number.h"

namespace errmap::machine {
namespace {

using data::QuotedName;
using models::ErrorSource;
using models::FittedModel;

// What a map says at every point, in the chain's unit.
struct MapAtPoints {
  VectorXd values;
  double half_width = 0.0;
  double degrees_of_freedom = std::numeric_limits<double>::infinity();
  std::vector<bool> outside;
};

// The column of that name, or else the only one that has it in another unit of
// the same quantity.
std::string ColumnOf(const data::CsvTable& table, const std::string& wanted) {
  if (table.Find(wanted) >= 0) return wanted;
  const data::Header header = data::ReadHeader(wanted);
  std::vector<std::string> found;
  std::vector<std::string> names;
  for (const data::CsvColumn& column : table.columns) {
    names.push_back(column.name);
    const data::Header other = data::ReadHeader(column.name);
    if (data::EqualsIgnoringCase(other.base, header.base) &&
        data::AreConvertible(other.unit, header.unit)) {
      found.push_back(column.name);
    }
  }
  if (found.size() == 1) return found.front();
  throw data::InputError(fmt::format(
      "{}: no column {}, which is a link's coordinate; the columns are {}",
      data::PrintablePath(table.file),
      QuotedName(wanted),
      data::ListOfNames(names)));
}

// The values of a coordinate in `unit`. A name without a unit has it.
VectorXd ColumnIn(const data::Unit& unit,
                  const data::CsvTable& table,
                  const std::string& wanted) {
  const std::string column = ColumnOf(table, wanted);
  VectorXd values = data::NumericColumn(table, column);
  const data::Unit found = data::UnitOfColumn(column);
  if (found.symbol.empty()) return values;
  if (!data::AreConvertible(found, unit)) {
    throw data::InputError(fmt::format(
        "{}: column {} is in {}, and a coordinate or position is in {} here; "
        "rename the column with its unit, or add another",
        data::PrintablePath(table.file),
        QuotedName(column),
        found.symbol,
        unit.symbol));
  }
  return values.unaryExpr(
      [&](double value) { return data::Converted(value, found, unit); });
}

class MachineEvaluator {
 public:
  MachineEvaluator(const models::Machine& machine,
                   const data::CsvTable& points,
                   const data::CsvTable* log,
                   const models::MapDataArguments& arguments)
      : machine_(machine), points_(points), log_(log), arguments_(arguments) {}

  MachinePoints Evaluate() {
    MachinePoints result;
    result.coordinates = Coordinates();
    for (std::size_t k = 0; k < machine_.errors.size(); ++k) {
      const models::KinematicChain::ErrorPlace& place =
          machine_.chain.errors()[k];
      try {
        AddComponent(machine_.errors[k], place, &result);
      } catch (const data::InputError& error) {
        throw data::InputError(
            fmt::format("{} ({})", error.what(), NameOf(machine_.errors[k])));
      }
    }
    if (!has_maps_) {
      for (models::ComponentAtPoints& component : result.components) {
        component.half_widths.setConstant(stats::kNaN);
      }
      remarks_.emplace_back(
          "no intervals: the machine has constants alone, which state no "
          "uncertainty");
    }
    if (num_with_memory_ > 0 && log_ == nullptr) {
      remarks_.push_back(fmt::format(
          "warning: {} with a memory ran through the points alone; give the "
          "day's temperatures so far with {}",
          report::Count(num_with_memory_, "map"),
          data::ArgumentName("after")));
    }
    result.remarks = std::move(remarks_);
    return result;
  }

 private:
  // "EXX of down.json, up.json"
  static std::string NameOf(const models::MachineError& error) {
    std::vector<std::string> files;
    for (const ErrorSource& source : error.sources) {
      if (source.map != nullptr) {
        files.push_back(data::PrintablePath(source.file));
      }
    }
    if (files.empty()) return error.name;
    return fmt::format("{} of {}", error.name, data::JoinWords(files, ", "));
  }

  MatrixXd Coordinates() const {
    MatrixXd coordinates(static_cast<Index>(points_.num_rows),
                         machine_.chain.num_coordinates());
    Index column = 0;
    for (const models::KinematicLink& link : machine_.chain.links()) {
      if (link.joint == models::Joint::kFixed) continue;
      const data::Unit unit = link.joint == models::Joint::kRotary
                                  ? data::UnitOfSymbol("rad")
                                  : machine_.length;
      coordinates.col(column) = ColumnIn(
          unit, points_, machine_.columns[static_cast<std::size_t>(column)]);
      ++column;
    }
    return coordinates;
  }

  // The column of the link's coordinate, "" of a fixed one.
  std::string CoordinateOf(Index link) const {
    std::size_t moving = 0;
    for (Index i = 0; i < link; ++i) {
      moving += JointOf(i) != models::Joint::kFixed ? 1 : 0;
    }
    return JointOf(link) == models::Joint::kFixed ? ""
                                                  : machine_.columns[moving];
  }

  models::Joint JointOf(Index link) const {
    return machine_.chain.links()[static_cast<std::size_t>(link)].joint;
  }

  void AddComponent(const models::MachineError& error,
                    const models::KinematicChain::ErrorPlace& place,
                    MachinePoints* result) {
    const std::string coordinate = CoordinateOf(place.link);
    const data::Unit unit = models::UnitOf(machine_, place.direction);
    std::vector<MapAtPoints> by_source;
    for (const ErrorSource& source : error.sources) {
      by_source.push_back(At(source, coordinate, unit));
    }
    const auto m = static_cast<Index>(points_.num_rows);
    const std::vector<std::size_t> chosen =
        by_source.size() == 1 ? std::vector<std::size_t>(points_.num_rows)
                              : Directions(coordinate);
    models::ComponentAtPoints component{VectorXd(m), VectorXd(m)};
    std::vector<bool> outside(points_.num_rows);
    for (Index row = 0; row < m; ++row) {
      const auto at = static_cast<std::size_t>(row);
      const MapAtPoints& source = by_source[chosen[at]];
      component.values[row] = source.values[row];
      component.half_widths[row] = source.half_width;
      outside[at] = source.outside[at];
    }
    for (const MapAtPoints& source : by_source) {
      component.degrees_of_freedom =
          std::min(component.degrees_of_freedom, source.degrees_of_freedom);
    }
    result->components.push_back(std::move(component));
    result->outside.push_back(std::move(outside));
  }

  // 0 forward, 1 reverse, per point.
  std::vector<std::size_t> Directions(const std::string& coordinate) const {
    const std::string name = models::DirectionColumn(coordinate);
    if (points_.Find(name) < 0) {
      throw data::InputError(fmt::format(
          "{}: no column {} of forward or reverse, which a pair of maps needs",
          data::PrintablePath(points_.file),
          QuotedName(name)));
    }
    const data::CsvColumn& column = points_.At(points_.Find(name));
    std::vector<std::size_t> directions;
    for (std::size_t row = 0; row < points_.num_rows; ++row) {
      const std::string text = points_.CellText(column, row);
      if (text != "forward" && text != "reverse") {
        throw data::InputError(
            fmt::format("{}: {} is neither forward nor "
                        "reverse",
                        points_.Where(row, name),
                        data::QuotedText(text)));
      }
      directions.push_back(text == "forward" ? 0 : 1);
    }
    return directions;
  }

  MapAtPoints At(const ErrorSource& source,
                 const std::string& coordinate,
                 const data::Unit& unit) {
    if (source.map == nullptr) {
      return {.values = VectorXd::Constant(static_cast<Index>(points_.num_rows),
                                           source.constant),
              .outside = std::vector<bool>(points_.num_rows)};
    }
    has_maps_ = true;
    const FittedModel& map = *source.map;
    RequireQuantity(map, unit);
    const MatrixXd inputs = InputsOf(map, coordinate);
    models::PointLog log;
    const models::Prediction prediction =
        map.PredictForm(map.FormInputs(Rows(map, inputs, &log)));
    const double factor = data::Converted(1.0, map.target.unit, unit);
    MapAtPoints at{.values = factor * prediction.errors, .outside = {}};
    SetHalfWidth(source, factor, &at);
    for (Index row = 0; row < inputs.rows(); ++row) {
      const bool forgets =
          log.log != nullptr && log.missing[static_cast<std::size_t>(row)] !=
                                    models::Missing::kNothing;
      at.outside.push_back(forgets ||
                           !models::IsInside(map.inputs, inputs, row));
    }
    return at;
  }

  void RequireQuantity(const FittedModel& map, const data::Unit& unit) const {
    if (data::AreConvertible(map.target.unit, unit)) return;
    throw data::InputError(fmt::format(
        "{}: the map predicts {} in {}, and the error is in {}",
        data::PrintablePath(points_.file),
        QuotedName(map.target.name),
        map.target.unit.symbol.empty() ? "no unit" : map.target.unit.symbol,
        unit.symbol));
  }

  // Of 90 %. The map's own interval is a quantile, and these do not add up over
  // many maps. What does is the standard deviation of its held-out errors, with
  // as many degrees of freedom as units were held out.
  void SetHalfWidth(const ErrorSource& source, double factor, MapAtPoints* at) {
    const FittedModel& map = *source.map;
    if (map.held_out != nullptr && !map.held_out->units.empty()) {
      constexpr double kUpper = 0.95;
      at->degrees_of_freedom = static_cast<double>(map.held_out->units.size());
      at->half_width = factor * map.held_out->rmse *
                       stats::StudentQuantile(kUpper, at->degrees_of_freedom);
    } else if (map.interval) {
      at->half_width = factor * map.interval->levels[0].half_width;
    } else {
      remarks_.push_back(fmt::format(
          "warning: {} has no prediction interval, so the uncertainty at the "
          "tool is not known",
          data::PrintablePath(source.file)));
      at->half_width = stats::kNaN;
    }
  }

  // (points x inputs) in the map's units.
  MatrixXd InputsOf(const FittedModel& map, const std::string& coordinate) {
    MatrixXd inputs(static_cast<Index>(points_.num_rows),
                    std::ssize(map.inputs));
    Index column = 0;
    for (const models::TrainedInput& input : map.inputs) {
      inputs.col(column++) = data::IsPosition(input.column)
                                 ? Position(input.column, coordinate)
                                 : ByName(points_, input.column);
    }
    return inputs;
  }

  VectorXd Position(const data::ColumnInfo& position,
                    const std::string& coordinate) const {
    if (coordinate.empty()) {
      throw data::InputError(fmt::format(
          "{}: the map reads {}, and its link is fixed and has no position",
          data::PrintablePath(points_.file),
          QuotedName(position.name)));
    }
    return ColumnIn(position.unit, points_, coordinate);
  }

  VectorXd ByName(const data::CsvTable& table, const data::ColumnInfo& column) {
    const data::MatchedColumn match = data::MatchColumn(table, column);
    NoteConversion(table, match);
    const VectorXd values = data::NumericColumn(table, match.of_file.name);
    return values.unaryExpr(
        [&](double value) { return match.InMapUnit(value); });
  }

  // Each conversion once, though many maps ask for it.
  void NoteConversion(const data::CsvTable& table,
                      const data::MatchedColumn& match) {
    if (match.Remark().empty()) return;
    std::string remark =
        data::PrintablePath(table.file) + ": " + match.Remark();
    if (said_.insert(remark).second) remarks_.push_back(std::move(remark));
  }

  // (rows of the log x inputs); positions are not known between measurements,
  // and no filter reads them.
  MatrixXd InputsInLog(const FittedModel& map) {
    MatrixXd inputs(static_cast<Index>(log_->num_rows), std::ssize(map.inputs));
    Index column = 0;
    for (const models::TrainedInput& input : map.inputs) {
      if (data::IsPosition(input.column)) {
        inputs.col(column++).setConstant(stats::kNaN);
      } else {
        inputs.col(column++) = ByName(*log_, input.column);
      }
    }
    return inputs;
  }

  // The points as a data set whose target is not known, and so 0.
  data::Dataset Rows(const FittedModel& map,
                     const MatrixXd& inputs,
                     models::PointLog* log) {
    data::Dataset::Parts parts;
    parts.source = points_.file;
    for (const models::TrainedInput& input : map.inputs) {
      parts.inputs.push_back(input.column);
    }
    parts.target = map.target;
    parts.target_values = VectorXd::Zero(inputs.rows());
    parts.input_values = inputs;
    if (map.history != nullptr && map.history->needs_sessions()) {
      ++num_with_memory_;
      const models::RowsForMap points{points_, inputs};
      if (log_ == nullptr) {
        *log = models::MakePointLog(*map.history, points, nullptr, arguments_);
      } else {
        const MatrixXd log_inputs = InputsInLog(map);
        const models::RowsForMap earlier{*log_, log_inputs};
        *log = models::MakePointLog(*map.history, points, &earlier, arguments_);
      }
      parts.log = log->log;
      parts.log_rows = log->rows;
    }
    return data::Dataset(std::move(parts));
  }

  const models::Machine& machine_;
  const data::CsvTable& points_;
  const data::CsvTable* log_;
  const models::MapDataArguments& arguments_;
  bool has_maps_ = false;
  long long num_with_memory_ = 0;
  std::set<std::string> said_;
  std::vector<std::string> remarks_;
};

}  // namespace

MachinePoints EvaluateAt(const models::Machine& machine,
                         const data::CsvTable& points,
                         const data::CsvTable* log,
                         const models::MapDataArguments& arguments) {
  return MachineEvaluator(machine, points, log, arguments).Evaluate();
}

}  // namespace errmap::machine
