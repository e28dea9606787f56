#include "models/promise/sensor_curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include <Eigen/Cholesky>

#include "fitting/fold_codes.h"
#include "models/error_model.h"
#include "models/history/view.h"
#include "models/inner_folds.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Shares of the mean diagonal of the normal equations.
constexpr std::array<double, 5> kPenalties = {1e-7, 1e-5, 1e-3, 1e-2, 1e-1};

// Rows of the design: 1, x, x^2 of the position, then each sensor and, with a
// position, each sensor times it.
struct Design {
  MatrixXd features;  // (m x f)
  VectorXd targets;   // (m)
  MatrixXd sensors;   // (m x p)
  std::vector<std::string> names;
  Index base = 1;        // columns that are always in
  Index per_sensor = 1;  // columns of each sensor
};

MatrixXd SensorsOf(const data::Dataset& dataset,
                   const std::vector<Index>& columns,
                   bool zeroed) {
  MatrixXd sensors = dataset.input_values()(Eigen::all, columns);
  if (!zeroed) return sensors;
  const data::SessionLog& log = *dataset.log();
  const std::vector<Index> sessions = dataset.session_codes();
  for (Index row = 0; row < sensors.rows(); ++row) {
    const Index first = log.first_rows[static_cast<std::size_t>(
        sessions[static_cast<std::size_t>(row)])];
    for (Index i = 0; i < sensors.cols(); ++i) {
      sensors(row, i) -=
          log.input_values(first, columns[static_cast<std::size_t>(i)]);
    }
  }
  return sensors;
}

Design MakeDesign(const data::Dataset& dataset, bool zeroed) {
  Design design;
  std::vector<Index> columns;
  for (Index i = 0; i < dataset.num_inputs(); ++i) {
    const data::ColumnInfo& column =
        dataset.inputs()[static_cast<std::size_t>(i)];
    if (IsPosition(column)) continue;
    columns.push_back(i);
    design.names.push_back(column.name);
  }
  if (columns.size() < 2) {
    throw std::invalid_argument("there are fewer than two sensors");
  }
  design.sensors = SensorsOf(dataset, columns, zeroed);
  design.targets = dataset.target_values();
  MatrixXd scaled = design.sensors;
  const Eigen::RowVectorXd mean = scaled.colwise().mean();
  const double scale = std::sqrt((scaled.rowwise() - mean).squaredNorm() /
                                 static_cast<double>(scaled.size()));
  scaled = (scaled.rowwise() - mean) / std::max(scale, 1e-12);
  const Index rows = scaled.rows();
  const Index p = scaled.cols();
  const Index position = FindPosition(dataset, "");
  design.base = position < 0 ? 1 : 3;
  design.per_sensor = position < 0 ? 1 : 2;
  design.features.resize(rows, design.base + design.per_sensor * p);
  design.features.col(0).setOnes();
  VectorXd x = VectorXd::Zero(rows);
  if (position >= 0) {
    x = dataset.input_values().col(position);
    x.array() -= x.mean();
    x /= std::max(x.cwiseAbs().maxCoeff(), 1e-12);
    design.features.col(1) = x;
    design.features.col(2) = x.cwiseAbs2();
  }
  for (Index i = 0; i < p; ++i) {
    const Index at = design.base + design.per_sensor * i;
    design.features.col(at) = scaled.col(i);
    if (position >= 0) {
      design.features.col(at + 1) = scaled.col(i).cwiseProduct(x);
    }
  }
  return design;
}

// Sums of squares and products: all that ridge regression needs of rows.
struct Moments {
  MatrixXd gram;      // (f x f)
  VectorXd products;  // (f) with the target
  double squares = 0.0;
  double rows = 0.0;
};

Moments MomentsOf(const Design& design, const std::vector<Index>& rows) {
  const MatrixXd features = design.features(rows, Eigen::all);
  const VectorXd targets = design.targets(rows);
  return {.gram = features.transpose() * features,
          .products = features.transpose() * targets,
          .squares = targets.squaredNorm(),
          .rows = static_cast<double>(rows.size())};
}

Moments operator-(const Moments& all, const Moments& part) {
  return {.gram = all.gram - part.gram,
          .products = all.products - part.products,
          .squares = all.squares - part.squares,
          .rows = all.rows - part.rows};
}

std::vector<Index> ColumnsOf(const Design& design,
                             const std::vector<Index>& sensors) {
  std::vector<Index> columns;
  for (Index i = 0; i < design.base; ++i) columns.push_back(i);
  for (const Index sensor : sensors) {
    for (Index i = 0; i < design.per_sensor; ++i) {
      columns.push_back(design.base + design.per_sensor * sensor + i);
    }
  }
  return columns;
}

