#include "models/learning/sensor_curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "fitting/fold_codes.h"
#include "fitting/interruption.h"
#include "fitting/least_squares/decompositions.h"
#include "fitting/parallel_for.h"
#include "models/error_model.h"
#include "models/history/view.h"
#include "models/inner_folds.h"
#include "models/scaling.h"
#include "stats/indices.h"
#include "stats/random.h"
#include "stats/summary.h"

namespace errmap::models {
namespace {

// Shares of the mean diagonal of the normal equations.
constexpr std::array<double, 5> kPenalties = {1e-7, 1e-5, 1e-3, 1e-2, 1e-1};

// Rows of the design: 1, x, x^2 of the position, then what a view makes of each
// sensor and, with a position, each of these times it.
struct Design {
  View view = View::kRaw;
  MatrixXd features;  // (m x f)
  VectorXd targets;   // (m)
  MatrixXd sensors;   // (m x p) each as the view has it, unfiltered
  std::vector<std::string> names;
  Index base = 1;                           // columns that are always in
  std::vector<std::vector<Index>> columns;  // of each sensor
};

// Columns less their mean, in spreads of their unit.
MatrixXd Standardised(const data::Dataset& rows,
                      const std::vector<Index>& columns) {
  MatrixXd scaled = rows.input_values()(Eigen::all, columns);
  std::vector<std::string> units;
  for (const Index column : columns) {
    units.push_back(
        rows.inputs()[static_cast<std::size_t>(column)].unit.symbol);
  }
  const VectorXd spreads = SpreadsOfUnits(scaled, units);
  scaled.rowwise() -= scaled.colwise().mean().eval();
  return scaled.array().rowwise() / spreads.transpose().array();
}

Design MakeDesign(const ViewedRows& viewed) {
  const data::Dataset& rows = *viewed.rows;
  Design design;
  design.view = viewed.view;
  std::vector<Index> made;  // columns of the form, positions apart
  std::vector<Index> sensor_of;
  std::vector<Index> unfiltered;
  for (Index i = 0; i < rows.num_inputs(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (viewed.is_position[at]) continue;
    const std::string& name = rows.inputs()[at].name;
    const std::string source =
        viewed.history == nullptr ? name : viewed.history->RootOf(name);
    const auto known = std::ranges::find(design.names, source);
    sensor_of.push_back(known - design.names.begin());
    made.push_back(i);
    if (known != design.names.end()) continue;
    design.names.push_back(source);
    unfiltered.push_back(i);
  }
  if (design.names.size() < 2) {
    throw std::invalid_argument("there are fewer than two sensors");
  }
  design.sensors = rows.input_values()(Eigen::all, unfiltered);
  design.targets = rows.target_values();
  const MatrixXd scaled = Standardised(rows, made);
  const Index position = FindPosition(rows, "");
  design.base = position < 0 ? 1 : 3;
  const Index per_column = position < 0 ? 1 : 2;
  design.features.resize(rows.num_rows(),
                         design.base + per_column * scaled.cols());
  design.features.col(0).setOnes();
  VectorXd x = VectorXd::Zero(rows.num_rows());
  if (position >= 0) {
    x = rows.input_values().col(position);
    x.array() -= x.mean();
    x /= std::max(x.cwiseAbs().maxCoeff(), 1e-12);
    design.features.col(1) = x;
    design.features.col(2) = x.cwiseAbs2();
  }
  design.columns.resize(design.names.size());
  for (Index i = 0; i < scaled.cols(); ++i) {
    const Index at = design.base + per_column * i;
    auto& columns = design.columns[static_cast<std::size_t>(
        sensor_of[static_cast<std::size_t>(i)])];
    design.features.col(at) = scaled.col(i);
    columns.push_back(at);
    if (position < 0) continue;
    design.features.col(at + 1) = scaled.col(i).cwiseProduct(x);
    columns.push_back(at + 1);
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

// What is left of them of some columns.
Moments Of(const std::vector<Index>& columns, const Moments& moments) {
  return {.gram = moments.gram(columns, columns),
          .products = moments.products(columns),
          .squares = moments.squares,
          .rows = moments.rows};
}

std::vector<Index> ColumnsOf(const Design& design,
                             const std::vector<Index>& sensors) {
  std::vector<Index> columns;
  for (Index i = 0; i < design.base; ++i) columns.push_back(i);
  for (const Index sensor : sensors) {
    const auto& of_sensor = design.columns[static_cast<std::size_t>(sensor)];
    columns.insert(columns.end(), of_sensor.begin(), of_sensor.end());
  }
  return columns;
}

// The first `base` columns bear no penalty.
VectorXd Ridge(const Moments& moments, Index base, double penalty) {
  MatrixXd gram = moments.gram;
  const double scale =
      penalty * gram.trace() / static_cast<double>(gram.rows());
  gram.diagonal().array() += 1e-10 * scale;
  gram.diagonal().tail(gram.rows() - base).array() += scale;
  return gram.ldlt().solve(moments.products);
}

double SquaresLeft(const Moments& moments, const VectorXd& weights) {
  return std::max(0.0,
                  moments.squares - 2.0 * weights.dot(moments.products) +
                      weights.dot(moments.gram * weights));
}

// Training rows with their inner folds.
struct Training {
  struct Fold {
    Moments held;
    Moments rest;
  };
  Moments all;
  std::vector<Fold> folds;
};

struct Judged {
  double squares = std::numeric_limits<double>::infinity();  // held out
  double penalty = kPenalties.front();
};

Judged JudgeSensors(const Design& design,
                    const Training& training,
                    const std::vector<Index>& sensors) {
  fitting::ThrowIfInterrupted();
  const std::vector<Index> columns = ColumnsOf(design, sensors);
  std::array<double, kPenalties.size()> squares = {};
  for (const Training::Fold& fold : training.folds) {
    const Moments held = Of(columns, fold.held);
    const Moments rest = Of(columns, fold.rest);
    for (std::size_t i = 0; i < kPenalties.size(); ++i) {
      squares[i] += SquaresLeft(held, Ridge(rest, design.base, kPenalties[i]));
    }
  }
  const auto best = std::ranges::min_element(squares);
  return {*best, kPenalties[static_cast<std::size_t>(best - squares.begin())]};
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
    Moments held = MomentsOf(design, of_fold);
    Moments rest = training.all - held;
    training.folds.push_back({std::move(held), std::move(rest)});
  }
  return training;
}

std::vector<Index> AllSensors(const Design& design) {
  return stats::AllIndices(std::ssize(design.names));
}

// Some sensors, and what they leave.
struct Choice {
  std::vector<Index> sensors;
  double squares = std::numeric_limits<double>::infinity();  // held out
};

// The best choice found for each number of sensors. A search starts from the
// best of one less and one more, from random sensors, and for two from all
// pairs. Sensors are then replaced one at a time while that helps (sequential
// replacement; Miller 2002, Section 3.7). From a single start, four of 36
// sensors ended with half as much error again.
class ChoiceSearch {
 public:
  ChoiceSearch(const Design& design, const Training& training, Index most)
      : design_(design),
        training_(training),
        best_(static_cast<std::size_t>(most + 1)) {}

  // From 0 sensors to `most`.
  std::vector<std::vector<Index>> Run() {
    for (std::size_t k = 1; k < best_.size(); ++k) {
      Offer(Grown(best_[k - 1].sensors));
      if (k == 2) OfferPairs();
      for (int i = 0; k > 2 && i < kRandomBeginnings; ++i) Offer(Drawn(k));
    }
    for (std::size_t k = best_.size() - 1; k > 1; --k) {
      Offer(Shrunk(best_[k].sensors));
    }
    std::vector<std::vector<Index>> by_number;
    for (Choice& choice : best_) by_number.push_back(std::move(choice.sensors));
    return by_number;
  }

 private:
  static constexpr int kRandomBeginnings = 4;
  static constexpr int kMostPasses = 3;
  // What rounding gains is not a gain.
  static constexpr double kGain = 1e-9;

  // Beginnings end in the same sets: each is judged once.
  double Squares(std::vector<Index> sensors) {
    std::ranges::sort(sensors);
    const auto [known, is_new] = squares_.try_emplace(sensors, 0.0);
    if (is_new) {
      known->second = JudgeSensors(design_, training_, sensors).squares;
    }
    return known->second;
  }

  // The sensor at `place` becomes the one that does best there.
  void ImprovePlace(std::size_t place, Choice* choice) {
    std::vector<Index> trial = choice->sensors;
    for (Index other = 0; other < std::ssize(design_.names); ++other) {
      if (std::ranges::find(choice->sensors, other) != choice->sensors.end()) {
        continue;
      }
      trial[place] = other;
      const double squares = Squares(trial);
      if (squares >= (1.0 - kGain) * choice->squares) continue;
      *choice = {trial, squares};
    }
  }

  Choice Grown(std::vector<Index> sensors) {
    sensors.push_back(-1);
    Choice grown{.sensors = std::move(sensors)};
    ImprovePlace(grown.sensors.size() - 1, &grown);
    return grown;
  }

  // Without the sensor that is missed least.
  Choice Shrunk(const std::vector<Index>& sensors) {
    Choice shrunk;
    for (std::size_t place = 0; place < sensors.size(); ++place) {
      std::vector<Index> rest = sensors;
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(place));
      const double squares = Squares(rest);
      if (squares < shrunk.squares) shrunk = {std::move(rest), squares};
    }
    return shrunk;
  }

  Choice Drawn(std::size_t number) {
    std::vector<Index> sensors = AllSensors(design_);
    random_.Shuffle(sensors);
    sensors.resize(number);
    const double squares = Squares(sensors);
    return {std::move(sensors), squares};
  }

  // Two sensors may do together what neither begins.
  void OfferPairs() {
    Choice& best = best_[2];
    const auto p = std::ssize(design_.names);
    for (Index one = 0; one < p; ++one) {
      for (Index other = one + 1; other < p; ++other) {
        const double squares = Squares({one, other});
        if (squares < best.squares) best = {{one, other}, squares};
      }
    }
  }

  void Offer(Choice choice) {
    for (int pass = 0; pass < kMostPasses; ++pass) {
      const double before = choice.squares;
      for (std::size_t place = 0; place < choice.sensors.size(); ++place) {
        ImprovePlace(place, &choice);
      }
      if (!(choice.squares < before)) break;
    }
    Choice& best = best_[choice.sensors.size()];
    if (choice.squares < best.squares) best = std::move(choice);
  }

  const Design& design_;
  const Training& training_;
  std::vector<Choice> best_;  // by number of sensors
  std::map<std::vector<Index>, double> squares_;
  stats::Random random_{1};
};

double TestSquares(const Design& design,
                   const Training& training,
                   const Moments& test,
                   const std::vector<Index>& sensors) {
  const std::vector<Index> columns = ColumnsOf(design, sensors);
  const double penalty = JudgeSensors(design, training, sensors).penalty;
  return SquaresLeft(Of(columns, test),
                     Ridge(Of(columns, training.all), design.base, penalty));
}

// What would stand in the place of a chosen sensor.
void LookForSubstitutes(const Design& design,
                        const Training& training,
                        const std::vector<Index>& chosen,
                        std::size_t place,
                        SensorCurve::Chosen* found) {
  constexpr double kAlike = 0.9;
  const double squares = JudgeSensors(design, training, chosen).squares;
  double least = std::numeric_limits<double>::infinity();
  std::vector<std::pair<double, std::string>> alike;
  for (Index other = 0; other < std::ssize(design.names); ++other) {
    if (std::ranges::find(chosen, other) != chosen.end()) continue;
    std::vector<Index> swapped = chosen;
    swapped[place] = other;
    const double with_other = JudgeSensors(design, training, swapped).squares;
    least = std::min(least, with_other);
    const double correlation = std::abs(stats::Correlation(
        design.sensors.col(chosen[place]), design.sensors.col(other)));
    if (correlation >= kAlike && with_other <= SensorCurve::kTolerance *
                                                   SensorCurve::kTolerance *
                                                   squares) {
      alike.emplace_back(-correlation,
                         design.names[static_cast<std::size_t>(other)]);
    }
  }
  if (std::isfinite(least) && squares > 0.0) {
    found->replaced_cost = std::sqrt(least / squares) - 1.0;
  }
  std::ranges::sort(alike);
  for (auto& [correlation, name] : alike) {
    found->substitutes.push_back(std::move(name));
  }
}

// The view with the lowest error of all sensors on units held out.
Design BestDesign(const data::Dataset& dataset,
                  const fitting::FoldCodes& folds) {
  ViewOptions options;
  options.sine_and_cosine = false;
  // A filter as fast as a sweep besides: it averages the noise of few sensors.
  std::vector<double> time_constants = MakeTimeConstants(dataset);
  if (!time_constants.empty()) {
    time_constants.insert(time_constants.begin(), time_constants.front() / 10);
    options.time_constants = time_constants;
  }
  std::vector<ViewedRows> views = MakeViews(dataset, options, 0.0);
  options.time_constants.emplace();  // the zero alone
  for (ViewedRows& viewed : MakeViews(dataset, options, 0.0)) {
    if (viewed.view == View::kZero) views.push_back(std::move(viewed));
  }
  const std::vector<Index> rows = stats::AllIndices(dataset.num_rows());
  Design best;
  double least = std::numeric_limits<double>::infinity();
  for (const ViewedRows& viewed : views) {
    Design design = MakeDesign(viewed);
    const double squares =
        JudgeSensors(
            design, TrainingOf(design, rows, folds), AllSensors(design))
            .squares;
    if (!(squares < least)) continue;
    least = squares;
    best = std::move(design);
  }
  return best;
}

}  // namespace

SensorCurve LearnSensors(const data::Dataset& dataset,
                         const SensorSearch& search) {
  const fitting::InterruptionScope interruptible(search.stop);
  const InnerFolds outer = MakeInnerFolds(dataset, {});
  const Design design = BestDesign(dataset, outer.folds);
  SensorCurve curve;
  curve.view = ToString(design.view);
  curve.held_out = outer.text;
  curve.all.sensors = std::ssize(design.names);
  const Index most = std::min(search.most_sensors, curve.all.sensors);
  const std::vector<Index> all_rows = stats::AllIndices(dataset.num_rows());
  const Training of_all = TrainingOf(design, all_rows, outer.folds);

  // A search in each fold, and the last in all rows.
  const Index folds = outer.folds.count();
  std::vector<std::vector<std::vector<Index>>> choices(
      static_cast<std::size_t>(folds + 1));
  MatrixXd squares(most + 2, folds);  // of 0, 1, ... sensors, and of all
  std::atomic<int> done = 0;
  const auto choose_in = [&](Index fold) {
    auto& chosen = choices[static_cast<std::size_t>(fold)];
    if (fold == folds) {
      chosen = ChoiceSearch(design, of_all, most).Run();
    } else {
      const auto [train, test] = outer.folds.Split(fold);
      const Training training = TrainingOf(
          design, train, MakeInnerFolds(dataset.SelectRows(train), {}).folds);
      const Moments held = MomentsOf(design, test);
      chosen = ChoiceSearch(design, training, most).Run();
      for (Index k = 0; k <= most; ++k) {
        squares(k, fold) = TestSquares(
            design, training, held, chosen[static_cast<std::size_t>(k)]);
      }
      squares(most + 1, fold) =
          TestSquares(design, training, held, AllSensors(design));
    }
    if (search.progress) search.progress(++done, static_cast<int>(folds) + 1);
  };
  fitting::ParallelFor(search.jobs, folds + 1, choose_in);

  const VectorXd rmse =
      (squares.rowwise().sum() / static_cast<double>(dataset.num_rows()))
          .cwiseSqrt();
  curve.all.rmse = rmse[most + 1];
  for (Index k = 0; k <= most; ++k) {
    curve.points.push_back({k, rmse[k]});
    if (!curve.enough && rmse[k] <= SensorCurve::kTolerance * curve.all.rmse) {
      curve.enough = k;
    }
  }
  const auto number = static_cast<std::size_t>(curve.enough.value_or(most));
  const std::vector<Index> chosen = choices.back()[number];
  choices.pop_back();
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const auto among = std::ranges::count_if(choices, [&](const auto& fold) {
      return std::ranges::find(fold[number], chosen[i]) != fold[number].end();
    });
    SensorCurve::Chosen& one = curve.chosen.emplace_back();
    one.sensor = design.names[static_cast<std::size_t>(chosen[i])];
    one.stability =
        static_cast<double>(among) / static_cast<double>(choices.size());
    LookForSubstitutes(design, of_all, chosen, i, &one);
  }
  return curve;
}

}  // namespace errmap::models
