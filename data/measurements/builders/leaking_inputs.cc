#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "data/column_words.h"
#include "data/measurements/builders/value_checks.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/least_squares.h"
#include "data/text.h"

namespace errmap::data {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr Index kFewestRowsToTell = 12;
constexpr Index kMostRowsLooked = 4000;
constexpr std::size_t kMostForTriples = 40;
constexpr std::size_t kMostCandidates = 200;

// What rounding may leave, of the target's standard deviation: of a difference
// of large columns, and of any other sum, which a good map may come near.
constexpr double kMostOfDifference = 0.5;
constexpr double kMostOfOther = 0.05;
constexpr double kCancels = 10.0;     // times the target's standard deviation
constexpr double kUnitSlack = 0.02;   // of coefficients that are alike
constexpr double kMostOfShare = 0.3;  // of the target's standard deviation
constexpr double kMostOfSize = 0.1;   // of that of the target's size
constexpr double kMostOfGap = 0.1;    // of the range of sizes
// Parts that add up (coefficients of one) may be rounded to their digits, some
// to fewer decimals than others.
constexpr double kMostOfParts = 0.005;

// The step of the decimals that values are written with; 0 of raw doubles.
double ResolutionOf(const VectorXd& values) {
  constexpr int kMostDecimals = 10;
  double step = 1.0;
  for (int decimals = 0; decimals <= kMostDecimals; ++decimals, step /= 10.0) {
    const double scale = std::pow(10.0, decimals);
    const bool whole = std::ranges::all_of(values, [&](double value) {
      const double scaled = value * scale;
      return std::abs(scaled - std::round(scaled)) <=
             1e-6 + 4e-16 * std::abs(scaled);
    });
    if (whole) return step;
  }
  return 0.0;
}

// Inputs that together determine the target, within the rounding of all.
struct Leak {
  std::vector<Index> left_out;  // of one to three, those that hold the error
  // "error_mm = actual_mm - nominal_mm", "|error_um| is above 3 where bad is
  // 1".
  std::string statement;
};

class LeakFinder {
 public:
  explicit LeakFinder(const Dataset::Parts& parts)
      : name_(NameInRemark(parts.target.name)),
        unit_(parts.target.unit),
        inputs_(parts.inputs) {
    const VectorXd& target_values = parts.target_values;
    const Eigen::MatrixXd& input_values = parts.input_values;
    const Index m = target_values.size();
    const Index stride = 1 + (m - 1) / kMostRowsLooked;
    // In the first row a difference to the row before is not known.
    for (Index row = m > kFewestRowsToTell ? 1 : 0; row < m; row += stride) {
      rows_.push_back(row);
    }
    target_ = target_values(rows_);
    resolution_ = ResolutionOf(target_);
    target_.array() -= target_.mean();
    sd_ = std::sqrt(target_.squaredNorm() / static_cast<double>(rows_.size()));
    for (Index j = 0; j < input_values.cols(); ++j) {
      TakeCandidate(j, input_values.col(j)(rows_));
    }
    const VectorXd looked = target_values(rows_);
    const Eigen::MatrixXd values = input_values(rows_, Eigen::all);
    FindShares(looked, values);
    FindSizes(looked, values);
    FindEarlier(target_values, input_values);
  }

  std::vector<Leak> Find() {
    if (static_cast<Index>(rows_.size()) < kFewestRowsToTell || !(sd_ > 0.0) ||
        candidates_.size() > kMostCandidates) {
      return {};
    }
    const auto size = static_cast<Index>(candidates_.size());
    Eigen::MatrixXd values(target_.size(), size);
    for (Index k = 0; k < size; ++k) values.col(k) = Of(k).values;
    products_ = values.transpose() * values;
    with_target_ = values.transpose() * target_;
    std::vector<Leak> leaks = alone_;
    for (std::size_t members = 1; members <= 3; ++members) {
      if (members == 3 && candidates_.size() > kMostForTriples) break;
      LookAtSets({}, 0, members, &leaks);
    }
    return leaks;
  }

 private:
  struct Candidate {
    Index input;
    VectorXd values;  // of the rows looked at, less their mean
    bool position;
    double sd = 0.0;
    double resolution = 0.0;
    bool settings = false;  // few values, as of a grid
    bool used = false;
  };

  const Candidate& Of(Index k) const { return candidates_[k]; }

