#include "models/members.h"

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace errmap::models {

struct MembersExample {
  struct Inner {
    double depth = 0.5;
  };
  std::string name = "a";
  std::optional<std::string> why;
  std::vector<bool> flags;
  std::variant<double, std::string> value;
  Inner inner;
  std::array<double, 2> both = {1.0, 2.0};
  static constexpr int kNoMember = 3;
  int last_of_all = 7;
};
class HiddenMembers {
 public:
  int hidden() const { return hidden_; }

 private:
  int hidden_ = 0;
};

namespace {

template <typename T>
std::vector<std::string> NamesIn(const T& record) {
  std::vector<std::string> names;
  VisitMembers(record, [&](std::string_view name, const auto& /*member*/) {
    names.emplace_back(name);
  });
  return names;
}

TEST(Members, AreVisitedByNameInTheOrderOfTheirDeclaration) {
  EXPECT_THAT(
      NamesIn(MembersExample()),
      ::testing::ElementsAre(
          "name", "why", "flags", "value", "inner", "both", "last_of_all"));
  EXPECT_THAT(NamesIn(MembersExample::Inner()),
              ::testing::ElementsAre("depth"));
}

TEST(Members, AreThoseOfTheRecordItself) {
  MembersExample record;
  VisitMembers(record, [](std::string_view name, auto& member) {
    if constexpr (requires { member += 1; }) {
      if (name == "last_of_all") member += 1;
    }
  });
  EXPECT_EQ(record.last_of_all, 8);
  EXPECT_EQ(&members::Get<0>(MembersOf(record)), &record.name);
}

TEST(Members, AreNotSeenInWhatHasAFormOfItsOwn) {
  EXPECT_TRUE(Record<MembersExample>);
  EXPECT_FALSE(Record<HiddenMembers>);
  EXPECT_FALSE(Record<std::string>);
  EXPECT_FALSE((Record<std::array<double, 2>>));
  EXPECT_FALSE((Record<std::pair<int, int>>));
  EXPECT_FALSE(Record<int>);
}

}  // namespace
}  // namespace errmap::models
