#include "models/fleet/share.h"

#include "data/sha256.h"

namespace errmap::models {

bool Share::Has(std::string_view name) const {
  constexpr std::size_t kDigits = 16;
  const std::uint64_t hash =
      std::stoull(data::Sha256(name).substr(0, kDigits), nullptr, 16);
  return hash % static_cast<std::uint64_t>(count) ==
         static_cast<std::uint64_t>(index);
}

}  // namespace errmap::models
