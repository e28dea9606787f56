#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "models/netcg/netcg_files.h"
#include "models/netcg/report_study.h"

namespace errmap::models {

/// errmap-netcg-1: runs of a run file.
nlohmann::ordered_json NetcgJson(const std::string& file,
                                 const std::vector<NetcgRecord>& records,
                                 const NetcgOptions& options);

/// errmap-netcg-study-1: the nine experiments beside the report's.
nlohmann::ordered_json NetcgStudyJson(const NetcgStudy& study);

}  // namespace errmap::models
