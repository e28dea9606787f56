#include "models/history/growth_beyond.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>

#include "fitting/least_squares/decompositions.h"
#include "models/history/growth.h"
#include "models/shared_work.h"
#include "stats/f_test.h"

namespace errmap::models {
namespace {

using data::Dataset;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

// A plane of all inputs, shrunk a little: sensors of few sessions are alike.
class Plane {
 public:
  Plane(const MatrixXd& inputs, const VectorXd& targets)
      : offset_(inputs.colwise().mean()),
        lowest_(inputs.colwise().minCoeff()),
        highest_(inputs.colwise().maxCoeff()),
        intercept_(targets.mean()) {
    constexpr double kShrink = 1e-2;
    const MatrixXd centred = inputs.rowwise() - offset_;
    const auto rows = static_cast<double>(inputs.rows());
    const RowVectorXd squares = centred.colwise().squaredNorm();
    MatrixXd products = centred.transpose() * centred;
    // A column that never moved has no slope.
    products.diagonal() += kShrink * squares.transpose() +
                           VectorXd::Constant(squares.size(), rows * kTiny);
    const VectorXd along =
        centred.transpose() * (targets.array() - intercept_).matrix();
    slopes_ = products.ldlt().solve(along);
  }

  VectorXd Predict(const MatrixXd& inputs) const {
    return ((inputs.rowwise() - offset_) * slopes_).array() + intercept_;
  }

  // What grows stops `room` trained ranges beyond.
  VectorXd Predict(MatrixXd inputs,
                   const std::vector<bool>& only_grows,
                   double room) const {
    for (Index j = 0; j < inputs.cols(); ++j) {
      if (!only_grows[static_cast<std::size_t>(j)]) continue;
      const double more = room * (highest_[j] - lowest_[j]);
      inputs.col(j) = inputs.col(j)
                          .cwiseMax(lowest_[j] - more)
                          .cwiseMin(highest_[j] + more);
    }
    return Predict(inputs);
  }

 private:
  static constexpr double kTiny = 1e-12;

  RowVectorXd offset_;
  RowVectorXd lowest_;
  RowVectorXd highest_;
  double intercept_ = 0.0;
  VectorXd slopes_;
};

constexpr double kMostRoom = 3.0;

// Least squares of the targets on some columns.
struct Remainder {
  Remainder(const MatrixXd& design, const VectorXd& targets) {
    const Eigen::ColPivHouseholderQR<MatrixXd> qr(design);
    // Less is rounding.
    constexpr double kLeast = 1e-24;
    squares = std::max((targets - design * qr.solve(targets)).squaredNorm(),
                       kLeast * targets.squaredNorm());
    degrees = static_cast<double>(targets.size() - qr.rank());
  }

  // That the columns which `more` has besides tell nothing.
  double PValueAgainst(const Remainder& more) const {
    const double taken = degrees - more.degrees;
    if (taken == 0.0) return 1.0;
    return stats::FTestPValue(
        ((squares - more.squares) / taken) / (more.squares / more.degrees),
        taken,
        more.degrees);
  }

