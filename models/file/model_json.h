#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "models/error_model.h"

// What the writer and the reader of model files share; no public header
// includes it, nor is it installed.

namespace errmap::models {

using ModelJson = nlohmann::ordered_json;

inline constexpr const char* kModelSchema = "errmap-model-1";

/// What an interval's units are where they are that.
inline constexpr const char* kWholeSessions = "sessions";

/// The key of an interval's half-width: "90", "95".
inline std::string CoverageKey(double coverage) {
  constexpr double kPercent = 100.0;
  return std::to_string(std::lround(coverage * kPercent));
}

ModelJson NumbersToJson(const Eigen::VectorXd& vector);
/// By rows.
ModelJson NumbersToJson(const Eigen::MatrixXd& matrix);

/// A value of a model file together with its place, for messages. Refers to
/// the document and the file's name, which must outlive it. Every reader
/// throws data::InputError naming file and key where the value is another.
class ModelJsonNode {
 public:
  ModelJsonNode(const ModelJson& value,
                std::string path,
                const std::string& source);

  [[noreturn]] void Refuse(const std::string& why) const;
  /// "must be 'a', 'b' or 'c', found 'd'".
  [[noreturn]] void RefuseWord(const std::vector<std::string>& words,
                               const std::string& found) const;
  /// "has no key 'a', 'b' or 'c'".
  [[noreturn]] void RefuseWithout(const std::vector<std::string>& keys) const;

  ModelJsonNode At(const std::string& key) const;
  /// Nothing where the key is not there, as in older files, or null.
  std::optional<ModelJsonNode> Find(const std::string& key) const;
  std::vector<ModelJsonNode> Elements() const;

  std::string Text() const;
  /// Finite.
  double Number() const;
  bool Truth() const;
  /// At least 0.
  Eigen::Index Count() const;
  Eigen::VectorXd Vector() const;
  /// Rows of one length.
  Eigen::MatrixXd Matrix() const;

 private:
  const ModelJson& value_;
  std::string path_;
  const std::string& source_;
};

/// Adds the model's form to its file: one key, named by the kind of form, of
/// those that ReadForm knows. Throws data::InputError on a model without a
/// formula.
void WriteForm(const ErrorModel& model,
               const std::string& equation,
               ModelJson* document);

/// The model itself and its equation, from the whole document and the kind that
/// was read already; `num_inputs` of the form, memory's derived ones included.
void ReadForm(const ModelJsonNode& document,
              Eigen::Index num_inputs,
              FittedModel* fitted);

}  // namespace errmap::models
