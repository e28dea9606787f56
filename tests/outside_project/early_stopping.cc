// A net of h nodes, stopped when days that it does not see grow worse, as a
// map.
#include <cstdlib>
#include <iostream>

#include <errmap/errmap.h>
using namespace errmap;

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const auto rows = data::MakeDataset(data::ReadCsv(argv[1]), {}).dataset;
  const auto x = models::UnitRangeScaling(rows.input_values());
  const auto y = models::SigmoidTargetScaling(rows.target_values());
  const models::NetShape shape{rows.num_inputs(), std::atoi(argv[2])};
  const Eigen::MatrixXd in = x.Apply(rows.input_values());
  const Eigen::VectorXd out =
      (y.slope * rows.target_values()).array() + y.offset;
  const models::NetObjective seen(shape, in.topRows(60), out.head(60), 1e-8);
  const models::NetObjective unseen(
      shape, in.bottomRows(240), out.tail(240), 0.0);
  Eigen::VectorXd best = models::InitialWeights(shape, 1);
  const auto goes_on = [&](const fitting::Iterate& at) {
    const double now = unseen.Evaluate(at.x, nullptr);
    const double least = unseen.Evaluate(best, nullptr);
    if (now < least) best = at.x;
    return now < 1.2 * least;
  };
  const auto fit = fitting::ScaledConjugateGradient({}).Minimize(
      seen, best, {.after_iteration = goes_on});
  const auto map = models::MapOfWeights(shape, best, x, y, rows);
  models::SaveModel(map, {}, "early.json");
  std::cout << fit.summary.message << " " << map.Predict(rows)[0] << "\n";
}
