#include "models/option_list.h"

#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/blend/blend_recipe.h"
#include "models/net/net_options.h"
#include "models/polynomial/polynomial_options.h"
#include "models/recipe_catalog.h"
#include "tests/models/model_test_data.h"
#include "tests/places.h"

namespace errmap::models {
namespace {

using ::testing::HasSubstr;
using ::testing::UnorderedElementsAreArray;

std::string RefusalOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

std::string InEffectText(const std::string& spec) {
  std::string text;
  for (const EffectiveOption& option : MakeRecipe(spec)->options()) {
    text += SpecWord(option.key, option.value);
  }
  return text;
}

// ---- Text first: every option of every type, by what its list says.

// Words that an option of these `values` takes, and words that it does not.
struct Tried {
  std::vector<std::string> good;
  std::vector<std::string> bad;
};

Tried WordsFor(const std::string& values) {
  Tried tried{{}, {"?"}};
  std::smatch found;
  std::string rest = values;
  if (std::regex_search(rest, found, std::regex("^(\\w+) or "))) {
    tried.good.push_back(found[1]);
    rest = found.suffix();
  }
  const std::regex range("^a (whole )?number from (\\S+)( to (\\S+)| on)$");
  if (rest.starts_with("one of ")) {
    std::istringstream words(rest.substr(std::string("one of ").size()));
    for (std::string word; std::getline(words >> std::ws, word, ',');) {
      tried.good.push_back(word);
    }
  } else if (std::regex_match(rest, found, range)) {
    const bool whole = found[1].matched;
    const auto beyond = [&](const std::string& bound, bool above) {
      if (whole) return std::to_string(std::stoll(bound) + (above ? 1 : -1));
      const double at = std::stod(bound);
      const double towards = above ? INFINITY : -INFINITY;
      return TextOf(std::nextafter(at, towards));
    };
    tried.good.push_back(found[2]);
    tried.bad.push_back(beyond(found[2], false));
    tried.bad.push_back(whole ? "2.5" : "nan");
    if (found[4].matched) {
      tried.good.push_back(found[4]);
      tried.bad.push_back(beyond(found[4], true));
    }
  } else if (values == "text") {
    tried = {{"position_mm"}, {""}};
  } else {  // auto, none or time constants above 0 joined by +
    tried = {{"auto", "none", "600", "600+3600.5"}, {"0", "-1", "10+", "inf"}};
  }
  return tried;
}

std::vector<std::string> AllTypes() {
  std::vector<std::string> types = ModelTypes();
  types.emplace_back("poly:formula=x+y");
  return types;
}

TEST(OptionList, TakesWhatItSaysAndNothingBeyond) {
  int good = 0;
  for (const std::string& type : AllTypes()) {
    for (const ModelOption& option : OptionsOfModel(type)) {
      if (option.name == "formula") continue;
      EXPECT_NE(option.about, "") << type << " " << option.name;
      const Tried tried = WordsFor(option.values);
      const std::string key = type + ":" + option.name + "=";
      for (const std::string& word : tried.good) {
        const std::string spec = key + word;
        // It may contradict the others, but not be out of range.
        const std::string refusal = RefusalOf([&] { MakeRecipe(spec); });
        EXPECT_THAT(refusal, Not(HasSubstr(" must be " + option.values)))
            << spec;
        if (!refusal.empty()) continue;
        ++good;
        EXPECT_EQ(InEffectText(RewrittenSpec(spec)), InEffectText(spec))
            << spec;
        EXPECT_EQ(RewrittenSpec(RewrittenSpec(spec)), RewrittenSpec(spec));
      }
      for (const std::string& word : tried.bad) {
        const std::string refusal = RefusalOf([&] { MakeRecipe(key + word); });
        const std::string why = word.empty() ? " is empty"
                                             : " must be " + option.values +
                                                   ", found '" + word + "'";
        EXPECT_EQ(refusal, "model '" + key + word + "': " + option.name + why);
      }
    }
  }
  EXPECT_GT(good, 400);
}

TEST(OptionList, WritesASpecBackAsItWas) {
  std::vector<std::string> specs = {
      "poly:eq8:T=t1_degC",
      "poly:eq8:T=\"bed: top, left\"",
      "poly:stepwise:criterion=p:enter=0.06",
      "poly:stepwise:select=aic:stop=none:choose=bic:max_terms=none",
      "poly:stepwise:terms=axis:include=position_mm^2+\"a: b\"*t1:view=history:"
      "history=600+3600:clip=none",
      "poly:best:criterion=cp:max_terms=5:sigma2=0.25:bootstrap=100",
      "poly:ridge:penalty=0.1:view=zero:angles=sincos:terms=linear:centred=no",
      "poly:lasso:rule=1se:view=auto:history=none:zero=none:intercept=no",
      "poly:formula=position_mm*t1_degC:intercept=no",
      "poly:formula=\"ema(t1_degC,600s)\":view=history:history=600",
      "net:scg:hidden=cv:wfactor=cv:starts=3:choose=cv",
      "net:scg:hidden=60:wfactor=0.0013:iterations=1500",
      "net:scg:discrepancy=0.0005:iterations=9:egoal=1e-09:errdel=2:nfreq=3",
      "net:lm:hidden=3:evaluations=5:seconds=0.5:members=2:rows=all",
      "net:nlopt:method=crs2_lm:box=3",
      "net:ceres:scale=none:output=linear:slope=0.5:method=bfgs:memory=9",
      "net:backprop:learning_rate=0.5:momentum=0",
      "blend:net=yes:view=history+zero:terms=full:degree=2"};
  // What is shipped: the types and what a comparison takes by default.
  for (const std::string& type : ModelTypes()) {
    if (type != "poly:full") specs.push_back(type);  // which says its degree
  }
  const data::Dataset shipped = errmap::testing::ShippedMeasurements();
  for (const auto& recipe :
       MakeDefaultRecipes(shipped, shipped.num_rows() / 2).recipes) {
    specs.push_back(recipe->name());
  }
  for (const std::string& spec : specs) EXPECT_EQ(RewrittenSpec(spec), spec);
}

// ---- Types first.

template <typename Options>
void ExpectRoundTrip(const Options& options) {
  EXPECT_EQ(RefusalOf([&] { options.Validate(); }), "");
  const std::string spec = SpecOf(options);
  EXPECT_TRUE(OptionsOf<Options>(spec) == options) << spec;
  const auto recipe = MakeRecipe(options);
  EXPECT_EQ(recipe->name(), spec);
  EXPECT_EQ(MakeRecipe(options, "mine")->name(), "mine");
  std::string in_effect;
  for (const EffectiveOption& option : recipe->options()) {
    in_effect += SpecWord(option.key, option.value);
  }
  EXPECT_EQ(in_effect, InEffectText(spec));
}

TEST(ModelOptions, DefaultsPassAndSurviveTheirSpec) {
  ExpectRoundTrip(ConstantOptions{});
  ExpectRoundTrip(ConstantOptions{.is_zero = true});
  ExpectRoundTrip(PositionTemperatureOptions{});
  ExpectRoundTrip(FullOptions{});
  ExpectRoundTrip(StepwiseOptions{});
  ExpectRoundTrip(BestSubsetOptions{});
  ExpectRoundTrip(PenalizedOptions{});
  ExpectRoundTrip(FormulaOptions{.formula = "x + y^2"});
  ExpectRoundTrip(NetOptions{});
  ExpectRoundTrip(BlendOptions{});
}

TEST(ModelOptions, SurviveTheirSpec) {
  ExpectRoundTrip(PositionTemperatureOptions{
      .form = PositionTemperatureForm::kTemperature, .temperature = "a, b"});
  ExpectRoundTrip(FullOptions{.degree = 12});
  ExpectRoundTrip(StepwiseOptions{
      .criterion = fitting::Criterion::kPValue,
      .select = fitting::Criterion::kAic,
      .direction = fitting::Direction::kBoth,
      .heredity = fitting::Heredity::kStrong,
      .enter = 0.01,
      .max_terms = StepwiseOptions::kNoLimit,
      .bootstrap = 0,
      .terms = {.degree = 2, .include = ParseTerms("x*y+z^2", "include")},
      .view = ViewOptions{.view = View::kZero},
      .clip = false});
  ExpectRoundTrip(PenalizedOptions{
      .family = fitting::Penalty::kLasso,
      .penalty = {.one_standard_error = true},
      .basis = {.view = ViewOptions{.time_constants = std::vector<double>(),
                                    .zero = false,
                                    .intercept = false},
                .terms = TermSet::kAxis,
                .centring = Centring::kAll}});
  ExpectRoundTrip(FormulaOptions{
      .formula = "x", .centring = Centring::kNone, .intercept = false});
  ExpectRoundTrip(NetOptions{.hidden = 12, .wfactor = 1.0 / 3.0});
  ExpectRoundTrip(NetOptions{.method = LmTraining{},
                             .hidden = kByCrossValidation,
                             .path = true,
                             .seconds = 0.1,
                             .starts = 1,
                             .rows = NetOptions::kAllRows,
                             .view = ViewOptions{.sine_and_cosine = false}});
  ExpectRoundTrip(NetOptions{
      .method = CeresTraining{.method = fitting::CeresMethod::kBfgs}});
  ExpectRoundTrip(BlendOptions{
      .net = true, .bases = {.view = ViewOptions{.view = View::kRaw}}});
}

TEST(ModelOptions, EachBoundBites) {
  const auto view = [](std::vector<double> constants) {
    return ViewOptions{.view = View::kHistory, .time_constants = constants};
  };
  const std::vector<std::pair<std::function<void()>, const char*>> cases = {
      {[] { FullOptions{.degree = 0}.Validate(); },
       "degree must be a whole number from 1 to 12, found '0'"},
      {[] { FullOptions{.degree = 13}.Validate(); }, "found '13'"},
      {[] { StepwiseOptions{.max_terms = -2}.Validate(); },
       "max_terms must be none or a whole number from 0 to 1000000, found"},
      {[] { StepwiseOptions{.sigma2 = 0.0}.Validate(); },
       "sigma2 must be above 0"},
      {[] { StepwiseOptions{.bootstrap = 1'000'001}.Validate(); },
       "bootstrap must be"},
      {[] { StepwiseOptions{.terms = {.degree = 5}}.Validate(); },
       "degree must be a whole number from 1 to 4, found '5'"},
      {[] {
         StepwiseOptions{.criterion = fitting::Criterion::kNone}.Validate();
       },
       "criterion must be one of p, aic"},
      {[] {
         StepwiseOptions{.criterion = fitting::Criterion::kPValue,
                         .enter = 0.2,
                         .remove = 0.1}
             .Validate();
       },
       "remove (0.1) is below enter (0.2)"},
      {[] { StepwiseOptions{.enter = 0.2}.Validate(); }, "are p-values"},
      {[] {
         BestSubsetOptions{.criterion = fitting::Criterion::kCv}.Validate();
       },
       "criterion must be one of aic"},
      {[] { BestSubsetOptions{.max_terms = 49}.Validate(); },
       "max_terms must be a whole number from 0 to 48, found '49'"},
      {[] { PenalizedOptions{.penalty = {.strength = -1.0}}.Validate(); },
       "penalty must be a number from 0 on, found '-1'"},
      {[] { PenalizedOptions{.penalty = {.strength = NAN}}.Validate(); },
       "penalty must be"},
      {[] {
         PenalizedOptions{.basis = {.centring = Centring::kHarmless}}
             .Validate();
       },
       "centred must be one of standard, yes, no"},
      {[&] {
         PenalizedOptions{.basis = {.view = view({600.0, 0.0})}}.Validate();
       },
       "history must be auto, none or time constants above 0 joined by +, "
       "found '600+0'"},
      {[] { FormulaOptions{.formula = "x++y"}.Validate(); }, "formula"},
      {[] { FormulaOptions{.formula = "x", .view = ViewOptions{}}.Validate(); },
       "written for one view"},
      {[] { NetOptions{.hidden = 0}.Validate(); },
       "model 'net:scg:hidden=0': hidden must be cv or a whole number from 1 "
       "to 10000, found '0'"},
      {[] { NetOptions{.wfactor = -1e-9}.Validate(); }, "wfactor must be cv"},
      {[] { NetOptions{.wfactor = NAN}.Validate(); }, "wfactor must be cv"},
      {[] { NetOptions{.iterations = 0}.Validate(); }, "iterations must be"},
      {[] { NetOptions{.egoal = -1.0}.Validate(); }, "egoal must be"},
      {[] { NetOptions{.gwgoal = 2e12}.Validate(); }, "gwgoal must be"},
      {[] { NetOptions{.slope = 0.0}.Validate(); }, "slope must be"},
      {[] { NetOptions{.evaluations = 0}.Validate(); }, "evaluations must be"},
      {[] { NetOptions{.errdel = 0.0}.Validate(); }, "errdel must be"},
      {[] { NetOptions{.nfreq = 0}.Validate(); }, "nfreq must be"},
      {[] { NetOptions{.seconds = 0.0}.Validate(); }, "seconds must be"},
      {[] { NetOptions{.starts = 0}.Validate(); }, "starts must be"},
      {[] { NetOptions{.members = 101}.Validate(); }, "members must be"},
      {[] { NetOptions{.rows = 99}.Validate(); },
       "rows must be all or a whole number from 100 on, found '99'"},
      {[] {
         NetOptions{.method = LmTraining{}, .decay = Decay::kWeights}
             .Validate();
       },
       "decay=weights is not for net:lm and net:ceres"},
      {[] { NetOptions{.wfactor = 1.0, .discrepancy = 0.1}.Validate(); },
       "discrepancy= finds the wfactor, which wfactor= fixes"},
      {[] {
         NetOptions{.method = BackpropTraining{.momentum = 1.0}}.Validate();
       },
       "momentum must be a number from 0 to 0.999999, found '1'"},
      {[] { NetOptions{.method = CeresTraining{.memory = 0}}.Validate(); },
       "memory must be"},
      {[] { NetOptions{.method = NloptTraining{.box = 0.0}}.Validate(); },
       "box must be"},
      {[] { BlendOptions{.bases = {.degree = 0}}.Validate(); },
       "degree must be"}};
  for (const auto& [validate, text] : cases) {
    EXPECT_THAT(RefusalOf(validate), HasSubstr(text));
  }
  EXPECT_THROW(MakeRecipe(NetOptions{.hidden = 0}), std::invalid_argument);
  EXPECT_THROW(OptionsOf<NetOptions>("blend"), std::invalid_argument);
}

// ---- The table of README.md.

TEST(OptionList, IsTheTableOfTheReadme) {
  std::ifstream readme(errmap::tests::SourceDir() + "/models/README.md");
  const auto quoted = [](const std::string& cell) {
    std::vector<std::string> words;
    const std::regex code("`([^`=]+)[^`]*`");
    for (std::sregex_iterator it(cell.begin(), cell.end(), code), end;
         it != end;
         ++it) {
      words.push_back((*it)[1]);
    }
    return words;
  };
  // "views" and the like stand for the options of the row of that name.
  std::map<std::string, std::vector<std::string>> sets;
  std::map<std::string, std::vector<std::string>> types;
  const std::regex row("^\\| (.+) \\| (.+) \\|( (.+))? \\|$");
  for (std::string line; std::getline(readme, line);) {
    std::smatch cells;
    if (!std::regex_match(line, cells, row)) continue;
    const std::string name = cells[1];
    std::vector<std::string> options = quoted(cells[4]);
    for (const auto& [set, of_set] : sets) {
      const std::string words = " " + cells[4].str() + ",";
      if (words.find(" " + set + ",") == std::string::npos) continue;
      options.insert(options.end(), of_set.begin(), of_set.end());
    }
    if (quoted(name).empty()) sets[name] = options;
    for (const std::string& type : quoted(name)) types[type] = options;
  }
  for (const std::string& type : ModelTypes()) {
    ASSERT_TRUE(types.contains(type)) << type;
    std::vector<std::string> names;
    for (const ModelOption& option : OptionsOfModel(type)) {
      names.push_back(option.name);
    }
    EXPECT_THAT(types[type], UnorderedElementsAreArray(names)) << type;
  }
}

}  // namespace
}  // namespace errmap::models
