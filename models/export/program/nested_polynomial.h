#pragma once

#include "models/export/program/map_program.h"

namespace errmap::models {

/// Instructions that leave the polynomial's value in kTerm 0, from its inputs
/// scaled in kScaled 0, 1, ...: nested (Horner) in the input that most terms
/// have, then likewise within, so that no power is ever formed.
Instructions NestedPolynomial(const PolynomialForm& form);

}  // namespace errmap::models
