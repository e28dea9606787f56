#include "data/measurements/clock/time_units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "data/column_header.h"
#include "data/column_words.h"
#include "data/csv.h"
#include "data/text.h"

namespace errmap::data {
namespace {

constexpr auto kTimeUnits = std::to_array<TimeUnit>({{"s", 1.0},
                                                     {"100ms", 0.1},
                                                     {"10ms", 1e-2},
                                                     {"ms", 1e-3},
                                                     {"us", 1e-6},
                                                     {"100ns", 1e-7},
                                                     {"ns", 1e-9},
                                                     {"min", 60.0},
                                                     {"h", 3600.0},
                                                     {"days", kSecondsOfDay}});

// Units as words.
constexpr auto kSpelledOut =
    std::to_array<std::pair<std::string_view, std::string_view>>(
        {{"s",
          "sec secs second seconds sek sekunde sekunden seconde secondes "
          "secondi segundo segundos sekunder"},
         {"ms", "millis msec msecs millisekunden milliseconds"},
         {"us", "us micros"},
         {"ns", "ns"},
         {"min",
          "min mins minute minutes minuten minuti minuto minutos minuter"},
         {"h",
          "hr hrs hour hours std stunde stunden heure heures ore hora horas "
          "timmar"},
         {"days", "days tage jours giorni dias doy"}});

}  // namespace

const TimeUnit* FindTimeUnit(std::string_view name) {
  const auto* const found =
      std::ranges::find(kTimeUnits, name, &TimeUnit::name);
  return found == kTimeUnits.end() ? nullptr : found;
}

const TimeUnit* StatedUnit(std::string_view column) {
  const Header header = ReadHeader(column);
  if (const TimeUnit* unit = FindTimeUnit(Trimmed(column))) return unit;
  if (const TimeUnit* unit = FindTimeUnit(header.unit.symbol)) return unit;
  if (EqualsIgnoringCase(header.unit_text, "d") ||
      EqualsIgnoringCase(header.unit_text, "days")) {
    return FindTimeUnit("days");
  }
  std::vector<std::string> words = WordsOf(column);
  // "seconds since the start", "sec_of_day".
  const auto of = std::ranges::find_if(words, [](const std::string& word) {
    return IsOneOf(word, "of since seit depuis from");
  });
  if (of != words.begin()) words.erase(of, words.end());
  if (words.empty()) return nullptr;
  // "Day" alone is a session.
  if (words.size() > 1 && IsOneOf(words.back(), "d day tag jour giorno dia")) {
    return FindTimeUnit("days");
  }
  for (std::string text : {words.back(), header.unit_text}) {
    // "Betriebsstunden"
    for (const std::string_view end : {"stunden", "minuten", "sekunden"}) {
      if (text.ends_with(end)) text = end;
    }
    for (const auto& [unit, said] : kSpelledOut) {
      if (IsOneOf(text, said)) return FindTimeUnit(unit);
    }
  }
  return nullptr;
}

bool NamesTime(std::string_view name) {
  return !StatesTemperature(name) && (StartsWithIgnoringCase(name, "time") ||
                                      StartsWithIgnoringCase(name, "zeit"));
}

double MedianStep(std::vector<double> steps) {
  std::erase_if(steps, [](double step) { return !(step > 0.0); });
  if (steps.empty()) return INFINITY;
  const auto middle =
      steps.begin() + static_cast<std::ptrdiff_t>((steps.size() - 1) / 2);
  std::ranges::nth_element(steps, middle);
  return *middle;
}

double MedianStepOf(const Eigen::VectorXd& time) {
  std::vector<double> steps;
  for (Eigen::Index i = 1; i < time.size(); ++i) {
    steps.push_back(time[i] - time[i - 1]);
  }
  return MedianStep(std::move(steps));
}

Eigen::Index TimesBack(const Eigen::VectorXd& time) {
  Eigen::Index count = 0;
  for (Eigen::Index i = 1; i < time.size(); ++i) {
    count += time[i] < time[i - 1] ? 1 : 0;
  }
  return count;
}

bool Pace::MayBeIn(const TimeUnit& unit) const {
  constexpr double kLeastStep = 0.01;
  constexpr double kMostSpan = 3653.0 * kSecondsOfDay;
  return !std::isfinite(step) ||
         (step * unit.seconds >= 0.999 * kLeastStep &&
          step * unit.seconds <= 1.001 * kSecondsOfDay &&
          (most - least) * unit.seconds < kMostSpan);
}

Pace PaceOf(std::vector<double> values) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  if (values.empty()) return {};
  std::vector<double> steps;
  for (std::size_t i = 1; i < values.size(); ++i) {
    steps.push_back(std::abs(values[i] - values[i - 1]));
  }
  // Rows in another order have long steps; sorted, they have their own.
  std::vector<double> sorted = values;
  std::ranges::sort(sorted);
  std::vector<double> in_order;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    in_order.push_back(sorted[i] - sorted[i - 1]);
  }
  const double step =
      std::min(MedianStep(std::move(steps)), MedianStep(std::move(in_order)));
  return {sorted.front(), sorted.back(), step};
}

