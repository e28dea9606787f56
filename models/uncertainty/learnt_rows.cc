#include "models/uncertainty/learnt_rows.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "models/study/repeated_rows.h"

namespace errmap::models {
namespace {

// 16 bits a row and 11 hashes: (1 - exp(-11 / 16))^11 of other rows seem known.
constexpr std::uint64_t kBitsPerRow = 16;
constexpr std::uint64_t kHashes = 11;
constexpr double kFalseHits = 0.0005;
// Rows kept, 64 KiB in the file.
constexpr Index kMostRowsHashed = 16384;
// Of rows of other sessions, what may be alike for a filter to tell anything.
constexpr double kMostAlike = 0.2;
constexpr unsigned kBitsPerDigit = 4;
constexpr std::string_view kDigits = "0123456789abcdef";

bool IsKept(std::uint64_t hash, Index every) {
  // Other bits than those of the places in the filter.
  return (hash * 0x94D049BB133111EBU >> 40U) %
             static_cast<std::uint64_t>(every) ==
         0;
}

// Calls `visit` with each place of a hash among so many bits (Kirsch &
// Mitzenmacher 2006).
template <typename Visit>
void ForPlaces(std::uint64_t hash, std::size_t digits, const Visit& visit) {
  const std::uint64_t bits = kBitsPerDigit * digits;
  const std::uint64_t step = (hash >> 32U) | 1U;
  for (std::uint64_t i = 0; i < kHashes; ++i) {
    const std::uint64_t bit = ((hash & 0xFFFFFFFFU) + i * step) % bits;
    visit(static_cast<std::size_t>(bit / kBitsPerDigit),
          1U << static_cast<unsigned>(bit % kBitsPerDigit));
  }
}

unsigned ValueOf(char digit) {
  return static_cast<unsigned>(kDigits.find(digit));
}

std::optional<LearntRows::Filter> MakeFilter(
    const data::Dataset& training,
    const std::vector<std::uint64_t>& hashes,
    Index every) {
  LearntRows::Filter filter{.alike = ShareAlike(training, hashes), .bits = {}};
  if (filter.alike > kMostAlike) return std::nullopt;
  const auto kept = static_cast<std::size_t>(std::ranges::count_if(
      hashes, [&](std::uint64_t hash) { return IsKept(hash, every); }));
  std::vector<unsigned> digits(1 + kept * kBitsPerRow / kBitsPerDigit);
  for (const std::uint64_t hash : hashes) {
    if (!IsKept(hash, every)) continue;
    ForPlaces(hash, digits.size(), [&](std::size_t digit, unsigned bit) {
      digits[digit] |= bit;
    });
  }
  for (const unsigned digit : digits) filter.bits += kDigits[digit];
  return filter;
}

}  // namespace

std::optional<LearntRows> MakeLearntRows(const FittedModel& fitted,
                                         const data::Dataset& training) {
  LearntRows learnt;
  learnt.every = 1 + (training.num_rows() - 1) / kMostRowsHashed;
  MatrixXd inputs(training.num_rows(), std::ssize(fitted.inputs));
  bool has_sensor = false;
  for (Index i = 0; i < inputs.cols(); ++i) {
    const data::ColumnInfo& column =
        fitted.inputs[static_cast<std::size_t>(i)].column;
    inputs.col(i) =
        training.input_values().col(training.FindInput(column.name));
    has_sensor = has_sensor || data::IsReadBySensor(column);
  }
  learnt.measured = MakeFilter(
      training, RowHashes(inputs, &training.target_values()), learnt.every);
  // Positions and counts come again in every session.
  if (has_sensor) {
    learnt.readings =
        MakeFilter(training, RowHashes(inputs, nullptr), learnt.every);
  }
  if (!learnt.measured && !learnt.readings) return std::nullopt;
  return learnt;
}

Index CountLearntRows(const FittedModel& fitted,
                      const MatrixXd& inputs,
                      const VectorXd* targets) {
  if (fitted.learnt == nullptr) return 0;
  const LearntRows& learnt = *fitted.learnt;
  const auto& filter = targets != nullptr ? learnt.measured : learnt.readings;
  if (!filter) return 0;
  double looked = 0.0;
  Index found = 0;
  for (const std::uint64_t hash : RowHashes(inputs, targets)) {
    if (!IsKept(hash, learnt.every)) continue;
    bool all = true;
    ForPlaces(hash, filter->bits.size(), [&](std::size_t digit, unsigned bit) {
      all = all && (ValueOf(filter->bits[digit]) & bit) != 0;
    });
    looked += 1.0;
    found += all ? 1 : 0;
  }
  // A machine at rest may repeat a reading.
  constexpr Index kFewestReadings = 3;
  if ((targets == nullptr && found < kFewestReadings) ||
      !AreMoreThanChance(found, looked, filter->alike + kFalseHits)) {
    return 0;
  }
  return static_cast<Index>(
      std::llround(static_cast<double>(found * inputs.rows()) / looked));
}

}  // namespace errmap::models
