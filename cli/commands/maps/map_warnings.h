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

/// Adds MODEL, a required model file.
void AddModelArgument(CLI::App* command, std::string* model);

/// Returns the first JSON members for a map tested on measurements: schema,
/// model, file, target and unit.
Json MapAnswerJson(const char* schema,
                   const models::FittedModel& fitted,
                   const std::vector<std::string>& files);

/// Calls models::LoadModel and, unless quiet, prints remarks on the file.
models::FittedModel LoadMap(const std::string& file, bool quiet);

/// Prints how the rows of a file were read and converted.
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

/// Returns the provenance in a model file.
models::Provenance ProvenanceOf(const std::string& model);

/// How many of a map's test rows are also among its training rows.
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
/// Returns a sentence; "" if none of these rows was used to fit the map.
std::string LearntText(const RowsLearnt& learnt);

struct RowsJudged {
  MatrixXd form_inputs;  // (rows x inputs of the form)
  std::vector<models::RowFlag> flags = {};
};

/// Returns flags of rows that are unlike training and, unless quiet, prints
/// which.
RowsJudged JudgeMapRows(const models::FittedModel& fitted,
                        const models::MapRows& rows,
                        bool quiet);

/// Unless quiet, prints on stderr which inputs (m x p) leave their trained
/// range, and which rows are unlike training. `rows` (m) are the numbers of the
/// data rows in the file.
void SayOutside(const std::vector<models::TrainedInput>& trained,
                const MatrixXd& inputs,
                const std::vector<models::RowFlag>& flags,
                const std::vector<Index>& rows,
                bool quiet);

/// Prints how many of `predicted` (m) are not finite, and where. `rows` (m) are
/// the numbers of the data rows in `file`. If all are finite, returns false and
/// prints nothing.
bool SayNotFinite(const VectorXd& predicted,
                  const std::vector<Index>& rows,
                  const std::string& file);

/// Adds --every: the time between rows, for maps whose memory counts rows.
void AddEveryOption(CLI::App* command, std::string* every);

/// Loads the map of a file. If `every` is given, converts a map that counts
/// rows to one that counts seconds, and adds this to its name. Throws
/// UsageError if `every` is not an interval or the map counts no rows;
/// otherwise throws as LoadMap.
models::FittedModel LoadForControl(const std::string& file,
                                   const std::string& every,
                                   bool quiet);

}  // namespace errmap::cli
