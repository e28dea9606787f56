#include "cli/report/text/commands/outside_text.h"

#include <algorithm>

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
  constexpr std::size_t kMostInputs = 5;
  std::vector<std::string> said;
  for (const models::InputOutside& found :
       models::InputsOutside(inputs, values)) {
    const models::TrainedInput& input =
        inputs[static_cast<std::size_t>(found.input)];
    const std::string& symbol = input.column.unit.symbol;
    said.push_back(fmt::format(
        "{} is {:g}{}{}, trained {:g} to {:g}: {} outside{}",
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
  if (said.empty()) return {};
  return {"warning: " + data::ShortList(said, kMostInputs, "; ")};
}

std::vector<std::string> UnlikeLines(
    const std::vector<models::TrainedInput>& inputs,
    const Eigen::MatrixXd& values,
    const std::vector<models::RowFlag>& flags,
    const std::vector<Index>& rows) {
  Index unlike = 0;
  std::size_t worst = 0;
  for (std::size_t i = 0; i < flags.size(); ++i) {
    // Of rows outside their range OutsideLines has said so.
    if (!flags[i].outside() ||
        !models::IsInside(inputs, values, static_cast<Index>(i))) {
      continue;
    }
    if (unlike == 0 || flags[i].severity > flags[worst].severity) worst = i;
    ++unlike;
  }
  if (unlike == 0) return {};
  return {fmt::format(
      "warning: {} unlike those in training, the worst is data row {}: {}",
      Count(unlike, "row"),
      rows[worst],
      FlagText(flags[worst]))};
}

}  // namespace errmap::report
