#include "data/measurements/builders/value_checks.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "data/argument_name.h"
#include "data/column_header.h"
#include "data/column_words.h"
#include "data/input_error.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/reading/reading.h"
#include "data/text.h"
#include "data/units.h"

namespace errmap::data {
namespace {

struct Range {
  double least = 0.0;
  double most = 0.0;
};

std::vector<Range> RangesOf(const Eigen::Ref<const Eigen::VectorXd>& values,
                            const std::vector<Eigen::Index>& starts) {
  std::vector<Range> ranges;
  for (std::size_t s = 0; s < starts.size(); ++s) {
    const auto end = s + 1 < starts.size() ? starts[s + 1] : values.size();
    const auto own = values.segment(starts[s], end - starts[s]);
    ranges.push_back({own.minCoeff(), own.maxCoeff()});
  }
  return ranges;
}

// The unit in which a session's range is that of the one beside it; "" for its
// own. A short travel or a cold day lies within it, in some unit or other: both
// ends have to agree.
std::string UnitOfSession(const Unit& own_unit,
                          const Range& own,
                          const Range& beside) {
  constexpr double kDegrees = 10.0;
  constexpr double kOfTravel = 1e-3;
  const double near = own_unit.quantity == Quantity::kTemperature
                          ? kDegrees
                          : kOfTravel * (beside.most - beside.least);
  const auto is_alike = [&](const Unit& unit) {
    return std::abs(Converted(own.least, unit, own_unit) - beside.least) <
               near &&
           std::abs(Converted(own.most, unit, own_unit) - beside.most) < near;
  };
  const bool is_off = own.least == own.most || beside.least == beside.most;
  if (is_off || is_alike(own_unit)) return "";
  const std::vector<Unit> units = UnitsOf(own_unit.quantity);
  const auto found = std::ranges::find_if(units, is_alike);
  return found == units.end() ? "" : found->symbol;
}

}  // namespace

std::optional<std::string> UnlikelySize(const ColumnInfo& target,
                                        const Eigen::VectorXd& values) {
  constexpr double kMost = 1000.0;  // um, RMS
  constexpr double kLeast = 0.05;
  const Unit um = UnitOfSymbol("um");
  if (!AreConvertible(target.unit, um)) return std::nullopt;
  const double rms =
      values.norm() / std::sqrt(static_cast<double>(values.size()));
  const double size = Converted(rms, target.unit, um);
  if (size == 0.0 || (size >= kLeast && size <= kMost)) return std::nullopt;
  return NameInRemark(target.name) + " is " + Rounded(rms) + " " +
         target.unit.symbol + " RMS, " + (size > kMost ? "more" : "less") +
         " than errors of machine tools; if it is in another unit, write that "
         "into its name: error_um, 'error [mm]'";
}

std::optional<std::string> LikelyFahrenheit(
    const std::vector<ColumnInfo>& inputs, const Eigen::MatrixXd& values) {
  constexpr double kColdShop = 59.0;  // degF, 15 degC
  constexpr double kWarmShop = 95.0;
  constexpr double kHotMachine = 150.0;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const std::string& name = inputs[i].name;
    if (!NamesTemperature(name) ||
        ReadHeader(name).source == UnitSource::kStated) {
      continue;
    }
    const auto column = values.col(static_cast<Eigen::Index>(i));
    const double coldest = column.minCoeff();
    if (coldest < kColdShop || coldest > kWarmShop ||
        column.maxCoeff() > kHotMachine) {
      continue;
    }
    names.push_back(name);
  }
  if (names.empty()) return std::nullopt;
  return "readings of " + ListOfNames(names) +
         " look like degF, but have no unit; if they are, write it: " +
         QuotedText(names.front() + " [degF]");
}

std::optional<std::string> OtherUnitInSession(
    const ColumnInfo& input,
    const Eigen::Ref<const Eigen::VectorXd>& values,
    const std::vector<Eigen::Index>& starts) {
  constexpr Eigen::Index kMostSessions = 1000;
  const bool is_position =
      input.role == Role::kPosition && IsLengthOrAngle(input.unit);
  const Unit own_unit = !is_position && input.unit.symbol.empty()
                            ? UnitOfSymbol("degC")
                            : input.unit;
  const auto n = std::ssize(starts);
  if ((!is_position && input.unit.quantity != Quantity::kTemperature &&
       !NamesTemperature(input.name)) ||
      n < 2 || n > kMostSessions) {
    return std::nullopt;
  }
  const std::vector<Range> ranges = RangesOf(values, starts);
  const auto remark = [&](std::size_t session, std::size_t beside) {
    const Range own = ranges[session];
    const Range other = ranges[beside];
    std::string unit = UnitOfSession(own_unit, own, other);
    if (unit.empty()) return unit;
    return NameInRemark(input.name) + " is " + Rounded(own.least) + " to " +
           Rounded(own.most) + " in session " + std::to_string(session + 1) +
           ", as if its unit were " + QuotedText(unit) + " there, and " +
           Rounded(other.least) + " to " + Rounded(other.most) +
           " in session " + std::to_string(beside + 1);
  };
  for (std::size_t s = 1; s < ranges.size(); ++s) {
    for (std::string text : {remark(s, s - 1), remark(s - 1, s)}) {
      if (!text.empty()) return text;
    }
  }
  return std::nullopt;
}

