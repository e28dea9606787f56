#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/commands/data_arguments.h"
#include "cli/commands/maps/map_warnings.h"
#include "cli/json_blocks.h"
#include "cli/output/claimed_folder.h"
#include "cli/report/number_text.h"
#include "cli/report/text/commands/calibration_check_text.h"
#include "cli/shell/command_options.h"
#include "cli/shell/standard_streams.h"
#include "cli/study_setup/provenance.h"
#include "data/files/atomic_file.h"
#include "data/files/shown_path.h"
#include "data/measurements/column_checks.h"
#include "data/text.h"
#include "fitting/interruption.h"
#include "models/history/rows_made_for.h"
#include "models/model_file.h"
#include "models/record_json.h"
#include "models/study/study_defaults.h"
#include "models/uncertainty/add_uncertainty.h"
#include "models/uncertainty/learnt_rows.h"
#include "models/uncertainty/map_update.h"

namespace errmap::cli {
namespace {

struct UpdateArguments {
  std::string model;
  std::string file;
  std::vector<std::string> known;  // what the map learnt from; none: as it says
  models::MapDataArguments columns;
  data::MissingPolicy missing = data::MissingPolicy::kError;
  data::FaultPolicy faults = data::FaultPolicy::kKeep;
  std::string out;
  std::uint64_t seed = 1;
  std::string format = "table";
  bool quiet = false;
};

// The map's own inputs and target; sessions and times as the data have them.
data::Dataset ReadRows(const models::FittedModel& map,
                       const std::string& file,
                       const UpdateArguments& arguments) {
  data::DatasetSelection selection{.target = map.target.name,
                                   .time = arguments.columns.time,
                                   .session = arguments.columns.session,
                                   .align = map.align,
                                   .missing = arguments.missing,
                                   .faults = arguments.faults,
                                   .keep_dead = true,
                                   .only_to_judge = true};
  for (const models::TrainedInput& input : map.inputs) {
    selection.inputs.push_back(input.column.name);
  }
  const data::TableForMap read = models::ReadForMap(
      map, {file}, models::MapColumns::kInputsAndTarget, arguments.columns);
  selection.where = models::FiltersFor(map, read.table);
  data::PreparedDataset prepared = data::MakeDataset(read.table, selection);
  SayRead(read, arguments.quiet);
  SayUnless(arguments.quiet, prepared.remarks);
  return std::move(prepared.dataset);
}

// What the map learnt from.
struct KnownFiles {
  std::vector<study_setup::InputFile> files;  // beside the one of new sessions
  std::vector<std::string> lost;  // those that are not found as they were
  bool any = false;               // whether any is known
};

// A file that the map names, where it is still as it was: by that name from
// here, beside the new sessions or beside the map. A map knows of most files
// their name alone (data::ShownPath), so where update is run from must not
// decide what is found.
std::optional<study_setup::InputFile> FindNamed(
    const study_setup::InputFile& named, const UpdateArguments& arguments) {
  namespace fs = std::filesystem;
  for (const fs::path& folder : {fs::path(),
                                 fs::path(arguments.file).parent_path(),
                                 fs::path(arguments.model).parent_path()}) {
    for (const fs::path& name :
         {fs::path(named.file), fs::path(named.file).filename()}) {
      const std::string path = (folder / name).string();
      std::error_code ignored;
      if (!fs::is_regular_file(path, ignored)) continue;
      study_setup::InputFile found = study_setup::HashInput(path);
      if (found.sha256 == named.sha256) return found;
    }
  }
  return std::nullopt;
}

// What --known names, else what the map does. The file of new sessions may be
// one of these under whatever name; it is not read a second time.
KnownFiles FindKnown(const UpdateArguments& arguments) {
  KnownFiles known;
  for (const std::string& file : arguments.known) {
    known.files.push_back(study_setup::HashInput(file));
  }
  known.any = !known.files.empty();
  if (known.any) return known;
  const std::string fresh = study_setup::HashInput(arguments.file).sha256;
  for (const study_setup::InputFile& named :
       study_setup::DataOf(ProvenanceOf(arguments.model))) {
    if (named.sha256 == fresh) {
      known.any = true;
    } else if (auto found = FindNamed(named, arguments)) {
      known.any = true;
      known.files.push_back(std::move(*found));
    } else {
      known.lost.push_back(named.file);
    }
  }
  return known;
}

// What the new map cannot learn from; "" where all is at hand.
std::string LostText(const KnownFiles& known) {
  if (known.lost.empty() && known.any) return "";
  return fmt::format(
      "{} missing or changed, so the new map would not learn from it; name "
      "all that it was fitted to with --known\n",
      known.lost.empty() ? "what the map was fitted to is"
                         : data::ListOfNames(known.lost) +
                               (known.lost.size() == 1 ? " is" : " are"));
}

// The rows of some files, one after the other; none: none.
std::optional<data::Dataset> ReadKnown(
    const models::FittedModel& map,
    const std::vector<study_setup::InputFile>& files,
    const UpdateArguments& arguments) {
  std::optional<data::Dataset> known;
  UpdateArguments as_fitted = arguments;
  as_fitted.columns.target.clear();
  for (const study_setup::InputFile& file : files) {
    data::Dataset rows = ReadRows(map, file.file, as_fitted);
    known = known ? models::Joined(*known, rows) : std::move(rows);
  }
  return known;
}

Json UpdateJson(const UpdateArguments& arguments,
                const models::FittedModel& old_map,
                const models::UpdateTrial& trial,
                bool better,
                Index learnt,
                const KnownFiles& known,
                const Json& provenance) {
  return {{"schema", "errmap-update-1"},
          {"model", old_map.name},
          {"file", data::ShownPath(arguments.out)},
          {"target", old_map.target.name},
          {"unit", old_map.target.unit.symbol},
          {"updated", better},
          {"known_rows", learnt},
          {"not_at_hand", known.lost},
          {"old_rmse", trial.old_rmse},
          {"new_rmse", trial.new_rmse},
          {"negated_rmse", trial.negated_rmse},
          {"shifted_rmse", trial.shifted_rmse},
          {"shift", trial.shift},
          {"sessions", models::ToJson(trial.sessions)},
          {"provenance", provenance}};
}

// The successor, of all rows, with its promise.
models::FittedModel FitSuccessor(const models::FittedModel& old_map,
                                 const data::Dataset& all,
                                 const models::FitContext& context,
                                 const std::atomic<bool>& stop) {
  models::FittedModel fitted =
      RecipeFromArgument(old_map.name)->Fit(all, context);
  fitted.where = old_map.where;
  models::AddExperience(all, &fitted);
  models::AddUncertainty(all,
                         RecipeFromArgument(old_map.name),
                         {.seed = context.seed,
                          .jobs = context.threads,
                          .stop = &stop,
                          .indifference = context.indifference},
                         &fitted);
  return fitted;
}

// What of the new rows the old map was fitted to: it looks better there than it
// is.
std::string KnownRowsText(Index learnt, Index rows) {
  return learnt == 0 ? ""
                     : fmt::format(
                           "the old map was fitted to {} of {}, so it looks "
                           "better here than it is: give only new sessions\n",
                           learnt,
                           report::Count(rows, "row"));
}

int RunUpdate(const UpdateArguments& arguments,
              const std::string& command_line) {
  std::vector<std::string> read = arguments.known;
  read.push_back(arguments.file);
  CheckOutputName("-o", arguments.out, read);
  RequirePlaceFor(arguments.out);
  const models::FittedModel old_map = LoadMap(arguments.model, arguments.quiet);
  const data::Dataset fresh = ReadRows(old_map, arguments.file, arguments);
  const KnownFiles known_files = FindKnown(arguments);
  std::vector<study_setup::InputFile> learnt_from = known_files.files;
  const double indifference = models::DefaultIndifference(old_map.target.unit);
  const std::atomic<bool>& stop = InstallInterruptFlag();
  const models::FitContext context{.seed = arguments.seed,
                                   .threads = JobsOf(0),
                                   .indifference = indifference};
  const Index learnt = models::CountLearntRows(
      old_map, fresh.input_values(), &fresh.target_values());
  const fitting::InterruptionScope interruptible(&stop);
  models::UpdateTrial trial;
  std::optional<data::Dataset> all;
  try {
    const auto known = ReadKnown(old_map, learnt_from, arguments);
    trial = models::TryUpdate(old_map,
                              known ? &*known : nullptr,
                              fresh,
                              *RecipeFromArgument(old_map.name),
                              context);
    all = known ? models::Joined(*known, fresh) : fresh;
  } catch (const std::invalid_argument& error) {
    throw data::InputError(fmt::format(
        "{}: {}", data::PrintablePath(arguments.file), error.what()));
  }
  if (stop.load()) return kInterrupted;
  if (!trial.why_failed.empty()) {
    Warn(fmt::format(
        "{} failed: {}; the old map stays", old_map.name, trial.why_failed));
    return kEveryFitFailed;
  }
  learnt_from.push_back(study_setup::HashInput(arguments.file));
  const bool better = trial.better(indifference);
  if (better) {
    models::FittedModel fitted;
    try {
      fitted = FitSuccessor(old_map, *all, context, stop);
    } catch (const fitting::Interrupted&) {
      return kInterrupted;
    }
    if (stop.load()) return kInterrupted;
    models::SaveModel(
        fitted,
        study_setup::ModelProvenance(
            command_line, learnt_from, all->num_rows(), arguments.seed),
        arguments.out);
  } else {
    data::WriteFileAtomically(arguments.out, data::ReadFile(arguments.model));
  }
  if (arguments.format == "json") {
    learnt_from.insert(learnt_from.begin(),
                       study_setup::HashInput(arguments.model));
    const Json provenance =
        ProvenanceJson(command_line,
                       {{"missing", ToString(arguments.missing)},
                        {"faults", ToString(arguments.faults)},
                        {"seed", arguments.seed}},
                       learnt_from);
    PrintResult(DumpJson(UpdateJson(
        arguments, old_map, trial, better, learnt, known_files, provenance)));
  } else {
    PrintFitted(fmt::format(
        "{}{}{}{}\n",
        LostText(known_files),
        KnownRowsText(learnt, fresh.num_rows()),
        report::TrialText(trial, old_map.target.unit, learnt == 0),
        better ? "the new map is better and is written to " + arguments.out
               : "the new map is no better: " + arguments.out +
                     " is the old one"));
  }
  return kDone;
}

}  // namespace

void AddUpdateCommand(CLI::App* app, Run* run) {
  const Command<UpdateArguments> command(
      app,
      run,
      "update",
      "Fit a map again with new sessions, if that makes it better");
  AddModelArgument(command, &command->model);
  AddOption(command, "NEW NEW.csv", command->file)
      .About("CSV file of at least two new sessions: inputs and target")
      .Required();
  AddOption(command, "-o,--output FILE.json", command->out)
      .About("Model file to write")
      .Required()
      .Under(kOutputOptions);
  AddOption(command, "--known DATA.csv", command->known)
      .About(
          "Rows that the map was fitted to (may be repeated; default: the "
          "unchanged files that it names, here, beside NEW or beside the map)")
      .OneAtATime();
  AddOption(command, "--time COL", command->columns.time)
      .About("Column of times (default: by name and values)");
  AddOption(command, "--session COL", command->columns.session)
      .About("Column of sessions (default: by name, else nights)");
  AddTargetOfMap(command, &command->columns);
  AddRowOptions(command, &command->missing, &command->faults);
  AddSeedOption(command, &command->seed);
  AddFormatOption(command, &command->format);
  AddQuietFlag(command, &command->quiet);
  SetFooter(
      command,
      R"(Fits the same type of model, with the same inputs, to old and new sessions.
The old map, and one that has not seen it, predict each new session. The new
map is written if its error is clearly lower, in RMSE and in the geometric mean
over the sessions. Otherwise the old map is written.
Example: errmap update map.json data/sets/turning_centre/later_days.csv --known data/sets/turning_centre/six_days.csv -o new.json)");
  command.Runs(RunUpdate);
}

}  // namespace errmap::cli