  double squares = 0.0;
  double degrees = 0.0;
};

enum class Course { kLevel, kStraight, kNeither };

// What all sessions say of the error in what only grows: whether it changes
// with it at all, and whether a straight line is all that can be seen, neither
// bent nor of sessions that lie about it.
Course CourseOf(const Dataset& all, const std::vector<bool>& only_grows) {
  // Of very many rows some tell it as well.
  constexpr Index kMostRows = 4000;
  std::vector<Index> some;
  for (Index row = 0; row < all.num_rows();
       row += 1 + all.num_rows() / kMostRows) {
    some.push_back(row);
  }
  const Dataset training = all.SelectRows(some);
  constexpr double kTells = 0.01;
  constexpr double kIsStraight = 0.2;
  const auto count = std::ranges::count(only_grows, true);
  const auto sessions = static_cast<Index>(RowsOfSessions(training).size());
  const Index others = training.num_inputs() - count;
  MatrixXd growing(training.num_rows(), count);
  MatrixXd rest(training.num_rows(), others + 1);
  rest.col(others).setOnes();
  Index place_growing = 0;
  Index place_rest = 0;
  for (Index j = 0; j < training.num_inputs(); ++j) {
    const VectorXd column = training.input_values().col(j);
    const VectorXd centred = column.array() - column.mean();
    if (only_grows[static_cast<std::size_t>(j)]) {
      growing.col(place_growing++) = centred / centred.norm();
    } else {
      rest.col(place_rest++) = centred;
    }
  }
  MatrixXd offsets = MatrixXd::Zero(training.num_rows(), sessions);
  const std::vector<Index> codes = training.session_codes();
  std::map<Index, Index> place_of;
  for (std::size_t row = 0; row < codes.size(); ++row) {
    const auto [at, is_new] =
        place_of.emplace(codes[row], static_cast<Index>(place_of.size()));
    offsets(static_cast<Index>(row), at->second) = 1.0;
  }
  const auto beside = [](const MatrixXd& left, const MatrixXd& right) {
    MatrixXd both(left.rows(), left.cols() + right.cols());
    both << left, right;
    return both;
  };
  const MatrixXd straight = beside(rest, growing);
  const VectorXd& targets = training.target_values();
  const Remainder level(rest, targets);
  const Remainder line(straight, targets);
  const Remainder bend(beside(straight, growing.cwiseAbs2()), targets);
  const Remainder own(beside(straight, offsets), targets);
  // Rows no more than columns: anything fits.
  if (bend.degrees == 0.0 || own.degrees == 0.0) return Course::kNeither;
  if (level.PValueAgainst(line) >= kTells) return Course::kLevel;
  return line.PValueAgainst(bend) > kIsStraight &&
                 line.PValueAgainst(own) > kIsStraight
             ? Course::kStraight
             : Course::kNeither;
}

double MakeRoomBeyond(const Dataset& training) {
  const std::vector<bool> only_grows = ColumnsThatOnlyGrow(training);
  if (std::ranges::find(only_grows, true) == only_grows.end()) {
    return kMostRoom;
  }
  const Course course = CourseOf(training, only_grows);
  if (course == Course::kLevel) return 0.0;
  if (course == Course::kStraight) return kMostRoom;
  constexpr std::array kRooms{0.0, 0.25, 0.5, 1.0, 2.0, kMostRoom};
  // Sums of the logarithms of later sessions' errors: no one decides alone. A
  // plane counts by the sessions that it knows.
  std::array<double, kRooms.size()> errors{};
  double judged = 0.0;
  std::vector<Index> earlier;
  const auto sessions = RowsOfSessions(training);
  // Where there are many sessions, some of the planes do.
  constexpr std::size_t kMostPlanes = 6;
  const std::size_t step = 1 + (sessions.size() - 3) / kMostPlanes;
  std::size_t known = 0;
  for (auto next = sessions.begin(); next != sessions.end(); ++next, ++known) {
    if (known >= 2 && (known - 2) % step == 0) {
      const Plane plane(training.input_values()(earlier, Eigen::all),
                        training.target_values()(earlier));
      const auto counts = static_cast<double>(known);
      for (auto later = next; later != sessions.end(); ++later) {
        judged += counts;
        const auto& [session, rows] = *later;
        for (std::size_t r = 0; r < kRooms.size(); ++r) {
          const VectorXd residuals =
              training.target_values()(rows) -
              plane.Predict(training.input_values()(rows, Eigen::all),
                            only_grows,
                            kRooms[r]);
          errors[r] +=
              counts *
              std::log(std::max(residuals.norm() /
                                    std::sqrt(static_cast<double>(rows.size())),
                                std::numeric_limits<double>::min()));
        }
      }
    }
    earlier.insert(earlier.end(), next->second.begin(), next->second.end());
  }
  // Less than this is no reason to doubt a line.
  constexpr double kMargin = 0.1;
  const double most = *std::ranges::min_element(errors) + kMargin * judged;
  for (std::size_t r = kRooms.size(); r-- > 0;) {
    if (errors[r] <= most) return kRooms[r];
  }
  return kMostRoom;
}

// Inputs (centred), and the bends in what only grows that go with `growth`.
MatrixXd WithBends(const MatrixXd& inputs,
                   const std::vector<bool>& only_grows,
                   Growth growth) {
  std::vector<VectorXd> columns;
  for (Index j = 0; j < inputs.cols(); ++j) columns.emplace_back(inputs.col(j));
  for (Index j = 0; growth != Growth::kStraight && j < inputs.cols(); ++j) {
    if (!only_grows[static_cast<std::size_t>(j)]) continue;
    for (Index i = 0; i < inputs.cols(); ++i) {
      const bool both_grow = only_grows[static_cast<std::size_t>(i)];
      if (both_grow && (i < j || growth == Growth::kWithOthers)) continue;
      columns.emplace_back(inputs.col(i).cwiseProduct(inputs.col(j)));
    }
  }
  MatrixXd terms(inputs.rows(), static_cast<Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) {
    terms.col(static_cast<Index>(k)) = columns[k];
  }
  return terms;
}

// How well all later sessions were foretold, each time that more were known.
class LaterSessions {
 public:
  LaterSessions(const Dataset& training, const std::vector<bool>& only_grows)
      : only_grows_(only_grows) {
    constexpr double kLeastKnown = 0.4;
    constexpr std::size_t kMostTimes = 12;
    std::vector<Index> rows;
    std::vector<Index> ends;
    for (const auto& [session, places] : RowsOfSessions(training)) {
      rows.insert(rows.end(), places.begin(), places.end());
      ends.push_back(static_cast<Index>(rows.size()));
    }
    const auto first = static_cast<std::size_t>(
        std::ceil(kLeastKnown * static_cast<double>(ends.size())));
    const std::size_t step = 1 + (ends.size() - first) / kMostTimes;
    for (std::size_t known = first; known < ends.size(); known += step) {
      known_.push_back(ends[known - 1]);
    }
    inputs_ = training.input_values()(rows, Eigen::all);
    targets_ = training.target_values()(rows);
  }

