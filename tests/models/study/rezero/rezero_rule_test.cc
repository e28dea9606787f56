#include "models/study/rezero/rezero_rule.h"

#include <cmath>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace errmap::models {
namespace {

TEST(RezeroRule, ReadsIntervalsInSeconds) {
  std::string noise;
  EXPECT_EQ(ParseRezero("2h", &noise).interval, 7200.0);
  EXPECT_EQ(ParseRezero("90min", &noise).interval, 5400.0);
  EXPECT_EQ(ParseRezero("0.5d", &noise).interval, 43200.0);
  EXPECT_EQ(ParseRezero("5", &noise).interval, 5.0);
  EXPECT_EQ(noise, "");
  const RezeroRule rule = ParseRezero("30s:noise=0.5um", &noise);
  EXPECT_EQ(rule.kind, RezeroKind::kEvery);
  EXPECT_EQ(rule.interval, 30.0);
  EXPECT_EQ(noise, "0.5um");
  EXPECT_EQ(rule.text, "30s:noise=0.5um");
}

TEST(RezeroRule, ReadsSessionsAndProbes) {
  std::string noise;
  EXPECT_EQ(ParseRezero("session", &noise).kind, RezeroKind::kSession);
  EXPECT_EQ(ParseRezero("probe:noise=1", &noise).kind, RezeroKind::kProbe);
  EXPECT_EQ(noise, "1");
  EXPECT_TRUE(std::isinf(ParseRezero("session", &noise).interval));
}

TEST(RezeroRule, RefusesOtherWords) {
  std::string noise;
  for (const char* text :
       {"", "2x", "h", "-2h", "0h", "2h:", "2h:noise=", "2h:sd=1", "day"}) {
    EXPECT_THROW(ParseRezero(text, &noise), std::invalid_argument) << text;
  }
}

}  // namespace
}  // namespace errmap::models
