
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data/columns.h"
#include "data/measurements/axis/axis.h"
#include "data/measurements/clock/clock.h"
#include "data/measurements/clock/time_units.h"
#include "data/measurements/column_roles.h"
#include "data/measurements/reading/table_in_reading.h"
#include "data/text.h"

namespace errmap::data {
namespace {

using Eigen::Index;

using Span = std::pair<double, double>;

// Whether nearly no time comes again in a session after other times.
bool AreDistinct(const Eigen::VectorXd& time,
                 const std::vector<std::string>& sessions) {
  std::vector<std::pair<std::string, double>> moments;
  for (std::size_t i = 0; i < sessions.size(); ++i) {
    moments.emplace_back(sessions[i], time[static_cast<Index>(i)]);
  }
  const auto without_repeats = [&] {
    moments.erase(std::unique(moments.begin(), moments.end()), moments.end());
    return std::ssize(moments);
  };
  const auto runs = without_repeats();
  std::ranges::sort(moments);
  return 10 * without_repeats() >= 9 * runs;
}

// Whether no session begins before another ends.
template <typename Label>
bool LieApart(const Eigen::VectorXd& time, const std::vector<Label>& sessions) {
  std::map<Label, Span> spans;
  for (std::size_t i = 0; i < sessions.size(); ++i) {
    const double at = time[static_cast<Index>(i)];
    Span& span = spans.try_emplace(sessions[i], at, at).first->second;
    span = {std::min(span.first, at), std::max(span.second, at)};
  }
  std::vector<Span> in_order;
  for (const auto& [session, span] : spans) in_order.push_back(span);
  std::ranges::sort(in_order);
  for (std::size_t i = 1; i < in_order.size(); ++i) {
    if (in_order[i].first < in_order[i - 1].second) return false;
  }
  return true;
}

bool RanksBefore(const std::string& a,
                 const std::string& b,
                 const std::map<std::string, std::size_t>& rank) {
  double of_a = 0.0;
  double of_b = 0.0;
  if (ParseNumber(a, &of_a) && ParseNumber(b, &of_b)) return of_a < of_b;
  return rank.at(a) < rank.at(b);
}

// The places (n) of rows in the order of their times (n): by one clock for all
// where the sessions (n names; "": none) lie apart in it, else in each session
// by itself, these by number or in order of appearance. Nothing where times
// without dates come again, as those of a clock that starts anew would.
std::optional<std::vector<Index>> OrderOfTime(
    const Clock& clock, const std::vector<std::string>& sessions) {
  const Eigen::VectorXd& time = clock.time;
  if (!clock.dated && !AreDistinct(time, sessions)) return std::nullopt;
  const bool apart = LieApart(time, sessions);
  std::map<std::string, std::size_t> rank;
  for (const std::string& session : sessions) {
    rank.try_emplace(session, rank.size());
  }
  std::vector<Index> places(sessions.size());
  std::iota(places.begin(), places.end(), Index{0});
  std::ranges::stable_sort(places, [&](Index a, Index b) {
    const auto& of_a = sessions[a];
    const auto& of_b = sessions[b];
    if (!apart && of_a != of_b) return RanksBefore(of_a, of_b, rank);
    return time[a] < time[b];
  });
  return places;
}

// Whether the number of the cycle (n) changes every few rows, and not to the
// next one or to the first, or at one position (n codes; none: not known).
bool AreMixed(const std::vector<double>& cycles,
              const std::vector<Index>& positions) {
  constexpr std::size_t kFewestRows = 12;
  constexpr std::size_t kFewRows = 6;  // of a cycle in one piece
  if (cycles.size() < kFewestRows) return false;
  double first = INFINITY;
  for (const double cycle : cycles) first = std::min(first, cycle);
  std::size_t changes = 0;
  std::size_t odd = 0;
  for (std::size_t i = 1; i < cycles.size(); ++i) {
    const double now = cycles[i];
    const double before = cycles[i - 1];
    if (now == before || std::isnan(now - before)) continue;
    ++changes;
    const bool stays = !positions.empty() && positions[i] == positions[i - 1];
    odd += stays || (now != before + 1.0 && now != first) ? 1 : 0;
  }
  return 2 * odd > changes && kFewRows * changes > cycles.size();
}

// Of each base row the number of the cycle; nothing without one.
std::vector<double> CyclesOf(const TableInReading& in) {
  std::ptrdiff_t column = in.read.roles.group;
  if (column == kNoColumn) column = in.FirstCalled(Word::kRun);
  if (column == kNoColumn) return {};
  return ValuesOf(in.table().At(column), in.base_rows);
}

bool CyclesAreMixed(const TableInReading& in) {
  const std::vector<double> cycles = CyclesOf(in);
  const std::vector<Index>& codes = in.read.axis.levels.codes;
  return AreMixed(cycles,
                  codes.size() == cycles.size() ? codes : std::vector<Index>());
}

// Whether cycles, sessions or numbers of the rows count down one by one through
// the file, whose newest row then stands on top.
bool CountsDown(const TableInReading& in, const CsvColumn& column) {
  constexpr double kFewest = 3.0;
  if (column.is_text() || !column.exceptions.empty() || !KeepsRecord(column)) {
    return false;
  }
  const std::vector<double> values = ValuesOf(column, in.base_rows);
  return !values.empty() && values.front() >= values.back() + kFewest &&
         std::ranges::adjacent_find(values, [](double now, double next) {
           return !(next == now || next == now - 1.0);
         }) == values.end();
}

// A clock without dates goes back at nearly every row where the newest row
// stands on top. A single traverse downwards may have numbers that fall.
bool IsUpsideDown(const TableInReading& in) {
  constexpr Index kFewestRows = 12;
  const auto n = std::ssize(in.base_rows);
  if (n < kFewestRows || in.read.axis.motion.is_sorted) return false;
  if (in.clock.is_found()) {
    return !in.clock.dated && 4 * TimesBack(in.clock.time) > 3 * n;
  }
  return std::ranges::any_of(in.table().columns, [&](const CsvColumn& column) {
    return CountsDown(in, column);
  });
}

// Of each base row, by the column that is called so; "" without one.
std::vector<std::string> SessionLabels(const TableInReading& in) {
  std::vector<std::string> labels(in.base_rows.size());
  std::ptrdiff_t column = in.table().Find(in.selection.session);
  if (in.selection.session.empty()) column = in.FirstCalled(Word::kSession);
  for (std::size_t i = 0; column >= 0 && i < labels.size(); ++i) {
    labels[i] = in.table().CellText(in.table().At(column),
                                    static_cast<std::size_t>(in.base_rows[i]));
  }
  return labels;
}

void TakeInOrder(TableInReading* in, const std::vector<Index>& places) {
  std::vector<Index> order;
  std::vector<bool> taken(in->given.num_rows, false);
  for (const Index place : places) {
    order.push_back(in->base_rows[place]);
    taken[order.back()] = true;
  }
  for (std::size_t row = 0; row < taken.size(); ++row) {
    if (!taken[row]) order.push_back(static_cast<Index>(row));
  }
  in->read.table = TakeRows(in->table(), order);
  in->read.order = std::move(order);
  in->base_rows = AllRows(in->base_rows.size());
  in->read.reading.order = "time";
}

// False if there is no such order.
bool SortByTime(TableInReading* in) {
  const auto places = OrderOfTime(in->clock, SessionLabels(*in));
  if (places) TakeInOrder(in, *places);
  return places.has_value();
}

void TurnUpsideDown(TableInReading* in) {
  std::vector<Index> places = AllRows(in->base_rows.size());
  std::ranges::reverse(places);
  TakeInOrder(in, places);
}

void FindClockAndAxis(TableInReading* in, bool looks_for_axis) {
  in->clock = FindClock(in->table(), in->selection, in->base_rows);
  if (!looks_for_axis) return;
  in->read.axis = FindAxis(
      in->table(), in->selection, in->read.roles.target, in->base_rows);
  // What no name calls a position, and the rows are in order of, is none if
  // they are in order of time as well: it counts on. Nor is it one if times
  // recur: at one time an axis is in one place only.
  const Axis& axis = in->read.axis;
  if (axis.motion.is_sorted && axis.evidence == Evidence::kValues &&
      in->clock.is_found() &&
      (TimesBack(in->clock.time) == 0 ||
       !AreDistinct(in->clock.time,
                    std::vector<std::string>(in->base_rows.size())))) {
    in->read.axis = {};
  }
}

}  // namespace

void PutInOrder(TableInReading* in, RowsFor use) {
  const bool looks_for_axis =
      use == RowsFor::kLearning || !in->selection.position.empty();
  FindClockAndAxis(in, looks_for_axis);
  if (use == RowsFor::kLearning && LeaveOutSavedTwice(in)) {
    FindClockAndAxis(in, looks_for_axis);
  }
  constexpr Index kFewestRows = 12;
  const auto n = static_cast<Index>(in->base_rows.size());
  const Index back = TimesBack(in->clock.time);
  const bool sorted = in->read.axis.motion.is_sorted && n >= kFewestRows;
  // Dates go back hardly ever; hours, and what begins anew, each day.
  const bool often =
      4 * back > n || (in->clock.dated && back >= 3 && 50 * back > n);
  const bool disorder =
      in->clock.is_found() &&
      (often || (sorted && back > 0) ||
       (in->clock.dated && in->given.parts.size() > 1 &&
        !LieApart(in->clock.time, PartsOfRows(in->given, in->base_rows))));
  const bool tells_no_history =
      disorder || (!in->clock.is_found() && (sorted || CyclesAreMixed(*in)));
  if (IsUpsideDown(*in)) {
    TurnUpsideDown(in);
    FindClockAndAxis(in, looks_for_axis);
  } else if (disorder && SortByTime(in)) {
    FindClockAndAxis(in, looks_for_axis);
  } else if (tells_no_history) {
    in->ordered = false;
    in->read.reading.order = "none";
  }
  if (in->ordered) {
    GoOnOverMidnight(in->table(), in->base_rows, &in->clock);
  } else {
    in->clock = {};
    in->clock.known.assign(in->base_rows.size(), true);
    in->clock.time.resize(n);
    std::ranges::copy(in->base_rows, in->clock.time.begin());
  }
  in->nights = FindNights(in->clock, in->Passes(), in->selection);
}

}  // namespace errmap::data
