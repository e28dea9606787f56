#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/commands/data_arguments.h"
#include "cli/output/claimed_folder.h"
#include "cli/report/text/commands/fault_text.h"
#include "cli/report/wrap_text.h"
#include "cli/shell/command_options.h"
#include "cli/shell/standard_streams.h"
#include "data/column_header.h"
#include "data/csv.h"
#include "data/files/atomic_file.h"
#include "data/measurements/joined_tables.h"
#include "data/measurements/reading/read_table.h"
#include "data/text.h"
#include "models/record_json.h"

namespace errmap::cli {
namespace {

struct ReadArguments {
  DataArguments data;
  std::string out;
  std::string format = "table";
};

// The rows that are used, in the order in which they were read, to be read
// again as they were: with the columns that were found in the others, session
// and time_s, which takes the place of a clock that is not a date.
// The name of a column in the clean table. A negative that --target made has
// the sign of an error now; under its own name it would be asked for again.
std::string CleanName(const data::CsvTable& table,
                      const data::ReadTable& read,
                      std::size_t column) {
  const std::string& name = table.columns[column].name;
  const std::string error = fmt::format("error [{}]", read.reading.target.unit);
  return column == read.roles.target && name.starts_with('-') &&
                 table.Find(error) < 0
             ? error
             : name;
}

std::string CleanCsv(const data::CsvTable& table,
                     const data::ReadTable& read,
                     const std::vector<Index>& in_use) {
  const data::FoundSessions& found = read.found;
  const bool add_session = found.sessions.column.empty() &&
                           found.sessions.labels.size() > 1 &&
                           table.Find("session") < 0;
  const bool add_time = found.time_column >= 0 && table.Find("time_s") < 0;
  const bool keeps_clock = found.dated && read.reading.time.unit == "date";
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const auto at = static_cast<std::ptrdiff_t>(i);
    if (add_time && !keeps_clock &&
        (at == found.time_column || at == found.date_column)) {
      continue;
    }
    kept.push_back(i);
  }
  std::string text;
  for (const std::size_t i : kept) {
    text +=
        (text.empty() ? "" : ",") + data::CsvField(CleanName(table, read, i));
  }
  text += add_session ? ",session" : "";
  text += add_time ? ",time_s\n" : "\n";
  for (std::size_t i = 0; i < read.log_rows.size(); ++i) {
    if (!std::ranges::binary_search(in_use, read.log_rows[i])) continue;
    const auto row = static_cast<std::size_t>(read.log_rows[i]);
    std::string line;
    for (const std::size_t column : kept) {
      line += data::CsvField(table.CellText(table.columns[column], row)) + ",";
    }
    line.pop_back();
    if (add_session) {
      line +=
          "," + data::CsvField(found.sessions.labels[static_cast<std::size_t>(
                    found.sessions.codes[i])]);
    }
    if (add_time) {
      line += "," + data::CsvNumber(found.time[static_cast<Index>(i)]);
    }
    text += line + "\n";
  }
  return text;
}

std::string Why(data::Evidence evidence, bool sure) {
  return std::string(ToString(evidence)) + (sure ? "" : ", unsure");
}

// Many are cut short; the unit that all of them are taken to be in.
std::string InUnit(const std::vector<std::string>& names) {
  const std::string unit = data::UnitOfColumn(names.front()).symbol;
  const bool is_shared =
      !unit.empty() && std::ranges::all_of(names, [&](const std::string& name) {
        return data::UnitOfColumn(name).symbol == unit;
      });
  constexpr std::size_t kMostNames = 100;
  return data::ShortList(names, kMostNames) + (is_shared ? " in " + unit : "");
}

std::string Described(const data::Reading& reading) {
  std::string text;
  const std::size_t columns = OutputTerminal().text_columns();
  for (const std::string& line : data::ReadingLines(reading)) {
    text += report::WrapText(line, columns) + "\n";
  }
  const auto row = [&](const std::string& role,
                       const std::string& what,
                       const std::string& why,
                       const std::string& option) {
    text += report::Hanging(
        fmt::format("  {:<10} ", role),
        fmt::format("{}{}; {}",
                    what,
                    why.empty() ? "" : fmt::format(" ({})", why),
                    option),
        columns);
  };
  text += "\n";
  row("role", "what it is (how it is known)", "", "what changes it");
  row("target",
      reading.target.column.value_or("none") +
          (reading.target.unit.empty() ? "" : " in " + reading.target.unit),
      Why(reading.target.evidence, reading.target.sure),
      "--target");
  row("axis",
      reading.position.column ? InUnit({*reading.position.column}) : "none",
      Why(reading.position.evidence, reading.position.sure),
      "--position");
  std::string ways = data::JoinWords(reading.direction.values, ", ");
  if (const std::string& chosen = reading.direction.chosen; !chosen.empty()) {
    ways = fmt::format("{} of {}", chosen, ways);
  }
  row("direction",
      ways.empty() ? "none" : ways,
      Why(reading.direction.evidence, reading.direction.sure),
      "--direction");
  row("time",
      reading.time.column.value_or("number of the row") +
          (reading.time.column ? " in " + reading.time.unit : ""),
      Why(reading.time.evidence, reading.time.sure),
      "--time, --time-unit");
  row("cycles",
      fmt::format("{}{}",
                  reading.cycles.count,
                  reading.cycles.column ? " by " + *reading.cycles.column : ""),
      Why(reading.cycles.evidence, reading.cycles.sure),
      "--group");
  row("sessions",
      fmt::format("{} by {}",
                  reading.sessions.count,
                  reading.sessions.column.value_or(reading.sessions.by)),
      Why(reading.sessions.evidence, reading.sessions.sure),
      "--session, --gap");
  const auto list = [&](const std::string& role,
                        const std::vector<std::string>& names) {
    if (names.empty()) return;
    row(role, InUnit(names), "", "--inputs, --exclude");
  };
  list("other axes", reading.positions);
  list("sensors", reading.sensors);
  list("switches", reading.switches);
  list("counters", reading.counters);
  for (const data::Reading::LeftOut& column : reading.left_out) {
    row("left out", column.column, column.why, "--inputs");
  }
  if (!reading.rows_left_out.empty()) {
    row("rows",
        std::to_string(reading.rows_left_out.size()),
        reading.rows_left_out.front().why,
        "--missing, --faults");
  }
  for (const std::string& remark : reading.remarks) {
    text += "\n" + report::WrapText(remark, columns) + "\n";
  }
  return text;
}

void Print(const data::Reading& reading, const std::string& format) {
  constexpr int kIndent = 1;
  if (format == "json") {
    PrintResult(models::JsonText(reading, kIndent) + "\n");
  } else {
    PrintResult(Described(reading));
  }
}

int RunRead(const ReadArguments& arguments) {
  if (!arguments.out.empty()) {
    CheckOutputName("-o", arguments.out, arguments.data.files);
  }
  data::Reading reading;
  try {
    const data::JoinedTable joined =
        data::ReadTables(arguments.data.files, arguments.data.selection);
    // Also where the columns then cannot be told.
    std::vector<std::string> of_files = joined.remarks;
    of_files.insert(of_files.end(),
                    joined.table.remarks.begin(),
                    joined.table.remarks.end());
    SayUnless(arguments.data.quiet, of_files);
    const data::ReadTable read =
        data::ReadRoles(joined.table, arguments.data.selection);
    reading = read.reading;
    const data::PreparedDataset prepared =
        data::MakeDataset(joined.table, arguments.data.selection);
    if (!arguments.out.empty()) {
      data::WriteFileAtomically(
          arguments.out, CleanCsv(read.table, read, prepared.dataset.rows()));
    }
    reading = prepared.reading;
    reading.remarks.insert(
        reading.remarks.begin(), joined.remarks.begin(), joined.remarks.end());
    for (std::string& line : report::FaultLines(prepared,
                                                arguments.data.selection.faults,
                                                report::FaultUse::kFit)) {
      reading.remarks.push_back(std::move(line));
    }
  } catch (const data::OpenQuestion& open) {
    if (arguments.format != "json") throw;
    reading.files = arguments.data.files;
    reading.questions.push_back(open.question());
    Print(reading, arguments.format);
    return kWrongCommandLine;
  } catch (const data::InputError& error) {
    if (reading.rows == 0 && arguments.format != "json") throw;
    if (reading.files.empty()) reading.files = arguments.data.files;
    Warn(error.what());
    reading.remarks.emplace_back(error.what());
    Print(reading, arguments.format);
    return kUnusableInput;
  }
  Print(reading, arguments.format);
  return kDone;
}

}  // namespace

void AddReadCommand(CLI::App* app, Run* run) {
  const Command<ReadArguments> command(
      app,
      run,
      "read",
      "Show how a file is understood, and the options that change it");
  AddDataArguments(command, &command->data);
  AddOption(command, "-o,--output clean.csv", command->out)
      .About("Write the table as understood")
      .Under(kOutputOptions);
  AddFormatOption(command, &command->format);
  SetFooter(command,
            "Each line names the option that changes it.\n"
            "Example: errmap read data/sets/turning_centre/six_days.csv");
  command.Runs(RunRead);
}

}  // namespace errmap::cli
