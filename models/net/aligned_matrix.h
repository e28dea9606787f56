#pragma once

#include <cstddef>
#include <memory>

#include <Eigen/Core>

#include "models/net/net_kernels.h"

namespace errmap::models {

/// Column-major matrix of zeros, aligned to the widest vectors of
/// models/net/net_kernels.h, so that no load crosses a cache line.
template <typename Scalar>
class AlignedMatrix {
 public:
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  AlignedMatrix() = default;
  AlignedMatrix(Eigen::Index rows, Eigen::Index cols)
      : rows_(rows),
        cols_(cols),
        memory_(static_cast<Scalar*>(::operator new(
            static_cast<std::size_t>(rows* cols) * sizeof(Scalar),
            kAlignment))) {
    all().setZero();
  }

  Eigen::Index rows() const { return rows_; }
  Eigen::Index cols() const { return cols_; }
  Scalar* data() { return memory_.get(); }
  const Scalar* data() const { return memory_.get(); }
  Scalar* column(Eigen::Index j) { return data() + j * rows_; }
  const Scalar* column(Eigen::Index j) const { return data() + j * rows_; }
  Eigen::Map<Matrix> all() { return {data(), rows_, cols_}; }
  Eigen::Map<const Matrix> all() const { return {data(), rows_, cols_}; }
  Eigen::Map<Matrix> columns(Eigen::Index begin, Eigen::Index count) {
    return {column(begin), rows_, count};
  }

 private:
  static constexpr std::align_val_t kAlignment{
      static_cast<std::size_t>(kVectorBytes)};
  struct Free {
    void operator()(Scalar* memory) const {
      ::operator delete(memory, kAlignment);
    }
  };

  Eigen::Index rows_ = 0;
  Eigen::Index cols_ = 0;
  std::unique_ptr<Scalar, Free> memory_;
};

}  // namespace errmap::models
