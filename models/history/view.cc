#include "models/history/view.h"

#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "data/text.h"
#include "models/history/session_start.h"
#include "models/history/view_options.h"
#include "models/shared_work.h"
#include "stats/indices.h"
#include "stats/not_a_number.h"
#include "stats/order_statistic.h"

namespace errmap::models {
namespace {

using data::Dataset;
bool Filters(View view) {
  return view == View::kHistory || view == View::kHistoryAndZero;
}

bool TakesZero(View view) {
  return view == View::kZero || view == View::kHistoryAndZero;
}

bool IsAngle(const data::ColumnInfo& column) {
  return column.unit.quantity == data::Quantity::kAngle;
}

// Returns true if an angle among the inputs turns so far that its sine and
// cosine carry more than the angle itself.
bool TurnsFar(const Dataset& training) {
  constexpr double kFar = 0.5;  // rad
  for (Index j = 0; j < training.num_inputs(); ++j) {
    const data::ColumnInfo& input =
        training.inputs()[static_cast<std::size_t>(j)];
    if (!IsAngle(input) || training.num_rows() == 0) continue;
    const auto values = training.input_values().col(j);
    const double span = values.maxCoeff() - values.minCoeff();
    if (span * RadiansPer(input) >= kFar) return true;
  }
  return false;
}

// The definitions of a view over the inputs of `training`.
History DefineView(const Dataset& training,
                   View view,
                   const std::vector<double>& time_constants,
                   bool sine_and_cosine) {
  History history;
  if (training.log() != nullptr) {
    history.time_unit = training.log()->time_unit;
    history.session = training.log()->sessions.column;
    history.time = training.log()->time_column;
    history.gap = training.log()->gap;
  }
  // Columns that filters and zeros are taken of, and columns that stay.
  std::vector<data::ColumnInfo> varying;
  for (const data::ColumnInfo& input : training.inputs()) {
    if (sine_and_cosine && IsAngle(input)) {
      for (const DerivedInput& part : {SineOf(input), CosineOf(input)}) {
        history.derived.push_back(part);
        history.form_inputs.push_back(part.column.name);
      }
    } else if (data::IsPosition(input)) {
      history.form_inputs.push_back(input.name);
    } else {
      varying.push_back(input);
    }
  }
  if (Filters(view)) {
    const std::vector<data::ColumnInfo> measured = varying;
    for (const double tau : time_constants) {
      for (const data::ColumnInfo& input : measured) {
        history.derived.push_back(Ema(input, tau, history.time_unit));
        varying.push_back(history.derived.back().column);
      }
    }
  }
  for (const data::ColumnInfo& column : varying) {
    if (TakesZero(view)) {
      history.derived.push_back(Zeroed(column));
      history.form_inputs.push_back(history.derived.back().column.name);
    } else {
      history.form_inputs.push_back(column.name);
    }
  }
  return history;
}

// Returns why these rows have no such view; "" if they have.
std::string WhyNot(const Dataset& training,
                   View view,
                   const std::vector<double>& time_constants) {
  const bool only_positions = std::ranges::all_of(
      training.inputs(),
      [](const data::ColumnInfo& input) { return data::IsPosition(input); });
  if (view == View::kRaw) return "";
  if (only_positions) return "there is no input besides positions";
  if (training.log() == nullptr) return "no sessions and times are known";
  if (!training.log()->ordered) return "the rows are in no order of time";
  if (Filters(view) && time_constants.empty()) {
    return "no session has a length";
  }
  if (TakesZero(view) && !training.has_sessions()) {
    return "a zero needs two sessions or more";
  }
  return "";
}

// Returns true if the means of the sessions rise all the way, or fall, and
// hardly a value lies in the range of the sessions before. Most columns turn
// within the first sessions: the rest is not looked at then.
bool OnlyGrows(Eigen::Ref<const VectorXd> column,
               const std::vector<std::vector<Index>>& sessions) {
  constexpr double kHardly = 0.1;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  double mean_before = stats::kNaN;
  double returned = 0.0;  // shares of the later sessions
  bool rises = true;
  bool falls = true;
  for (const std::vector<Index>& places : sessions) {
    const Eigen::ArrayXd values = column(places);
    const double mean = values.mean();
    if (!std::isnan(mean_before)) {
      rises = rises && mean > mean_before;
      falls = falls && mean < mean_before;
      if (!rises && !falls) return false;
      returned += (values >= low && values <= high).cast<double>().mean();
    }
    mean_before = mean;
    low = std::min(low, values.minCoeff());
    high = std::max(high, values.maxCoeff());
  }
  return returned < kHardly * static_cast<double>(sessions.size() - 1);
}

}  // namespace

const std::vector<std::string>& ViewWords() {
  static const std::vector<std::string> words = {
      "raw", "history", "zero", "history+zero"};
  return words;
}

std::string_view ToString(View view) {
  return ViewWords()[static_cast<std::size_t>(view)];
}

std::string ViewedRows::label() const {
  std::string text(ToString(view));
  if (sine_and_cosine) text += " with sine and cosine";
  return text;
}

View ViewOf(std::string_view word) {
  return static_cast<View>(std::ranges::find(ViewWords(), word) -
                           ViewWords().begin());
}

std::vector<bool> ColumnsThatOnlyGrow(const Dataset& rows) {
  constexpr std::size_t kFewestSessions = 3;
  std::vector<bool> only_grow(static_cast<std::size_t>(rows.num_inputs()),
                              false);
  auto sessions = stats::IndicesByCode(rows.session_codes());
  std::erase_if(sessions, [](const auto& of_one) { return of_one.empty(); });
  if (sessions.size() < kFewestSessions) return only_grow;
  for (Index j = 0; j < rows.num_inputs(); ++j) {
    only_grow[static_cast<std::size_t>(j)] =
        OnlyGrows(rows.input_values().col(j), sessions);
  }
  return only_grow;
}

std::vector<double> MakeTimeConstants(const Dataset& training) {
  if (training.log() == nullptr) return {};
  const data::SessionLog& log = *training.log();
  std::vector<double> lengths;
  for (const std::vector<Index>& rows : RowsOfSessions(training)) {
    const VectorXd times = log.time(rows);
    lengths.push_back(times.maxCoeff() - times.minCoeff());
  }
  if (lengths.empty()) return {};
  const double typical = stats::UpperMedian(std::move(lengths));
  if (!(typical > 0.0)) return {};
  // Three digits: they stand in names, and more would mean nothing.
  const auto rounded = [](double value) {
    const double unit = std::pow(10.0, std::floor(std::log10(value)) - 2.0);
    return std::round(value / unit) * unit;
  };
  constexpr std::array<double, 3> kShares = {100.0, 30.0, 10.0};
  std::vector<double> constants;
  for (const double share : kShares) {
    constants.push_back(rounded(typical / share));
  }
  return constants;
}

double LargestFirstError(const Dataset& training) {
  double largest = stats::kNaN;
  if (training.log() == nullptr) return largest;
  const data::SessionLog& log = *training.log();
  const std::set<Index> firsts(log.first_rows.begin(), log.first_rows.end());
  for (Index row = 0; row < training.num_rows(); ++row) {
    if (!firsts.contains(training.log_rows()[static_cast<std::size_t>(row)])) {
      continue;
    }
    const double size = std::abs(training.target_values()[row]);
    if (!(largest >= size)) largest = size;
  }
  return largest;
}

std::vector<ViewedRows> MakeViews(const Dataset& training,
                                  const std::optional<ViewOptions>& asked,
                                  double indifference) {
  const ViewOptions options = asked.value_or(ViewOptions{.view = View::kRaw});
  const bool with_history =
      !options.time_constants || !options.time_constants->empty();
  const std::vector<double> time_constants =
      options.time_constants && with_history ? *options.time_constants
                                             : MakeTimeConstants(training);
  std::vector<View> wanted;
  if (options.view) {
    const std::string why = WhyNot(training, *options.view, time_constants);
    if (!why.empty()) {
      throw std::invalid_argument(
          fmt::format("view={}: {}", ToString(*options.view), why));
    }
    wanted = {*options.view};
  } else {
    for (const View view :
         {View::kRaw, View::kHistory, View::kZero, View::kHistoryAndZero}) {
      if (Filters(view) && !with_history) continue;
      if (TakesZero(view) && !options.zero) continue;
      // A zero alone is part of a zero with history.
      if (view == View::kZero && with_history) continue;
      if (WhyNot(training, view, time_constants).empty()) {
        wanted.push_back(view);
      }
    }
  }
  std::vector<bool> angle_forms = {options.sine_and_cosine.value_or(false)};
  if (!options.view && !options.sine_and_cosine && TurnsFar(training)) {
    angle_forms.push_back(true);
  }
  std::vector<std::pair<View, bool>> forms;
  for (const View view : wanted) {
    for (const bool turned : angle_forms) forms.emplace_back(view, turned);
  }
  const double first_error = LargestFirstError(training);
  std::vector<ViewedRows> views;
  for (const auto& [view, sine_and_cosine] : forms) {
    ViewedRows viewed;
    viewed.view = view;
    viewed.sine_and_cosine = sine_and_cosine;
    const bool derives = view != View::kRaw || sine_and_cosine;
    if (derives) {
      viewed.history = std::make_shared<const History>(
          DefineView(training, view, time_constants, sine_and_cosine));
      viewed.rows = std::make_shared<const Dataset>(
          DeriveDataset(training, *viewed.history));
    } else {
      viewed.rows = std::make_shared<const Dataset>(training);
    }
    for (const data::ColumnInfo& input : viewed.rows->inputs()) {
      viewed.is_position.push_back(data::IsPosition(input));
    }
    viewed.only_grows = ColumnsThatOnlyGrow(*viewed.rows);
    // Inputs that are zero at the start of a session give a zero error there,
    // if that is what was measured.
    viewed.intercept =
        options.intercept && !(TakesZero(view) && first_error <= indifference);
    views.push_back(std::move(viewed));
  }
  return views;
}

std::shared_ptr<const std::vector<ViewedRows>> SharedViews(
    const Dataset& training,
    const std::optional<ViewOptions>& options,
    const FitContext& context) {
  const auto make = [&] {
    return std::make_shared<const std::vector<ViewedRows>>(
        MakeViews(training, options, context.indifference));
  };
  if (context.shared == nullptr) return make();
  auto views = context.shared->Get<std::vector<ViewedRows>>(
      fmt::format("views {} {}",
                  !options         ? "none"
                  : !options->view ? "auto"
                                   : ToString(*options->view),
                  KeyOf(options)),
      make,
      SharedWork::Keep::kWhileHeld);
  // Whoever fits other rows must not share; a wrong map would be silent.
  if (views->front().rows->target_values() != training.target_values()) {
    throw std::logic_error("SharedViews: the rows are not those shared");
  }
  return views;
}

}  // namespace errmap::models
