#include "cli/commands/maps/map_warnings.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/commands/data_arguments.h"
#include "cli/report/number_text.h"
#include "cli/report/text/commands/fault_text.h"
#include "cli/report/text/commands/outside_text.h"
#include "cli/shell/command_options.h"
#include "cli/study_setup/provenance.h"
#include "data/files/atomic_file.h"
#include "data/input_error.h"
#include "data/measurements/reading/reading.h"
#include "data/text.h"
#include "models/history/with_history.h"
#include "models/session/zero_schedule.h"
#include "models/uncertainty/learnt_rows.h"

namespace errmap::cli {

void AddModelArgument(CLI::App* command, std::string* model) {
  AddOption(command, "MODEL FILE.json", *model).About("Model file").Required();
}

Json MapAnswerJson(const char* schema,
                   const models::FittedModel& fitted,
                   const std::vector<std::string>& files) {
  return {{"schema", schema},
          {"model", fitted.name},
          {"file", study_setup::ShownNames(files)},
          {"target", fitted.target.name},
          {"unit", fitted.target.unit.symbol}};
}

models::FittedModel LoadMap(const std::string& file, bool quiet) {
  models::FittedModel fitted = models::LoadModel(file);
  SayUnless(quiet, fitted.remarks);
  return fitted;
}

void RequireAges(const models::FittedModel& fitted, const std::string& model) {
  if (!models::KnowsAges(fitted)) {
    throw data::InputError(fmt::format(
        "{}: has no held-out errors with times; fit the map to two "
        "sessions or more and a column of times (without --no-interval)",
        data::PrintablePath(model)));
  }
}

models::Provenance ProvenanceOf(const std::string& model) {
  const Json document = Json::parse(data::ReadFile(model));
  const Json texts = document.value("provenance", Json::object());
  models::Provenance provenance;
  for (const auto& [key, text] : texts.items()) {
    if (text.is_string()) provenance.emplace_back(key, text);
  }
  return provenance;
}

RowsLearnt FindRowsLearnt(const models::FittedModel& fitted,
                          const std::string& model,
                          const std::vector<std::string>& files,
                          const models::MapRows& rows) {
  const std::vector<study_setup::InputFile> all =
      study_setup::DataOf(ProvenanceOf(model));
  const data::Dataset& dataset = rows.prepared.dataset;
  RowsLearnt learnt{.of = dataset.num_rows()};
  learnt.file = std::ranges::all_of(
      study_setup::HashInputs(files), [&](const study_setup::InputFile& file) {
        return std::ranges::find(all,
                                 file.sha256,
                                 &study_setup::InputFile::sha256) != all.end();
      });
  learnt.rows = learnt.file ? learnt.of
                            : models::CountLearntRows(fitted,
                                                      dataset.input_values(),
                                                      &dataset.target_values());
  return learnt;
}

Json LearntJson(const RowsLearnt& learnt) {
  return {{"file", learnt.file}, {"rows", learnt.rows}};
}

std::string LearntText(const RowsLearnt& learnt) {
  if (learnt.file) {
    return "The map was fitted to this file: these figures do not apply to new "
           "rows.\n";
  }
  return learnt.rows == 0 ? ""
                          : fmt::format(
                                "The map was fitted to {} of {} rows: these "
                                "figures do not apply to new ones.\n",
                                learnt.rows,
                                learnt.of);
}

void SayRead(const data::TableForMap& read, bool quiet) {
  SayUnless(quiet, data::ReadingLines(read.reading));
  SayUnless(quiet, read.remarks);
}

models::MapRows ReadMapRows(const models::FittedModel& fitted,
                            const std::vector<std::string>& files,
                            const models::MapRowsOptions& options,
                            bool quiet) {
  return RowsForMap(
      fitted,
      models::ReadForMap(
          fitted, files, models::MapColumns::kInputsAndTarget, options.log),
      options,
      quiet);
}

models::MapRows RowsForMap(const models::FittedModel& fitted,
                           data::TableForMap read,
                           const models::MapRowsOptions& options,
                           bool quiet) {
  models::MapRows rows =
      models::MakeMapRows(fitted, std::move(read.table), options);
  SayRead(read, quiet);
  SayUnless(quiet, rows.prepared.remarks);
  SayUnless(quiet,
            report::FaultLines(
                rows.prepared, options.faults, report::FaultUse::kJudge));
  SayUnless(quiet, rows.warnings);
  return rows;
}

RowsJudged JudgeMapRows(const models::FittedModel& fitted,
                        const models::MapRows& rows,
                        bool quiet) {
  RowsJudged judged{.form_inputs = fitted.FormInputs(rows.dataset)};
  const MatrixXd& inputs = rows.dataset.input_values();
  judged.flags = models::FlagRows(fitted, inputs, judged.form_inputs);
  SayOutside(fitted.inputs, inputs, judged.flags, rows.dataset.rows(), quiet);
  return judged;
}

void SayOutside(const std::vector<models::TrainedInput>& trained,
                const MatrixXd& inputs,
                const std::vector<models::RowFlag>& flags,
                const std::vector<Index>& rows,
                bool quiet) {
  SayUnless(quiet, report::OutsideLines(trained, inputs));
  SayUnless(quiet, report::UnlikeLines(trained, inputs, flags, rows));
}

bool SayNotFinite(const VectorXd& predicted,
                  const std::vector<Index>& rows,
                  const std::string& file) {
  Index count = 0;
  Index first = 0;
  for (Index i = predicted.size() - 1; i >= 0; --i) {
    if (std::isfinite(predicted[i])) continue;
    ++count;
    first = i;
  }
  if (count == 0) return false;
  Warn(
      fmt::format("{}: {} of {} not finite, the first in data row {}; do not "
                  "use the map there",
                  data::PrintablePath(file),
                  count,
                  report::Count(predicted.size(), "prediction"),
                  rows[static_cast<std::size_t>(first)]));
  return true;
}

void AddEveryOption(CLI::App* command, std::string* every) {
  AddOption(command, "--every TIME", *every)
      .About(
          "Time between rows, for a map whose memory counts rows: 30s, 2min");
}

models::FittedModel LoadForControl(const std::string& file,
                                   const std::string& every,
                                   bool quiet) {
  models::FittedModel map = LoadMap(file, quiet);
  if (every.empty()) return map;
  const std::optional<double> seconds = data::ParseInterval(every);
  if (!seconds) {
    throw UsageError(
        fmt::format("--every must be a time such as 30s or 2min; found {}",
                    data::QuotedText(every)));
  }
  if (!models::CountsRows(map)) {
    throw UsageError(fmt::format(
        "--every is for a map whose memory counts rows; that of {} does not",
        data::PrintablePath(file)));
  }
  // What is written says what it was made for.
  map.name += " with a row every " + every;
  return models::WithRowsEvery(std::move(map), *seconds);
}

}  // namespace errmap::cli
