#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "models/error_model.h"
#include "stats/eigen.h"

// Shared by the writer and the reader of model files. Not installed, and not
// included by public headers.

namespace errmap::models {

using ModelJson = nlohmann::ordered_json;

inline constexpr const char* kModelSchema = "errmap-model-1";

/// Value of an interval's key `units` for whole sessions.
inline constexpr const char* kWholeSessions = "sessions";

/// Returns the key of an interval's half-width: "90", "95".
inline std::string CoverageKey(double coverage) {
  constexpr double kPercent = 100.0;
  return std::to_string(std::lround(coverage * kPercent));
}

/// A value of a model file and its place, for messages. Refers to the document
/// and the file's name, which must outlive it. Every reader throws
/// data::InputError naming file and key if the value is of another kind.
class ModelJsonNode {
 public:
  ModelJsonNode(const ModelJson& value,
                std::string path,
                const std::string& source);

  [[noreturn]] void Refuse(const std::string& why) const;
  /// Throws "must be 'a', 'b' or 'c', found 'd'".
  [[noreturn]] void RefuseWord(const std::vector<std::string>& words,
                               const std::string& found) const;
  /// Throws "has no key 'a', 'b' or 'c'".
  [[noreturn]] void RefuseWithout(const std::vector<std::string>& keys) const;

  ModelJsonNode At(const std::string& key) const;
  /// Returns nothing if the key is missing, as in older files, or null.
  std::optional<ModelJsonNode> Find(const std::string& key) const;
  std::vector<ModelJsonNode> Elements() const;

  std::string Text() const;
  /// Reads a finite number.
  double Number() const;
  bool Truth() const;
  /// Reads a number of at least 0.
  Index Count() const;
  VectorXd Vector() const;
  /// Reads rows of equal length.
  MatrixXd Matrix() const;

 private:
  const ModelJson& value_;
  std::string path_;
  const std::string& source_;
};

/// Adds the model's form to its file under one key that ReadForm knows, named
/// after the kind of form. Throws data::InputError if the model has no formula.
void WriteForm(const ErrorModel& model,
               const std::string& equation,
               ModelJson* document);

/// Reads the model and its equation from the whole document, given the kind
/// already read; `num_inputs` is that of the form, including derived inputs.
void ReadForm(const ModelJsonNode& document,
              Index num_inputs,
              FittedModel* fitted);

}  // namespace errmap::models
