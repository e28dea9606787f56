#pragma once

#include <memory>
#include <string>
#include <vector>

#include "data/measurements/dataset.h"
#include "models/study/study.h"

namespace errmap::models {

/// The version of errmap and, if available, the start of the SHA-256 of the
/// running program. Another build may compute other bits.
const std::string& ProgramIdentity();

/// Keys of the fits of one component's study: the SHA-256 of everything that
/// affects an outcome. Fits with the same key have the same outcome in any
/// study. `holdouts` must outlive them. Each row is hashed once.
class FitLabels {
 public:
  FitLabels(std::string component,
            const data::Dataset& dataset,
            const std::vector<Holdout>& holdouts,
            const std::vector<std::unique_ptr<ModelRecipe>>& recipes,
            const StudyOptions& options,
            std::string program = ProgramIdentity());

  const std::string& component() const { return component_; }
  std::string KeyOf(const StudyTask& task) const;
  /// Returns the keys of all fits, in the order of StudyTasks.
  std::vector<std::string> Keys() const;

 private:
  struct Model {
    std::string name;
    std::string options;
  };

  std::string component_;
  const std::vector<Holdout>& holdouts_;
  StudyOptions options_;
  std::string program_;
  std::vector<StudyTask> tasks_;
  std::vector<Model> models_;
  std::string all_rows_;
  std::vector<std::vector<std::string>> rows_;  // by hold-out and fold
};

}  // namespace errmap::models
