#pragma once

#include <string>
#include <vector>

#include "cli/json_blocks.h"
#include "data/measurements/column_match.h"
#include "models/error_model.h"
#include "models/model_file.h"
#include "models/sensors/applicability.h"
#include "models/session/map_rows.h"
#include "stats/eigen.h"

namespace CLI {
class App;
}

namespace errmap::cli {

/// Adds MODEL, a model file that a command must be given.
void AddModelArgument(CLI::App* command, std::string* model);

/// The first members of the JSON of a map that is judged on measurements:
/// schema, model, file, target and unit.
Json MapAnswerJson(const char* schema,
                   const models::FittedModel& fitted,
                   const std::vector<std::string>& files);

/// Calls models::LoadModel and, unless quiet, says what users should know about
/// the file.
models::FittedModel LoadMap(const std::string& file, bool quiet);

/// Says how the rows of a file were read and what was converted.
void SayRead(const data::TableForMap& read, bool quiet);

/// Returns the measured rows of a table from ReadForMap, or of files. Remarks
/// and warnings go to stderr unless quiet. Throws data::InputError as
/// MakeMapRows does.
models::MapRows RowsForMap(const models::FittedModel& fitted,
                           data::TableForMap read,
                           const models::MapRowsOptions& options,
                           bool quiet);
models::MapRows ReadMapRows(const models::FittedModel& fitted,
                            const std::vector<std::string>& files,
                            const models::MapRowsOptions& options,
                            bool quiet);

/// Throws data::InputError, naming the file, unless models::KnowsAges.
void RequireAges(const models::FittedModel& fitted, const std::string& model);

/// Returns the provenance that a model file states.
models::Provenance ProvenanceOf(const std::string& model);

/// How many of the rows on which a map is judged it has also learnt from.
struct RowsLearnt {
  bool file = false;  // the map names each of the files as its own
  Index rows = 0;     // rows recognised by their values
  Index of = 0;       // all rows
};

/// Compares the data with the hashes of files in the model file `model`, and
/// with the hashes of rows in the map.
RowsLearnt FindRowsLearnt(const models::FittedModel& fitted,
                          const std::string& model,
                          const std::vector<std::string>& files,
                          const models::MapRows& rows);

Json LearntJson(const RowsLearnt& learnt);
/// Returns a line for people; "" if the map learnt from none of these rows.
std::string LearntText(const RowsLearnt& learnt);

struct RowsJudged {
  MatrixXd form_inputs;  // (rows x inputs of the form)
  std::vector<models::RowFlag> flags;
};

/// Returns flags of rows that are unlike training and, unless quiet, names
/// them.
RowsJudged JudgeMapRows(const models::FittedModel& fitted,
                        const models::MapRows& rows,
                        bool quiet);

/// Says on stderr, unless quiet, which inputs (m x p) leave their trained
/// range, and which rows are unlike training. `rows` (m) are the numbers of the
/// data rows in the file.
void SayOutside(const std::vector<models::TrainedInput>& trained,
                const MatrixXd& inputs,
                const std::vector<models::RowFlag>& flags,
                const std::vector<Index>& rows,
                bool quiet);

/// Says how many of `predicted` (m) are not finite, and where. `rows` (m) are
/// the numbers of the data rows in `file`. Returns false and says nothing if
/// all are finite.
bool SayNotFinite(const VectorXd& predicted,
                  const std::vector<Index>& rows,
                  const std::string& file);

}  // namespace errmap::cli
