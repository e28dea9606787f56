#pragma once

#include "models/export/program/map_program.h"

namespace errmap::models {

/// Returns instructions that compute the polynomial in kTerm 0 from its scaled
/// inputs in kScaled 0, 1, .... They nest it (Horner's scheme) by the input
/// that most terms contain, then recursively, so that no power is computed.
Instructions NestedPolynomial(const PolynomialForm& form);

}  // namespace errmap::models
