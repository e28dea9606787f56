#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace errmap::data {

/// The numbers of a column: owned, or a caller's and read in place.
class ColumnValues {
 public:
  using View =
      Eigen::Map<const Eigen::ArrayXd, Eigen::Unaligned, Eigen::InnerStride<>>;
  using value_type = double;
  using const_iterator = View::const_iterator;
  using iterator = const_iterator;
  using const_reference = const double&;

  ColumnValues() = default;
  ColumnValues(std::vector<double> own) : own_(std::move(own)) {}
  /// A caller's `size` numbers, `stride` apart; `keeper` keeps them alive.
  static ColumnValues Borrowed(const double* first,
                               std::ptrdiff_t stride,
                               std::size_t size,
                               std::shared_ptr<const void> keeper) {
    ColumnValues values;
    values.first_ = first;
    values.stride_ = stride;
    values.size_ = size;
    values.keeper_ = std::move(keeper);
    return values;
  }

  std::size_t size() const { return is_borrowed() ? size_ : own_.size(); }
  bool empty() const { return size() == 0; }
  const double& operator[](std::size_t i) const {
    return is_borrowed() ? first_[static_cast<std::ptrdiff_t>(i) * stride_]
                         : own_[i];
  }
  const_iterator begin() const { return view().cbegin(); }
  const_iterator end() const { return view().cend(); }
  bool operator==(const ColumnValues& other) const {
    return size() == other.size() && (view() == other.view()).all();
  }

  operator std::vector<double>() const { return {begin(), end()}; }

  /// Gives write access; first copies a caller's numbers.
  std::vector<double>& Own() {
    if (is_borrowed()) *this = std::vector<double>(begin(), end());
    return own_;
  }
  void reserve(std::size_t size) { Own().reserve(size); }
  void push_back(double value) { Own().push_back(value); }

 private:
  bool is_borrowed() const { return keeper_ != nullptr; }
  View view() const {
    return {is_borrowed() ? first_ : own_.data(),
            static_cast<Eigen::Index>(size()),
            Eigen::InnerStride<>(is_borrowed() ? stride_ : 1)};
  }

  std::vector<double> own_;
  const double* first_ = nullptr;
  std::ptrdiff_t stride_ = 1;
  std::size_t size_ = 0;
  std::shared_ptr<const void> keeper_;
};

}  // namespace errmap::data