  bool ProveBetter(Growth growth, Growth than) const {
    constexpr std::size_t kFewestTimes = 4;
    constexpr double kBetter = 0.9;
    return known_.size() >= kFewestTimes &&
           std::ranges::all_of(known_, [&](Index known) {
             return ErrorOf(growth, known) < kBetter * ErrorOf(than, known);
           });
  }

 private:
  // Of all later rows, by the first `known`.
  double ErrorOf(Growth growth, Index known) const {
    const Index later = inputs_.rows() - known;
    const RowVectorXd centre = inputs_.topRows(known).colwise().mean();
    const MatrixXd terms =
        WithBends(inputs_.rowwise() - centre, only_grows_, growth);
    const Plane plane(terms.topRows(known), targets_.head(known));
    return (targets_.tail(later) - plane.Predict(terms.bottomRows(later)))
        .norm();
  }

  const std::vector<bool>& only_grows_;
  MatrixXd inputs_;  // by session, as the targets
  VectorXd targets_;
  std::vector<Index> known_;  // rows, each time
};

Growth FindGrowth(const Dataset& training) {
  // Bends of more than these are too many to be proven.
  constexpr std::ptrdiff_t kMostBends = 200;
  const std::vector<bool> only_grows = ColumnsThatOnlyGrow(training);
  const auto growing = std::ranges::count(only_grows, true);
  if (growing == 0 || growing * training.num_inputs() > kMostBends) {
    return Growth::kStraight;
  }
  const LaterSessions later(training, only_grows);
  Growth proven = Growth::kStraight;
  for (const Growth growth : {Growth::kWithOthers, Growth::kBending}) {
    if (later.ProveBetter(growth, proven)) proven = growth;
  }
  return proven;
}

// Of these rows once.
template <typename Result>
Result Shared(const std::string& what,
              const Dataset& training,
              SharedWork* shared,
              Result (*find)(const Dataset&)) {
  if (shared == nullptr) return find(training);
  std::string key = what;
  for (const data::ColumnInfo& input : training.inputs()) {
    key += ' ' + input.name;
  }
  return *shared->Get<Result>(
      key, [&] { return std::make_shared<const Result>(find(training)); });
}

}  // namespace

Growth GrowthBeyond(const Dataset& training, SharedWork* shared) {
  return Shared("growth beyond", training, shared, FindGrowth);
}

double RoomBeyond(const Dataset& training, SharedWork* shared) {
  return Shared("room beyond", training, shared, MakeRoomBeyond);
}

void LeaveRoom(const std::vector<std::string>& growing,
               double room,
               const std::vector<TrainedInput>& form_inputs,
               Guards* guards) {
  bool any = false;
  for (std::size_t i = 0; i < form_inputs.size(); ++i) {
    const TrainedInput& input = form_inputs[i];
    if (std::ranges::find(growing, input.column.name) == growing.end()) {
      continue;
    }
    // Widened by the margin of all inputs it is `room` ranges more.
    const double centre = 0.5 * (input.min + input.max);
    const double half = 0.5 * (input.max - input.min) * (1.0 + 2.0 * room) /
                        (1.0 + 2.0 * guards->input_margin);
    guards->input_min[static_cast<Index>(i)] = centre - half;
    guards->input_max[static_cast<Index>(i)] = centre + half;
    any = true;
  }
  if (!any) return;
  const double more = room * (guards->error_max - guards->error_min);
  guards->error_min -= more;
  guards->error_max += more;
}

}  // namespace errmap::models
