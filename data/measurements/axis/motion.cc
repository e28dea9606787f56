#include "data/measurements/axis/motion.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <utility>

namespace errmap::data {
namespace {

using Eigen::Index;

// Spacing of levels per width; of values that come again exactly, as those of a
// coarse encoder may, more than any program's positions would show.
constexpr double kFarBelow = 10.0;
constexpr double kFarBelowOfExact = 1000.0;

struct Value {
  double value;
  Index count;
};

std::vector<Value> Distinct(std::span<const double> values) {
  std::vector<double> sorted;
  for (const double value : values) {
    if (std::isfinite(value)) sorted.push_back(value);
  }
  std::ranges::sort(sorted);
  std::vector<Value> distinct;
  for (const double value : sorted) {
    if (distinct.empty() || distinct.back().value != value) {
      distinct.push_back({value, 0});
    }
    ++distinct.back().count;
  }
  return distinct;
}

// Whether each comes about as often as the others, the ends of a sweep apart.
bool ComeAlike(const std::vector<Value>& distinct) {
  std::vector<Index> counts;
  for (const Value& value : distinct) counts.push_back(value.count);
  std::ranges::sort(counts);
  const Index median = counts[counts.size() / 2];
  const auto alike = std::ranges::count_if(counts, [&](Index count) {
    return 2 * count >= median && count <= 2 * median;
  });
  return median >= 2 && 10 * alike >= 9 * std::ssize(counts);
}

// Where to part ascending values, so that the parts are far narrower than what
// is between them; infinite if there is no such place.
double PartsAt(const std::vector<Value>& distinct, double far_below) {
  std::vector<double> gaps;
  for (std::size_t i = 1; i < distinct.size(); ++i) {
    gaps.push_back(distinct[i].value - distinct[i - 1].value);
  }
  std::vector<double> sorted = gaps;
  std::ranges::sort(sorted);
  // The widest jump among the gaps decides; then the parts must keep to it.
  std::size_t at = 0;
  double widest = 0.0;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (const double jump = sorted[i] / sorted[i - 1]; jump > widest) {
      widest = jump;
      at = i;
    }
  }
  if (widest < 3.0) return INFINITY;
  double width = 0.0;
  double from = distinct.front().value;
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    if (gaps[i] >= sorted[at]) from = distinct[i + 1].value;
    width = std::max(width, distinct[i + 1].value - from);
  }
  return sorted[at] >= far_below * width ? sorted[at] : INFINITY;
}

// The share of the rows of which the levels before tell the next.
double Predictability(const std::vector<Index>& visits) {
  std::map<std::pair<Index, Index>, std::map<Index, Index>> next;
  for (std::size_t i = 2; i < visits.size(); ++i) {
    ++next[{visits[i - 2], visits[i - 1]}][visits[i]];
  }
  Index told = 0;
  for (const auto& [before, after] : next) {
    Index most = 0;
    for (const auto& [level, count] : after) most = std::max(most, count);
    // What happens once tells nothing.
    told += most > 1 ? most : 0;
  }
  return visits.size() < 3 ? 0.0
                           : static_cast<double>(told) /
                                 static_cast<double>(visits.size() - 2);
}

// 0 where the step is none, or so long that it begins the next pass.
std::vector<int> StepSigns(const Levels& levels) {
  const auto most = std::max<Index>(1, std::ssize(levels.centers) / 2);
  std::vector<int> signs(levels.codes.size(), 0);
  Index last = -1;
  for (std::size_t i = 0; i < signs.size(); ++i) {
    const Index now = levels.codes[i];
    if (now < 0) continue;
    const Index step = last < 0 ? 0 : now - last;
    if (step != 0 && std::abs(step) <= most) signs[i] = step > 0 ? 1 : -1;
    last = now;
  }
  return signs;
}

// Of several rows where the way turns, the first half belongs to the way there.
void PartStandsAtTurns(const Levels& levels,
                       const std::vector<int>& signs,
                       std::vector<int>* directions) {
  const std::vector<Index>& codes = levels.codes;
  for (std::size_t i = 0; i < codes.size();) {
    std::size_t end = i + 1;
    while (end < codes.size() && codes[end] == codes[i]) ++end;
    const std::size_t half = i + (end - i + 1) / 2;
    for (std::size_t k = i + 1; signs[i] != 0 && k < half; ++k) {
      (*directions)[k] = signs[i];
    }
    i = end;
  }
}

// Where all rows go one way: steps back to where the pass began begin the next
// one, as after a pass that was broken off. They are not steps of the way.
void BeginAnew(const Levels& levels, int way, std::vector<int>* signs) {
  Index first = -1;
  Index last = -1;
  for (std::size_t i = 0; i < signs->size(); ++i) {
    const Index now = levels.codes[i];
    if (now < 0) continue;
    int& sign = (*signs)[i];
    if (sign == -way && now == first) sign = 0;
    if (now != last && sign == 0) first = now;
    last = now;
  }
}

