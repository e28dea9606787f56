#pragma once

#include <string>
#include <vector>

#include "cli/json_blocks.h"
#include "models/netcg/netcg_files.h"
#include "models/netcg/report_study.h"

namespace errmap::cli {

/// errmap-netcg-1: runs of a run file.
Json NetcgJson(const std::string& file,
               const std::vector<models::NetcgRecord>& records,
               const models::NetcgOptions& options);

/// errmap-netcg-study-1: the nine experiments beside the report's.
Json NetcgStudyJson(const models::NetcgStudy& study);

}  // namespace errmap::cli
