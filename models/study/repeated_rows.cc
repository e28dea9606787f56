#include "models/study/repeated_rows.h"

#include <algorithm>
#include <bit>
#include <unordered_map>
#include <unordered_set>

#include "stats/distributions.h"

namespace errmap::models {
namespace {

std::uint64_t HashOf(const MatrixXd& inputs,
                     const VectorXd* targets,
                     Index row) {
  std::uint64_t hash = 0;
  const auto mix = [&](double value) {
    const float rounded = static_cast<float>(value) + 0.0F;  // no -0
    hash = (hash ^ std::bit_cast<std::uint32_t>(rounded)) * 0x9E3779B97F4A7C15U;
    hash ^= hash >> 29U;
  };
  for (Index i = 0; i < inputs.cols(); ++i) mix(inputs(row, i));
  if (targets != nullptr) mix((*targets)[row]);
  hash *= 0xBF58476D1CE4E5B9U;
  return hash ^ (hash >> 32U);
}

}  // namespace

std::vector<std::uint64_t> RowHashes(const MatrixXd& inputs,
                                     const VectorXd* targets) {
  std::vector<std::uint64_t> hashes;
  for (Index row = 0; row < inputs.rows(); ++row) {
    hashes.push_back(HashOf(inputs, targets, row));
  }
  return hashes;
}

double ShareAlike(const data::Dataset& training,
                  const std::vector<std::uint64_t>& hashes) {
  std::vector<Index> codes;
  if (training.num_sessions() > 1) {
    codes = training.session_codes();
  } else if (training.has_groups()) {
    codes = training.groups().codes;
  } else {
    for (Index row = 0; row < training.num_rows(); ++row) codes.push_back(row);
  }
  constexpr Index kSeveral = -1;
  std::unordered_map<std::uint64_t, Index> where;
  for (std::size_t i = 0; i < hashes.size(); ++i) {
    const auto [at, is_new] = where.try_emplace(hashes[i], codes[i]);
    if (!is_new && at->second != codes[i]) at->second = kSeveral;
  }
  const auto alike = std::ranges::count_if(
      hashes, [&](std::uint64_t hash) { return where.at(hash) == kSeveral; });
  return static_cast<double>(alike) / static_cast<double>(hashes.size());
}

bool AreMoreThanChance(Index found, double looked, double share_by_chance) {
  constexpr double kRare = 0.001;  // as many or more, of a Poisson variable
  return found > 0 &&
         1.0 - stats::ChiSquaredUpperTail(2.0 * looked * share_by_chance,
                                          2.0 * static_cast<double>(found)) <
             kRare;
}

Index CountRowsOf(const data::Dataset& training, const data::Dataset& judged) {
  std::vector<Index> columns;
  for (const data::ColumnInfo& input : training.inputs()) {
    columns.push_back(judged.FindInput(input.name));
  }
  const std::vector<std::uint64_t> learnt =
      RowHashes(training.input_values(), &training.target_values());
  const std::unordered_set<std::uint64_t> known(learnt.begin(), learnt.end());
  const std::vector<std::uint64_t> hashes = RowHashes(
      judged.input_values()(Eigen::all, columns), &judged.target_values());
  const Index found = std::ranges::count_if(
      hashes, [&](auto hash) { return known.contains(hash); });
  return AreMoreThanChance(found,
                           static_cast<double>(hashes.size()),
                           ShareAlike(training, learnt))
             ? found
             : 0;
}

}  // namespace errmap::models
