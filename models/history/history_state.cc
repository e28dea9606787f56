#include "models/history/history_state.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "models/history/lag.h"
#include "stats/not_a_number.h"

namespace errmap::models {
namespace {

[[noreturn]] void Refuse(const std::string& what) {
  throw std::invalid_argument("HistoryState: " + what);
}

Index FindName(const std::vector<data::ColumnInfo>& columns,
               const std::string& name) {
  const auto found = std::ranges::find(columns, name, &data::ColumnInfo::name);
  if (found == columns.end()) {
    Refuse(fmt::format("no column or earlier derived input '{}'", name));
  }
  return found - columns.begin();
}

}  // namespace

HistoryState::HistoryState(const History& history,
                           const std::vector<data::ColumnInfo>& columns)
    : num_columns_(std::ssize(columns)) {
  std::vector<data::ColumnInfo> known = columns;
  for (const DerivedInput& input : history.derived) {
    Node node{.filter = input.filter, .source = FindName(known, input.of)};
    const data::ColumnInfo& of = known[static_cast<std::size_t>(node.source)];
    if (std::ranges::find(known, input.column.name, &data::ColumnInfo::name) !=
        known.end()) {
      Refuse(fmt::format("two inputs are named '{}'", input.column.name));
    }
    switch (input.filter) {
      case Filter::kEma:
        if (!(input.tau > 0.0) || !std::isfinite(input.tau)) {
          Refuse(fmt::format("tau of '{}' must be above 0, found {}",
                             input.column.name,
                             input.tau));
        }
        node.tau = static_cast<std::size_t>(
            std::ranges::find(taus_, input.tau) - taus_.begin());
        if (node.tau == taus_.size()) taus_.push_back(input.tau);
        node.between = input.between;
        break;
      case Filter::kZero:
        break;
      case Filter::kSine:
      case Filter::kCosine:
        node.factor = RadiansPer(of);
        break;
    }
    nodes_.push_back(node);
    known.push_back(input.column);
  }
  for (const std::string& name : history.form_inputs) {
    form_sources_.push_back(FindName(known, name));
    form_columns_.push_back(
        known[static_cast<std::size_t>(form_sources_.back())]);
  }
  gains_.resize(taus_.size());
  values_ = VectorXd::Constant(std::ssize(known), stats::kNaN);
  memory_ = VectorXd::Constant(std::ssize(nodes_), stats::kNaN);
  form_inputs_ = VectorXd::Constant(std::ssize(form_sources_), stats::kNaN);
}

void HistoryState::Start(const Eigen::Ref<const VectorXd>& readings) {
  values_.setConstant(stats::kNaN);
  memory_.setConstant(stats::kNaN);
  SetReadings(readings);
  started_ = true;
  Update(false);
}

void HistoryState::Step(double dt, const Eigen::Ref<const VectorXd>& readings) {
  if (!started_) Refuse("Step before Start");
  if (!(dt >= 0.0)) Refuse(fmt::format("a step of {}; time goes on", dt));
  previous_ = values_;
  SetReadings(readings);
  for (std::size_t i = 0; i < taus_.size(); ++i) {
    const double u = dt / taus_[i];
    const double mean_decay = MeanDecay(u);
    gains_[i] = {.decay = u * mean_decay, .ramp = 1.0 - mean_decay};
  }
  Update(true);
}

void HistoryState::TakeZero() {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (nodes_[i].filter == Filter::kZero) {
      memory_[static_cast<Index>(i)] = stats::kNaN;
    }
  }
  Update(false);
}

void HistoryState::SetReadings(const Eigen::Ref<const VectorXd>& readings) {
  if (readings.size() != num_columns_) {
    Refuse(
        fmt::format("{} readings, expected {}", readings.size(), num_columns_));
  }
  for (Index i = 0; i < num_columns_; ++i) {
    if (!std::isnan(readings[i])) values_[i] = readings[i];
  }
}

void HistoryState::Update(bool passes) {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    const double x = values_[node.source];
    double& memory = memory_[static_cast<Index>(i)];
    double& value = values_[num_columns_ + static_cast<Index>(i)];
    switch (node.filter) {
      case Filter::kEma:
        if (std::isnan(memory)) {
          memory = x;  // the first number: in its steady state
        } else if (passes) {
          const Gains& gains = gains_[node.tau];
          const double from =
              node.between == Between::kLinear ? previous_[node.source] : x;
          memory += gains.decay * (from - memory) + gains.ramp * (x - from);
        }
        value = memory;
        break;
      case Filter::kZero:
        if (std::isnan(memory)) memory = x;
        value = x - memory;
        break;
      case Filter::kSine:
        value = std::sin(node.factor * x);
        break;
      case Filter::kCosine:
        value = std::cos(node.factor * x);
        break;
    }
  }
  for (std::size_t i = 0; i < form_sources_.size(); ++i) {
    form_inputs_[static_cast<Index>(i)] = values_[form_sources_[i]];
  }
}

}  // namespace errmap::models
