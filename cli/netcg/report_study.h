#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/netcg/netcg_files.h"

namespace errmap::netcg {

/// A training run of NISTIR 5367 with its values in Tables 3 and 4; errors in
/// mm.
struct ReportRun {
  int number = 0;
  bool down = true;  // the direction of motion, else up
  Index hidden = 0;
  std::string_view selection;  // of thermocouples
  Index patterns = 0;
  int thermocouples = 0;  // as printed
  int input_nodes = 0;    // as printed
  Index weights = 0;
  double mean = 0.0;
  double sd = 0.0;
  double min = 0.0;
  double max = 0.0;
  double iteration_seconds = 0.0;  // on the CONVEX C3820
  double iteration_seconds_sd = 0.0;
  double elapsed_seconds = 0.0;

  /// Number of thermocouples implied by the number of weights: W = (I+1)H +
  /// H+1.
  int implied_thermocouples() const {
    return static_cast<int>((weights - hidden - 1) / hidden) - 2;
  }
};

struct NetcgStudyOptions {
  NetcgOptions netcg;
  std::int64_t iterations = 1500;
  int jobs = 0;  // runs at a time; 0 = one per processor
};

struct NetcgStudyRun {
  ReportRun report;
  std::vector<int> thermocouples;
  int starts = 0;      // seeds tried
  NetcgRecord record;  // without its files
};

struct NetcgStudy {
  std::string folder;
  NetcgStudyOptions options;
  std::vector<NetcgStudyRun> runs = {};
  double seconds = 0.0;                 // of all runs together
  std::vector<std::string> notes = {};  // where it differs from the report
  /// If options.netcg.out is given: the files of all runs, with the run file
  /// and pattern files that reproduce them.
  std::vector<NetcgOutputFile> files = {};
};

/// Runs the report's nine experiments on a folder of `errmap simulate
/// turning-centre`. They use x_displacement_down.csv and x_displacement_up.csv,
/// but only day 1 if there is a column `day`. Training rows are i % 3 != 2 down
/// and i % 2 == 0 up, as the report's counts of 397 and 298 of 595 imply.
/// Thermocouples are those of sections 9.1 to 9.8, except those that are dead
/// in the files. All other settings are those of Appendix B. Results do not
/// depend on options.jobs. Throws InputError naming file and column.
NetcgStudy RunReportStudy(const std::string& folder,
                          const NetcgStudyOptions& options);

/// Returns Table 4 as text: our results beside the report's, in um and seconds.
std::string StudyText(const NetcgStudy& study);

}  // namespace errmap::netcg
