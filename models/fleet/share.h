#pragma once

#include <cstdint>
#include <string_view>

namespace errmap::models {

/// The share of a fleet's components that one task does: number `index` of
/// `count`, from 0.
struct Share {
  std::int64_t index = 0;
  std::int64_t count = 1;

  /// Dealt by a hash of the name (its SHA-256's first 8 bytes, modulo `count`),
  /// so that a component more or less moves no other.
  bool Has(std::string_view name) const;
};

}  // namespace errmap::models
