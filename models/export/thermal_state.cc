#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "data/argument_name.h"
#include "data/text.h"
#include "models/export/compensation_table.h"
#include "models/history/map_log.h"

namespace errmap::models {
namespace {

// The readings other than the position, if there is one.
std::vector<std::string> NamesBeside(const MapProgram& program, int position) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < program.readings.size(); ++i) {
    if (static_cast<int>(i) == position) continue;
    names.push_back(program.readings[i].column.name);
  }
  return names;
}

}  // namespace

std::vector<HeldReading> ParseHeldReadings(std::string_view text) {
  std::vector<HeldReading> held;
  while (!text.empty()) {
    const std::string_view item = text.substr(0, text.find(','));
    text.remove_prefix(std::min(item.size() + 1, text.size()));
    const std::size_t equals = item.rfind('=');
    double value = 0.0;
    if (equals == std::string_view::npos || equals == 0 ||
        !data::ParseNumber(item.substr(equals + 1), &value)) {
      throw std::invalid_argument(fmt::format(
          "{}: '{}' is not NAME=VALUE", data::ArgumentName("at"), item));
    }
    held.emplace_back(std::string(data::Trimmed(item.substr(0, equals))),
                      value);
  }
  return held;
}

void RequireHeldReadings(const std::vector<HeldReading>& held,
                         const std::vector<const MapProgram*>& programs) {
  std::vector<std::string> known;
  for (const MapProgram* program : programs) {
    for (std::string& name : NamesBeside(*program, PositionOf(*program))) {
      known.push_back(std::move(name));
    }
  }
  for (const HeldReading& reading : held) {
    if (std::ranges::find(known, reading.first) != known.end()) continue;
    const std::string near = data::NearestName(reading.first, known);
    throw std::invalid_argument(
        fmt::format("{}: no input {} beside the position{}",
                    data::ArgumentName("at"),
                    data::QuotedName(reading.first),
                    near.empty() ? "" : "; is it " + near + "?"));
  }
}

ErrorCurve CurveAfterLog(const FittedModel& fitted,
                         const MapProgram& program,
                         const data::CsvTable& log,
                         int row) {
  const MatrixXd readings = InputsOf(fitted, log);
  const MapLog map = MakeMapLog(fitted, log, {});
  ProgramRun run(program, Precision::kDouble);
  const auto session = [&](Index at) {
    return map.log->sessions.codes[static_cast<std::size_t>(at)];
  };
  Index before = -1;
  for (Index at = map.log == nullptr ? row : 0; at <= row; ++at) {
    if (map.log != nullptr && session(at) != session(row)) continue;
    double error = 0.0;
    if (before < 0) {
      run.Begin(readings.row(at));
    } else {
      run.Step(
          map.log->time[at] - map.log->time[before], readings.row(at), &error);
    }
    before = at;
  }
  return {program, std::move(run), readings.row(row)};
}

std::string StateText(const ErrorCurve& curve) {
  constexpr int kMost = 6;
  constexpr std::size_t kMostName = 40;
  std::string text;
  int named = 0;
  for (std::size_t i = 0; i < curve.program().readings.size(); ++i) {
    if (static_cast<int>(i) == curve.position_index()) continue;
    if (++named > kMost) return text + ", ...";
    text += fmt::format(
        "{}{} = {:g}",
        text.empty() ? "at " : ", ",
        data::Printable(curve.program().readings[i].column.name, kMostName),
        curve.readings()[static_cast<Index>(i)]);
  }
  return text.empty() ? "it reads nothing but the position" : text;
}

GridOptions ParseGrid(const std::string& grid,
                      const std::string& over,
                      const ErrorCurve& curve) {
  GridOptions options;
  int length = 0;
  if (std::sscanf(grid.c_str(),
                  "%5dx%5d%n",
                  &options.positions,
                  &options.columns,
                  &length) != 2 ||
      length != std::ssize(grid) || options.positions < 2 ||
      options.columns < 2) {
    throw std::invalid_argument(
        data::ArgumentName("grid") +
        " takes ROWSxCOLUMNS, both from 2 to 99999, such as 33x9");
  }
  const int position = curve.position_index();
  const std::vector<std::string> others =
      NamesBeside(curve.program(), position);
  if (over.empty() && others.size() == 1) {
    options.over = position == 0 ? 1 : 0;
  } else if (over.empty() && others.size() > 1) {
    throw std::invalid_argument(fmt::format(
        "{}: name the input across the columns with {}, one of {}",
        data::ArgumentName("table"),
        data::ArgumentName("over"),
        data::JoinWords(
            {others.begin(),
             others.begin() + std::min<std::ptrdiff_t>(6, std::ssize(others))},
            ", ")));
  } else if (!over.empty()) {
    const auto found = std::ranges::find(others, over);
    if (found == others.end()) {
      throw std::invalid_argument(
          fmt::format("{}: no input {} beside the position",
                      data::ArgumentName("over"),
                      data::QuotedName(over)));
    }
    const auto beside = static_cast<int>(found - others.begin());
    options.over = beside + (position >= 0 && beside >= position ? 1 : 0);
  }
  return options;
}

}  // namespace errmap::models
