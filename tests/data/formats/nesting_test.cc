#include "data/formats/nesting.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/input_error.h"

namespace errmap::data {
namespace {

TEST(Nesting, CountsBracketsOutsideOfStrings) {
  const std::string most(kMostNesting, '[');
  EXPECT_TRUE(IsShallowJson(most));
  EXPECT_FALSE(IsShallowJson(most + "{"));
  EXPECT_TRUE(IsShallowJson(most + "]["));
  EXPECT_TRUE(IsShallowJson(most + "\"[[[\\\"[[[\""));
  EXPECT_FALSE(IsShallowJson(most + "\"\\\\\"["));
  // Ends that nothing began lend no depth to what follows.
  EXPECT_FALSE(IsShallowJson("]]]]" + most + "["));
}

TEST(Nesting, SaysWhatIsTooDeep) {
  RequireShallowJson("{\"a\": [1]}");
  EXPECT_THAT([] { RequireShallowJson(std::string(kMostNesting + 1, '[')); },
              ::testing::ThrowsMessage<InputError>(
                  ::testing::HasSubstr("nested deeper than 64 brackets")));
}

}  // namespace
}  // namespace errmap::data
