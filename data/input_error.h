#pragma once

#include <stdexcept>

namespace errmap::data {

/// Unusable input: a file that cannot be read or lacks required content. what()
/// is one line: file, place (line, row, column), the fault and the remedy. The
/// command line ends with exit status 3.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace errmap::data
