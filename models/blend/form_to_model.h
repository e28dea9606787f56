#pragma once

#include <memory>

#include "models/error_model.h"
#include "stats/eigen.h"

namespace errmap::models {

/// Returns the model of a form read from a file. For a polynomial, `parameters`
/// shows whether the intercept was fitted. Throws std::invalid_argument if the
/// form is inconsistent.
std::shared_ptr<const ErrorModel> ModelOfForm(ModelDescription form,
                                              Index parameters);

}  // namespace errmap::models
