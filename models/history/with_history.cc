#include "models/history/with_history.h"

#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "models/history/session_start.h"

namespace errmap::models {

FittedModel WithHistory(FittedModel fitted,
                        const data::Dataset& training,
                        const History& history) {
  auto read = std::make_shared<History>();
  read->time_unit = history.time_unit;
  read->session = history.session;
  read->time = history.time;
  read->gap = history.gap;
  read->latest_start = LatestStart(training);
  read->longest_step = LongestStep(training);
  std::set<std::string> needed;
  for (const TrainedInput& input : fitted.inputs) {
    read->form_inputs.push_back(input.column.name);
    needed.insert(input.column.name);
  }
  // Backwards, since each derived input builds on earlier ones only.
  for (auto input = history.derived.rbegin(); input != history.derived.rend();
       ++input) {
    if (!needed.contains(input->column.name)) continue;
    needed.insert(input->of);
    read->derived.insert(read->derived.begin(), *input);
  }
  read->row_changes = RowChanges(training, *read);
  LearnStarts(training, read.get());
  std::vector<Index> columns;
  for (const std::string& name : read->columns()) {
    columns.push_back(training.FindInput(name));
  }
  fitted.inputs = DescribeInputs(training, columns);
  fitted.history = std::move(read);
  return fitted;
}

bool CountsRows(const FittedModel& fitted) {
  return fitted.history != nullptr && fitted.history->needs_time() &&
         fitted.history->time_unit == "rows";
}

FittedModel WithRowsEvery(FittedModel fitted, double seconds) {
  if (!CountsRows(fitted)) return fitted;
  auto timed = std::make_shared<History>(*fitted.history);
  timed->time_unit = "s";
  timed->latest_start *= seconds;
  timed->longest_step *= seconds;
  timed->row_changes.clear();
  for (DerivedInput& input : timed->derived) input.tau *= seconds;
  fitted.history = std::move(timed);
  return fitted;
}

}  // namespace errmap::models
