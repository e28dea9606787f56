#include "cli/study_setup/provenance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/json_blocks.h"
#include "models/version.h"
#include "tests/cli/cli_fixture.h"

namespace errmap {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::MatchesRegex;

class Provenance : public Cli {};

// Of an empty file: FIPS 180-4's own example of the empty message.
constexpr const char* kEmptySha256 =
    "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";

TEST_F(Provenance, NamesEveryLibraryOnceWithAVersion) {
  const auto libraries = study_setup::MakeProvenance("", {}).libraries;
  for (const char* name : {"Boost",
                           "Ceres",
                           "Eigen",
                           "NLopt",
                           "OpenBLAS",
                           "OpenSSL",
                           "fmt",
                           "nlohmann_json",
                           "oneTBB"}) {
    EXPECT_EQ(
        std::ranges::count(
            libraries, name, [](const auto& library) { return library.first; }),
        1)
        << name;
  }
  for (const auto& [name, version] : libraries) {
    EXPECT_THAT(version, MatchesRegex("[0-9]+[.][0-9]+.*")) << name;
  }
}

TEST_F(Provenance, HoldsWhatItIsGivenBesideCompilerLibrariesAndPlatform) {
  Write("empty.csv", "");
  const std::string path = (scratch_ / "empty.csv").string();
  const cli::Json block = cli::ProvenanceJson(
      "errmap fit empty.csv", {{"seed", 7}}, {study_setup::HashInput(path)});
  EXPECT_EQ(block["command_line"], "errmap fit empty.csv");
  EXPECT_EQ(block["configuration"]["seed"], 7);
  EXPECT_EQ(
      block["inputs"],
      cli::Json::array({{{"file", "empty.csv"}, {"sha256", kEmptySha256}}}));
  EXPECT_THAT(block["compiler"].get<std::string>(), HasSubstr("++ "));
  EXPECT_THAT(block["platform"].get<std::string>(), HasSubstr(" kernels"));
  EXPECT_EQ(block["libraries"].size(),
            study_setup::MakeProvenance("", {}).libraries.size());
}

TEST_F(Provenance, RefusesAnInputThatIsNotThere) {
  EXPECT_THROW(study_setup::HashInput("no such file.csv"), data::InputError);
}

TEST_F(Provenance, OfAModelFileIsPlainTexts) {
  const models::Provenance provenance = study_setup::ModelProvenance(
      "errmap fit a.csv", {{"a.csv", "5a"}, {"b.csv", "6b"}}, 397, 12);
  EXPECT_THAT(provenance, Contains(std::pair("data_sha256", "5a")));
  EXPECT_THAT(provenance, Contains(std::pair("data_2", "b.csv")));
  EXPECT_THAT(study_setup::DataOf(provenance),
              ElementsAre(study_setup::InputFile{"a.csv", "5a"},
                          study_setup::InputFile{"b.csv", "6b"}));
  EXPECT_THAT(study_setup::DataOf({{"seed", "1"}}), IsEmpty());
  EXPECT_THAT(provenance, Contains(std::pair("rows", "397")));
  EXPECT_THAT(provenance, Contains(std::pair("seed", "12")));
  for (const auto& [key, text] : provenance) EXPECT_NE(text, "") << key;
  const auto libraries = std::ranges::find(
      provenance, "libraries", [](const auto& entry) { return entry.first; });
  ASSERT_NE(libraries, provenance.end());
  EXPECT_THAT(libraries->second, HasSubstr("Eigen 3."));
}

TEST_F(Provenance, StandsInEveryDocumentWithWhatTookEffect) {
  Write("d.csv", "position_mm,error_mm\n0,1\n1,2\n2,4\n3,5\n4,6\n5,8\n");
  const auto of = [](const Json& document) {
    const Json& block = document["provenance"];
    EXPECT_EQ(block["version"], models::Version());
    EXPECT_TRUE(block["libraries"].contains("Ceres")) << block;
    EXPECT_TRUE(block["libraries"].contains("CLI11")) << block;
    return block;
  };
  const Json fit = of(RunJson({"fit",
                               "d.csv",
                               "--model",
                               "poly:position",
                               "-o",
                               "m.json",
                               "--format",
                               "json"}));
  EXPECT_EQ(fit["configuration"]["target"], "error_mm");
  EXPECT_EQ(fit["configuration"]["seed"], 1);
  EXPECT_EQ(fit["inputs"][0]["file"], "d.csv");
  const Json compare = of(RunJson({"compare",
                                   "d.csv",
                                   "--models",
                                   "mean",
                                   "--holdout",
                                   "every:3",
                                   "--format",
                                   "json"}));
  EXPECT_EQ(compare["inputs"], fit["inputs"]);
  const Json residuals = of(RunJson(
      {"residuals", "d.csv", "--column", "error_mm", "--format", "json"}));
  EXPECT_EQ(residuals["configuration"]["position"], "position_mm");
  EXPECT_EQ(residuals["configuration"]["group"], nullptr);
  const Json evaluate =
      of(RunJson({"evaluate", "m.json", "d.csv", "--format", "json"}));
  EXPECT_EQ(evaluate["inputs"].size(), 2U);
  const Json certify =
      of(RunJson({"certify", "gradients", "--format", "json"}));
  EXPECT_EQ(certify["configuration"]["part"], "gradients");
  const Json model = Json::parse(Read("m.json"));
  EXPECT_THAT(model["provenance"]["libraries"].get<std::string>(),
              HasSubstr("OpenBLAS "));
}

TEST_F(Provenance, DoesNotTellWhereAMapIsWritten) {
  Write("d.csv", "position_mm,error_mm\n0,1\n1,2\n2,4\n3,5\n4,6\n5,8\n");
  for (const std::vector<std::string>& out :
       std::vector<std::vector<std::string>>{{"-o", "1.json"},
                                             {"-o2.json"},
                                             {"--output", "3.json"},
                                             {"--output=4.json"}}) {
    std::vector<std::string> words = {"fit", "d.csv", "--model", "mean"};
    words.insert(words.end(), out.begin(), out.end());
    EXPECT_EQ(Run(words).status, 0);
  }
  for (const char* file : {"2.json", "3.json", "4.json"}) {
    EXPECT_EQ(Read(file), Read("1.json"));
  }
}

}  // namespace
}  // namespace errmap
