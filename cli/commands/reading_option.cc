#include <fmt/format.h>

#include "cli/commands/data_arguments.h"
#include "data/files/atomic_file.h"
#include "data/files/shown_path.h"
#include "data/input_error.h"
#include "data/measurements/reading/reading.h"
#include "data/throwing_as.h"
#include "models/record_json.h"

namespace errmap::cli {

void TakeReading(const std::string& path, data::DatasetSelection* selection) {
  const data::Reading reading =
      data::ThrowingAs<data::InputError, data::InputError>(
          data::ShownPath(path) + ": ", [&] {
            return models::RecordFromText<data::Reading>(
                data::ReadFile(path),
                data::Reading().schema,
                "errmap read DATA.csv --format json > reading.json writes one");
          });
  if (!reading.questions.empty()) {
    throw data::InputError(fmt::format("{}: is open: {}",
                                       data::ShownPath(path),
                                       reading.questions.front().question));
  }
  // "-correction_um" of a correction.
  if (reading.target.column) selection->target = *reading.target.column;
  selection->inputs.clear();
  if (reading.position.column) {
    selection->position = *reading.position.column;
    selection->inputs.push_back(*reading.position.column);
  }
  for (const auto* columns : {&reading.positions,
                              &reading.sensors,
                              &reading.switches,
                              &reading.counters}) {
    selection->inputs.insert(
        selection->inputs.end(), columns->begin(), columns->end());
  }
  if (!reading.direction.chosen.empty()) {
    selection->direction = reading.direction.chosen;
  } else if (reading.direction.by == "column") {
    selection->direction = *reading.direction.column;
  }
  // "Datum + Uhrzeit" is found again as it was.
  if (reading.time.column &&
      reading.time.column->find(" + ") == std::string::npos) {
    selection->time = *reading.time.column;
    if (reading.time.unit != "date" && reading.time.unit != "rows") {
      selection->time_unit = reading.time.unit;
    }
  }
  if (reading.cycles.by == "column") selection->group = *reading.cycles.column;
  if (reading.sessions.column) {
    selection->session = *reading.sessions.column;
  } else if (reading.sessions.gap_s) {
    selection->gap = fmt::format("{:.6g}s", *reading.sessions.gap_s);
  }
}

}  // namespace errmap::cli
