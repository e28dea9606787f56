#include <algorithm>
#include <utility>

#include <Eigen/Core>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <oneapi/tbb/version.h>

#include "data/sha256.h"
#include "fitting/matrix_product.h"
#include "fitting/minimisers/ceres_optimizer.h"
#include "fitting/minimisers/nlopt_optimizer.h"
#include "models/net/net_kernels.h"
#include "models/study/record/provenance_record.h"
#include "models/version.h"
#include "stats/distributions.h"

namespace errmap::models {
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
  return fmt::format(
      "{}, {} kernels", ERRMAP_PROCESSOR, FastestNetKernels<double>().name);
}

std::string FmtVersion() {
  return fmt::format("{}.{}.{}",
                     FMT_VERSION / 10000,
                     FMT_VERSION / 100 % 100,
                     FMT_VERSION % 100);
}

ByName<std::string>& LibraryVersions() {
  static ByName<std::string> versions = {
      {"Boost", stats::BoostVersion()},
      {"Ceres", fitting::CeresVersion()},
      {"Eigen",
       fmt::format("{}.{}.{}",
                   EIGEN_WORLD_VERSION,
                   EIGEN_MAJOR_VERSION,
                   EIGEN_MINOR_VERSION)},
      {"NLopt", fitting::NloptVersion()},
      {"OpenBLAS", fitting::OpenBlasConfiguration()},
      {"OpenSSL", data::OpenSslVersion()},
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

}  // namespace

void NameLibrary(const std::string& name, const std::string& version) {
  ByName<std::string>& versions = LibraryVersions();
  versions.insert(std::ranges::upper_bound(versions, std::pair(name, version)),
                  {name, version});
}

ProvenanceRecord MakeProvenance(std::string command_line,
                                std::vector<InputFileRecord> inputs) {
  return {.version = std::string(Version()),
          .command_line = std::move(command_line),
          .inputs = std::move(inputs),
          .compiler = Compiler(),
          .libraries = LibraryVersions(),
          .platform = Platform()};
}

}  // namespace errmap::models
