#include "cli/commands/maps/map_warnings.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "cli/commands/data_arguments.h"
#include "cli/report/number_text.h"
#include "cli/report/words/fault_text.h"
#include "cli/report/words/outside_text.h"
#include "data/text.h"

namespace errmap::cli {

using Eigen::Index;

data::CsvTable ReadForMap(const models::FittedModel& fitted,
                          const std::string& file,
                          models::MapColumns columns,
                          bool quiet) {
  data::TableForMap read = models::ReadForMap(fitted, file, columns);
  SayUnless(quiet, read.remarks);
  return std::move(read.table);
}

models::MapRows ReadMapRows(const models::FittedModel& fitted,
                            const std::string& file,
                            const models::MapRowsOptions& options,
                            bool quiet) {
  models::MapRows rows = models::MakeMapRows(
      fitted,
      ReadForMap(fitted, file, models::MapColumns::kInputsAndTarget, quiet),
      options);
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
  RowsJudged judged{.form_inputs = fitted.FormInputs(rows.dataset),
                    .flags = {}};
  const Eigen::MatrixXd& inputs = rows.dataset.input_values();
  judged.flags = models::FlagRows(fitted, inputs, judged.form_inputs);
  SayOutside(fitted.inputs, inputs, judged.flags, rows.dataset.rows(), quiet);
  return judged;
}

void SayOutside(const std::vector<models::TrainedInput>& trained,
                const Eigen::MatrixXd& inputs,
                const std::vector<models::RowFlag>& flags,
                const std::vector<Index>& rows,
                bool quiet) {
  SayUnless(quiet, report::OutsideLines(trained, inputs));
  SayUnless(quiet, report::UnlikeLines(flags, rows));
}

bool SayNotFinite(const Eigen::VectorXd& predicted,
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
  Say(
      fmt::format("{}: {} of {} not finite, the first in data row {}; the map "
                  "does not serve there",
                  data::PrintablePath(file),
                  count,
                  report::Count(predicted.size(), "prediction"),
                  rows[static_cast<std::size_t>(first)]));
  return true;
}

}  // namespace errmap::cli
