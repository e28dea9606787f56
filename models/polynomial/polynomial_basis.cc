#include "models/polynomial/polynomial_basis.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <map>
#include <numeric>

#include <fmt/format.h>

namespace errmap::models {
namespace {

int OrderOf(const TermPowers& powers) {
  return std::accumulate(powers.begin(), powers.end(), 0);
}

// Orders terms as AllTerms lists them.
struct TermOrder {
  bool operator()(const TermPowers& a, const TermPowers& b) const {
    const int order_a = OrderOf(a);
    const int order_b = OrderOf(b);
    return order_a != order_b ? order_a < order_b : a > b;
  }
};

void AppendTermsOfOrder(int order,
                        std::size_t input,
                        TermPowers* powers,
                        std::vector<TermPowers>* terms) {
  if (input + 1 == powers->size()) {
    (*powers)[input] = order;
    terms->push_back(*powers);
    (*powers)[input] = 0;
    return;
  }
  for (int power = order; power >= 0; --power) {
    (*powers)[input] = power;
    AppendTermsOfOrder(order - power, input + 1, powers, terms);
  }
  (*powers)[input] = 0;
}

// A name that a formula could not be read with stands in double quotes.
std::string Quoted(const std::string& name) {
  const bool plain = std::all_of(name.begin(), name.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' ||
           c == '.';
  });
  return plain ? name : '"' + name + '"';
}

// Coefficients of ((x - offset) * scale)^power in powers of x.
std::vector<long double> ExpandPower(double offset, double scale, int power) {
  std::vector<long double> coefficients{1.0L};
  for (int i = 0; i < power; ++i) {
    std::vector<long double> next(coefficients.size() + 1, 0.0L);
    for (std::size_t k = 0; k < coefficients.size(); ++k) {
      next[k + 1] += coefficients[k] * static_cast<long double>(scale);
      next[k] -= coefficients[k] * static_cast<long double>(scale) *
                 static_cast<long double>(offset);
    }
    coefficients = std::move(next);
  }
  return coefficients;
}

}  // namespace

std::optional<Index> CountTerms(Index num_inputs, int degree) {
  Index count = 1;
  for (int i = 1; i <= degree; ++i) {
    if (count > std::numeric_limits<Index>::max() / (num_inputs + i)) {
      return std::nullopt;
    }
    count = count * (num_inputs + i) / i;  // a binomial at every step: exact
  }
  return count - 1;
}

std::vector<TermPowers> AllTerms(Index num_inputs, int degree) {
  std::vector<TermPowers> terms;
  if (num_inputs == 0) return terms;
  TermPowers powers(static_cast<std::size_t>(num_inputs), 0);
  for (int order = 1; order <= degree; ++order) {
    AppendTermsOfOrder(order, 0, &powers, &terms);
  }
  return terms;
}

MatrixXd TermMatrix(const MatrixXd& scaled_inputs,
                    const std::vector<TermPowers>& terms) {
  MatrixXd matrix(scaled_inputs.rows(), std::ssize(terms));
  for (Index column = 0; column < matrix.cols(); ++column) {
    const TermPowers& powers = terms[static_cast<std::size_t>(column)];
    bool has_factor = false;
    for (Index input = 0; input < scaled_inputs.cols(); ++input) {
      for (int i = 0; i < powers[static_cast<std::size_t>(input)]; ++i) {
        if (has_factor) {
          matrix.col(column).array() *= scaled_inputs.col(input).array();
        } else {
          matrix.col(column) = scaled_inputs.col(input);
        }
        has_factor = true;
      }
    }
    if (!has_factor) matrix.col(column).setOnes();
  }
  return matrix;
}

std::string TermName(const TermPowers& term,
                     const std::vector<std::string>& input_names) {
  std::string name;
  for (std::size_t i = 0; i < term.size(); ++i) {
    if (term[i] == 0) continue;
    if (!name.empty()) name += '*';
    name += Quoted(input_names[i]);
    if (term[i] > 1) name += '^' + std::to_string(term[i]);
  }
  return name;
}

std::vector<PolynomialTerm> ExpandToPhysicalUnits(const PolynomialForm& form) {
  std::map<TermPowers, long double, TermOrder> expanded;
  const auto num_inputs = static_cast<std::size_t>(form.input_offset.size());
  expanded[TermPowers(num_inputs, 0)] =
      static_cast<long double>(form.intercept);
  for (const PolynomialTerm& term : form.terms) {
    // The product of the inputs' expansions, one input at a time.
    std::map<TermPowers, long double> product{
        {TermPowers(num_inputs, 0),
         static_cast<long double>(term.coefficient)}};
    for (std::size_t input = 0; input < num_inputs; ++input) {
      if (term.powers[input] == 0) continue;
      const auto factor =
          ExpandPower(form.input_offset[static_cast<Index>(input)],
                      form.input_scale[static_cast<Index>(input)],
                      term.powers[input]);
      std::map<TermPowers, long double> next;
      for (const auto& [powers, coefficient] : product) {
        for (std::size_t k = 0; k < factor.size(); ++k) {
          if (factor[k] == 0.0L) continue;  // an input that is not moved
          TermPowers raised = powers;
          raised[input] = static_cast<int>(k);
          next[raised] += coefficient * factor[k];
        }
      }
      product = std::move(next);
    }
    for (const auto& [powers, coefficient] : product) {
      expanded[powers] += coefficient;
    }
  }
  std::vector<PolynomialTerm> terms;
  for (const auto& [powers, coefficient] : expanded) {
    terms.push_back({powers, static_cast<double>(coefficient)});
  }
  return terms;
}

std::string EquationText(const PolynomialForm& form,
                         const data::ColumnInfo& target,
                         const std::vector<TrainedInput>& inputs,
                         double rmse) {
  std::vector<std::string> names;
  for (const TrainedInput& input : inputs) names.push_back(input.column.name);
  const std::vector<PolynomialTerm> terms = ExpandToPhysicalUnits(form);
  // Sum of the largest sizes of the terms: a coefficient of d digits errs by
  // half a unit of the last.
  double size = 0.0;
  for (const PolynomialTerm& term : terms) {
    double largest = std::abs(term.coefficient);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      largest *=
          std::pow(std::max(std::abs(inputs[i].min), std::abs(inputs[i].max)),
                   term.powers[i]);
    }
    size += largest;
  }
  constexpr int kFewestDigits = 9;
  constexpr int kMostDigits = 17;
  constexpr double kShareOfRmse = 1e-6;
  int digits = kFewestDigits;
  while (digits < kMostDigits &&
         size * 0.5 * std::pow(10.0, 1 - digits) > kShareOfRmse * rmse) {
    ++digits;
  }
  std::string text = target.name + " =";
  bool first = true;
  for (const PolynomialTerm& term : terms) {
    const std::string name = TermName(term.powers, names);
    const bool negative = std::signbit(term.coefficient);
    if (first) {
      text += negative ? " -" : " ";
    } else {
      text += negative ? " - " : " + ";
    }
    first = false;
    text += fmt::format("{:.{}e}", std::abs(term.coefficient), digits - 1);
    if (!name.empty()) text += '*' + name;
  }
  return text;
}

}  // namespace errmap::models
