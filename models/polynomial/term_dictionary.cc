#include "models/polynomial/term_dictionary.h"

#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "data/text.h"
#include "fitting/interruption.h"
#include "models/history/view.h"
#include "models/polynomial/polynomial_fit.h"
#include "models/regression_record.h"

namespace errmap::models {
namespace {

using data::Dataset;
constexpr double kMostValues = 1.25e8;  // 1 GB
constexpr Index kMostTriangle = 4000;   // columns; four triangles of 128 MB

// "position_mm+t1_degC^2".
struct Terms {
  using Value = std::vector<NamedTerm>;
  std::string name;

  std::string values() const { return Words().values(); }
  std::optional<Value> Read(const std::string& text) const {
    if (text.empty()) return std::nullopt;
    return ParseTerms(text, name);
  }
  bool Allows(const Value& /*value*/) const { return true; }
  OptionText Write(const Value& value) const { return TermsText(value); }
};

std::vector<TermPowers> CheckedTerms(const Dataset& training,
                                     TermSet set,
                                     int degree) {
  constexpr Index kMostDictionaryTerms = 2'000'000;
  std::vector<bool> is_position;
  for (const data::ColumnInfo& input : training.inputs()) {
    is_position.push_back(data::IsPosition(input));
  }
  const auto count = CountTerms(set, is_position, degree);
  const Index rows = training.num_rows();
  const double values =
      count ? static_cast<double>(*count) * static_cast<double>(rows)
            : std::numeric_limits<double>::infinity();
  const bool held = values <= kMostValues;
  const bool reduced =
      count && *count <= kMostTriangle && rows > 2 * (*count + 2);
  if (!count || *count > kMostDictionaryTerms || (!held && !reduced)) {
    throw std::invalid_argument(fmt::format(
        "degree {} in {} inputs makes {} candidate terms, too many to hold "
        "for {} rows; use a lower degree or fewer inputs",
        degree,
        training.num_inputs(),
        count ? std::to_string(*count) : "countless",
        rows));
  }
  return MakeTerms(set, is_position, degree);
}

// Columns of the named terms in the dictionary.
std::vector<Index> Find(const std::vector<NamedTerm>& named,
                        const PolynomialDesign& design,
                        int degree,
                        const std::string& what) {
  const std::vector<std::string> names = design.dataset().InputNames();
  std::vector<Index> found;
  for (const TermPowers& powers : ResolveTerms(named, names, what)) {
    const auto at =
        std::find(design.terms().begin(), design.terms().end(), powers);
    if (at == design.terms().end()) {
      throw std::invalid_argument(
          fmt::format("{}: {} is not among the terms up to degree {}",
                      what,
                      TermName(powers, names),
                      degree));
    }
    found.push_back(at - design.terms().begin());
  }
  return found;
}

PolynomialDesign DesignOf(const Dataset& training,
                          TermSet set,
                          int degree,
                          Centring centring) {
  std::vector<TermPowers> terms = CheckedTerms(training, set, degree);
  std::vector<Index> inputs = AllColumns(training);
  ColumnScaling scaling = PolynomialScaling(training, inputs, terms, centring);
  return {training, std::move(inputs), std::move(scaling), std::move(terms)};
}

}  // namespace

Option<std::optional<int>> DegreeOption() {
  constexpr std::int64_t kMostDegree = 4;
  return OptionFor<std::optional<int>>(
      "degree",
      "the highest power of a term",
      [](auto& degree) { return &degree; },
      IntegerRange{1, kMostDegree});
}

Option<std::vector<NamedTerm>> TermsOption(const std::string& name,
                                           const std::string& about) {
  return OptionFor<std::vector<NamedTerm>>(
      name, about, [](auto& terms) { return &terms; }, Terms{name});
}

OptionList<TermOptions> TermOptionList() {
  return {OptionFor("terms",
                    "the products to choose from",
                    &TermOptions::set,
                    EnumWords<TermSet>(TermSetWords())),
          Within(DegreeOption(), &TermOptions::degree),
          OptionFor("centred",
                    "products of inputs about the middle of their range",
                    &TermOptions::centring,
                    OneOf<Centring>{
                        {{"yes", Centring::kAll}, {"no", Centring::kNone}}}),
          Within(TermsOption("include", "terms that are always in"),
                 &TermOptions::include),
          Within(TermsOption("exclude", "terms that are always left out"),
                 &TermOptions::exclude)};
}

TermDictionary::TermDictionary(const Dataset& training,
                               const TermOptions& options)
    : degree(options.degree.value_or(
          DefaultDegreeOf(options.set, training.num_inputs()))),
      design(DesignOf(training, options.set, degree, options.centring)),
      include(Find(options.include, design, degree, "include")),
      excluded(static_cast<std::size_t>(design.num_terms()), false) {
  for (const Index term : Find(options.exclude, design, degree, "exclude")) {
    if (std::find(include.begin(), include.end(), term) != include.end()) {
      throw std::invalid_argument(
          fmt::format("{} is both included and excluded",
                      design.TermNames()[static_cast<std::size_t>(term)]));
    }
    excluded[static_cast<std::size_t>(term)] = true;
  }
}

std::vector<std::vector<Index>> TermDictionary::Parents() const {
  std::map<TermPowers, Index> place;
  for (std::size_t i = 0; i < design.terms().size(); ++i) {
    place.emplace(design.terms()[i], static_cast<Index>(i));
  }
  std::vector<std::vector<Index>> parents(design.terms().size());
  for (std::size_t i = 0; i < parents.size(); ++i) {
    TermPowers powers = design.terms()[i];
    for (int& power : powers) {
      if (power == 0) continue;
      --power;
      // The parent of a term of degree 1 is the intercept, always in.
      const auto found = place.find(powers);
      if (found != place.end()) parents[i].push_back(found->second);
      ++power;
    }
  }
  return parents;
}

Index TermDictionary::NumOpen() const {
  return static_cast<Index>(
      std::count(excluded.begin(), excluded.end(), false));
}

std::string ChosenTerms(const TermDictionary& dictionary,
                        const std::vector<Index>& chosen) {
  if (chosen.empty()) return "no term was chosen";
  std::vector<std::string> names;
  for (const Index term : chosen) {
    names.push_back(dictionary.design.NameOf(term));
  }
  return "chosen: " + data::JoinWords(names, ", ");
}

void ReportExcluded(const TermDictionary& dictionary,
                    const DesignRows& rows,
                    const std::vector<Index>& chosen,
                    LeastSquaresRecord* record) {
  if (fitting::IsInterrupted()) return;
  const std::vector<std::string> names = dictionary.design.TermNames();
  const auto name = [&](Index term) {
    return names[static_cast<std::size_t>(term)];
  };
  const MatrixXd terms = rows.terms(Eigen::all, chosen);
  std::vector<std::string> chosen_names;
  for (const Index term : chosen) chosen_names.push_back(name(term));
  for (const fitting::ExcludedTerm& term :
       fitting::JudgeExcluded(rows.Problem(), chosen)) {
    if (fitting::IsInterrupted()) break;
    if (!term.aliased) {
      record->excluded.push_back({name(term.candidate), term.f, term.p});
      continue;
    }
    record->aliased.push_back({name(term.candidate),
                               WhyAliased(rows.terms.col(term.candidate),
                                          terms,
                                          chosen_names,
                                          rows.intercept)});
  }
  std::stable_sort(record->excluded.begin(),
                   record->excluded.end(),
                   [](const ExcludedRecord& a, const ExcludedRecord& b) {
                     return a.f > b.f;
                   });
}

}  // namespace errmap::models