// What stands still, or begins a pass, goes where the next step goes.
std::vector<int> DirectionsOf(const Levels& levels,
                              const std::vector<int>& signs) {
  std::vector<int> directions(signs.size(), 0);
  int next = 0;
  for (std::size_t i = signs.size(); i-- > 0;) {
    if (signs[i] != 0) next = signs[i];
    directions[i] = next;
  }
  PartStandsAtTurns(levels, signs, &directions);
  int last = 0;
  for (int& direction : directions) {
    if (direction == 0) direction = last;
    last = direction;
  }
  return directions;
}

}  // namespace

Levels LevelsOf(std::span<const double> values) {
  Levels levels;
  const std::vector<Value> distinct = Distinct(values);
  if (distinct.empty()) {
    levels.codes.assign(values.size(), -1);
    return levels;
  }
  levels.come_alike = ComeAlike(distinct);
  double part =
      PartsAt(distinct, levels.come_alike ? kFarBelowOfExact : kFarBelow);
  if (levels.come_alike && !std::isfinite(part)) part = 0.0;
  std::vector<double> ends;  // the highest value of each level
  double from = distinct.front().value;
  double sum = 0.0;
  Index count = 0;
  const auto end_level = [&](double last) {
    ends.push_back(last);
    levels.centers.push_back(
        count == 1 || last == from ? last : sum / static_cast<double>(count));
    levels.width = std::max(levels.width, last - from);
    sum = 0.0;
    count = 0;
  };
  for (std::size_t i = 0; i < distinct.size(); ++i) {
    const Value& value = distinct[i];
    if (i > 0 &&
        (!std::isfinite(part) || value.value - distinct[i - 1].value >= part)) {
      end_level(distinct[i - 1].value);
      from = value.value;
    }
    sum += value.value * static_cast<double>(value.count);
    count += value.count;
  }
  end_level(distinct.back().value);
  levels.codes.reserve(values.size());
  for (const double value : values) {
    levels.codes.push_back(std::isfinite(value)
                               ? std::ranges::lower_bound(ends, value) -
                                     ends.begin()
                               : -1);
  }
  return levels;
}

Levels PartsOfRange(std::span<const double> values) {
  constexpr Index kParts = 12;
  constexpr double kReach = 0.7;  // of a part's width, from its middle
  const std::vector<Value> distinct = Distinct(values);
  Levels parts;
  if (distinct.size() < 2) return parts;
  const double low = distinct.front().value;
  const double width = (distinct.back().value - low) / kParts;
  for (Index i = 0; i < kParts; ++i) {
    parts.centers.push_back(low + (static_cast<double>(i) + 0.5) * width);
  }
  Index now = -1;
  for (const double value : values) {
    if (std::isfinite(value) &&
        (now < 0 || std::abs(value - parts.centers[now]) > kReach * width)) {
      now = std::min(kParts - 1, static_cast<Index>((value - low) / width));
    }
    parts.codes.push_back(std::isfinite(value) ? now : -1);
  }
  return parts;
}

Motion MotionThrough(const Levels& levels) {
  const std::size_t n = levels.codes.size();
  const Index num_levels = std::ssize(levels.centers);
  Motion motion;
  motion.directions.assign(n, 0);
  motion.passes.assign(n, 0);
  std::vector<Index> visits;
  Index rows = 0;
  bool rises = true;
  bool falls = true;
  for (const Index code : levels.codes) {
    if (code < 0) continue;
    ++rows;
    if (!visits.empty() && visits.back() == code) continue;
    if (!visits.empty()) (code > visits.back() ? falls : rises) = false;
    visits.push_back(code);
  }
  motion.is_sorted =
      (rises || falls) && num_levels >= 3 && rows >= 2 * num_levels;
  motion.num_passes = rows > 0 ? 1 : 0;
  if (num_levels < 2) return motion;
  motion.is_commanded = num_levels >= 3 && rows >= 2 * num_levels &&
                        std::ssize(visits) >= 2 * num_levels - 1 &&
                        Predictability(visits) >= 0.8;
  std::vector<int> signs = StepSigns(levels);
  motion.directions = DirectionsOf(levels, signs);
  const auto up = std::ranges::count(motion.directions, 1);
  constexpr double kGoodPart = 0.25;
  motion.both_ways =
      motion.is_commanded &&
      static_cast<double>(std::min(up, std::ssize(signs) - up)) >=
          kGoodPart * static_cast<double>(n);
  if (motion.is_commanded && !motion.both_ways) {
    BeginAnew(levels, 2 * up > std::ssize(signs) ? 1 : -1, &signs);
    motion.directions = DirectionsOf(levels, signs);
  }
  // A pass begins anew where the way is again that of the first row, or with a
  // long step back.
  const int first = n > 0 ? motion.directions[0] : 0;
  Index before = -1;
  Index pass = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Index now = levels.codes[i];
    if (now >= 0 && before >= 0) {
      const bool jumps = now != before && signs[i] == 0;
      const bool turns = motion.both_ways && motion.directions[i] == first &&
                         motion.directions[i - 1] != first;
      if (jumps || turns) ++pass;
    }
    motion.passes[i] = pass;
    if (now < 0) continue;
    before = now;
    // What was logged before a pass, without a position, belongs to it.
    for (std::size_t k = i; k-- > 0 && levels.codes[k] < 0;) {
      motion.passes[k] = pass;
    }
  }
  motion.num_passes = pass + 1;
  return motion;
}

}  // namespace errmap::data
