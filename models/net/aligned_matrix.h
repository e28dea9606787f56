#pragma once

#include <cstddef>
#include <memory>

#include "models/net/net_kernels.h"
#include "stats/eigen.h"

namespace errmap::models {

/// Column-major matrix of zeros, aligned to the widest vectors of
/// models/net/net_kernels.h, so that no load crosses a cache line.
template <typename Scalar>
class AlignedMatrix {
 public:
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  AlignedMatrix() = default;
  AlignedMatrix(Index rows, Index cols)
      : rows_(rows),
        cols_(cols),
        memory_(static_cast<Scalar*>(::operator new(
            static_cast<std::size_t>(rows* cols) * sizeof(Scalar),
            kAlignment))) {
    all().setZero();
  }

  Index rows() const { return rows_; }
  Index cols() const { return cols_; }
  Scalar* data() { return memory_.get(); }
  const Scalar* data() const { return memory_.get(); }
  Scalar* column(Index j) { return data() + j * rows_; }
  const Scalar* column(Index j) const { return data() + j * rows_; }
  Eigen::Map<Matrix> all() { return {data(), rows_, cols_}; }
  Eigen::Map<const Matrix> all() const { return {data(), rows_, cols_}; }
  Eigen::Map<Matrix> columns(Index begin, Index count) {
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

  Index rows_ = 0;
  Index cols_ = 0;
  std::unique_ptr<Scalar, Free> memory_;
};

}  // namespace errmap::models
