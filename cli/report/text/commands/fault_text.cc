#include "cli/report/text/commands/fault_text.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "cli/report/number_text.h"
#include "data/argument_name.h"
#include "data/measurements/faults/thermometers.h"
#include "data/text.h"
#include "models/fault_effect.h"

namespace errmap::report {
namespace {

using data::ColumnFault;
using data::FaultKind;

// "data row 17", "data rows 17, 40, 41 and 12 more".
std::string RowsText(const std::vector<Eigen::Index>& rows) {
  constexpr std::size_t kMostRows = 5;
  std::string text = rows.size() == 1 ? "data row " : "data rows ";
  for (std::size_t i = 0; i < std::min(rows.size(), kMostRows); ++i) {
    text += fmt::format("{}{}", i == 0 ? "" : ", ", rows[i]);
  }
  if (rows.size() > kMostRows) {
    text += fmt::format(" and {} more", rows.size() - kMostRows);
  }
  return text;
}

// The unit in which a column of impossible temperatures would make sense.
std::string UnitHint(const ColumnFault& fault, const data::Unit& unit) {
  constexpr double kColdShop = -20.0;  // degC
  constexpr double kHotMachine = 120.0;
  const data::Unit degc = data::UnitOfSymbol("degC");
  for (const data::Unit& other : data::UnitsOf(data::Quantity::kTemperature)) {
    if (other.symbol != unit.symbol &&
        data::Converted(fault.low, other, degc) > kColdShop &&
        data::Converted(fault.high, other, degc) < kHotMachine) {
      return fmt::format(", as if in {}: say so in the column's name",
                         other.symbol);
    }
  }
  return "";
}

std::string WhatIsWrong(const ColumnFault& fault,
                        const data::Dataset& dataset) {
  const data::Unit& unit = dataset.ColumnOf(fault).unit;
  const std::string symbol = unit.symbol.empty() ? "" : " " + unit.symbol;
  const std::string rows = RowsText(fault.rows);
  switch (fault.kind) {
    case FaultKind::kImpossible:
      if (!fault.of_cells) {
        return fmt::format(
            "has {} values that no thermometer reads, such as {:g}{} in data "
            "row {}{}",
            fault.rows.size(),
            fault.value,
            symbol,
            fault.rows.front(),
            fault.rows.size() == static_cast<std::size_t>(dataset.num_rows())
                ? UnitHint(fault, unit)
                : "");
      }
      return fmt::format(
          "{:g}{} in {} is beyond any thermometer; all others "
          "are {:g} to {:g}",
          fault.value,
          symbol,
          rows,
          fault.low,
          fault.high);
    case FaultKind::kOutlying:
      return fmt::format("{:g}{} in {} is far beyond all others, {:g} to {:g}",
                         fault.value,
                         symbol,
                         rows,
                         fault.low,
                         fault.high);
    case FaultKind::kJump:
      return fmt::format("jumps from {:g} to {:g}{} and back in {}",
                         fault.low,
                         fault.value,
                         symbol,
                         rows);
    case FaultKind::kStep:
      return fmt::format(
          "steps by {:+g}{} in {} while no other thermometer moves",
          fault.value,
          symbol,
          rows);
    case FaultKind::kStuck:
      return fmt::format(
          "is stuck at {:g}{} from data row {} to {}, while the "
          "other thermometers move by {:.2g}",
          fault.value,
          symbol,
          fault.rows.front(),
          fault.rows.back(),
          fault.high);
    case FaultKind::kNoisy:
      return fmt::format(
          "has noise of {:.2g}{} from row to row, the other thermometers "
          "{:.2g}",
          fault.value,
          symbol,
          fault.high);
    case FaultKind::kDrifting:
      return fmt::format(
          "drifts from the other thermometers by {:+.2g}{} from first to last "
          "row (scatter {:.2g}){}",
          fault.value,
          symbol,
          fault.high,
          fault.low < static_cast<double>(data::kFewestOthers)
              ? ", or one of them drifts"
              : "");
    case FaultKind::kRepeated:
      return fmt::format("and all else in {} repeat other rows value for value",
                         rows);
    case FaultKind::kZero:
      return fmt::format(
          "is 0 in {} where the other rows say {:.3g}{}: no reading, as of a "
          "lost beam",
          rows,
          fault.low,
          symbol);
    case FaultKind::kOtherUnit:
      return fmt::format(
          "is some {:.0f} times smaller in data rows {} to {} than in the "
          "others, as if in another unit",
          fault.value,
          fault.rows.front(),
          fault.rows.back());
  }
  return "";
}

std::string EffectText(const models::FaultEffect& effect,
                       const data::Unit& unit,
                       const char* rows,
                       const char* what) {
  if (!std::isfinite(effect.rmse_with) || !std::isfinite(effect.rmse_without)) {
    return "";
  }
  const ErrorText error(unit, effect.rmse_without);
  return fmt::format(
      "a linear map's error on {} is {} RMSE with {}, {} without",
      rows,
      error.WithUnit(effect.rmse_with),
      what,
      error.WithUnit(effect.rmse_without));
}

}  // namespace

std::vector<std::string> FaultLines(const data::PreparedDataset& prepared,
                                    data::FaultPolicy policy,
                                    FaultUse use) {
  const data::Dataset& dataset = prepared.dataset;
  std::vector<std::string> lines;
  for (const ColumnFault& fault : prepared.faults) {
    const std::string& name = dataset.ColumnOf(fault).name;
    std::string line = fmt::format(
        "warning: {} {}", data::Printable(name), WhatIsWrong(fault, dataset));
    if (!fault.of_cells && fault.input >= 0 && use == FaultUse::kFit) {
      const std::string effect =
          EffectText(models::EffectOfInput(dataset, fault.input),
                     dataset.target().unit,
                     "rows held out",
                     "the column");
      line += ". " + data::ArgumentName("exclude", data::Printable(name)) +
              " leaves it out" + (effect.empty() ? "" : ": " + effect);
    }
    lines.push_back(std::move(line));
  }
  const std::vector<Eigen::Index> rows =
      data::RowsOfCellFaults(prepared.faults);
  if (rows.empty()) return lines;
  if (policy == data::FaultPolicy::kDropRows) {
    lines.push_back(
        fmt::format("{} left out because of them",
                    Count(static_cast<long long>(rows.size()), "row")));
    return lines;
  }
  const std::string effect =
      use == FaultUse::kJudge ? ""
                              : EffectText(models::EffectOfRows(dataset, rows),
                                           dataset.target().unit,
                                           "the other rows",
                                           rows.size() == 1 ? "it" : "them");
  lines.push_back(fmt::format(
      "{} leaves {} out{}",
      data::ArgumentName("faults", "drop-rows"),
      rows.size() == 1 ? "this row" : fmt::format("these {} rows", rows.size()),
      effect.empty() ? "" : ": " + effect));
  return lines;
}

}  // namespace errmap::report