void AskForUnit(const CsvTable& table,
                const std::string& target,
                const Eigen::VectorXd& values,
                bool named) {
  constexpr Eigen::Index kFewestRows = 12;
  constexpr double kMost = 1.0;  // mm
  const Header header = ReadHeader(target);
  const bool in_inches =
      std::ranges::any_of(table.columns, [](const CsvColumn& column) {
        return IsOneOf(UnitOfColumn(column.name).symbol, "in degF");
      });
  const bool is_large =
      !header.unit.symbol.empty() &&
      values.squaredNorm() >= kMost * static_cast<double>(values.size());
  const bool is_called =
      !named && header.unit.symbol.empty() && ErrorSign(target) != 0;
  if (header.unit.quantity == Quantity::kTime && !named) {
    throw OpenQuestion(
        PrintablePath(table.file),
        {.topic = "unit",
         .question = "is " + QuotedName(target) + " in seconds of arc?",
         .answers = {{.option = ArgumentName("target", target + " [arcsec]"),
                      .means = "yes"},
                     {.option = ArgumentName("target", target),
                      .means = "no, it is a time"}}});
  }
  if (header.source == UnitSource::kStated || values.size() < kFewestRows ||
      !(is_large || is_called || (in_inches && !named))) {
    return;
  }
  std::vector<Reading::Answer> answers;
  const auto offer = [&](const std::string& unit) {
    answers.push_back(
        {.option = ArgumentName("target", target + " [" + unit + "]"),
         .means = "in " + unit});
  };
  // "Pitch error "": a sign that counts in brackets only.
  const auto in_brackets = ReadUnit(target.substr(target.find_last_of(' ') + 1),
                                    UnitPlace::kBracketed);
  if (in_brackets && in_brackets->quantity == Quantity::kAngle) {
    offer(in_brackets->symbol);
  }
  offer("um");
  offer("mm");
  if (in_inches) offer("in");
  throw OpenQuestion(
      PrintablePath(table.file),
      {.topic = "unit",
       .question = "in which unit is " + QuotedName(target) + "?",
       .answers = std::move(answers)});
}

Eigen::VectorXd WeightsOf(const CsvTable& table,
                          const CsvColumn& column,
                          const std::vector<Eigen::Index>& rows) {
  constexpr double kLeastShare = 1e-30;
  Eigen::VectorXd weights = ValuesOfRows(column, rows);
  Eigen::Index least = 0;
  const double smallest = weights.minCoeff(&least);
  const auto row = static_cast<std::size_t>(rows[least]);
  const std::string weight =
      table.Where(row, column.name) + ": weight " + CsvNumber(smallest);
  if (!(smallest > 0.0)) {
    throw InputError(weight + " is not positive; correct it or remove the row");
  }
  if (smallest < kLeastShare * weights.maxCoeff()) {
    throw InputError(weight +
                     " is less than 1e-30 of the largest; remove the row");
  }
  weights /= weights.maxCoeff();
  return weights / weights.mean();
}

void RequireSquares(const CsvTable& table,
                    const std::vector<Eigen::Index>& rows,
                    const std::string& what,
                    const std::string& column,
                    const Eigen::Ref<const Eigen::VectorXd>& values) {
  constexpr double kMost = 1e100;
  constexpr double kLeast = 1e-100;
  Eigen::Index row = 0;
  const double largest = values.cwiseAbs().maxCoeff(&row);
  if (largest == 0.0 || (largest >= kLeast && largest <= kMost)) return;
  throw InputError(
      table.Where(static_cast<std::size_t>(rows[row]), column) +
      ": the largest " + what + ", " + CsvNumber(values[row]) +
      ", is not a size between 1e-100 and 1e100, whose squares can be summed; "
      "correct it or choose another unit");
}

}  // namespace errmap::data
