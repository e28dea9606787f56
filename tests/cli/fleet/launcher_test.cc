#include "cli/fleet/commands/launcher.h"

#include <map>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/command.h"

namespace errmap::cli {
namespace {

using ::testing::HasSubstr;
using Variables = std::map<std::string, std::string>;

std::string Found(const std::string& text, const Variables& variables = {}) {
  try {
    const fleet::Share share = ShareOf(text, [&](const char* name) {
      const auto found = variables.find(name);
      return found == variables.end() ? nullptr : found->second.c_str();
    });
    return std::to_string(share.index) + "/" + std::to_string(share.count);
  } catch (const UsageError& error) {
    return error.what();
  }
}

Variables Array(const char* id,
                const char* min,
                const char* max,
                const char* count) {
  return {{"SLURM_ARRAY_TASK_ID", id},
          {"SLURM_ARRAY_TASK_MIN", min},
          {"SLURM_ARRAY_TASK_MAX", max},
          {"SLURM_ARRAY_TASK_COUNT", count}};
}

TEST(ShareOf, ReadsAShare) {
  EXPECT_EQ(Found("3/8"), "3/8");
  for (const char* text :
       {"8/8", "-1/8", "1/0", "1", "/", "1/8x", "a/b", "", "1/99999999"}) {
    EXPECT_THAT(Found(text), HasSubstr("give I/N")) << text;
  }
}

TEST(ShareOf, AsksLaunchersInTheirOrder) {
  Variables all = Array("4", "0", "7", "8");
  EXPECT_EQ(Found("env", all), "4/8");
  all["SLURM_PROCID"] = "0";
  all["SLURM_NTASKS"] = "1";  // a task of the array, not of an srun
  EXPECT_EQ(Found("env", all), "4/8");
  all["SLURM_NTASKS"] = "3";
  EXPECT_EQ(Found("env", all), "0/3");
  all["PMI_RANK"] = "1";
  all["PMI_SIZE"] = "2";
  EXPECT_EQ(Found("env", all), "1/2");
  all["OMPI_COMM_WORLD_RANK"] = "5";
  all["OMPI_COMM_WORLD_SIZE"] = "6";
  EXPECT_EQ(Found("env", all), "5/6");
}

TEST(ShareOf, CountsAnArrayFromItsFirstTaskByItsStep) {
  Variables array = Array("9", "1", "13", "4");
  array["SLURM_ARRAY_TASK_STEP"] = "4";
  EXPECT_EQ(Found("env", array), "2/4");
}

TEST(ShareOf, RefusesAnArrayWithGapsAndWhatIsHalfSet) {
  // sbatch --array=3,7
  EXPECT_THAT(Found("env", Array("7", "3", "7", "2")),
              HasSubstr("shares would be left out"));
  EXPECT_THAT(Found("env"), HasSubstr("no launcher's variables"));
  EXPECT_THAT(Found("env", {{"PMI_RANK", "1"}}),
              HasSubstr("PMI_SIZE is not set"));
  EXPECT_THAT(Found("env", {{"PMI_RANK", "2"}, {"PMI_SIZE", "2"}}),
              HasSubstr("is not a share"));
  EXPECT_THAT(Found("env", {{"PMI_RANK", "x"}, {"PMI_SIZE", "2"}}),
              HasSubstr("no whole number"));
}

}  // namespace
}  // namespace errmap::cli
