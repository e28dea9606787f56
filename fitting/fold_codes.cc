#include "fitting/fold_codes.h"

#include <algorithm>

namespace errmap::fitting {

Index FoldCodes::count() const {
  return codes.empty() ? 0 : *std::max_element(codes.begin(), codes.end()) + 1;
}

FoldCodes::Rows FoldCodes::Split(Index fold) const {
  Rows rows;
  for (std::size_t i = 0; i < codes.size(); ++i) {
    if (codes[i] == fold) {
      rows.test.push_back(static_cast<Index>(i));
    } else if (Fits(fold, i)) {
      rows.train.push_back(static_cast<Index>(i));
    }
  }
  return rows;
}

std::vector<FoldCodes::Rows> FoldCodes::Splits() const {
  std::vector<Rows> splits;
  for (Index fold = first_judged(); fold < count(); ++fold) {
    splits.push_back(Split(fold));
  }
  return splits;
}

}  // namespace errmap::fitting