// Of these columns; the base bears no penalty.
VectorXd Ridge(const Design& design,
               const Moments& moments,
               const std::vector<Index>& columns,
               double penalty) {
  MatrixXd gram = moments.gram(columns, columns);
  const double scale =
      penalty * gram.trace() / static_cast<double>(gram.rows());
  gram.diagonal().array() += 1e-10 * scale;
  gram.diagonal().tail(gram.rows() - design.base).array() += scale;
  return gram.ldlt().solve(moments.products(columns));
}

double SquaresLeft(const Moments& moments,
                   const std::vector<Index>& columns,
                   const VectorXd& weights) {
  return std::max(0.0,
                  moments.squares -
                      2.0 * weights.dot(moments.products(columns)) +
                      weights.dot(moments.gram(columns, columns) * weights));
}

// Training rows with their inner folds.
struct Training {
  Moments all;
  std::vector<Moments> folds;  // of each fold's own rows
};

struct Judged {
  double squares = std::numeric_limits<double>::infinity();  // held out
  double penalty = kPenalties.front();
};

Judged JudgeSensors(const Design& design,
                    const Training& training,
                    const std::vector<Index>& sensors) {
  const std::vector<Index> columns = ColumnsOf(design, sensors);
  Judged best;
  for (const double penalty : kPenalties) {
    double squares = 0.0;
    for (const Moments& fold : training.folds) {
      squares += SquaresLeft(
          fold, columns, Ridge(design, training.all - fold, columns, penalty));
    }
    if (squares < best.squares) best = {squares, penalty};
  }
  return best;
}

Training TrainingOf(const Design& design,
                    const std::vector<Index>& rows,
                    const fitting::FoldCodes& folds) {
  Training training{.all = MomentsOf(design, rows), .folds = {}};
  for (Index fold = 0; fold < folds.count(); ++fold) {
    std::vector<Index> of_fold;
    for (const Index i : folds.Split(fold).test) {
      of_fold.push_back(rows[static_cast<std::size_t>(i)]);
    }
    training.folds.push_back(MomentsOf(design, of_fold));
  }
  return training;
}

// The sensor at `place` of `chosen` becomes the one that does best there.
// Returns its squares; `chosen` stays where none does better than `least`.
double ImprovePlace(const Design& design,
                    const Training& training,
                    std::size_t place,
                    double least,
                    std::vector<Index>* chosen) {
  std::vector<Index> trial = *chosen;
  for (Index other = 0; other < static_cast<Index>(design.names.size());
       ++other) {
    if (std::ranges::find(*chosen, other) != chosen->end()) continue;
    trial[place] = other;
    const double squares = JudgeSensors(design, training, trial).squares;
    // What rounding gains is no gain.
    constexpr double kGain = 1e-9;
    if (squares >= (1.0 - kGain) * least) continue;
    least = squares;
    *chosen = trial;
  }
  return least;
}

// The best of all pairs: two sensors may do together what neither begins.
std::vector<Index> BestPair(const Design& design, const Training& training) {
  const auto p = static_cast<Index>(design.names.size());
  std::vector<Index> best;
  double least = std::numeric_limits<double>::infinity();
  for (Index one = 0; one < p; ++one) {
    for (Index other = one + 1; other < p; ++other) {
      const double squares =
          JudgeSensors(design, training, {one, other}).squares;
      if (squares >= least) continue;
      least = squares;
      best = {one, other};
    }
  }
  return best;
}

// Sensors by their number, 0 to `most`: each time the best is added, then each
// replaced while that helps (sequential replacement; Miller 2002, Section 3.7).
std::vector<std::vector<Index>> ChooseByNumber(const Design& design,
                                               const Training& training,
                                               Index most) {
  constexpr int kMostPasses = 3;
  std::vector<std::vector<Index>> by_number{{}};
  std::vector<Index> chosen;
  while (static_cast<Index>(chosen.size()) < most) {
    chosen.push_back(-1);
    double least = ImprovePlace(design,
                                training,
                                chosen.size() - 1,
                                std::numeric_limits<double>::infinity(),
                                &chosen);
    for (int pass = 0; pass < kMostPasses; ++pass) {
      const double before = least;
      for (std::size_t place = 0; place < chosen.size(); ++place) {
        least = ImprovePlace(design, training, place, least, &chosen);
      }
      if (!(least < before)) break;
    }
    if (chosen.size() == 2) chosen = BestPair(design, training);
    by_number.push_back(chosen);
  }
  return by_number;
}

std::vector<Index> AllSensors(const Design& design) {
  std::vector<Index> all(design.names.size());
  std::iota(all.begin(), all.end(), Index{0});
  return all;
}

double TestSquares(const Design& design,
                   const Training& training,
                   const Moments& test,
                   const std::vector<Index>& sensors) {
  const std::vector<Index> columns = ColumnsOf(design, sensors);
  const double penalty = JudgeSensors(design, training, sensors).penalty;
  return SquaresLeft(
      test, columns, Ridge(design, training.all, columns, penalty));
}

