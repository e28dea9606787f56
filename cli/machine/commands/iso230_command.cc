#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/commands/data_arguments.h"
#include "cli/commands/maps/map_warnings.h"
#include "cli/json_blocks.h"
#include "cli/output/claimed_folder.h"
#include "cli/report/figures/svg.h"
#include "cli/report/number_text.h"
#include "cli/report/plot.h"
#include "cli/report/table.h"
#include "cli/shell/command_options.h"
#include "cli/shell/standard_streams.h"
#include "cli/study_setup/provenance.h"
#include "data/files/atomic_file.h"
#include "data/files/shown_path.h"
#include "data/input_error.h"
#include "data/measurements/axis/motion.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/reading/read_table.h"
#include "data/text.h"
#include "data/way_words.h"
#include "models/kinematics/iso230.h"
#include "models/record_json.h"

namespace errmap::cli {
namespace {

using models::PositioningFigures;
using models::PositioningPoint;

struct Iso230Arguments {
  std::vector<std::string> files;
  std::vector<std::string> maps;  // none, one, or one per file
  std::string target;
  std::string position;
  std::string direction;
  std::string figure;
  std::string format = "table";
  bool quiet = false;
};

// Approaches with what they deviated by, without and with a map.
struct Approached {
  std::string target;
  data::Unit unit;
  std::string position;  // column
  std::vector<double> positions;
  std::vector<double> before;
  std::vector<double> after;  // none without a map
  std::vector<bool> upwards;
};

// How the table of a test is read: its axis, and its ways where a column has
// them.
data::Reading ReadingOf(const data::CsvTable& table,
                        const Iso230Arguments& arguments) {
  if (!arguments.direction.empty()) {
    data::RequireColumn(table, arguments.direction, "--direction");
  }
  data::Reading reading = data::ReadRoles(table,
                                          {.target = arguments.target,
                                           .position = arguments.position,
                                           .direction = arguments.direction,
                                           .with_log = false})
                              .reading;
  if (!reading.position.column) {
    throw data::InputError(
        table.file + ": no column is a position; name it with --position");
  }
  return reading;
}

// Where the axis was sent: readings of an encoder differ by microns.
VectorXd Targets(const VectorXd& positions) {
  const data::Levels levels = data::LevelsOf(
      {positions.data(), static_cast<std::size_t>(positions.size())});
  VectorXd targets(positions.size());
  for (Index i = 0; i < positions.size(); ++i) {
    const Index code = levels.codes[static_cast<std::size_t>(i)];
    targets[i] = code < 0 ? positions[i]
                          : levels.centers[static_cast<std::size_t>(code)];
  }
  return targets;
}

// By the column of directions if there is one, else by the motion.
std::vector<bool> DirectionsOf(const data::CsvTable& table,
                               const std::vector<Index>& rows,
                               const VectorXd& positions,
                               const data::Reading::Direction& direction,
                               bool named) {
  std::vector<bool> upwards = models::ApproachedUpwards(Targets(positions));
  const std::ptrdiff_t column = table.Find(direction.column.value_or(""));
  if (column < 0) return upwards;
  const data::CsvColumn& words = table.At(column);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto row = static_cast<std::size_t>(rows[i]);
    const std::string word = table.CellText(words, row);
    const auto label = std::ranges::find(direction.labels, word);
    const bool is_told = direction.sure && direction.labels.size() == 2 &&
                         label != direction.labels.end();
    if (is_told) {
      upwards[i] = label == direction.labels.begin();
    } else if (const auto up = data::IsUpwards(word)) {
      upwards[i] = *up;
    } else if (named) {
      throw data::InputError(
          fmt::format("{}: {} is not a direction: up or down, + or -, 1 or -1; "
                      "without --direction the order of the positions decides",
                      table.Where(row, words.name),
                      data::QuotedName(word)));
    }
  }
  return upwards;
}

void Take(const data::CsvTable& table,
          const data::Reading& reading,
          const std::vector<Index>& rows,
          const data::ColumnInfo& target,
          const VectorXd& before,
          const VectorXd& after,
          const Iso230Arguments& arguments,
          Approached* all) {
  const std::string& position = *reading.position.column;
  const VectorXd positions = data::NumericColumn(table, position)(rows);
  if (all->target.empty()) {
    all->target = target.name;
    all->unit = target.unit;
    all->position = position;
  } else if (all->unit.symbol != target.unit.symbol) {
    throw data::InputError(
        fmt::format("{}: the error is in {}, that of {} in {}",
                    table.file,
                    target.unit.symbol,
                    arguments.files.front(),
                    all->unit.symbol));
  }
  const std::vector<bool> upwards = DirectionsOf(
      table, rows, positions, reading.direction, !arguments.direction.empty());
  all->positions.insert(
      all->positions.end(), positions.begin(), positions.end());
  all->before.insert(all->before.end(), before.begin(), before.end());
  all->after.insert(all->after.end(), after.begin(), after.end());
  all->upwards.insert(all->upwards.end(), upwards.begin(), upwards.end());
}

void ReadWithMap(const std::string& file,
                 const std::string& map,
                 const Iso230Arguments& arguments,
                 Approached* all) {
  const models::FittedModel fitted = LoadMap(map, arguments.quiet);
  const models::MapRows rows = ReadMapRows(fitted, {file}, {}, arguments.quiet);
  const VectorXd& measured = rows.dataset.target_values();
  Take(rows.table,
       ReadingOf(rows.table, arguments),
       rows.dataset.rows(),
       fitted.target,
       measured,
       measured - fitted.PredictForm(fitted.FormInputs(rows.dataset)).errors,
       arguments,
       all);
}

void ReadAlone(const std::string& file,
               const Iso230Arguments& arguments,
               Approached* all) {
  const data::CsvTable table = data::ReadCsv(file);
  const data::Reading reading = ReadingOf(table, arguments);
  const data::PreparedDataset prepared =
      data::MakeDataset(table,
                        {.target = arguments.target,
                         .inputs = {*reading.position.column},
                         .only_to_judge = true,
                         .with_log = false});
  const data::Dataset& dataset = prepared.dataset;
  Take(table,
       reading,
       dataset.rows(),
       dataset.target(),
       dataset.target_values(),
       {},
       arguments,
       all);
}

Approached ReadAll(const Iso230Arguments& arguments) {
  Approached all;
  for (std::size_t i = 0; i < arguments.files.size(); ++i) {
    if (arguments.maps.empty()) {
      ReadAlone(arguments.files[i], arguments, &all);
    } else {
      ReadWithMap(arguments.files[i],
                  arguments.maps[std::min(i, arguments.maps.size() - 1)],
                  arguments,
                  &all);
    }
  }
  return all;
}

std::vector<PositioningPoint> PointsOf(const Approached& all,
                                       const std::vector<double>& deviations) {
  const auto vector = [](const std::vector<double>& values) {
    return Eigen::Map<const VectorXd>(values.data(), std::ssize(values));
  };
  return models::PositioningPointsOf(
      {.positions = Targets(vector(all.positions)),
       .deviations = vector(deviations),
       .upwards = all.upwards});
}

// A test as it was measured, and with a map if there is one.
struct Judged {
  std::vector<PositioningPoint> before;
  std::vector<PositioningPoint> after;
};

// A figure of the standard by its letter.
struct Figure {
  const char* key;
  const char* words;
  double value;
};

std::vector<Figure> FiguresOf(const std::vector<PositioningPoint>& points) {
  const PositioningFigures f = PositioningFiguresOf(points);
  return {{"A", "bidirectional accuracy", f.accuracy},
          {"A_up", "accuracy, upwards", f.up.accuracy},
          {"A_down", "accuracy, downwards", f.down.accuracy},
          {"R", "bidirectional repeatability", f.repeatability},
          {"R_up", "repeatability, upwards", f.up.repeatability},
          {"R_down", "repeatability, downwards", f.down.repeatability},
          {"E", "bidirectional systematic error", f.systematic},
          {"E_up", "systematic error, upwards", f.up.systematic},
          {"E_down", "systematic error, downwards", f.down.systematic},
          {"M", "mean bidirectional error", f.mean_bidirectional},
          {"B", "reversal error", f.reversal},
          {"B_mean", "mean reversal, up less down", f.mean_reversal}};
}

report::Table FiguresTable(const Judged& judged, const data::Unit& unit) {
  report::Table table;
  const std::vector<Figure> before = FiguresOf(judged.before);
  const std::vector<Figure> after =
      judged.after.empty() ? std::vector<Figure>() : FiguresOf(judged.after);
  for (std::size_t i = 0; i < before.size(); ++i) {
    const auto number = [&](const Figure& figure) {
      return report::Number{figure.value, 4, unit.display_scale};
    };
    std::vector<report::Table::Named> row = {{{"figure", false}, before[i].key},
                                             {{"measured"}, number(before[i])}};
    if (!after.empty()) row.push_back({{"with the map"}, number(after[i])});
    row.push_back({{"unit", false}, std::string_view(unit.display_symbol)});
    row.push_back({{"what", false}, before[i].words});
    table.Add(std::move(row));
  }
  return table;
}

struct RunCount {
  Index least = 0;
  Index most = 0;
};
RunCount RunsOf(const std::vector<PositioningPoint>& points,
                models::Approaches PositioningPoint::*side) {
  RunCount count{.least = (points.front().*side).runs, .most = 0};
  for (const PositioningPoint& point : points) {
    count.least = std::min(count.least, (point.*side).runs);
    count.most = std::max(count.most, (point.*side).runs);
  }
  return count;
}

std::string RunsText(const RunCount& count) {
  return count.least == count.most
             ? fmt::format("{}", count.least)
             : fmt::format("{} to {}", count.least, count.most);
}

// What the test has, and what the standard asks for that it lacks.
std::string TestText(const Approached& all, const Judged& judged) {
  constexpr Index kRunsAsked = 5;
  const RunCount up = RunsOf(judged.before, &PositioningPoint::up);
  const RunCount down = RunsOf(judged.before, &PositioningPoint::down);
  std::string text =
      fmt::format("ISO 230-2: {} at {}, {} runs upwards and {} downwards\n",
                  data::Printable(all.target),
                  report::Count(std::ssize(judged.before), "position"),
                  RunsText(up),
                  RunsText(down));
  if (up.most == 0 || down.most == 0) {
    text +=
        "all runs are in one direction: A, R, E, M and B need both; give the "
        "file of the other direction, too\n";
  } else if (std::min(up.least, down.least) < kRunsAsked) {
    text += fmt::format("the standard asks for {} runs in each direction\n",
                        kRunsAsked);
  }
  return text;
}

Json FiguresJson(const std::vector<PositioningPoint>& points) {
  if (points.empty()) return nullptr;
  Json json;
  for (const Figure& figure : FiguresOf(points)) {
    json[figure.key] = figure.value;
  }
  return json;
}

Json TestJson(const Iso230Arguments& arguments,
              const Approached& all,
              const Judged& judged,
              const std::string& command_line) {
  Json files = Json::array();
  std::vector<study_setup::InputFile> inputs;
  for (const std::string& file : arguments.files) {
    files.push_back(data::ShownPath(file));
    inputs.push_back(study_setup::HashInput(file));
  }
  for (const std::string& map : arguments.maps) {
    inputs.push_back(study_setup::HashInput(map));
  }
  return {{"schema", "errmap-iso230-1"},
          {"files", std::move(files)},
          {"target", all.target},
          {"unit", all.unit.symbol},
          {"position", all.position},
          {"measured", FiguresJson(judged.before)},
          {"with_map", FiguresJson(judged.after)},
          {"points",
           {{"measured", models::ToJson(judged.before)},
            {"with_map", models::ToJson(judged.after)}}},
          {"provenance", ProvenanceJson(command_line, Json(nullptr), inputs)}};
}

// Means of one direction, and 2 s about them.
void AddSeries(const std::vector<PositioningPoint>& points,
               models::Approaches PositioningPoint::*side,
               const std::string& label,
               const std::string& colour,
               double scale,
               report::Plot* plot) {
  for (const double times : {0.0, -2.0, 2.0}) {
    report::Series series{.label = times == 0.0 ? label : "",
                          .mark = report::Mark::kLine,
                          .colour = colour,
                          .dashed = times != 0.0};
    for (const PositioningPoint& point : points) {
      const models::Approaches& of = point.*side;
      series.Add({point.position,
                  scale * (times == 0.0 ? of.mean : of.mean + times * of.sd)});
    }
    plot->series.push_back(std::move(series));
  }
}

std::string FigureSvg(const Approached& all, const Judged& judged) {
  report::Plot plot;
  plot.name = "iso230";
  plot.width = 820;
  plot.height = 420;
  plot.x = {.quantity = all.position};
  plot.y = {.quantity = "deviation", .unit = all.unit.display_symbol};
  const auto add = [&](const std::vector<PositioningPoint>& points,
                       const std::string& what,
                       const char* up,
                       const char* down) {
    if (points.empty()) return;
    const double scale = all.unit.display_scale;
    AddSeries(
        points, &PositioningPoint::up, "upwards" + what, up, scale, &plot);
    AddSeries(points,
              &PositioningPoint::down,
              "downwards" + what,
              down,
              scale,
              &plot);
  };
  add(judged.before, "", "#0072B2", "#A33A00");
  add(judged.after, ", with the map", "#56B4E9", "#E69F00");
  return report::SvgFile(
      report::Svg(plot,
                  "Positioning test by ISO 230-2",
                  "Means of the runs at each position in each direction, and "
                  "two standard deviations about them."));
}

int RunIso230(const Iso230Arguments& arguments,
              const std::string& command_line) {
  if (arguments.maps.size() > 1 &&
      arguments.maps.size() != arguments.files.size()) {
    throw UsageError(
        fmt::format("{} maps for {} files: name one for all, or one for each",
                    arguments.maps.size(),
                    arguments.files.size()));
  }
  if (!arguments.figure.empty()) {
    std::vector<std::string> read = arguments.files;
    read.insert(read.end(), arguments.maps.begin(), arguments.maps.end());
    CheckOutputName("--figure", arguments.figure, read);
    RequirePlaceFor(arguments.figure);
  }
  const Approached all = ReadAll(arguments);
  Judged judged{.before = PointsOf(all, all.before), .after = {}};
  if (!all.after.empty()) judged.after = PointsOf(all, all.after);
  if (!arguments.figure.empty()) {
    data::WriteFileAtomically(arguments.figure, FigureSvg(all, judged));
  }
  if (arguments.format == "json") {
    PrintResult(DumpJson(TestJson(arguments, all, judged, command_line)));
    return kDone;
  }
  const report::Table table = FiguresTable(judged, all.unit);
  const auto text = report::TableText(table, arguments.format);
  if (text) {
    PrintResult(*text);
  } else {
    PrintFitted(TestText(all, judged) +
                report::TerminalTable(table, OutputTerminal().columns));
  }
  return kDone;
}

}  // namespace

