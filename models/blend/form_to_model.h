#pragma once

#include <memory>

#include <Eigen/Core>

#include "models/error_model.h"

namespace errmap::models {

/// The model of a form that was read back; `parameters` of a polynomial says
/// whether its intercept is one. Throws std::invalid_argument where the form
/// does not agree with itself.
std::shared_ptr<const ErrorModel> ModelOfForm(ModelDescription form,
                                              Eigen::Index parameters);

}  // namespace errmap::models
