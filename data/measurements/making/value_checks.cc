#include "data/measurements/making/value_checks.h"

#include <cmath>

#include "data/input_error.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/rounded.h"
#include "data/units.h"

namespace errmap::data {

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
         " than machine tools err by; if it is in another unit, write that "
         "into its name: error_um, 'error [mm]'";
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
      table.Where(static_cast<std::size_t>(rows[static_cast<std::size_t>(row)]),
                  column) +
      ": the largest " + what + ", " + CsvNumber(values[row]) +
      ", is no size between 1e-100 and 1e100, whose squares can be summed; "
      "correct it or choose another unit");
}

}  // namespace errmap::data
