#pragma once

#include <string>

#include "models/export/language.h"

namespace errmap::models {

/// Writes the program `name` as C99: local arrays, a pointer to the state, and
/// tables and functions whose names begin with `name`.
class CLanguage final : public Language {
 public:
  CLanguage(std::string name, Precision precision);

  std::string CellName(Cell cell) const override;
  std::string Number(double value, bool single) const override;
  std::string TrainedState(int form, int coordinate) const override;
  std::string HasAny(int mask) const override;

 private:
  std::string Flag(int bit) const override;
  std::string Assign(const std::string& to,
                     const std::string& value,
                     bool narrows) const override;
  std::string Call(Function function,
                   const std::string& argument,
                   bool single) const override;
  Lines Affine(const Instruction& it, const MatrixXd& table) const override;
  Lines Sigmoids(const Instruction& it) const override;

  std::string name_;
};

}  // namespace errmap::models
