#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "data/measurements/dataset.h"
#include "models/study/study.h"

namespace errmap::models {

/// Where a fit stands in its study, and all that its outcome depends on.
struct FitLabel {
  std::string component;
  std::string holdout;  // "" for a fit to all rows
  std::size_t fold = 0;
  std::string model;  // the SPEC as given
  // Texts that differ where the fit may differ.
  std::string program;  // version and build
  std::string options;  // of the model, with the values that take effect
  std::string context;  // seed and the like
  std::string rows;     // SHA-256 of training and test rows and their columns

  /// SHA-256 of what the outcome depends on: two fits with the same key have
  /// the same outcome, wherever they stand.
  std::string Key() const;
};

/// Version of errmap and, where it can be had, the start of the SHA-256 of the
/// running program: another build may give other bits.
const std::string& ProgramIdentity();

/// Labels of the fits of one component's study; `holdouts` must outlive them.
/// Each row is hashed once.
class FitLabels {
 public:
  FitLabels(std::string component,
            const data::Dataset& dataset,
            const std::vector<Holdout>& holdouts,
            const std::vector<std::unique_ptr<ModelRecipe>>& recipes,
            const StudyOptions& options,
            std::string program = ProgramIdentity());

  const std::string& component() const { return component_; }
  /// SHA-256 of the program and of all rows and columns, whatever is fitted.
  std::string DataKey() const;
  FitLabel Of(const StudyTask& task) const;
  /// Of all fits, as StudyTasks orders them.
  std::vector<FitLabel> All() const;

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
