// A map from measurements to its file and back, of several families.
#include <cmath>
#include <cstdlib>
#include <iostream>

#include <errmap/errmap.h>
using namespace errmap::models;

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const auto table = errmap::data::ReadCsv(argv[1]);
  const auto rows =
      errmap::data::MakeDataset(table, {.target = "error_mm"}).dataset;
  const auto try_out = [&](const auto& options) {
    const auto recipe = MakeRecipe(options);
    const auto map = recipe->Fit(rows, {});
    SaveModel(map, {{"made_by", "an outside project"}}, argv[2]);
    if (LoadModel(argv[2]).Predict(rows) != map.Predict(rows)) std::exit(1);
    const double n = static_cast<double>(rows.num_rows());
    const Eigen::VectorXd left = rows.target_values() - map.Predict(rows);
    std::cout << recipe->name() << " " << 1e3 * left.norm() / std::sqrt(n)
              << " um\n";
  };
  try_out(FullOptions{.degree = 3});
  try_out(NetOptions{.method = CeresTraining{}, .hidden = 4, .iterations = 5});
  try_out(NetOptions{.hidden = 4, .wfactor = 1e-4, .iterations = 50});
}