  void TakeCandidate(Index input, VectorXd values) {
    const ColumnInfo& column = inputs_[input];
    const Quantity quantity = column.unit.quantity;
    if (!column.unit.symbol.empty() && quantity != unit_.quantity &&
        quantity != Quantity::kLength) {
      return;
    }
    Candidate candidate{.input = input,
                        .values = std::move(values),
                        .position = IsPosition(column)};
    const std::set<double> levels(candidate.values.begin(),
                                  candidate.values.end());
    candidate.settings = 3 * levels.size() <= rows_.size();
    // What is set is not a rounded reading.
    candidate.resolution =
        candidate.settings ? 0.0 : ResolutionOf(candidate.values);
    candidate.values.array() -= candidate.values.mean();
    candidate.sd = std::sqrt(candidate.values.squaredNorm() /
                             static_cast<double>(rows_.size()));
    if (candidate.sd > 0.0) candidates_.push_back(std::move(candidate));
  }

  // Errors as shares, in ppm or percent: of the position, or of a constant
  // where the name says an error. But for a factor they give the target (of the
  // rows looked at).
  void FindShares(const VectorXd& target, const Eigen::MatrixXd& values) {
    if (std::ssize(rows_) < kFewestRowsToTell || !(sd_ > 0.0)) return;
    for (Index j = 0; j < values.cols(); ++j) {
      const auto& column = inputs_[j];
      if (column.unit.quantity != Quantity::kRatio) continue;
      std::optional<Leak> leak;
      if (ErrorSign(column.name) != 0) {
        leak = ShareOf(target, j, values.col(j), VectorXd::Ones(target.size()));
      }
      for (Index k = 0; !leak && k < values.cols(); ++k) {
        if (!IsPosition(inputs_[k])) continue;
        leak = ShareOf(target, j, values.col(j), values.col(k));
        if (!leak) continue;
        leak->statement += " times " + NameOf(k);
      }
      if (leak) alone_.push_back(*std::move(leak));
    }
  }

  std::optional<Leak> ShareOf(const VectorXd& target,
                              Index input,
                              const VectorXd& share,
                              const VectorXd& whole) const {
    const VectorXd product = share.cwiseProduct(whole);
    const double b = product.dot(target) / product.squaredNorm();
    const double rounding =
        ResolutionOf(share) * std::abs(b) * whole.cwiseAbs().maxCoeff();
    // At 0 there is no share.
    const double worst = (whole.array() == 0.0)
                             .select(0.0, (target - b * product).array())
                             .abs()
                             .maxCoeff();
    if (!(worst <= rounding + resolution_ && worst < kMostOfShare * sd_)) {
      return std::nullopt;
    }
    return Leak{.left_out = {input},
                .statement = name_ + " = " + Rounded(b) + " " + NameOf(input)};
  }

  // What is made of the error's size: a share of a tolerance, what is left of
  // it, or whether it is exceeded.
  void FindSizes(const VectorXd& target, const Eigen::MatrixXd& values) {
    if (std::ssize(rows_) < kFewestRowsToTell || !(sd_ > 0.0)) return;
    const VectorXd size = target.cwiseAbs();
    const bool has_both_signs =
        target.minCoeff() < 0.0 && target.maxCoeff() > 0.0;
    for (Index j = 0; j < values.cols(); ++j) {
      const ColumnInfo& input = inputs_[j];
      if (IsPosition(input) || (!input.unit.symbol.empty() &&
                                input.unit.quantity != unit_.quantity &&
                                input.unit.quantity != Quantity::kRatio)) {
        continue;
      }
      std::string what = has_both_signs ? LineOf(size, j, values.col(j)) : "";
      if (what.empty()) what = LimitOf(size, j, values.col(j));
      if (what.empty()) continue;
      alone_.push_back(
          {.left_out = {j}, .statement = "|" + name_ + "| " + what});
    }
  }

  // "= 8 - tolerance_left"; "" where the size is not a line of the values.
  std::string LineOf(const VectorXd& size,
                     Index input,
                     const VectorXd& values) const {
    const VectorXd x = values.array() - values.mean();
    const VectorXd y = size.array() - size.mean();
    const double b = x.dot(y) / x.squaredNorm();
    const double rounding = ResolutionOf(values) * std::abs(b) + resolution_;
    const double sd =
        std::sqrt(y.squaredNorm() / static_cast<double>(y.size()));
    const double worst = (y - b * x).cwiseAbs().maxCoeff();
    if (!(worst <= rounding && rounding < kMostOfSize * sd)) return "";
    const double a = size.mean() - b * values.mean();
    if (std::abs(a) <= rounding) return "= " + Rounded(b) + " " + NameOf(input);
    return "= " + Rounded(a) + (b < 0.0 ? " - " : " + ") +
           Rounded(std::abs(b)) + " " + NameOf(input);
  }

