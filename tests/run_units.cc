// Runs the tests of an executable that holds several units:
//
//   FOLDER_tests [--unit=NAME] [GoogleTest's options]
//
// --unit=NAME runs those of NAME_test.cc alone; a NAME without a test fails.

#include <cstdio>
#include <cstdlib>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

// A filter for the tests that stand in UNIT_test.cc; "" where there is none.
std::string FilterOf(const std::string& unit) {
  const std::string file = "/" + unit + "_test.cc";
  std::set<std::string> names;
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  for (int s = 0; s < all.total_test_suite_count(); ++s) {
    const testing::TestSuite& suite = *all.GetTestSuite(s);
    for (int t = 0; t < suite.total_test_count(); ++t) {
      const testing::TestInfo& test = *suite.GetTestInfo(t);
      if (std::string(test.file()).ends_with(file)) {
        names.insert(std::string(suite.name()) + "." + test.name());
      }
    }
  }
  std::string filter;
  for (const std::string& name : names) {
    filter += (filter.empty() ? "" : ":") + name;
  }
  return filter;
}

}  // namespace

int main(int argc, char** argv) {
  setenv("XDG_CACHE_HOME", "/dev/null", 1);  // as CTest does
  testing::InitGoogleMock(&argc, argv);
  const std::string option = "--unit=";
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (!word.starts_with(option)) {
      std::fprintf(stderr, "%s: unknown option %s\n", argv[0], argv[i]);
      return 2;
    }
    const std::string filter = FilterOf(word.substr(option.size()));
    if (filter.empty()) {
      std::fprintf(stderr, "%s: no test in a file of %s\n", argv[0], argv[i]);
      return 1;
    }
    GTEST_FLAG_SET(filter, filter);
  }
  return RUN_ALL_TESTS();
}
