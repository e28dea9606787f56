#include "cli/commands/data_arguments.h"

#include <algorithm>
#include <charconv>
#include <system_error>
#include <thread>
#include <type_traits>
#include <vector>

#include "cli/command.h"
#include "cli/report/table.h"
#include "cli/report/text/commands/fault_text.h"
#include "cli/shell/command_options.h"
#include "cli/shell/command_reference.h"
#include "cli/shell/standard_streams.h"
#include "data/files/shown_path.h"
#include "data/measurements/joined_tables.h"
#include "data/measurements/reading/reading.h"
#include "data/throwing_as.h"
#include "models/model_spec.h"
#include "models/recipe_catalog.h"
#include "models/record.h"
#include "models/study/journal/kept_fits.h"

namespace errmap::cli {
namespace {

// Splits "A,B" at commas outside double quotes and takes the quotes off.
std::vector<std::string> SplitNames(const std::string& flag,
                                    const std::string& list) {
  if (list.empty()) return {};
  std::vector<std::string> names = SplitFlag(flag, list);
  for (std::string& name : names) {
    if (name.size() >= 2 && name.front() == '"' && name.back() == '"') {
      name = name.substr(1, name.size() - 2);
      for (std::size_t at = 0; (at = name.find("\"\"", at)) != name.npos;
           ++at) {
        name.erase(at, 1);  // RFC 4180: two quotes stand for one
      }
    }
  }
  return names;
}

void AddFormats(CLI::App* command,
                const std::string& words,
                const std::vector<std::string>& formats,
                std::string* format) {
  AddOption(command, "--format", *format)
      .About(words)
      .OneOf(formats)
      .ShowDefault()
      .Under(kOutputOptions);
}

}  // namespace

std::vector<std::string> SplitFlag(const std::string& flag,
                                   const std::string& list) {
  return data::ThrowingAs<UsageError>(flag + ": ",
                                      [&] { return models::SplitList(list); });
}

std::string FlagOf(std::string_view key) {
  std::string flag = "--" + std::string(key);
  std::ranges::replace(flag, '_', '-');
  return flag;
}

void FlagAdder::operator()(const study_setup::StudyOption& option,
                           std::string& text) const {
  if (option.check == nullptr) {
    AddOption(command_, FlagOf(option.key), text).About(option.help);
  } else {
    AddOption(command_,
              FlagOf(option.key),
              [&text, flag = FlagOf(option.key), check = option.check](
                  const std::string& given) {
                data::ThrowingAs<UsageError>(flag + " ", [&] { check(given); });
                text = given;
              })
        .About(option.help);
  }
  Finish(option);
}

void FlagAdder::operator()(const study_setup::StudyOption& option,
                           std::vector<std::string>& names) const {
  AddOption(command_,
            FlagOf(option.key),
            [&names, flag = FlagOf(option.key)](const std::string& list) {
              names = SplitNames(flag, list);
            })
      .About(option.help);
  Finish(option);
}

void FlagAdder::operator()(const study_setup::StudyOption& option,
                           bool& flag) const {
  AddFlag(command_, FlagOf(option.key), flag).About(option.help);
  Finish(option);
}

void FlagAdder::operator()(const study_setup::StudyOption& option,
                           study_setup::GivenError& error) const {
  AddOption(command_,
            FlagOf(option.key),
            [&error,
             flag = FlagOf(option.key),
             may_be_zero = option.may_be_zero](const std::string& text) {
              error = ErrorOfFlag(flag.c_str(), text, may_be_zero);
            })
      .About(option.help);
  Finish(option);
}

void FlagAdder::Finish(const study_setup::StudyOption& option) const {
  const Option added = FindOption(command_, FlagOf(option.key));
  if (*option.value != '\0') added.Value(option.value);
  if (!heading_.empty()) added.Under(heading_);
  if (option.seldom) added.Seldom();
}

void AddDataArguments(CLI::App* command, DataArguments* arguments) {
  AddOption(command, "DATA FILE.csv", arguments->files)
      .About(
          "CSV file, one row per reading; several files, or a folder, are days "
          "of one component")
      .Required();
  // Before the others, which overrule it.
  AddOption(command,
            "--reading READING.json",
            [arguments](const std::string& path) {
              TakeReading(path, &arguments->selection);
            })
      .About(
          "Read the columns as `errmap read --format json` wrote them, unless "
          "another option differs")
      .Under(kDataOptions)
      .Seldom();
  study_setup::ForSelectionOptions(arguments->selection,
                                   FlagAdder(command, kDataOptions));
  AddFlag(command, "--quiet", arguments->quiet)
      .About("No remarks and no progress on stderr")
      .Under(kOutputOptions);
}

std::vector<std::string> DataArguments::PathsWith(
    std::vector<std::string> others) const {
  others.insert(others.begin(), files.begin(), files.end());
  return others;
}

void AddRowOptions(CLI::App* command,
                   data::MissingPolicy* missing,
                   data::FaultPolicy* faults) {
  const data::DatasetSelection all;
  study_setup::ForSelectionOptions(
      all,
      [&]<typename Member>(const study_setup::StudyOption& option,
                           const Member& /*said*/,
                           const auto&... values) {
        const FlagAdder add(command, kDataOptions);
        if constexpr (std::is_same_v<Member, data::MissingPolicy>) {
          add(option, *missing, values...);
        } else if constexpr (std::is_same_v<Member, data::FaultPolicy>) {
          add(option, *faults, values...);
        }
      });
}

void AddMapDataArguments(CLI::App* command,
                         models::MapDataArguments* arguments) {
  AddOption(command, "--after EARLIER.csv", arguments->after)
      .About("Earlier readings, for the filters of a map with a memory");
  AddOption(command, "--time COL", arguments->time)
      .About(
          "Column of times or dates (default: that of the map, else by name "
          "and values)");
  AddOption(command, "--session COL", arguments->session)
      .About(
          "Column of sessions (default: that of the map)\nA session is an "
          "uninterrupted run");
}

void AddJoinedLogArguments(CLI::App* command,
                           models::MapDataArguments* arguments) {
  AddOption(command, "--with LOG.csv", arguments->with)
      .About("Log of more columns, joined by time");
  AddOption(command, "--clock-offset D", arguments->clock_offset)
      .About("How far that log's clock is ahead: 3s, -2min");
}

void AddTargetOfMap(CLI::App* command, models::MapDataArguments* arguments) {
  AddOption(command, "--target COL", arguments->target)
      .About(
          "Column of the measured errors (default: that of the "
          "map)\n--target=-COL for corrections");
}

void AddFromRest(CLI::App* command, models::MapDataArguments* arguments) {
  AddFlag(command, "--from-rest", arguments->from_rest)
      .About(
          "The machine was at rest before the first row of each session, even "
          "if its thermometers or clock suggest otherwise");
}

data::PreparedDataset ReadData(const DataArguments& arguments) {
  const data::JoinedTable read =
      data::ReadTables(arguments.files, arguments.selection);
  SayUnless(arguments.quiet, read.remarks);
  data::PreparedDataset prepared =
      data::MakeDataset(read.table, arguments.selection);
  SayUnless(arguments.quiet, data::ReadingLines(prepared.reading));
  SayUnless(arguments.quiet, prepared.remarks);
  SayUnless(arguments.quiet,
            report::FaultLines(
                prepared, arguments.selection.faults, report::FaultUse::kFit));
  return prepared;
}

study_setup::GivenError ErrorOfFlag(const char* flag,
                                    const std::optional<std::string>& text,
                                    bool may_be_zero) {
  if (!text) return {};
  return data::ThrowingAs<UsageError>(flag + std::string(" "), [&] {
    return study_setup::ParseGivenError(*text, may_be_zero);
  });
}

double GoalOrNone(const std::optional<std::string>& goal,
                  const data::ColumnInfo& target,
                  double size,
                  bool quiet) {
  const study_setup::GivenError given = ErrorOfFlag("--goal", goal, false);
  if (!given.is_given()) return models::kNotKnown;
  const std::string remark =
      study_setup::BareNumberRemark("goal", given, target, size);
  if (!remark.empty()) SayUnless(quiet, {remark});
  return data::ThrowingAs<UsageError>(
      "--goal ", [&] { return study_setup::InUnitOf(target.unit, given); });
}

int JobsOf(int jobs) {
  if (jobs > 0) return jobs;
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

std::unique_ptr<models::ModelRecipe> RecipeFromArgument(
    const std::string& spec) {
  return data::ThrowingAs<UsageError>("",
                                      [&] { return models::MakeRecipe(spec); });
}

void Warn(const std::string& line) { WriteMessage(line); }

void SayUnless(bool quiet, const std::vector<std::string>& lines) {
  if (quiet) return;
  for (const std::string& line : lines) Warn(line);
}

std::function<void(const std::string&)> Sayer(bool quiet) {
  if (quiet) return {};
  return Warn;
}

void AddKeepPathsFlag(CLI::App* command) {
  AddFlag(command, "--keep-paths", [] { data::KeepPaths(); })
      .About(
          "Write absolute paths, not just file names, into reports, maps and "
          "journals")
      .Under(kOutputOptions)
      .Seldom();
}

void AddCacheFlag(CLI::App* command, std::string* cache) {
  *cache = models::DefaultCacheFolder();
  AddFlag(command, "--no-cache", [cache] { cache->clear(); })
      .About(
          "Repeat every fit\nOtherwise fits of earlier runs on the same data "
          "come from ~/.cache/errmap, which may be removed at any time")
      .Seldom();
}

void AddQuietFlag(CLI::App* command, bool* quiet) {
  AddFlag(command, "--quiet", *quiet)
      .About("No remarks on stderr")
      .Under(kOutputOptions);
}

void AddForceFlag(CLI::App* command, bool* force) {
  AddFlag(command, "--force", *force)
      .About(
          "Also replace files in the folder that errmap did not write, or that "
          "were changed since; never an input")
      .Under(kOutputOptions)
      .Seldom();
}

void AddSeedOption(CLI::App* command,
                   std::uint64_t* seed,
                   const std::string& what) {
  // CLI11 would take -1 and 2^64 for the largest number there is.
  AddOption(command, "--seed N", *seed)
      .About(what)
      .ShowDefault()
      .Check([](const std::string& text) {
        std::uint64_t number = 0;
        const char* const end = text.data() + text.size();
        const auto [rest, error] = std::from_chars(text.data(), end, number);
        return error == std::errc() && rest == end
                   ? ""
                   : "give a whole number from 0 to 18446744073709551615";
      });
}

void AddFormatOption(CLI::App* command, std::string* format) {
  AddFormats(command, "table or json", {"table", "json"}, format);
}

void AddTableFormatOption(CLI::App* command,
                          const std::string& words,
                          std::string* format) {
  std::vector<std::string> formats{"table", "json"};
  for (const report::TableFormat& known : report::TableFormats()) {
    formats.emplace_back(known.name);
  }
  AddFormats(command, words, formats, format);
}

}  // namespace errmap::cli
