#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "models/record.h"
#include "models/study/judgement/verdict.h"
#include "models/study/record/data_record.h"
#include "models/study/record/figure_record.h"
#include "models/study/record/judgement_record.h"
#include "models/study/record/model_record.h"
#include "models/study/record/provenance_record.h"
#include "models/study/record/recommendation_record.h"

// The results of a study as plain data. These structs are results.json, schema
// errmap-results-2: each member is a key, in the same order. Lengths are in the
// data file's unit; NaN stands for a missing value (null in the file), and
// nothing is infinite. Tables, pages and sentences are made from them.
//
// This is the top; each part has a header in this folder:
//
//   data_record.h            data, unit of display, hold-outs
//   model_record.h           fits, a model under each hold-out, its residuals
//   judgement_record.h       pairs of models, verdicts, re-zeroed maps
//   recommendation_record.h  the recommended map
//   figure_record.h          the rows behind the figures
//   provenance_record.h      configuration, program, files
//
// Coefficients and their statistics are in models/regression_record.h.

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
  std::optional<InterpolationGap> gap;
  std::vector<PairRecord> comparisons;
  ByName<std::vector<std::vector<std::string>>> tiers;
  std::vector<StabilityRecord> stability;
  std::vector<VerdictRecord> verdict;
  std::optional<RecommendationRecord> recommendation;
  /// Set if requested.
  LeftOut<RezeroRecord> rezero;
  FiguresRecord figures;
};

inline constexpr std::string_view kResultsSchema = "errmap-results-2";
/// The schema of older stores, with less on the recommended map.
inline constexpr std::string_view kStoredResultsSchema = "errmap-results-1";

/// Reason to doubt that a file holds the unchanged results of a run.
enum class Doubt {
  kNoHash,   // written by an older program, or the hash was removed
  kChanged,  // its content does not match its hash
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
  OtherKeys others;      // what slices add
  LeftOut<Doubt> doubt;  // set by the reader
};

/// Returns the pair of two models under a hold-out, in either order, or null.
const PairRecord* FindPair(const ComponentRecord& component,
                           std::string_view holdout,
                           std::string_view one,
                           std::string_view other);

/// Returns results.json; replaces bytes in names that are not UTF-8. The
/// content_sha256 in provenance covers all else except measured times (keys
/// with "seconds" or ending in _ns). It is the same for the same study,
/// whatever the indentation.
std::string ToJsonText(const StudyRecord& record);
/// Returns the record in one line, unchanged: with its `doubt`, without a new
/// hash.
std::string ToJsonLine(const StudyRecord& record);

/// Reads the text of ToJsonText: Same(FromJsonText(ToJsonText(r)), r). Missing
/// keys, as in older, incomplete or failed results, keep the values of a new
/// record. `doubt` shows whether the hash matches. Throws data::InputError if
/// the text is not JSON, has another schema, or a value of another type.
StudyRecord FromJsonText(std::string_view text);
/// Reads the results of a store, also of kStoredResultsSchema.
StudyRecord FromStoredJsonText(std::string_view text);

}  // namespace errmap::models
