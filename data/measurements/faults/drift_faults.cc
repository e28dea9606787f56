#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include "data/measurements/dataset.h"
#include "data/measurements/faults/thermometers.h"

namespace errmap::data {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// A drifting thermometer: what it reads beyond all that the others explain (by
// their first principal components) rises with the rows, by that much in all
// and by that many standard deviations about the line; where the rows are one
// session, or the others explain the time itself, nothing can be said.
constexpr Index kFewestSessions = 3;
constexpr Index kMostComponents = 5;
constexpr double kLeastDrift = 0.5;  // degC
constexpr double kDriftTimes = 10.0;
// Of 60 healthy machines that ran little a day, 5 of the 20 of four days went
// 10 to 19 times so far: four rooms are in line by chance.
constexpr Index kFewSessions = 4;
constexpr double kDriftTimesOfFew = 25.0;
constexpr double kMostScatterNoise = 8.0;  // else it goes its own ways anyhow
constexpr double kLeastTimeLeft = 0.3;     // sd of time, of that before

// Thermometers too unlike for that are held against each other where sessions
// begin: a machine that rested is as warm as its room. Of 3,600 pairs of 60
// simulated machines of 4 to 10 days none goes so far, while 0.04 degC an hour,
// nights included, are 3 degC by the fourth day.
constexpr Index kFewestStarts = 4;
constexpr double kLeastColdDrift = 2.5;  // degC
constexpr double kColdDriftTimes = 8.0;

struct Drift {
  double change = 0.0;   // from first to last row
  double scatter = 0.0;  // about the line
  double ratio() const { return std::abs(change) / scatter; }
};

// The straight line of `values` in time, which runs from -1 to 1.
Drift LineOf(const VectorXd& values, const VectorXd& time) {
  const VectorXd from_mean = time.array() - time.mean();
  const double slope = from_mean.dot(values) / from_mean.squaredNorm();
  const VectorXd rest =
      values.array() - values.mean() - slope * from_mean.array();
  return {
      .change = 2.0 * slope,
      .scatter = rest.norm() / std::sqrt(static_cast<double>(rest.size() - 2))};
}

bool IsTrusted(Index input, const std::vector<ColumnFault>& known) {
  return std::ranges::none_of(known, [&](const ColumnFault& fault) {
    return fault.input == input && !fault.of_cells;
  });
}

// Thermometers over the rows in which all of them are sound, with the row
// number: each of mean 0 and length 1, those that never change of length 0.
struct Standardised {
  MatrixXd values;  // (rows x thermometers)
  VectorXd sd;      // of each, as it was
  VectorXd time;    // (rows)
  double time_sd = 0.0;
};

// What more rows would add is the time that they take.
constexpr Index kMostRows = 10000;
constexpr Index kMostValues = 10000000;
constexpr Index kFewestOfMany = 100;

// At most so many of these, as far apart as can be.
std::vector<Index> SpreadRows(std::vector<Index> rows, Index most) {
  const auto size = static_cast<Index>(rows.size());
  if (size <= most) return rows;
  std::vector<Index> spread;
  for (Index i = 0; i < most; ++i) {
    spread.push_back(rows[i * (size - 1) / (most - 1)]);
  }
  return spread;
}

double Standardise(Eigen::Ref<VectorXd> values) {
  values.array() -= values.mean();
  const double length = values.norm();
  if (length > 0.0) values /= length;
  return length / std::sqrt(static_cast<double>(values.size()));
}

Standardised StandardiseRows(const MeasuredColumns& measured,
                             const std::vector<Thermometer>& thermometers,
                             const std::vector<Index>& used,
                             const std::vector<Index>& rows) {
  const auto m = static_cast<double>(measured.target_values.size());
  const auto size = static_cast<Index>(used.size());
  Standardised found{.values = MatrixXd(std::ssize(rows), size),
                     .sd = VectorXd(size),
                     .time = VectorXd(std::ssize(rows))};
  for (Index k = 0; k < size; ++k) {
    const Index input = thermometers[used[k]].input;
    found.values.col(k) = measured.input_values.col(input)(rows);
    // Of what varies little about a large value the mean is exact enough then.
    found.values.col(k).array() -= found.values(0, k);
    found.sd[k] = Standardise(found.values.col(k));
  }
  for (Index i = 0; i < found.time.size(); ++i) {
    found.time[i] =
        2.0 * static_cast<double>(rows[i]) / std::max(m - 1.0, 1.0) - 1.0;
  }
  found.time_sd = Standardise(found.time);
  return found;
}

// The leading principal axes V of the thermometers, whose correlation is R.
struct Axes {
  MatrixXd v;          // (thermometers x q), orthonormal
  MatrixXd rv;         // R V
  VectorXd variances;  // of V'R V, which is diagonal
  VectorXd vr_time;    // V' times the correlations with time
};

// More than the components that are taken away, as those of the others are
// looked for in the space of these.
constexpr Index kAxes = 16;
// Of so many and fewer all axes are found at once.
constexpr Index kFewThermometers = 64;

// An orthonormal start that is the same everywhere.
MatrixXd FirstAxes(Index size, Index count) {
  MatrixXd start(size, count);
  for (Index i = 0; i < size; ++i) {
    for (Index k = 0; k < count; ++k) {
      start(i, k) = std::cos(static_cast<double>(i * count + k) * 1.7 +
                             static_cast<double>(k * k));
    }
  }
  return start;
}

MatrixXd Orthonormal(const MatrixXd& columns) {
  return Eigen::HouseholderQR<MatrixXd>(columns).householderQ() *
         MatrixXd::Identity(columns.rows(), columns.cols());
}

// Orthogonal iteration (Golub & Van Loan, section 8.2.4): each step takes rows
// times thermometers times axes, where all of R would take their square.
Axes LeadingAxes(const Standardised& of) {
  const MatrixXd& s = of.values;
  const Index count = std::min(kAxes, s.cols());
  MatrixXd v;
  if (s.cols() <= kFewThermometers) {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> all(s.transpose() * s);
    v = all.eigenvectors().rightCols(count);
  } else {
    constexpr int kSteps = 6;
    v = Orthonormal(FirstAxes(s.cols(), count));
    for (int step = 0; step < kSteps; ++step) {
      const MatrixXd scores = s * v;
      v = Orthonormal(s.transpose() * scores);
    }
  }
  const MatrixXd scores = s * v;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> within(scores.transpose() *
                                                       scores);
  Axes axes;
  axes.v = v * within.eigenvectors();
  axes.rv = s.transpose() * (scores * within.eigenvectors());
  axes.variances = within.eigenvalues();
  axes.vr_time = axes.v.transpose() * (s.transpose() * of.time);
  return axes;
}

// Of thermometer `j` by the principal components of the others, which are
// looked for in the space of the axes without `j` (Rayleigh-Ritz).
std::optional<Drift> DriftOf(const Standardised& of,
                             const Axes& axes,
                             Index j) {
  const Index count = axes.v.cols();
  const VectorXd v = axes.v.row(j);
  const VectorXd z = axes.rv.row(j);
  const double with_time = of.values.col(j).dot(of.time);
  // Without row j the axes have the products I - v v', which T makes I.
  const double length = v.norm();
  MatrixXd t = MatrixXd::Identity(count, count);
  if (length > 0.0) {
    const VectorXd u = v / length;
    const double left = 1.0 - length * length;
    constexpr double kNothing = 1e-10;
    t += ((left > kNothing ? 1.0 / std::sqrt(left) : 0.0) - 1.0) * u *
         u.transpose();
  }
  const MatrixXd rest = MatrixXd(axes.variances.asDiagonal()) -
                        v * z.transpose() - z * v.transpose() +
                        v * v.transpose();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> components(t * rest * t);
  const MatrixXd onto = components.eigenvectors().transpose() * t;
  const VectorXd a = onto * (z - v);
  const VectorXd b = onto * (axes.vr_time - with_time * v);
  double var_j = 1.0;
  double var_time = 1.0;
  double joint = with_time;
  const Index others = of.values.cols() - 1;
  for (Index k = 0; k < std::min({kMostComponents, others, count}); ++k) {
    const Index at = count - 1 - k;  // largest last
    const double variance = components.eigenvalues()[at];
    if (!(variance > 1e-9)) break;
    var_j -= a[at] * a[at] / variance;
    var_time -= b[at] * b[at] / variance;
    joint -= a[at] * b[at] / variance;
  }
  if (!(var_time > kLeastTimeLeft * kLeastTimeLeft)) return std::nullopt;
  const double slope = joint / var_time;
  return Drift{
      .change = 2.0 * slope * of.sd[j] / of.time_sd,  // time: from -1 to 1
      .scatter = of.sd[j] * std::sqrt(std::max(var_j - slope * joint, 1e-12))};
}

}  // namespace

