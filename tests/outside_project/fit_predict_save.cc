// A map from measurements to its file and back.
#include <cmath>
#include <iostream>

#include <errmap/errmap.h>

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const auto table = errmap::data::ReadCsv(argv[1]);
  const auto rows =
      errmap::data::MakeDataset(table, {.target = "error_mm"}).dataset;
  for (const char* spec : {"poly:full:degree=3",
                           "net:scg:hidden=4:iterations=50",
                           "net:ceres:hidden=4:iterations=5",
                           "net:nlopt:hidden=4:iterations=5"}) {
    const auto map = errmap::models::MakeRecipe(spec)->Fit(rows, {});
    errmap::models::SaveModel(
        map, {{"made_by", "an outside project"}}, argv[2]);
    const auto again = errmap::models::LoadModel(argv[2]);
    if (again.Predict(rows) != map.Predict(rows)) return 1;
    const double n = static_cast<double>(rows.num_rows());
    const auto left = rows.target_values() - map.Predict(rows);
    std::cout << spec << " " << 1e3 * left.norm() / std::sqrt(n) << " um\n";
  }
}
