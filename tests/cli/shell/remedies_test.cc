#include <gtest/gtest.h>

#include "cli/shell/standard_streams.h"

namespace errmap::cli {
namespace {

std::string Kept(std::string_view message) {
  return WithOwnRemedies(message, [](std::string_view option) {
    return option == "--missing" || option == "--time";
  });
}

TEST(WithOwnRemedies, LeavesOutWhatTheCommandLacks) {
  EXPECT_EQ(Kept("empty cell; fill it in, or leave it out with --exclude t1, "
                 "or drop such rows with --missing drop-rows (3 such cells)"),
            "empty cell; fill it in, or drop such rows with --missing "
            "drop-rows (3 such cells)");
  EXPECT_EQ(Kept("t1 never changes and is left out; --keep-dead keeps it"),
            "t1 never changes and is left out");
  EXPECT_EQ(Kept("no time; name it with --group, or with --time, or add one"),
            "no time; with --time, or add one");
}

TEST(WithOwnRemedies, LeavesQuotationsAndOtherCommandsAlone) {
  for (const char* message :
       {"no option '--quiet'; see errmap residuals --help",
        "column 'a; b --exclude c' is not a number; correct it",
        "no map; errmap fit DATA.csv --model mean -o map.json makes one",
        "--by rows is no such choice",
        "the machine's rows; --time names them"}) {
    EXPECT_EQ(Kept(message), message);
  }
}

TEST(AdviseOnly, HoldsForNoLaterRunOfAHost) {
  AdviseOnly({"--time"});
  Host host;
  const HostedRun hosted(&host);
  WriteMessage("t1 never changes and is left out; --keep-dead keeps it");
  EXPECT_EQ(host.messages,
            std::vector<std::string>{
                "t1 never changes and is left out; --keep-dead keeps it"});
}

}  // namespace
}  // namespace errmap::cli
