#include "cli/study_file/provenance.h"

#include <algorithm>

#include <CLI/Version.hpp>
#include <Eigen/Core>
#include <fmt/format.h>
#include <oneapi/tbb/version.h>
#include <openssl/crypto.h>

#include "cli/shell/shown_path.h"
#include "data/atomic_file.h"
#include "data/sha256.h"
#include "fitting/matrix_product.h"
#include "fitting/minimisers/ceres_optimizer.h"
#include "fitting/minimisers/nlopt_optimizer.h"
#include "models/net/net_kernels.h"
#include "models/study/record/record_json.h"
#include "models/version.h"
#include "stats/distributions.h"

namespace errmap::cli {
namespace {

std::string Compiler() {
#if defined(__clang__)
  return "clang++ " __clang_version__ ", " ERRMAP_BUILD_TYPE;
#else
  return "g++ " __VERSION__ ", " ERRMAP_BUILD_TYPE;
#endif
}

// The nets' loops are chosen at run time, and their bits with them.
std::string Platform() {
  return fmt::format("{}, {} kernels",
                     ERRMAP_PROCESSOR,
                     models::FastestNetKernels<double>().name);
}

std::string FmtVersion() {
  return fmt::format("{}.{}.{}",
                     FMT_VERSION / 10000,
                     FMT_VERSION / 100 % 100,
                     FMT_VERSION % 100);
}

}  // namespace

InputFile HashInput(const std::string& file) {
  return {file, data::Sha256(data::ReadFile(file))};
}

const std::vector<std::pair<std::string, std::string>>& LibraryVersions() {
  static const std::vector<std::pair<std::string, std::string>> versions = {
      {"Boost", stats::BoostVersion()},
      {"CLI11", CLI11_VERSION},
      {"Ceres", fitting::CeresVersion()},
      {"Eigen",
       fmt::format("{}.{}.{}",
                   EIGEN_WORLD_VERSION,
                   EIGEN_MAJOR_VERSION,
                   EIGEN_MINOR_VERSION)},
      {"NLopt", fitting::NloptVersion()},
      {"OpenBLAS", fitting::OpenBlasConfiguration()},
      {"OpenSSL", OpenSSL_version(OPENSSL_FULL_VERSION_STRING)},
      {"fmt", FmtVersion()},
      {"nlohmann_json",
       fmt::format("{}.{}.{}",
                   NLOHMANN_JSON_VERSION_MAJOR,
                   NLOHMANN_JSON_VERSION_MINOR,
                   NLOHMANN_JSON_VERSION_PATCH)},
      {"oneTBB",
       fmt::format("{}.{}.{}",
                   TBB_VERSION_MAJOR,
                   TBB_VERSION_MINOR,
                   TBB_VERSION_PATCH)},
  };
  return versions;
}

models::ProvenanceRecord MakeProvenance(const std::string& command_line,
                                        const std::vector<InputFile>& inputs) {
  models::ProvenanceRecord record;
  record.version = models::Version();
  record.command_line = command_line;
  for (const InputFile& input : inputs) {
    record.inputs.push_back(
        {.file = ShownPath(input.file), .sha256 = input.sha256});
  }
  record.compiler = Compiler();
  record.libraries = LibraryVersions();
  record.platform = Platform();
  return record;
}

Json ProvenanceJson(const std::string& command_line,
                    const Json& configuration,
                    const std::vector<InputFile>& inputs) {
  Json json = models::ToJson(MakeProvenance(command_line, inputs));
  json["configuration"] = configuration;
  return json;
}

models::Provenance ModelProvenance(const std::string& command_line,
                                   const InputFile& data,
                                   long long rows,
                                   unsigned long long seed) {
  std::string libraries;
  for (const auto& [name, version] : LibraryVersions()) {
    libraries +=
        fmt::format("{}{} {}", libraries.empty() ? "" : ", ", name, version);
  }
  return {{"command_line", command_line},
          {"data", ShownPath(data.file)},
          {"data_sha256", data.sha256},
          {"rows", std::to_string(rows)},
          {"seed", std::to_string(seed)},
          {"compiler", Compiler()},
          {"libraries", libraries},
          {"platform", Platform()}};
}

}  // namespace errmap::cli
