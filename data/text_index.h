#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace errmap::data {

/// Index of the distinct texts of a column. It is an open-addressing hash table
/// of indices into CsvColumn::texts, including texts already there, and does
/// not copy the texts.
class TextIndex {
 public:
  std::uint32_t IndexOf(std::string_view text,
                        std::vector<std::string>* texts) {
    if (2 * (texts->size() + 1) > slots_.size()) Grow(*texts);
    std::uint32_t& slot = slots_[SlotOf(text, *texts)];
    if (slot == 0) {
      texts->emplace_back(text);
      slot = static_cast<std::uint32_t>(texts->size());
    }
    return slot - 1;
  }

 private:
  std::size_t SlotOf(std::string_view text,
                     const std::vector<std::string>& texts) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t i = std::hash<std::string_view>{}(text)&mask;
    while (slots_[i] != 0 && texts[slots_[i] - 1] != text) i = (i + 1) & mask;
    return i;
  }

  void Grow(const std::vector<std::string>& texts) {
    constexpr std::size_t kLeast = 16;
    slots_.assign(std::max(kLeast, std::bit_ceil(2 * (texts.size() + 1))), 0);
    for (std::size_t i = 0; i < texts.size(); ++i) {
      slots_[SlotOf(texts[i], texts)] = static_cast<std::uint32_t>(i + 1);
    }
  }

  std::vector<std::uint32_t> slots_;  // 1 + index, 0 where free; a power of two
};

}  // namespace errmap::data
