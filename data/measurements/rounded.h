#pragma once

#include <string>

namespace errmap::data {

/// Rounds to three digits, and from 100 to a million to the next whole number.
std::string Rounded(double value);

}  // namespace errmap::data