void AddIso230Command(CLI::App* app, Run* run) {
  const Command<Iso230Arguments> command(
      app,
      run,
      "iso230",
      "Figures of a positioning test (ISO 230-2), with a map or without");
  AddOption(command, "DATA FILE.csv", command->files)
      .About(
          "CSV files with the error at each approach to a position: one file "
          "for both directions, or one for each")
      .Required();
  AddOption(command, "--map MODEL.json", command->maps)
      .About(
          "Map to compensate by: one for all files, or one per file in order")
      .OneAtATime();
  AddOption(command, "--target COL", command->target)
      .About("Column of the error (default: the only one named error*)");
  AddOption(command, "--position COL", command->position)
      .About(
          "Column of the target positions (default: the first named "
          "position*)");
  AddOption(command, "--direction COL", command->direction)
      .About(
          "Column of the direction of approach: up or down, + or - (default: "
          "direction, else the order of the positions)");
  AddOption(command, "--figure FILE.svg", command->figure)
      .About("Draw the test");
  AddTableFormatOption(command, "What to print", &command->format);
  AddQuietFlag(command, &command->quiet);
  SetFooter(
      command,
      R"(Each row is one approach to a position. The figures of ISO 230-2:2014
come from the means and standard deviations of the runs at each position and
direction.
- A: accuracy; R: repeatability; E: systematic error; also of one direction
alone
- M: mean bidirectional error; B: reversal error

The standard tests a settled machine: in warm-up rows its drift enters R and
A.
Example: errmap iso230 data/sets/turning_centre/x_displacement_down.csv data/sets/turning_centre/x_displacement_up.csv)");
  command.Runs(RunIso230);
}

}  // namespace errmap::cli
