// A net of h nodes, stopped when rows that it does not see grow worse.
#include <cstdlib>
#include <iostream>

#include <errmap/errmap.h>

int main(int argc, char** argv) {
  const Eigen::Index h = argc > 1 ? std::atoi(argv[1]) : 6;
  const Eigen::MatrixXd x = Eigen::MatrixXd::Random(300, 2);
  const Eigen::VectorXd y = 0.5 + 0.2 * (3.0 * x.col(0)).array().sin() +
                            0.1 * Eigen::ArrayXd::Random(300);
  const errmap::models::NetShape shape{.inputs = 2, .hidden = h};
  const errmap::models::NetObjective seen(
      shape, x.topRows(60), y.topRows(60), 1e-8);
  const errmap::models::NetObjective unseen(
      shape, x.bottomRows(240), y.bottomRows(240), 0.0);
  double least = unseen.Evaluate(errmap::models::InitialWeights(shape, 1), {});
  const auto goes_on = [&](const errmap::fitting::Iterate& at) {
    least = std::min(least, unseen.Evaluate(at.x, nullptr));
    return unseen.Evaluate(at.x, nullptr) < 1.2 * least;
  };
  const auto fit = errmap::fitting::ScaledConjugateGradient({}).Minimize(
      seen,
      errmap::models::InitialWeights(shape, 1),
      {.after_iteration = goes_on});
  std::cout << fit.summary.iterations << " " << fit.summary.message << "\n";
}