std::vector<ColumnFault> FindDrift(const MeasuredColumns& measured,
                                   const std::vector<Thermometer>& thermometers,
                                   const std::vector<ColumnFault>& known) {
  std::vector<ColumnFault> faults;
  if (measured.num_sessions < kFewestSessions) return faults;
  std::vector<Index> used;  // places among the thermometers
  for (std::size_t k = 0; k < thermometers.size(); ++k) {
    if (IsTrusted(thermometers[k].input, known)) {
      used.push_back(static_cast<Index>(k));
    }
  }
  const std::vector<Index> sound = SoundRows(measured, thermometers);
  if (sound.size() < 3) return faults;
  // Few thermometers agree less: rooms of three days are in line by chance.
  const std::size_t fewest =
      measured.num_sessions > kFewestSessions ? 1 : kFewestOthers;
  const double times =
      measured.num_sessions > kFewSessions ? kDriftTimes : kDriftTimesOfFew;
  // The worst first: it no longer counts among the others then. Of very many
  // the first few make the case.
  constexpr std::size_t kMostOfMany = 8;
  const bool many = std::ssize(used) > kFewThermometers;
  while (used.size() > fewest && !(many && faults.size() == kMostOfMany)) {
    const Standardised of =
        StandardiseRows(measured,
                        thermometers,
                        used,
                        SpreadRows(sound,
                                   std::clamp(kMostValues / std::ssize(used),
                                              kFewestOfMany,
                                              kMostRows)));
    const Axes axes = LeadingAxes(of);
    Drift worst{.change = 0.0, .scatter = 1.0};
    Index worst_at = -1;
    for (std::size_t at = 0; at < used.size(); ++at) {
      const Index k = used[at];
      const std::optional<Drift> drift =
          DriftOf(of, axes, static_cast<Index>(at));
      const Thermometer& t = thermometers[k];
      if (!drift || std::abs(drift->change) < kLeastDrift * t.degree ||
          drift->scatter > kMostScatterNoise * t.noise ||
          drift->ratio() < times || drift->ratio() < worst.ratio()) {
        continue;
      }
      worst = *drift;
      worst_at = k;
    }
    if (worst_at < 0) break;
    faults.push_back(
        MakeFault(measured,
                  FaultKind::kDrifting,
                  thermometers[worst_at].input,
                  {},
                  worst.change,
                  {static_cast<double>(used.size() - 1), worst.scatter}));
    std::erase(used, worst_at);
  }
  return faults;
}

