#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace errmap::models {

/// Scratch values for one row, on the stack unless there are many, so that a
/// prediction in a control loop allocates no memory.
class RowScratch {
 public:
  explicit RowScratch(std::size_t count) {
    if (count > near_.size()) far_.resize(count);
  }
  double* data() { return far_.empty() ? near_.data() : far_.data(); }
  double& operator[](std::size_t i) { return data()[i]; }

 private:
  static constexpr std::size_t kFew = 1024;
  std::array<double, kFew> near_;
  std::vector<double> far_;
};

}  // namespace errmap::models
