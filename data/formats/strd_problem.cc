#include "data/formats/strd_problem.h"

#include <map>
#include <sstream>

#include "data/formats/strd_texts.h"
#include "data/input_error.h"

namespace errmap::data {
namespace {

using Words = std::vector<std::string>;

class Parser {
 public:
  Parser(std::string_view text, const std::string& name)
      : stream_(std::string(text)), name_(name) {}

  StrdProblem Parse() {
    for (Words words; NextLine(&words);) {
      if (words[0] == "data") return Data();
      Head(words);
    }
    return Fail("no line 'data'");
  }

 private:
  bool NextLine(Words* words) {
    for (std::string line; std::getline(stream_, line);) {
      ++line_;
      std::istringstream parts(line);
      words->clear();
      for (std::string word; parts >> word;) words->push_back(word);
      if (!words->empty()) return true;
    }
    return false;
  }

  StrdProblem Fail(const std::string& what) const {
    throw InputError(name_ + ": line " + std::to_string(line_) + ": " + what);
  }

  int Whole(const std::string& word) const {
    std::size_t used = 0;
    int value = 0;
    try {
      value = std::stoi(word, &used);
    } catch (const std::exception&) {
      used = 0;
    }
    if (used != word.size()) Fail("'" + word + "' is not a whole number");
    return value;
  }

  void Head(const Words& words) {
    const std::string& key = words[0];
    const std::size_t values = words.size() - 1;
    const auto require = [&](std::size_t count) {
      if (values != count) {
        Fail("'" + key + "' takes " + std::to_string(count) +
             " values, found " + std::to_string(values));
      }
    };
    // Keys of one text.
    static const std::map<std::string_view, std::string StrdProblem::*> kTexts =
        {{"level", &StrdProblem::level},
         {"rss", &StrdProblem::residual_sum_of_squares},
         {"mean", &StrdProblem::mean},
         {"sd", &StrdProblem::standard_deviation},
         {"autocorrelation", &StrdProblem::autocorrelation}};
    if (const auto text = kTexts.find(key); text != kTexts.end()) {
      require(1);
      problem_.*text->second = words[1];
    } else if (key == "set") {
      require(2);
      problem_.kind = Kind(words[1]);
      problem_.name = words[2];
    } else if (key == "parameter") {
      const bool nonlinear = problem_.kind == StrdKind::kNonlinear;
      require(nonlinear ? 5 : 3);
      problem_.parameters.push_back({.name = words[1],
                                     .start1 = nonlinear ? words[2] : "",
                                     .start2 = nonlinear ? words[3] : "",
                                     .certified = words[values - 1],
                                     .standard_deviation = words[values]});
    } else if (key == "dof") {
      require(1);
      problem_.degrees_of_freedom = Whole(words[1]);
    } else if (key == "powers") {
      require(2);
      problem_.design = StrdDesign::kPowers;
      problem_.low_power = Whole(words[1]);
      problem_.high_power = Whole(words[2]);
    } else if (key == "intercept") {
      require(0);
      problem_.design = StrdDesign::kIntercept;
    } else if (key == "columns") {
      problem_.columns.assign(words.begin() + 1, words.end());
    } else {
      Fail("unknown key '" + key + "'");
    }
  }

  StrdKind Kind(const std::string& word) const {
    if (word == "nonlinear") return StrdKind::kNonlinear;
    if (word == "linear") return StrdKind::kLinear;
    if (word != "univariate") Fail("unknown kind '" + word + "'");
    return StrdKind::kUnivariate;
  }

  StrdProblem Data() {
    if (problem_.columns.empty()) Fail("no line 'columns' before the data");
    const std::size_t width = problem_.columns.size();
    for (Words words; NextLine(&words);) {
      if (problem_.kind == StrdKind::kUnivariate) {
        for (std::string& word : words) problem_.rows.push_back({word});
        continue;
      }
      if (words.size() != width) {
        Fail(std::to_string(width) + " values are needed, found " +
             std::to_string(words.size()));
      }
      problem_.rows.push_back(words);
    }
    if (problem_.rows.empty()) Fail("no data");
    return problem_;
  }

  std::istringstream stream_;
  std::string name_;
  int line_ = 0;
  StrdProblem problem_;
};

}  // namespace

StrdProblem ParseStrdProblem(std::string_view text, const std::string& name) {
  return Parser(text, name).Parse();
}

const std::vector<StrdProblem>& StrdProblems() {
  static const std::vector<StrdProblem> kProblems = [] {
    std::vector<StrdProblem> problems;
    for (const StrdKind kind :
         {StrdKind::kNonlinear, StrdKind::kLinear, StrdKind::kUnivariate}) {
      for (const StrdText& text : StrdTexts()) {
        StrdProblem problem =
            ParseStrdProblem(text.text, std::string(text.name));
        if (problem.kind == kind) problems.push_back(std::move(problem));
      }
    }
    return problems;
  }();
  return kProblems;
}

}  // namespace errmap::data
