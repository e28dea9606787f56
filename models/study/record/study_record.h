#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "models/study/record/data_record.h"
#include "models/study/record/figure_record.h"
#include "models/study/record/judgement_record.h"
#include "models/study/record/machine_record.h"
#include "models/study/record/model_record.h"
#include "models/study/record/provenance_record.h"
#include "models/study/record/recommendation_record.h"
#include "models/study/record/record.h"
#include "models/study/record/record_values.h"
#include "models/study/record/rezero_record.h"

// What a study found, as plain data: these structs are results.json, schema
// errmap-results-1, member by key in the same order. Lengths are in the data
// file's own unit; NaN stands for what there is not (null in the file), and
// nothing is infinite. Tables, pages and sentences are drawn from them.
//
// Here is the top; each part has a header beside this one:
//
//   data_record.h            data, unit of display, hold-outs
//   model_record.h           fits, figures of a model under each hold-out
//   regression_record.h      steps, coefficients, analysis of variance
//   residual_record.h        tests of held-out residuals
//   judgement_record.h       pairs of models, verdicts
//   recommendation_record.h  the recommended map
//   remark_record.h          what speaks for it and bounds its worth
//   rezero_record.h          maps that are re-zeroed
//   figure_record.h          the rows behind the figures
//   machine_record.h         the error at the tool
//   provenance_record.h      configuration, program, files

namespace errmap::models {

struct ComponentRecord {
  std::string name;
  bool interrupted = false;
  DataRecord data;
  double goal = kNotKnown;
  double indifference = kNotKnown;
  DisplayRecord display;
  std::vector<HoldoutRecord> holdouts;
  std::vector<ModelRecord> models;
  std::optional<GapRecord> gap;
  std::vector<PairRecord> comparisons;
  ByName<std::vector<std::vector<std::string>>> tiers;
  std::vector<StabilityRecord> stability;
  std::vector<VerdictRecord> verdict;
  std::optional<RecommendationRecord> recommendation;
  /// Where it was asked for.
  LeftOut<RezeroRecord> rezero;
  FiguresRecord figures;
};

inline constexpr std::string_view kResultsSchema = "errmap-results-1";

/// Why a file is perhaps not what a run found.
enum class Doubt {
  kNoHash,   // an older program wrote it, or the hash was taken out
  kChanged,  // its content is not that of its hash
};
/// "no hash", "changed".
std::string_view ToString(Doubt doubt);

struct StudyRecord {
  std::string schema;
  std::string version;
  std::uint64_t seed = 0;
  bool interrupted = false;
  ProvenanceRecord provenance;
  std::vector<ComponentRecord> components;
  LeftOut<MachineRecord> machine;  // where they were put together
  LeftOut<Doubt> doubt;            // by who read it
};

/// Two models under a hold-out, either way round, or null.
const PairRecord* FindPair(const ComponentRecord& component,
                           std::string_view holdout,
                           std::string_view one,
                           std::string_view other);

/// results.json; what is no UTF-8 in names is replaced. Its content_sha256, in
/// provenance, is of all else but measured times (keys with "seconds" or that
/// end in _ns): the same of the same study, however the file is indented.
std::string ToJsonText(const StudyRecord& record);
/// In one line, as the record stands: with its doubt, without a hash of its
/// own.
std::string ToJsonLine(const StudyRecord& record);

/// What ToJsonText wrote: Same(FromJsonText(ToJsonText(r)), r). Of a document
/// that is older, incomplete or of a failed run what is missing, null or of
/// another type is as in a new record; `doubt` says whether its hash agrees.
/// Throws data::InputError where the text
/// is no JSON or of another schema.
StudyRecord FromJsonText(std::string_view text);

}  // namespace errmap::models
