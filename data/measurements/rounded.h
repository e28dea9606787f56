#pragma once

#include <string>

namespace errmap::data {

/// To three digits, from 100 to a million to the next whole number.
std::string Rounded(double value);

}  // namespace errmap::data
