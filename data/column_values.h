#pragma once

#include <cstddef>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

namespace errmap::data {

/// The numbers of a column: its own, or a caller's, read in place.
class ColumnValues {
 public:
  class Iterator {
   public:
    using iterator_category = std::input_iterator_tag;
    using value_type = double;
    using difference_type = std::ptrdiff_t;
    using pointer = const double*;
    using reference = const double&;

    Iterator() = default;
    Iterator(const double* at, std::ptrdiff_t stride)
        : at_(at), stride_(stride) {}
    const double& operator*() const { return *at_; }
    Iterator& operator++() {
      at_ += stride_;
      return *this;
    }
    Iterator operator++(int) {
      Iterator before = *this;
      ++*this;
      return before;
    }
    bool operator==(const Iterator&) const = default;

   private:
    const double* at_ = nullptr;
    std::ptrdiff_t stride_ = 1;
  };
  using value_type = double;
  using const_iterator = Iterator;
  using iterator = Iterator;
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
  Iterator begin() const {
    return is_borrowed() ? Iterator(first_, stride_) : Iterator(own_.data(), 1);
  }
  Iterator end() const {
    return is_borrowed()
               ? Iterator(first_ + static_cast<std::ptrdiff_t>(size_) * stride_,
                          stride_)
               : Iterator(own_.data() + own_.size(), 1);
  }
  bool operator==(const ColumnValues& other) const {
    if (size() != other.size()) return false;
    for (std::size_t i = 0; i < size(); ++i) {
      if ((*this)[i] != other[i]) return false;
    }
    return true;
  }

  operator std::vector<double>() const { return {begin(), end()}; }

  /// Gives write access; a caller's numbers are copied first.
  std::vector<double>& Own() {
    if (is_borrowed()) *this = std::vector<double>(begin(), end());
    return own_;
  }
  void reserve(std::size_t size) { Own().reserve(size); }
  void push_back(double value) { Own().push_back(value); }

 private:
  bool is_borrowed() const { return keeper_ != nullptr; }

  std::vector<double> own_;
  const double* first_ = nullptr;
  std::ptrdiff_t stride_ = 1;
  std::size_t size_ = 0;
  std::shared_ptr<const void> keeper_;
};

}  // namespace errmap::data
