#include "models/kinematics/machine.h"

#include "data/column_header.h"

namespace errmap::models {

data::Unit UnitOf(const Machine& machine, ErrorDirection direction) {
  return IsRotation(direction) ? data::UnitOfSymbol("rad") : machine.length;
}

VectorXd SensitiveLengths(const Machine& machine,
                          const Eigen::MatrixX3d& errors) {
  VectorXd squares = VectorXd::Zero(errors.rows());
  for (std::size_t d = 0; d < machine.sensitive.size(); ++d) {
    if (!machine.sensitive[d]) continue;
    squares += errors.col(static_cast<Index>(d)).cwiseAbs2();
  }
  return squares.cwiseSqrt();
}

std::string_view LetterOf(ErrorDirection direction) {
  constexpr std::array<std::string_view, kNumErrorDirections> kLetters = {
      "X", "Y", "Z", "A", "B", "C"};
  return kLetters[static_cast<std::size_t>(direction)];
}

std::string DirectionColumn(std::string_view coordinate) {
  return data::ReadHeader(coordinate).base + "_direction";
}

}  // namespace errmap::models