std::optional<ColumnFault> FindColdDrift(
    const MeasuredColumns& measured,
    const std::vector<Index>& session_starts,
    const std::vector<ColumnFault>& known) {
  const Unit degc = UnitOfSymbol("degC");
  std::vector<Index> used;
  for (Index k = 0; k < measured.input_values.cols(); ++k) {
    const Unit& unit = measured.inputs[k].unit;
    if (unit.quantity == degc.quantity && IsTrusted(k, known)) {
      used.push_back(k);
    }
  }
  const auto num_starts = static_cast<Index>(session_starts.size());
  const auto num_others = static_cast<Index>(used.size()) - 1;
  if (num_starts < kFewestStarts || num_others < 1) return std::nullopt;
  MatrixXd cold(num_starts, num_others + 1);  // degC
  for (Index k = 0; k <= num_others; ++k) {
    const Index input = used[k];
    const Unit& unit = measured.inputs[input].unit;
    for (Index i = 0; i < num_starts; ++i) {
      cold(i, k) = Converted(
          measured.input_values(session_starts[i], input), unit, degc);
    }
  }
  VectorXd time(num_starts);
  const auto first = static_cast<double>(session_starts.front());
  const auto last = static_cast<double>(session_starts.back());
  for (Index i = 0; i < num_starts; ++i) {
    const auto start = static_cast<double>(session_starts[i]);
    time[i] = (2.0 * start - first - last) / (last - first);
  }
  Drift worst{.change = 0.0, .scatter = 1.0};
  Index worst_at = -1;
  double own = 0.0;
  for (Index k = 0; k <= num_others; ++k) {
    const VectorXd others =
        (cold.rowwise().sum() - cold.col(k)) / static_cast<double>(num_others);
    const Drift drift = LineOf(cold.col(k) - others, time);
    if (!(std::abs(drift.change) >= kLeastColdDrift &&
          drift.ratio() >= kColdDriftTimes)) {
      continue;
    }
    // The one that drifts leaves the others most; of two, which leave each
    // other alike, it changes more.
    const double change = std::abs(
        num_others == 1 ? LineOf(cold.col(k), time).change : drift.change);
    if (change < own) continue;
    own = change;
    worst = drift;
    worst_at = used[k];
  }
  if (worst_at < 0) return std::nullopt;
  const double degree = DegreeIn(measured.inputs[worst_at].unit);
  return MakeFault(measured,
                   FaultKind::kDrifting,
                   worst_at,
                   {},
                   degree * worst.change,
                   {static_cast<double>(num_others), degree * worst.scatter});
}

}  // namespace errmap::data
