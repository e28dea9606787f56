#include "fitting/minimisers/optimizer.h"

#include <chrono>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "stats/require.h"

namespace errmap::fitting {
namespace {

// A residual form whose evaluations are counted: residuals alone as a value,
// with the Jacobian as a gradient.
class CountedResiduals final : public ResidualFunction {
 public:
  CountedResiduals(const ResidualFunction& function,
                   std::int64_t* values,
                   std::int64_t* gradients)
      : function_(function), values_(values), gradients_(gradients) {}

  Index num_residuals() const override { return function_.num_residuals(); }
  double ridge() const override { return function_.ridge(); }
  void Evaluate(const VectorXd& x,
                VectorXd* residuals,
                MatrixXd* jacobian) const override {
    ++(jacobian == nullptr ? *values_ : *gradients_);
    function_.Evaluate(x, residuals, jacobian);
  }
  std::unique_ptr<Linearization> NewLinearization() const override {
    return std::make_unique<Counted>(function_.NewLinearization(), gradients_);
  }

 private:
  class Counted final : public Linearization {
   public:
    Counted(std::unique_ptr<Linearization> linearization,
            std::int64_t* gradients)
        : linearization_(std::move(linearization)), gradients_(gradients) {}
    void MoveTo(const VectorXd& x,
                VectorXd* residuals,
                MatrixXd* gram) override {
      ++*gradients_;
      linearization_->MoveTo(x, residuals, gram);
    }
    VectorXd Apply(const VectorXd& v) const override {
      return linearization_->Apply(v);
    }
    VectorXd ApplyTransposed(const VectorXd& u) const override {
      return linearization_->ApplyTransposed(u);
    }

   private:
    std::unique_ptr<Linearization> linearization_;
    std::int64_t* gradients_;
  };

  const ResidualFunction& function_;
  std::int64_t* values_;
  std::int64_t* gradients_;
};

// Counts what passes through; the summary of every optimizer is filled alike.
template <typename Scalar>
class CountedObjective final : public BasicObjective<Scalar> {
 public:
  using Vector = VectorOf<Scalar>;

  explicit CountedObjective(const BasicObjective<Scalar>& objective)
      : objective_(objective) {}

  Index num_parameters() const override { return objective_.num_parameters(); }

  Scalar Evaluate(const Vector& x, Vector* gradient) const override {
    ++(gradient == nullptr ? values_ : gradients_);
    return objective_.Evaluate(x, gradient);
  }

  std::unique_ptr<Path<Scalar>> NewPath(const Vector& x) const override {
    return std::make_unique<CountedPath>(*this, objective_.NewPath(x));
  }

  const ResidualFunction* residuals() const override {
    if (!residuals_.has_value() && objective_.residuals() != nullptr) {
      residuals_.emplace(*objective_.residuals(), &values_, &gradients_);
    }
    return residuals_.has_value() ? &*residuals_ : nullptr;
  }

  void Report(FitSummary* summary) const {
    summary->value_evaluations = values_;
    summary->gradient_evaluations = gradients_;
    summary->curvature_evaluations = curvatures_;
  }

 private:
  class CountedPath final : public Path<Scalar> {
   public:
    CountedPath(const CountedObjective& owner,
                std::unique_ptr<Path<Scalar>> path)
        : owner_(owner), path_(std::move(path)) {}

    void SetDirection(const Vector& p) override { path_->SetDirection(p); }
    Scalar Curvature() override {
      const int gradients = path_->gradients_per_curvature();
      if (gradients > 0) {
        owner_.gradients_ += gradients;
      } else {
        ++owner_.curvatures_;
      }
      return path_->Curvature();
    }
    int gradients_per_curvature() const override {
      return path_->gradients_per_curvature();
    }
    Scalar Value(Scalar a) override {
      ++owner_.values_;
      return path_->Value(a);
    }
    void Accept(Scalar a) override {
      path_->Accept(a);
      counted_here_ = false;
    }
    const Vector& Gradient() override {
      if (!counted_here_) ++owner_.gradients_;
      counted_here_ = true;
      return path_->Gradient();
    }

   private:
    const CountedObjective& owner_;
    std::unique_ptr<Path<Scalar>> path_;
    bool counted_here_ = false;  // the gradient at this point
  };

  const BasicObjective<Scalar>& objective_;
  mutable std::int64_t values_ = 0;
  mutable std::int64_t gradients_ = 0;
  mutable std::int64_t curvatures_ = 0;
  mutable std::optional<CountedResiduals> residuals_;  // once asked for
};

void RequireAtLeast(const std::string& field, double value, double least) {
  stats::Require(
      value >= least,
      "StoppingRules: " + field + " must be at least " + std::to_string(least),
      value);
}

void RequireAbove(const std::string& field, double value, double bound) {
  stats::Require(
      value > bound,
      "StoppingRules: " + field + " must be above " + std::to_string(bound),
      value);
}

}  // namespace

void StoppingRules::Validate() const {
  RequireAtLeast("iterations", static_cast<double>(iterations), 0.0);
  RequireAtLeast("evaluations", static_cast<double>(evaluations), 1.0);
  RequireAbove("seconds", seconds, 0.0);
  RequireAtLeast("cost_goal", cost_goal, 0.0);
  RequireAtLeast("gradient_goal", gradient_goal, 0.0);
  RequireAbove("slow_ratio", slow_ratio, 0.0);
  RequireAtLeast(
      "progress_interval", static_cast<double>(progress_interval), 1.0);
}

template <typename Scalar>
Minimum BasicOptimizer<Scalar>::Minimize(const BasicObjective<Scalar>& f,
                                         const Vector& x0,
                                         const RunControl& run) const {
  if (x0.size() != f.num_parameters()) {
    throw std::invalid_argument(
        "Minimize: x0 has " + std::to_string(x0.size()) +
        " elements, the objective has " + std::to_string(f.num_parameters()) +
        " parameters");
  }
  if (!x0.allFinite()) {
    throw std::invalid_argument("Minimize: x0 must be finite throughout");
  }
  const CountedObjective<Scalar> counted(f);
  const auto start = std::chrono::steady_clock::now();
  Minimum minimum = DoMinimize(counted, x0, run);
  minimum.summary.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
          .count();
  counted.Report(&minimum.summary);
  return minimum;
}

template class BasicOptimizer<double>;
template class BasicOptimizer<float>;

}  // namespace errmap::fitting
