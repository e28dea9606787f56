#pragma once

#include <memory>

#include "models/error_model.h"
#include "stats/eigen.h"

namespace errmap::models {

/// Returns the model of a form read from a file. `parameters` of a polynomial
/// tells whether its intercept is one. Throws std::invalid_argument if the form
/// is inconsistent.
std::shared_ptr<const ErrorModel> ModelOfForm(ModelDescription form,
                                              Index parameters);

}  // namespace errmap::models
