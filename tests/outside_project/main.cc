// What README.md shows, and the way from a map to its file and back.

#include <cmath>
#include <iostream>

#include "data/dataset.h"
#include "models/model_file.h"
#include "models/recipe_catalog.h"

namespace {

double Rmse(const errmap::data::Dataset& dataset,
            const errmap::models::FittedModel& map) {
  const Eigen::VectorXd residuals =
      dataset.target_values() - map.Predict(dataset);
  return std::sqrt(residuals.squaredNorm() /
                   static_cast<double>(residuals.size()));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const auto table = errmap::data::ReadCsv(argv[1]);
  const auto dataset =
      errmap::data::MakeDataset(table, {.target = "error_mm"}).dataset;
  for (const char* spec : {"poly:full:degree=3",
                           "net:scg:hidden=4:iterations=50",
                           "net:ceres:hidden=4:iterations=5",
                           "net:nlopt:hidden=4:iterations=5"}) {
    const auto map = errmap::models::MakeRecipe(spec)->Fit(dataset, {});
    errmap::models::SaveModel(
        map, {{"made_by", "an outside project"}}, argv[2]);
    const auto again = errmap::models::LoadModel(argv[2]);
    if (again.Predict(dataset) != map.Predict(dataset)) return 1;
    std::cout << spec << " " << 1000.0 * Rmse(dataset, map) << " um\n";
  }
}
