// A model of one's own, k nearest neighbours, in a study beside the others.
#include <iostream>

#include <errmap/errmap.h>
using namespace errmap;
using namespace errmap::models;
struct Neighbours final : ErrorModel {
  explicit Neighbours(const data::Dataset& rows)
      : x(rows.input_values()), y(rows.target_values()) {}
  const Eigen::MatrixXd x;
  const Eigen::VectorXd y;
  Eigen::Index num_inputs() const override { return x.cols(); }
  Eigen::Index num_parameters() const override { return x.size(); }
  double DoPredictRow(const double* row) const override {
    const Eigen::Map<const Eigen::RowVectorXd> at(row, x.cols());
    Eigen::VectorXd far = (x.rowwise() - at).rowwise().squaredNorm();
    double sum = 0.0;
    for (Eigen::Index k = 0, nearest = 0; k < 5; ++k) {
      far.minCoeff(&nearest);
      sum += y[nearest];
      far[nearest] = INFINITY;
    }
    return sum / 5.0;
  }
};

struct NeighboursRecipe final : ModelRecipe {
  std::string name() const override { return "my:neighbours"; }
  ModelKind kind() const override { return ModelKind::kFile; }
  FittedModel Fit(const data::Dataset& rows, const FitContext&) const override {
    return MapOfModel(*this, rows, std::make_shared<Neighbours>(rows));
  }
};

int main(int, char** argv) {
  const auto rows = data::MakeDataset(data::ReadCsv(argv[1]), {}).dataset;
  OwnRecipes own;
  own.recipes.push_back(std::make_unique<NeighboursRecipe>());
  const auto study = CompareMaps(
      rows, {.holdouts = {"groups:5"}, .models = {"mean"}}, std::move(own));
  std::cout << study.study.models[1].holdouts[0].test.rmse
            << " mm by neighbours\n";
}
