#include "cli/report/text/commands/outside_text.h"

#include <fmt/format.h>

#include "cli/report/number_text.h"
#include "data/text.h"
#include "models/trained_range.h"

namespace errmap::report {

using Eigen::Index;

namespace {

std::string FlagText(const models::RowFlag& flag) {
  const std::string name = data::Printable(flag.column.name);
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
                             : "the other inputs suggest",
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

}  // namespace

std::vector<std::string> OutsideLines(
    const std::vector<models::TrainedInput>& inputs,
    const Eigen::MatrixXd& values) {
  std::vector<std::string> lines;
  constexpr std::size_t kMostInputs = 5;
  Index rows = 0;
  for (Index row = 0; row < values.rows(); ++row) {
    rows += models::IsInside(inputs, values, row) ? 0 : 1;
  }
  if (rows == 0) return lines;
  const std::vector<models::InputOutside> outside =
      models::InputsOutside(inputs, values);
  // Of one input its own line says it.
  if (outside.size() != 1) {
    lines.push_back(fmt::format(
        "warning: {} outside the trained range of the inputs: there the "
        "map extrapolates",
        Count(rows, "row")));
  }
  for (std::size_t i = 0; i < outside.size() && i < kMostInputs; ++i) {
    const models::InputOutside& found = outside[i];
    const models::TrainedInput& input =
        inputs[static_cast<std::size_t>(found.input)];
    const std::string& symbol = input.column.unit.symbol;
    lines.push_back(fmt::format(
        "warning: {} is {:g}{}{}, trained {:g} to {:g}: {} outside{}",
        data::Printable(input.column.name),
        found.min,
        found.min == found.max ? "" : fmt::format(" to {:g}", found.max),
        symbol.empty() ? "" : " " + symbol,
        input.min,
        input.max,
        Count(found.num_rows, "row"),
        found.looks_like.empty()
            ? ""
            : fmt::format("; as if in {}: say so in the column's name",
                          found.looks_like)));
  }
  if (outside.size() > kMostInputs) {
    lines.push_back(fmt::format(
        "warning: and {} more outside",
        Count(static_cast<long long>(outside.size() - kMostInputs), "input")));
  }
  return lines;
}

std::vector<std::string> UnlikeLines(const std::vector<models::RowFlag>& flags,
                                     const std::vector<Index>& rows) {
  std::vector<std::string> lines;
  Index unlike = 0;
  std::size_t worst = 0;
  for (std::size_t i = 0; i < flags.size(); ++i) {
    if (!flags[i].outside()) continue;
    if (flags[i].severity > flags[worst].severity) worst = i;
    if (flags[i].why != models::Outside::kRange) ++unlike;
  }
  if (unlike > 0) {
    lines.push_back(
        fmt::format("warning: {} unlike those in training: a new thermal "
                    "state, or thermometers that contradict each other",
                    Count(unlike, "row")));
  }
  if (!flags.empty() && flags[worst].outside()) {
    lines.push_back(fmt::format("warning: farthest outside is data row {}: {}",
                                rows[worst],
                                FlagText(flags[worst])));
  }
  return lines;
}

}  // namespace errmap::report
