#include "models/model_spec.h"

#include <functional>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/recipe_catalog.h"

namespace errmap::models {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

std::string MessageOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(ModelSpec, SplitsTypeAndOptionsAtColons) {
  const ModelSpec spec = ParseModelSpec("net:scg:hidden=60:wfactor=1.3e-3");
  EXPECT_EQ(spec.type, "net:scg");
  EXPECT_THAT(spec.options,
              ElementsAre(Pair("hidden", "60"), Pair("wfactor", "1.3e-3")));
}

TEST(ModelSpec, KeepsColonsAndCommasInDoubleQuotes) {
  const ModelSpec spec = ParseModelSpec("poly:eq8:T=\"bed: top, left\"");
  EXPECT_THAT(spec.options, ElementsAre(Pair("T", "bed: top, left")));
  EXPECT_THAT(SplitList("zero,poly:eq8:T=\"a,b\", mean"),
              ElementsAre("zero", "poly:eq8:T=\"a,b\"", "mean"));
}

TEST(ModelSpec, RefusesWhatItCannotReadAndSaysWhat) {
  EXPECT_THAT(MessageOf([] { ParseModelSpec(""); }), HasSubstr("''"));
  EXPECT_THAT(MessageOf([] { ParseModelSpec("poly:eq8:T=\"a"); }),
              HasSubstr("never closed"));
  EXPECT_THAT(MessageOf([] { ParseModelSpec("poly:degree=2:full"); }),
              HasSubstr("'full' is not an option"));
  EXPECT_THAT(MessageOf([] { ParseModelSpec("poly:full:degree=2:degree=3"); }),
              HasSubstr("given twice"));
  EXPECT_THAT(MessageOf([] { SplitList("zero,,mean"); }),
              HasSubstr("empty place"));
}

TEST(RecipeCatalog, NamesTheRangeOfAnOptionAndWhatThereIs) {
  EXPECT_THAT(MessageOf([] { MakeRecipe("poly:full:degree=0"); }),
              HasSubstr("degree must be a whole number from 1 to 12"));
  EXPECT_THAT(MessageOf([] { MakeRecipe("net:scg:hidden=2.5"); }),
              HasSubstr("hidden must be cv or a whole number"));
  EXPECT_THAT(MessageOf([] { MakeRecipe("net:scg:wfactor=-1"); }),
              HasSubstr("wfactor must be cv or a number from 0"));
  EXPECT_THAT(MessageOf([] { MakeRecipe("net:scg:wfactor=nan"); }),
              HasSubstr("wfactor must be cv or a number"));
  EXPECT_THAT(MessageOf([] { MakeRecipe("net:scg:scale=raw"); }),
              HasSubstr("one of standard, range, none"));
  EXPECT_THAT(MessageOf([] { MakeRecipe("net:scg:hiden=3"); }),
              HasSubstr("no option 'hiden'; did you mean 'hidden'? net:scg "
                        "has hidden"));
  EXPECT_THAT(MessageOf([] { MakeRecipe("zero:a=1"); }),
              HasSubstr("zero takes no options"));
  EXPECT_THAT(MessageOf([] { MakeRecipe("poly:eq10"); }),
              HasSubstr("there are zero, mean"));
  EXPECT_THAT(MessageOf([] { MakeRecipe("poly:eq88"); }),
              HasSubstr("did you mean 'poly:eq8'?"));
}

TEST(RecipeCatalog, NamesTheOptionsOfEveryTypeAndNoOthers) {
  const auto names = [](const std::string& type) {
    std::vector<std::string> all;
    for (const ModelOption& option : OptionsOfModel(type)) {
      all.push_back(option.name);
    }
    return all;
  };
  EXPECT_THAT(names("poly:eq8"), ElementsAre("position", "T", "clip"));
  EXPECT_THAT(names("net:scg"), ::testing::Contains("wfactor"));
  EXPECT_THAT(names("zero"), ::testing::IsEmpty());
  EXPECT_THROW(names("poly:eq10"), std::invalid_argument);
  // Every default in use is of an option that there is.
  for (const std::string& type : ModelTypes()) {
    EXPECT_NE(AboutModel(type), "") << type;
    for (const EffectiveOption& option : MakeRecipe(type)->options()) {
      EXPECT_THAT(names(type), ::testing::Contains(option.key)) << type;
    }
  }
}

TEST(RecipeCatalog, MakesEveryTypeItLists) {
  for (const std::string& type : ModelTypes()) {
    EXPECT_EQ(MakeRecipe(type)->name(), type);
  }
}

std::int64_t IterationsOf(const ModelRecipe& recipe) {
  for (const EffectiveOption& option : recipe.options()) {
    if (option.key == "iterations") return std::get<std::int64_t>(option.value);
  }
  return -1;
}

TEST(RecipeCatalog, GivesLevenbergMarquardtFewerSteps) {
  EXPECT_EQ(IterationsOf(*MakeRecipe("net:scg")), 1500);
  EXPECT_EQ(IterationsOf(*MakeRecipe("net:lm")), 200);
  EXPECT_EQ(IterationsOf(*MakeRecipe("net:lm:iterations=7")), 7);
  EXPECT_THAT(MessageOf([] { MakeRecipe("net:lm:variant=moller"); }),
              HasSubstr("no option 'variant'"));
}

}  // namespace
}  // namespace errmap::models