  // "is above 3 where out_of_tol is 1": of flags that go on and off often, as
  // no switch does just where the error passes a limit.
  std::string LimitOf(const VectorXd& size,
                      Index input,
                      const VectorXd& values) const {
    constexpr Index kFewestChanges = 8;
    const double on = values.maxCoeff();
    const double off = values.minCoeff();
    if (!((values.array() == on) || (values.array() == off)).all()) return "";
    const Index m = values.size();
    const Index changes =
        (values.tail(m - 1).array() != values.head(m - 1).array()).count();
    if (changes < kFewestChanges) return "";
    constexpr double kInf = std::numeric_limits<double>::infinity();
    const auto range_of = [&](double value) {
      const auto is = values.array() == value;
      return std::pair(is.select(size.array(), kInf).minCoeff(),
                       is.select(size.array(), -kInf).maxCoeff());
    };
    std::pair large = range_of(on);
    std::pair small = range_of(off);
    const bool when_on = large.first > small.first;
    if (!when_on) std::swap(large, small);
    const double gap = large.first - small.second;
    if (gap < 0.0 || gap > kMostOfGap * (large.second - small.first)) return "";
    return "is above " + Rounded(large.first - 0.5 * gap) + " where " +
           NameOf(input) + " is " + Rounded(when_on ? on : off);
  }

  // The error of the row before, in nearly all rows (m x p values).
  void FindEarlier(const VectorXd& target, const Eigen::MatrixXd& values) {
    constexpr Index kNearlyAll = 95;  // percent
    const Index m = target.size() - 1;
    if (m < kFewestRowsToTell || !(sd_ > 0.0)) return;
    for (Index j = 0; j < values.cols(); ++j) {
      const auto earlier = target.head(m).array();
      const Index alike = (values.col(j).tail(m).array() == earlier).count();
      if (100 * alike < kNearlyAll * m) continue;
      alone_.push_back(
          {.left_out = {j},
           .statement = NameOf(j) + " = " + name_ + " of the row before"});
    }
  }

  std::string NameOf(Index input) const {
    return NameInRemark(inputs_[input].name);
  }

  // All sets of that many that begin with `set`.
  void LookAtSets(std::vector<Index> set,
                  Index next,
                  std::size_t members,
                  std::vector<Leak>* leaks) {
    if (set.size() == members) {
      if (const auto leak = LeakOf(set)) leaks->push_back(*leak);
      return;
    }
    for (Index k = next; k < static_cast<Index>(candidates_.size()); ++k) {
      if (std::ranges::any_of(set, [&](Index i) { return Of(i).used; })) return;
      if (Of(k).used) continue;
      set.push_back(k);
      LookAtSets(set, k + 1, members, leaks);
      set.pop_back();
    }
  }

  // What the rounding of all columns may leave.
  double RoundingOf(const std::vector<Index>& set, const VectorXd& b) const {
    constexpr double kSlack = 0.505;
    double rounding = resolution_ + 1e-12 * sd_;
    for (std::size_t i = 0; i < set.size(); ++i) {
      rounding += std::abs(b[static_cast<Index>(i)]) *
                  (Of(set[i]).resolution + 1e-12 * Of(set[i]).sd);
    }
    return kSlack * rounding;
  }

  // `worst`: what the sum leaves of the target.
  bool MayBe(const std::vector<Index>& set,
             const VectorXd& b,
             double worst) const {
    if (worst <= kMostOfOther * sd_ && GoesOneToOne(set, b)) return true;
    const double rounding = RoundingOf(set, b);
    if (IsTheErrorItself(set, b)) return rounding <= kMostOfDifference * sd_;
    const double least = b.cwiseAbs().minCoeff();
    const double most = b.cwiseAbs().maxCoeff();
    double size = 0.0;
    for (std::size_t i = 0; i < set.size(); ++i) {
      size = std::max(size, std::abs(b[static_cast<Index>(i)]) * Of(set[i]).sd);
    }
    if (set.size() > 1 && least > (1.0 - kUnitSlack) * most &&
        size > kCancels * sd_) {
      return rounding <= kMostOfDifference * sd_;
    }
    if (rounding > kMostOfOther * sd_) return false;
    return !std::ranges::all_of(
        set, [&](Index k) { return Of(k).position || Of(k).settings; });
  }