double Correlation(const VectorXd& a, const VectorXd& b) {
  const VectorXd u = a.array() - a.mean();
  const VectorXd v = b.array() - b.mean();
  return u.dot(v) / std::max(u.norm() * v.norm(), 1e-300);
}

std::vector<std::string> SubstitutesFor(const Design& design,
                                        const Training& training,
                                        const std::vector<Index>& chosen,
                                        std::size_t place) {
  constexpr double kAlike = 0.9;
  const double limit = SensorCurve::kTolerance * SensorCurve::kTolerance *
                       JudgeSensors(design, training, chosen).squares;
  std::vector<std::pair<double, std::string>> found;
  for (Index other = 0; other < static_cast<Index>(design.names.size());
       ++other) {
    if (std::ranges::find(chosen, other) != chosen.end()) continue;
    const double alike = std::abs(Correlation(design.sensors.col(chosen[place]),
                                              design.sensors.col(other)));
    if (!(alike >= kAlike)) continue;
    std::vector<Index> swapped = chosen;
    swapped[place] = other;
    if (JudgeSensors(design, training, swapped).squares > limit) continue;
    found.emplace_back(-alike, design.names[static_cast<std::size_t>(other)]);
  }
  std::ranges::sort(found);
  std::vector<std::string> names;
  for (auto& [alike, name] : found) names.push_back(std::move(name));
  return names;
}

// The view with the lower inner error of all sensors.
Design BetterDesign(const data::Dataset& dataset,
                    const fitting::FoldCodes& folds,
                    bool* zeroed) {
  Design raw = MakeDesign(dataset, false);
  *zeroed = false;
  if (!dataset.has_sessions()) return raw;
  Design less_first = MakeDesign(dataset, true);
  std::vector<Index> rows(static_cast<std::size_t>(dataset.num_rows()));
  std::iota(rows.begin(), rows.end(), Index{0});
  const auto squares = [&](const Design& design) {
    return JudgeSensors(
               design, TrainingOf(design, rows, folds), AllSensors(design))
        .squares;
  };
  *zeroed = squares(less_first) < squares(raw);
  return *zeroed ? less_first : raw;
}

}  // namespace

SensorCurve LearnSensors(const data::Dataset& dataset, Index most_sensors) {
  const InnerFolds outer = MakeInnerFolds(dataset, {});
  SensorCurve curve;
  const Design design = BetterDesign(dataset, outer.folds, &curve.zeroed);
  curve.unit = outer.text;
  curve.all_sensors = static_cast<Index>(design.names.size());
  const Index most = std::min(most_sensors, curve.all_sensors);
  VectorXd squares = VectorXd::Zero(most + 1);
  double all_squares = 0.0;
  double rows = 0.0;
  std::vector<std::vector<std::vector<Index>>> choices;
  for (Index fold = 0; fold < outer.folds.count(); ++fold) {
    const auto [train, test] = outer.folds.Split(fold);
    const Training training = TrainingOf(
        design, train, MakeInnerFolds(dataset.SelectRows(train), {}).folds);
    const Moments held = MomentsOf(design, test);
    choices.push_back(ChooseByNumber(design, training, most));
    for (Index k = 0; k <= most; ++k) {
      squares[k] += TestSquares(
          design, training, held, choices.back()[static_cast<std::size_t>(k)]);
    }
    all_squares += TestSquares(design, training, held, AllSensors(design));
    rows += held.rows;
  }
  for (Index k = 0; k <= most; ++k) {
    curve.points.push_back({k, std::sqrt(squares[k] / rows)});
  }
  curve.all_rmse = std::sqrt(all_squares / rows);
  for (const SensorCurve::Point& point : curve.points) {
    if (curve.enough < 0 &&
        point.rmse <= SensorCurve::kTolerance * curve.all_rmse) {
      curve.enough = point.sensors;
    }
  }
  const auto number =
      static_cast<std::size_t>(curve.enough >= 0 ? curve.enough : most);
  std::vector<Index> all_rows(static_cast<std::size_t>(dataset.num_rows()));
  std::iota(all_rows.begin(), all_rows.end(), Index{0});
  const Training training = TrainingOf(design, all_rows, outer.folds);
  const std::vector<Index> chosen =
      ChooseByNumber(design, training, static_cast<Index>(number)).back();
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const auto among = std::ranges::count_if(choices, [&](const auto& fold) {
      return std::ranges::find(fold[number], chosen[i]) != fold[number].end();
    });
    curve.chosen.push_back(
        {.sensor = design.names[static_cast<std::size_t>(chosen[i])],
         .stability =
             static_cast<double>(among) / static_cast<double>(choices.size()),
         .substitutes = SubstitutesFor(design, training, chosen, i)});
  }
  return curve;
}

}  // namespace errmap::models
