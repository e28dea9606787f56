#include "models/history/growth_beyond.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>

#include "fitting/least_squares/decompositions.h"
#include "models/history/growth.h"
#include "models/scaling.h"
#include "models/shared_work.h"
#include "stats/f_test.h"

namespace errmap::models {
namespace {

using data::Dataset;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

// Of very many rows some tell it as well.
Dataset SomeRows(const Dataset& all) {
  constexpr Index kMostRows = 4000;
  std::vector<Index> some;
  for (Index row = 0; row < all.num_rows();
       row += 1 + all.num_rows() / kMostRows) {
    some.push_back(row);
  }
  return all.SelectRows(some);
}

// What is told of them depends on no unit, and no square of them overflows.
MatrixXd InTheirRanges(const MatrixXd& inputs) {
  return UnitRangeScaling(inputs).Apply(inputs);
}

// Rows session after session.
struct Sessions {
  explicit Sessions(const Dataset& rows) {
    std::vector<Index> order;
    for (const auto& [session, places] : RowsOfSessions(rows)) {
      order.insert(order.end(), places.begin(), places.end());
      ends.push_back(static_cast<Index>(order.size()));
    }
    inputs = InTheirRanges(rows.input_values())(order, Eigen::all);
    targets = rows.target_values()(order);
  }

  std::size_t count() const { return ends.size(); }

  MatrixXd inputs;  // in their ranges
  VectorXd targets;
  std::vector<Index> ends;  // rows of the first session, of the first two, ...
};

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
  const Dataset training = SomeRows(all);
  constexpr double kTells = 0.01;
  constexpr double kIsStraight = 0.2;
  const auto count = std::ranges::count(only_grows, true);
  const Index others = training.num_inputs() - count;
  MatrixXd growing(training.num_rows(), count);
  MatrixXd rest(training.num_rows(), others + 1);
  rest.col(others).setOnes();
  const MatrixXd inputs = InTheirRanges(training.input_values());
  Index place_growing = 0;
  Index place_rest = 0;
  for (Index j = 0; j < inputs.cols(); ++j) {
    if (only_grows[static_cast<std::size_t>(j)]) {
      growing.col(place_growing++) = inputs.col(j);
    } else {
      rest.col(place_rest++) = inputs.col(j);
    }
  }
  MatrixXd offsets =
      MatrixXd::Zero(training.num_rows(), training.num_sessions());
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
  const Sessions sessions(training);
  // Where there are many sessions, some of the planes do.
  constexpr std::size_t kMostPlanes = 6;
  const std::size_t step = 1 + (sessions.count() - 3) / kMostPlanes;
  for (std::size_t known = 2; known < sessions.count(); known += step) {
    const Index rows_known = sessions.ends[known - 1];
    const Plane plane(sessions.inputs.topRows(rows_known),
                      sessions.targets.head(rows_known));
    const auto counts = static_cast<double>(known);
    for (std::size_t later = known; later < sessions.count(); ++later) {
      judged += counts;
      const Index first = sessions.ends[later - 1];
      const Index rows = sessions.ends[later] - first;
      for (std::size_t r = 0; r < kRooms.size(); ++r) {
        const VectorXd residuals =
            sessions.targets.segment(first, rows) -
            plane.Predict(
                sessions.inputs.middleRows(first, rows), only_grows, kRooms[r]);
        errors[r] +=
            counts * std::log(std::max(residuals.norm() /
                                           std::sqrt(static_cast<double>(rows)),
                                       std::numeric_limits<double>::min()));
      }
    }
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

// Of all later rows, by the first `known`.
double ErrorBeyond(const Sessions& sessions,
                   const std::vector<bool>& only_grows,
                   Growth growth,
                   Index known) {
  const Index later = sessions.inputs.rows() - known;
  const RowVectorXd centre = sessions.inputs.topRows(known).colwise().mean();
  const MatrixXd terms =
      WithBends(sessions.inputs.rowwise() - centre, only_grows, growth);
  const Plane plane(terms.topRows(known), sessions.targets.head(known));
  return (sessions.targets.tail(later) - plane.Predict(terms.bottomRows(later)))
      .norm();
}

// Each time that more sessions are known.
bool ForetellsBetter(const Sessions& sessions,
                     const std::vector<bool>& only_grows,
                     Growth growth,
                     Growth than) {
  constexpr double kLeastKnown = 0.4;
  constexpr std::size_t kFewestTimes = 4;
  constexpr std::size_t kMostTimes = 12;
  constexpr double kBetter = 0.9;
  const auto first = static_cast<std::size_t>(
      std::ceil(kLeastKnown * static_cast<double>(sessions.count())));
  const std::size_t times = sessions.count() - first;
  if (times < kFewestTimes) return false;
  const std::size_t step = 1 + times / kMostTimes;
  for (std::size_t i = first; i < sessions.count(); i += step) {
    const Index known = sessions.ends[i - 1];
    if (!(ErrorBeyond(sessions, only_grows, growth, known) <
          kBetter * ErrorBeyond(sessions, only_grows, than, known))) {
      return false;
    }
  }
  return true;
}

Growth FindGrowth(const Dataset& training) {
  // Bends of more than these are too many to be proven.
  constexpr std::ptrdiff_t kMostBends = 200;
  const std::vector<bool> only_grows = ColumnsThatOnlyGrow(training);
  const auto growing = std::ranges::count(only_grows, true);
  if (growing == 0 || growing * training.num_inputs() > kMostBends) {
    return Growth::kStraight;
  }
  const Sessions sessions(SomeRows(training));
  Growth proven = Growth::kStraight;
  for (const Growth growth : {Growth::kWithOthers, Growth::kBending}) {
    if (ForetellsBetter(sessions, only_grows, growth, proven)) proven = growth;
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