  std::optional<Leak> LeakOf(const std::vector<Index>& set) {
    const auto rows = static_cast<double>(rows_.size());
    // By the products first, which costs little and tells nearly all.
    const Eigen::MatrixXd products = products_(set, set);
    const VectorXd rough = SolveLeastSquares(products, with_target_(set));
    const double left =
        (target_.squaredNorm() - rough.dot(with_target_(set))) / rows;
    const double bound = 2.0 * RoundingOf(set, rough);
    if (!(left <= bound * bound + kMostOfParts * kMostOfParts * sd_ * sd_))
      return std::nullopt;
    Eigen::MatrixXd values(target_.size(), static_cast<Index>(set.size()));
    for (std::size_t i = 0; i < set.size(); ++i) {
      values.col(static_cast<Index>(i)) = Of(set[i]).values;
    }
    const VectorXd b = SolveLeastSquares(values, target_);
    const double worst = (target_ - values * b).cwiseAbs().maxCoeff();
    // The mean of rounded values is off by less than their rounding.
    const bool adds_up =
        ((b.cwiseAbs().array() - 1.0).abs() < kUnitSlack).all();
    const double allowed =
        std::max(2.0 * RoundingOf(set, b), adds_up ? kMostOfParts * sd_ : 0.0);
    if (!b.allFinite() || worst > allowed || !MayBe(set, b, worst)) {
      return std::nullopt;
    }
    return MakeLeak(set, b);
  }

  Leak MakeLeak(const std::vector<Index>& set, const VectorXd& b) {
    Leak leak;
    std::string formula;
    std::vector<std::size_t> places(set.size());
    std::iota(places.begin(), places.end(), std::size_t{0});
    std::ranges::stable_sort(places, std::greater<>(), [&](std::size_t i) {
      return b[static_cast<Index>(i)];
    });
    for (const std::size_t i : places) {
      const double factor = b[static_cast<Index>(i)];
      const bool one = std::abs(std::abs(factor) - 1.0) < kUnitSlack;
      if (!formula.empty() || factor < 0.0) {
        formula += formula.empty() ? "-" : factor < 0.0 ? " - " : " + ";
      }
      formula += (one ? "" : Rounded(std::abs(factor)) + " ") +
                 NameOf(Of(set[i]).input);
    }
    leak.statement = name_ + " = " + formula;
    for (const Index k : set) {
      if (!Of(k).position && !Of(k).settings) {
        candidates_[k].used = true;
        leak.left_out.push_back(Of(k).input);
      }
    }
    // Two positions: the measured one is written with more digits.
    if (leak.left_out.empty()) {
      const Index k = *std::ranges::max_element(set, {}, [&](Index i) {
        const VectorXd& values = Of(i).values;
        return std::set<double>(values.begin(), values.end()).size();
      });
      candidates_[k].used = true;
      leak.left_out.push_back(Of(k).input);
    }
    return leak;
  }

  // A position that goes with the error one to one is where it was measured.
  bool IsTheErrorItself(const std::vector<Index>& set,
                        const VectorXd& b) const {
    return Of(set[0]).position && GoesOneToOne(set, b);
  }

  // One column, in its unit; of a name whose unit could not be told
  // ("position_in") in any unit of length.
  bool GoesOneToOne(const std::vector<Index>& set, const VectorXd& b) const {
    if (set.size() != 1) return false;
    const auto is_factor_of = [&](const Unit& unit) {
      return AreConvertible(unit, unit_) &&
             std::abs(std::abs(b[0]) / Converted(1.0, unit, unit_) - 1.0) <
                 kUnitSlack;
    };
    const Unit& unit = inputs_[Of(set[0]).input].unit;
    if (!unit.symbol.empty()) return is_factor_of(unit);
    return std::ranges::any_of(
        std::array{"mm", "in", "m", "um", "cm"},
        [&](const char* symbol) { return is_factor_of(UnitOfSymbol(symbol)); });
  }

  std::string name_;  // of the target, as remarks say it
  const Unit& unit_;
  const std::vector<ColumnInfo>& inputs_;
  std::vector<Index> rows_;  // looked at
  VectorXd target_;          // of these, less its mean
  double sd_ = 0.0;
  double resolution_ = 0.0;
  std::vector<Candidate> candidates_;
  std::vector<Leak> alone_;   // of one input, but for a position
  Eigen::MatrixXd products_;  // of candidates
  VectorXd with_target_;
};

}  // namespace

std::vector<UselessInput> LeakingInputs(const Dataset::Parts& parts) {
  std::vector<UselessInput> useless;
  for (const Leak& leak : LeakFinder(parts).Find()) {
    for (const Index input : leak.left_out) {
      useless.push_back({.input = input,
                         .why = "holds the error itself (" + leak.statement +
                                " in all rows, to rounding)",
                         .behind = ": no control knows it beforehand",
                         .even_named = true});
    }
  }
  return useless;
}

}  // namespace errmap::data
