#include "cli/machine/true_poses.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "cli/machine/machine_points.h"
#include "data/column_header.h"
#include "data/columns.h"
#include "data/input_error.h"
#include "data/measurements/column_match.h"
#include "data/text.h"

namespace errmap::machine {
namespace {

using Eigen::MatrixX3d;

// "p0n": at least two axes move.
bool IsDiagonal(const std::string& name) {
  return name.size() == 3 && name.find_first_not_of("pn0") == name.npos &&
         std::ranges::count(name, '0') < 2;
}

}  // namespace

MatrixX3d TrueErrors(const data::CsvTable& table,
                     const models::Machine& machine) {
  const data::Unit& unit = machine.length;
  MatrixX3d errors(static_cast<Index>(table.num_rows), 3);
  Index column = 0;
  for (const char* direction : {"x", "y", "z"}) {
    const data::MatchedColumn match = data::MatchColumn(
        table, {fmt::format("error_{}_{}", direction, unit.symbol), unit});
    errors.col(column++) =
        data::NumericColumn(table, match.of_file.name)
            .unaryExpr([&](double value) { return match.InMapUnit(value); });
  }
  return errors;
}

bool HasTrueErrors(const data::CsvTable& table) {
  return std::ranges::any_of(table.columns, [](const data::CsvColumn& column) {
    const data::Header parts = data::ReadHeader(column.name);
    return parts.base == "error_x" &&
           parts.unit.quantity == data::Quantity::kLength;
  });
}

std::vector<Index> TruePoses::RowsOf(
    const std::vector<std::string>& labels) const {
  std::vector<Index> rows;
  for (const std::string& label : labels) {
    for (std::size_t row = 0; row < sessions.codes.size(); ++row) {
      const auto code = static_cast<std::size_t>(sessions.codes[row]);
      if (sessions.labels[code] == label) {
        rows.push_back(static_cast<Index>(row));
      }
    }
  }
  return rows;
}

TruePoses MakeTruePoses(data::CsvTable table,
                        const models::Machine& machine,
                        const std::string& session) {
  TruePoses poses{
      .table = std::move(table),
  };
  poses.errors = TrueErrors(poses.table, machine);
  poses.sessions = data::GroupByColumn(
      poses.table, session, data::AllRows(poses.table.num_rows));
  poses.coordinates = EvaluateAt(machine, poses.table, nullptr, {}).coordinates;
  poses.places = PlacesOf(machine.chain, poses.coordinates);
  return poses;
}

MatrixX3d PlacesOf(const models::KinematicChain& chain,
                   const MatrixXd& coordinates) {
  MatrixX3d places(coordinates.rows(), 3);
  for (Index row = 0; row < coordinates.rows(); ++row) {
    places.row(row) = chain.NominalReach(coordinates.row(row));
  }
  return places;
}

std::optional<DiagonalRuns> ReadDiagonalRuns(const data::CsvTable& table) {
  constexpr const char* kName = "diagonal";
  constexpr const char* kDirection = "diagonal_direction";
  if (table.Find(kName) < 0) return std::nullopt;
  if (table.Find(kDirection) < 0) {
    throw data::InputError(
        fmt::format("{}: no column {} of forward or reverse beside {}",
                    data::PrintablePath(table.file),
                    data::QuotedName(kDirection),
                    data::QuotedName(kName)));
  }
  const auto text = [&](const char* column, std::size_t row) {
    return table.CellText(table.At(table.Find(column)), row);
  };
  DiagonalRuns runs{.diagonals = data::GroupByColumn(
                        table, kName, data::AllRows(table.num_rows))};
  for (std::size_t row = 0; row < table.num_rows; ++row) {
    const std::string name = text(kName, row);
    if (!IsDiagonal(name)) {
      throw data::InputError(
          fmt::format("{}: {} is not a diagonal: give the signs of X, Y and Z "
                      "along it by p, n or 0, such as ppn or p0n",
                      table.Where(row, kName),
                      data::QuotedText(name)));
    }
    const std::string direction = text(kDirection, row);
    if (direction != "forward" && direction != "reverse") {
      throw data::InputError(
          fmt::format("{}: {} is neither forward nor reverse",
                      table.Where(row, kDirection),
                      data::QuotedText(direction)));
    }
    runs.upwards.push_back(direction == "forward");
  }
  return runs;
}

std::vector<DiagonalFigures> DiagonalFiguresOf(const data::CsvTable& table,
                                               const DiagonalRuns& runs,
                                               const std::vector<Index>& rows,
                                               const MatrixX3d& places,
                                               const MatrixX3d& errors) {
  std::vector<DiagonalFigures> all;
  for (std::size_t i = 0; i < runs.diagonals.labels.size(); ++i) {
    std::vector<Index> along;
    std::vector<bool> upwards;
    for (const Index row : rows) {
      const auto at = static_cast<std::size_t>(row);
      if (runs.diagonals.codes[at] != static_cast<Index>(i)) continue;
      along.push_back(row);
      upwards.push_back(runs.upwards[at]);
    }
    if (along.empty()) continue;
    const std::string& name = runs.diagonals.labels[i];
    try {
      all.push_back({name,
                     models::PositioningFiguresOf(models::AlongDiagonal(
                         name,
                         MatrixX3d(places(along, Eigen::all)),
                         MatrixX3d(errors(along, Eigen::all)),
                         std::move(upwards)))});
    } catch (const std::invalid_argument& error) {
      throw data::InputError(fmt::format("{}: diagonal {}: {}",
                                         data::PrintablePath(table.file),
                                         data::QuotedName(name),
                                         error.what()));
    }
  }
  return all;
}

}  // namespace errmap::machine