double SecondsOfDigits(double number) {
  if (!(number >= 19800101000000.0 && number < 20700101000000.0)) {
    return std::nan("");
  }
  const std::string text = CsvNumber(std::floor(number));
  if (text.size() != 14) return std::nan("");
  const auto part = [&](std::size_t at, std::size_t size) {
    return text.substr(at, size);
  };
  const auto parsed =
      ParseDateTime(part(0, 4) + "-" + part(4, 2) + "-" + part(6, 2) + " " +
                    part(8, 2) + ":" + part(10, 2) + ":" + part(12, 2));
  return parsed ? parsed->seconds + number - std::floor(number) : std::nan("");
}

std::optional<Epoch> EpochOf(const Pace& pace, Named called) {
  constexpr double kFrom = 6.3e8;
  constexpr double kTo = 2.84e9;
  const auto from_1970 = [&](std::string_view name) -> std::optional<Epoch> {
    const TimeUnit* unit = FindTimeUnit(name);
    const bool fits = pace.least * unit->seconds >= kFrom &&
                      pace.most * unit->seconds <= kTo && pace.MayBeIn(*unit);
    return fits ? std::optional(Epoch{unit, 0.0}) : std::nullopt;
  };
  for (const char* name : {"s", "ms", "us"}) {
    if (auto epoch = from_1970(name)) return epoch;
  }
  // Windows counts 100 ns from 1601, .NET from the year 1.
  const TimeUnit* ticks = FindTimeUnit("100ns");
  for (const double to_1970 : {11644473600.0, 62135596800.0}) {
    if (pace.least * ticks->seconds - to_1970 >= kFrom &&
        pace.most * ticks->seconds - to_1970 <= kTo) {
      return Epoch{ticks, -to_1970};
    }
  }
  if (auto epoch = from_1970("ns")) return epoch;
  // Excel counts days from 30 December 1899, MATLAB from year 0.
  const TimeUnit* days = FindTimeUnit("days");
  for (const double days_to_1970 : {kExcelDaysTo1970, 719529.0}) {
    const double from = (pace.least - days_to_1970) * kSecondsOfDay;
    const double to = (pace.most - days_to_1970) * kSecondsOfDay;
    // No other numbers have the fractions of a day beside seven figures.
    const bool is_datenum = days_to_1970 > kExcelDaysTo1970 &&
                            pace.least != std::floor(pace.least) &&
                            pace.MayBeIn(*days) && pace.step < 1.0;
    const bool fits =
        called == Named::kDate || is_datenum ||
        (called == Named::kTime && pace.MayBeIn(*days) && pace.step < 1.0);
    if (fits && from >= kFrom && to <= kTo) {
      return Epoch{days, -days_to_1970 * kSecondsOfDay};
    }
  }
  return std::nullopt;
}

std::optional<double> NamedDays(std::string_view column) {
  constexpr double kJulianTo1970 = 2440587.5;
  constexpr double kModifiedJulianTo1970 = 40587.0;
  if (HasWordOf(column, "mjd")) return kModifiedJulianTo1970;
  if (HasWordOf(column, "jd bjd hjd julian")) return kJulianTo1970;
  if (HasWordOf(column, "days tage jours") &&
      column.find("1970") != column.npos)
    return 0.0;
  return std::nullopt;
}

std::optional<Epoch> NamedEpoch(std::string_view column, const Pace& pace) {
  constexpr double kFrom = 3650.0;  // days from 1970
  constexpr double kTo = 36500.0;
  const std::optional<double> days_to_1970 = NamedDays(column);
  if (!days_to_1970 || pace.least - *days_to_1970 < kFrom ||
      pace.most - *days_to_1970 > kTo) {
    return std::nullopt;
  }
  return Epoch{FindTimeUnit("days"), -*days_to_1970 * kSecondsOfDay};
}

bool AreWholeDays(const std::vector<double>& values) {
  constexpr double kFrom = 32874.0;
  constexpr double kTo = 58440.0;
  bool any = false;
  for (const double day : values) {
    any = any || !std::isnan(day);
    const bool fits = day >= kFrom && day < kTo && day == std::floor(day);
    if (!fits && !std::isnan(day)) return false;
  }
  return any;
}

}  // namespace errmap::data
