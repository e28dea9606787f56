#include "cli/commands/maps/map_warnings.h"

#include <cmath>

#include <fmt/format.h>

#include "cli/study_file/data_arguments.h"
#include "data/measurements/column_match.h"
#include "data/text.h"
#include "models/report/number_text.h"
#include "models/trained_range.h"

namespace errmap::cli {

using Eigen::Index;

data::CsvTable ReadForMap(const models::FittedModel& fitted,
                          const std::string& file,
                          MapColumns columns,
                          bool quiet) {
  std::vector<data::ColumnInfo> of_map;
  for (const models::TrainedInput& input : fitted.inputs) {
    of_map.push_back(input.column);
  }
  if (columns == MapColumns::kInputsAndTarget) of_map.push_back(fitted.target);
  data::TableForMap read = data::InMapUnits(data::ReadCsv(file), of_map);
  if (!quiet) {
    for (const std::string& remark : read.remarks) Say(remark);
  }
  return std::move(read.table);
}

Eigen::MatrixXd InputsOf(const models::FittedModel& fitted,
                         const data::CsvTable& table) {
  Eigen::MatrixXd inputs(static_cast<Eigen::Index>(table.num_rows),
                         static_cast<Eigen::Index>(fitted.inputs.size()));
  Eigen::Index column = 0;
  for (const models::TrainedInput& input : fitted.inputs) {
    inputs.col(column++) = data::NumericColumn(
        table, input.column.name, data::MissingPolicy::kError, nullptr);
  }
  return inputs;
}

void SayOutside(const std::vector<models::TrainedInput>& inputs,
                const Eigen::MatrixXd& values) {
  constexpr std::size_t kMostInputs = 5;
  Index rows = 0;
  for (Index row = 0; row < values.rows(); ++row) {
    rows += models::IsInside(inputs, values, row) ? 0 : 1;
  }
  if (rows == 0) return;
  Say(fmt::format(
      "warning: {} outside the trained range of the inputs: there the "
      "map extrapolates",
      report::Count(rows, "row")));
  const std::vector<models::InputOutside> outside =
      models::InputsOutside(inputs, values);
  for (std::size_t i = 0; i < outside.size() && i < kMostInputs; ++i) {
    const models::InputOutside& found = outside[i];
    const models::TrainedInput& input =
        inputs[static_cast<std::size_t>(found.input)];
    const std::string& symbol = input.column.unit.symbol;
    Say(fmt::format(
        "warning: {} is {:g} to {:g}{}, trained {:g} to {:g}: {} outside{}",
        data::Printable(input.column.name, input.column.name.size()),
        found.min,
        found.max,
        symbol.empty() ? "" : " " + symbol,
        input.min,
        input.max,
        report::Count(found.num_rows, "row"),
        found.looks_like.empty()
            ? ""
            : fmt::format("; as if in {}: say so in the column's name",
                          found.looks_like)));
  }
  if (outside.size() > kMostInputs) {
    Say(fmt::format(
        "warning: and {} more outside",
        report::Count(static_cast<long long>(outside.size() - kMostInputs),
                      "input")));
  }
}

std::string FlagText(const models::RowFlag& flag) {
  const std::string name =
      data::Printable(flag.column.name, flag.column.name.size());
  const std::string& symbol = flag.column.unit.symbol;
  switch (flag.why) {
    case models::Outside::kNo:
      return "";
    case models::Outside::kRange:
    case models::Outside::kRelation:
      return fmt::format("{} is {:.6g}{}, {} {:.6g} to {:.6g}",
                         name,
                         flag.value,
                         symbol.empty() ? "" : " " + symbol,
                         flag.why == models::Outside::kRange
                             ? "trained"
                             : "the other inputs tell",
                         flag.low,
                         flag.high);
    case models::Outside::kDistance:
      return fmt::format(
          "the thermal state is {:.1f} times as far from every trained one as "
          "held-out rows were",
          flag.severity);
    case models::Outside::kLeverage:
      return fmt::format(
          "the leverage of the thermal state is {:.2g}, at most {:.2g} in "
          "held-out rows",
          flag.value,
          flag.high);
  }
  return "";
}

void SayUnlike(const std::vector<models::RowFlag>& flags,
               const std::vector<Index>& rows) {
  Index unlike = 0;
  std::size_t worst = 0;
  for (std::size_t i = 0; i < flags.size(); ++i) {
    if (!flags[i].outside()) continue;
    if (flags[i].severity > flags[worst].severity) worst = i;
    if (flags[i].why != models::Outside::kRange) ++unlike;
  }
  if (unlike > 0) {
    Say(fmt::format(
        "warning: {} in a thermal state unlike those of training, or with "
        "inputs that do not go together as they did there",
        report::Count(unlike, "row")));
  }
  if (!flags.empty() && flags[worst].outside()) {
    Say(fmt::format("warning: farthest outside is data row {}: {}",
                    rows[worst],
                    FlagText(flags[worst])));
  }
}

bool SayNotFinite(const Eigen::VectorXd& predicted,
                  const std::vector<Index>& rows,
                  const std::string& file) {
  Index count = 0;
  Index first = 0;
  for (Index i = predicted.size() - 1; i >= 0; --i) {
    if (std::isfinite(predicted[i])) continue;
    ++count;
    first = i;
  }
  if (count == 0) return false;
  Say(
      fmt::format("{}: {} of {} not finite, the first in data row {}; the map "
                  "does not serve there",
                  data::PrintablePath(file),
                  count,
                  report::Count(predicted.size(), "prediction"),
                  rows[static_cast<std::size_t>(first)]));
  return true;
}

}  // namespace errmap::cli
