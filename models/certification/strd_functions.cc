#include "models/certification/strd_functions.h"

#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

namespace errmap::models {
namespace {

using fitting::ExtendedMatrix;
using fitting::ExtendedVector;
using stats::DoubleDouble;

// The right number of bits for every scalar.
template <typename X>
X Pi() {
  constexpr DoubleDouble kPi{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};
  return static_cast<X>(kPi);
}

template <typename T>
T Square(const T& x) {
  return x * x;
}

using std::atan;
using std::cos;
using std::exp;
using std::pow;
using std::sin;

// A model with its number of parameters, some of which are linear.
template <typename Model, int kNumber, int... kIndices>
struct Formula {
  static constexpr int kParameters = kNumber;
  static constexpr std::array<int, sizeof...(kIndices)> kLinear = {kIndices...};

  template <typename T, typename X>
  static T Predict(const T* b, const X* x) {
    return Model()(b, x);
  }
};

using Function = std::unique_ptr<fitting::RegressionFunction>;
using FunctionMaker = Function (*)(ExtendedMatrix, ExtendedVector);

template <int kParameters, int... kLinear, typename Model>
FunctionMaker Of(Model /*by its type*/) {
  return [](ExtendedMatrix predictors, ExtendedVector target) -> Function {
    return std::make_unique<
        fitting::FormulaRegression<Formula<Model, kParameters, kLinear...>>>(
        std::move(predictors), std::move(target));
  };
}

// NIST's models; b[0] is b1. Written so that X (data) and T (parameters, with
// derivatives) mix: constants become T where they meet one.
const std::map<std::string, FunctionMaker>& Makers() {
  static const FunctionMaker rise =
      Of<2, 0>([]<typename T, typename X>(const T* b, const X* x) {
        return b[0] * (T(X(1.0)) - exp(-b[1] * T(x[0])));
      });
  static const FunctionMaker chwirut =
      Of<3>([]<typename T, typename X>(const T* b, const X* x) {
        return exp(-b[0] * T(x[0])) / (b[1] + b[2] * T(x[0]));
      });
  static const FunctionMaker gauss =
      Of<8, 0, 2, 5>([]<typename T, typename X>(const T* b, const X* x) {
        return b[0] * exp(-b[1] * T(x[0])) +
               b[2] * exp(-Square<T>((T(x[0]) - b[3]) / b[4])) +
               b[5] * exp(-Square<T>((T(x[0]) - b[6]) / b[7]));
      });
  static const FunctionMaker cubic_over_cubic =
      Of<7, 0, 1, 2, 3>([]<typename T, typename X>(const T* b, const X* x) {
        const T t(x[0]);
        return (b[0] + t * (b[1] + t * (b[2] + t * b[3]))) /
               (T(X(1.0)) + t * (b[4] + t * (b[5] + t * b[6])));
      });
  static const FunctionMaker lanczos =
      Of<6, 0, 2, 4>([]<typename T, typename X>(const T* b, const X* x) {
        const T t(x[0]);
        return b[0] * exp(-b[1] * t) + b[2] * exp(-b[3] * t) +
               b[4] * exp(-b[5] * t);
      });
  static const std::map<std::string, FunctionMaker> kMakers{
      {"Bennett5", Of<3, 0>([]<typename T, typename X>(const T* b, const X* x) {
         return b[0] * pow(b[1] + T(x[0]), T(X(-1.0)) / b[2]);
       })},
      {"BoxBOD", rise},
      {"Chwirut1", chwirut},
      {"Chwirut2", chwirut},
      {"DanWood", Of<2, 0>([]<typename T, typename X>(const T* b, const X* x) {
         return b[0] * pow(T(x[0]), b[1]);
       })},
      {"Eckerle4", Of<3, 0>([]<typename T, typename X>(const T* b, const X* x) {
         return b[0] / b[1] *
                exp(T(X(-0.5)) * Square<T>((T(x[0]) - b[2]) / b[1]));
       })},
      {"ENSO",
       Of<9, 0, 1, 2, 4, 5, 7, 8>(
           []<typename T, typename X>(const T* b, const X* x) {
             const X turn = X(2.0) * Pi<X>() * x[0];
             const T year = T(turn / X(12.0));
             const T second = T(turn) / b[3];
             const T third = T(turn) / b[6];
             return b[0] + b[1] * cos(year) + b[2] * sin(year) +
                    b[4] * cos(second) + b[5] * sin(second) +
                    b[7] * cos(third) + b[8] * sin(third);
           })},
      {"Gauss1", gauss},
      {"Gauss2", gauss},
      {"Gauss3", gauss},
      {"Hahn1", cubic_over_cubic},
      {"Kirby2",
       Of<5, 0, 1, 2>([]<typename T, typename X>(const T* b, const X* x) {
         const T t(x[0]);
         return (b[0] + t * (b[1] + t * b[2])) /
                (T(X(1.0)) + t * (b[3] + t * b[4]));
       })},
      {"Lanczos1", lanczos},
      {"Lanczos2", lanczos},
      {"Lanczos3", lanczos},
      {"MGH09", Of<4, 0>([]<typename T, typename X>(const T* b, const X* x) {
         const T t(x[0]);
         return b[0] * (t * (t + b[1])) / (t * (t + b[2]) + b[3]);
       })},
      {"MGH10", Of<3, 0>([]<typename T, typename X>(const T* b, const X* x) {
         return b[0] * exp(b[1] / (T(x[0]) + b[2]));
       })},
      {"MGH17",
       Of<5, 0, 1, 2>([]<typename T, typename X>(const T* b, const X* x) {
         const T t(x[0]);
         return b[0] + b[1] * exp(-t * b[3]) + b[2] * exp(-t * b[4]);
       })},
      {"Misra1a", rise},
      {"Misra1b", Of<2, 0>([]<typename T, typename X>(const T* b, const X* x) {
         const T one(X(1.0));
         const T base = one + b[1] * T(x[0] / X(2.0));
         return b[0] * (one - one / (base * base));
       })},
      {"Misra1c", Of<2, 0>([]<typename T, typename X>(const T* b, const X* x) {
         const T one(X(1.0));
         return b[0] *
                (one - pow(one + T(X(2.0)) * b[1] * T(x[0]), T(X(-0.5))));
       })},
      {"Misra1d", Of<2, 0>([]<typename T, typename X>(const T* b, const X* x) {
         const T product = b[1] * T(x[0]);
         return b[0] * product / (T(X(1.0)) + product);
       })},
      {"Nelson",
       Of<3, 0, 1>([]<typename T, typename X>(const T* b, const X* x) {
         return b[0] - b[1] * T(x[0]) * exp(-b[2] * T(x[1]));
       })},
      {"Rat42", Of<3, 0>([]<typename T, typename X>(const T* b, const X* x) {
         return b[0] / (T(X(1.0)) + exp(b[1] - b[2] * T(x[0])));
       })},
      {"Rat43", Of<4, 0>([]<typename T, typename X>(const T* b, const X* x) {
         const T one(X(1.0));
         return b[0] / pow(one + exp(b[1] - b[2] * T(x[0])), one / b[3]);
       })},
      {"Roszman1",
       Of<4, 0, 1>([]<typename T, typename X>(const T* b, const X* x) {
         return b[0] - b[1] * T(x[0]) -
                atan(b[2] / (T(x[0]) - b[3])) / T(Pi<X>());
       })},
      {"Thurber", cubic_over_cubic}};
  return kMakers;
}

template <typename Text>
VectorXd ParameterNumbers(const data::StrdProblem& problem, Text text) {
  VectorXd numbers(std::ssize(problem.parameters));
  for (std::size_t j = 0; j < problem.parameters.size(); ++j) {
    numbers[static_cast<Index>(j)] =
        stats::ParseDoubleDouble(problem.parameters[j].*text).hi;
  }
  return numbers;
}

}  // namespace

ExtendedVector StrdColumn(const data::StrdProblem& problem,
                          std::size_t column) {
  ExtendedVector values(std::ssize(problem.rows));
  for (std::size_t i = 0; i < problem.rows.size(); ++i) {
    values[static_cast<Index>(i)] =
        stats::ParseDoubleDouble(problem.rows[i].at(column));
  }
  return values;
}

std::unique_ptr<fitting::RegressionFunction> MakeStrdFunction(
    const data::StrdProblem& problem) {
  const auto maker = Makers().find(problem.name);
  if (problem.kind != data::StrdKind::kNonlinear || maker == Makers().end()) {
    throw std::invalid_argument("MakeStrdFunction: no nonlinear model '" +
                                problem.name + "'");
  }
  ExtendedVector target = StrdColumn(problem, 0);
  if (problem.name == "Nelson") {
    for (DoubleDouble& y : target) y = log(y);
  }
  ExtendedMatrix predictors(target.size(), std::ssize(problem.columns) - 1);
  for (std::size_t j = 1; j < problem.columns.size(); ++j) {
    predictors.col(static_cast<Index>(j) - 1) = StrdColumn(problem, j);
  }
  auto function = maker->second(std::move(predictors), std::move(target));
  if (function->num_parameters() != std::ssize(problem.parameters)) {
    throw std::invalid_argument("MakeStrdFunction: " + problem.name + " has " +
                                std::to_string(function->num_parameters()) +
                                " parameters, found " +
                                std::to_string(problem.parameters.size()));
  }
  return function;
}

VectorXd CertifiedParameters(const data::StrdProblem& problem) {
  return ParameterNumbers(problem, &data::StrdParameter::certified);
}

VectorXd CertifiedDeviations(const data::StrdProblem& problem) {
  return ParameterNumbers(problem, &data::StrdParameter::standard_deviation);
}

VectorXd StrdStart(const data::StrdProblem& problem, int start) {
  if (start != 1 && start != 2) {
    throw std::invalid_argument("StrdStart: start must be 1 or 2, found " +
                                std::to_string(start));
  }
  return ParameterNumbers(
      problem,
      start == 1 ? &data::StrdParameter::start1 : &data::StrdParameter::start2);
}

}  // namespace errmap::models
