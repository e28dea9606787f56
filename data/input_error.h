#pragma once

#include <stdexcept>

namespace errmap::data {

/// Unusable input: a file that cannot be read or does not hold what it must.
/// what() is one line: file, place (line, row, column), what is wrong and what
/// to do about it. The command line ends with exit status 3.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace errmap::data
