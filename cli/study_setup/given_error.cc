#include "cli/study_setup/given_error.h"

#include <stdexcept>

#include <fmt/format.h>

#include "data/column_header.h"
#include "data/text.h"

namespace errmap::study_setup {
namespace {

// Where a unit begins: behind the last digit or point. Units have no digits.
std::size_t EndOfNumber(std::string_view text) {
  const std::size_t last = text.find_last_of("0123456789.");
  return last == std::string_view::npos ? 0 : last + 1;
}

}  // namespace

std::string GivenError::Text() const {
  return has_unit() ? fmt::format("{} {}", value, unit.symbol)
                    : fmt::format("{}", value);
}

GivenError ParseGivenError(std::string_view text, bool may_be_zero) {
  GivenError given;
  const std::size_t end = EndOfNumber(text);
  std::string_view symbol = text.substr(end);
  while (symbol.starts_with(' ')) symbol.remove_prefix(1);
  if (!data::ParseNumber(text.substr(0, end), &given.value)) {
    throw std::invalid_argument(fmt::format(
        "must be a finite number such as 0.002, or one with its unit such as "
        "2um, found {}",
        data::QuotedText(text)));
  }
  if (given.value < 0.0 || (given.value == 0.0 && !may_be_zero)) {
    throw std::invalid_argument(fmt::format("must be {} 0, found {}",
                                            may_be_zero ? "at least" : "above",
                                            given.value));
  }
  if (symbol.empty()) return given;
  // As in the header of a column, where units may be spelt in many ways.
  const data::Header header = data::ReadHeader(fmt::format("x [{}]", symbol));
  if (header.source != data::UnitSource::kStated) {
    throw std::invalid_argument(fmt::format("has no unit {}; there are {}",
                                            data::QuotedText(symbol),
                                            data::KnownUnits()));
  }
  given.unit = header.unit;
  return given;
}

double InUnitOf(const data::Unit& target, const GivenError& given) {
  if (!given.is_given() || !given.has_unit()) return given.value;
  if (!data::AreConvertible(given.unit, target)) {
    throw std::invalid_argument(fmt::format("is {}, but the target is {}",
                                            given.Text(),
                                            target.symbol.empty()
                                                ? std::string("without a unit")
                                                : "in " + target.symbol));
  }
  // A difference: of temperatures no zero enters.
  return data::Converted(given.value, given.unit, target) -
         data::Converted(0.0, given.unit, target);
}

std::string BareNumberRemark(const char* what,
                             const GivenError& given,
                             const data::ColumnInfo& target,
                             double size) {
  constexpr double kLeastShare = 0.01;  // of the errors that is still a goal
  const data::Unit& unit = target.unit;
  if (given.has_unit() || unit.display_scale == 1.0 || !(given.value > size) ||
      given.value / unit.display_scale < kLeastShare * size) {
    return "";
  }
  return fmt::format(
      "{0} {1} is in {2}, the unit of {3}: {4:g} {5}, more than the error "
      "itself; write {1}{5} if that was meant",
      what,
      given.value,
      unit.symbol,
      data::Printable(target.name),
      unit.display_scale * given.value,
      unit.display_symbol);
}

void CheckRezero(std::string_view text) {
  std::string noise;
  models::ParseRezero(text, &noise);
  if (!noise.empty()) ParseGivenError(noise, true);
}

models::RezeroRule RezeroIn(const data::Unit& target, std::string_view text) {
  std::string noise;
  models::RezeroRule rule = models::ParseRezero(text, &noise);
  if (!noise.empty()) {
    rule.noise = InUnitOf(target, ParseGivenError(noise, true));
  }
  return rule;
}

}  // namespace errmap::study_setup
