#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "cli/json_blocks.h"
#include "data/csv.h"
#include "models/error_model.h"
#include "models/model_file.h"
#include "models/promise/applicability.h"
#include "models/promise/map_rows.h"

namespace errmap::cli {

/// models::LoadModel; says what is to be known of the file, unless quiet.
models::FittedModel LoadMap(const std::string& file, bool quiet);

/// models::ReadForMap; says what was converted, unless quiet.
data::CsvTable ReadForMap(const models::FittedModel& fitted,
                          const std::vector<std::string>& files,
                          models::MapColumns columns,
                          bool quiet);

/// The measured rows of a table that ReadForMap gave, or of files; remarks and
/// warnings go to stderr unless quiet. Throws data::InputError as MakeMapRows
/// does.
models::MapRows RowsForMap(const models::FittedModel& fitted,
                           data::CsvTable table,
                           const models::MapRowsOptions& options,
                           bool quiet);
models::MapRows ReadMapRows(const models::FittedModel& fitted,
                            const std::vector<std::string>& files,
                            const models::MapRowsOptions& options,
                            bool quiet);

/// Throws data::InputError, naming the file, unless models::KnowsAges.
void RequireAges(const models::FittedModel& fitted, const std::string& model);

/// What a model file says of where it comes from.
models::Provenance ProvenanceOf(const std::string& model);

/// Of the rows of files that a map is judged on, what it learnt from.
struct RowsLearnt {
  bool file = false;      // each file is one that the map names
  Eigen::Index rows = 0;  // known again by their values
  Eigen::Index of = 0;    // all of them
};

/// By the hashes of files in the model file `model`, and of rows in the map.
RowsLearnt FindRowsLearnt(const models::FittedModel& fitted,
                          const std::string& model,
                          const std::vector<std::string>& files,
                          const models::MapRows& rows);

Json LearntJson(const RowsLearnt& learnt);
/// A line for people; "" where nothing was learnt from these rows.
std::string LearntText(const RowsLearnt& learnt);

struct RowsJudged {
  Eigen::MatrixXd form_inputs;  // (rows x inputs of the form)
  std::vector<models::RowFlag> flags;
};

/// Says where `rows` are unlike training, unless quiet.
RowsJudged JudgeMapRows(const models::FittedModel& fitted,
                        const models::MapRows& rows,
                        bool quiet);

/// Says on stderr, unless quiet, which inputs (m x p) leave their trained range
/// and which rows are unlike training; `rows` (m) are the data rows of the
/// file.
void SayOutside(const std::vector<models::TrainedInput>& trained,
                const Eigen::MatrixXd& inputs,
                const std::vector<models::RowFlag>& flags,
                const std::vector<Eigen::Index>& rows,
                bool quiet);

/// Says how many of `predicted` (m) are not finite and where, `rows` (m) being
/// the data rows of `file`; false, and nothing said, where all are finite.
bool SayNotFinite(const Eigen::VectorXd& predicted,
                  const std::vector<Eigen::Index>& rows,
                  const std::string& file);

}  // namespace errmap::cli
