#include "data/argument_name.h"

#include <gtest/gtest.h>

namespace errmap::data {
namespace {

std::string Shouted(std::string_view member, std::string_view value) {
  return std::string(member) + "!" + std::string(value);
}

TEST(ArgumentName, IsTheMembersUnlessTheProgramHasAnother) {
  EXPECT_EQ(ArgumentName("keep_dead"), "keep_dead");
  EXPECT_EQ(ArgumentName("exclude", "t3"), "exclude = t3");
  NameArgumentsBy(Shouted);
  EXPECT_EQ(ArgumentName("exclude", "t3"), "exclude!t3");
  NameArgumentsBy(nullptr);
  EXPECT_EQ(ArgumentName("keep_dead"), "keep_dead");
}

}  // namespace
}  // namespace errmap::data
