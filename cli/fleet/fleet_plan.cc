#include "cli/fleet/fleet_plan.h"

#include <algorithm>
#include <exception>
#include <new>

#include <fmt/format.h>

#include "cli/study_file/plan/rough_time.h"
#include "cli/study_file/plan/study_plan.h"
#include "data/text.h"
#include "models/report/number_text.h"

namespace errmap::cli {
namespace {

// Rows and inputs as numbers, in some copies, designs of a few hundred columns,
// and the program itself.
double MebibytesOf(const ComponentPlan& component) {
  constexpr double kProgram = 200.0;
  constexpr double kColumns = 400.0;
  constexpr double kBytes = 8.0;
  const data::Dataset& dataset = component.comparison.data.dataset;
  return kProgram +
         kBytes * static_cast<double>(dataset.num_rows()) *
             (kColumns + 4.0 * static_cast<double>(dataset.num_inputs())) /
             (1 << 20U);
}

}  // namespace

FleetPlan PlanFleet(const StudyConfig& config) {
  constexpr std::size_t kMostLookedAt = 24;
  FleetPlan plan;
  const std::size_t count = config.components.size();
  plan.components = static_cast<std::int64_t>(count);
  const std::size_t sample = std::min(count, kMostLookedAt);
  for (std::size_t i = 0; i < sample; ++i) {
    const ComponentConfig& component = config.components[i * count / sample];
    StudyConfig study = config;
    study.components = {component};
    ++plan.looked_at;
    try {
      const StudyPlan one = PlanStudy(study, true);
      plan.fits += one.num_fits();
      plan.seconds += RoughSeconds(one.components.front(), 1);
      plan.largest_mib =
          std::max(plan.largest_mib, MebibytesOf(one.components.front()));
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      plan.unusable.push_back(
          data::Printable(component.name, component.name.size()) + ": " +
          error.what());
    }
  }
  const double factor =
      sample == 0 ? 0.0
                  : static_cast<double>(count) / static_cast<double>(sample);
  plan.fits *= factor;
  plan.seconds *= factor;
  return plan;
}

std::string FleetPlanText(const FleetPlan& plan,
                          std::int64_t tasks,
                          int jobs,
                          const std::string& out) {
  std::string text = fmt::format(
      "{}, of which {} were looked at\nsome {:.0f} fits in all; roughly {} on "
      "{} of {}\n",
      report::Count(plan.components, "component"),
      plan.looked_at,
      plan.fits,
      RoughTimeText(plan.seconds / static_cast<double>(tasks * jobs)),
      report::Count(tasks, "task"),
      report::Count(jobs, "job"));
  for (const std::string& line : plan.unusable) {
    text += "unusable: " + line + "\n";
  }
  text += out.empty() ? std::string("no files (give --out STORE for them)\n")
                      : fmt::format(
                            "files in {}: fleet.json, components/, "
                            "errmap.sqlite, report.html\n",
                            data::PrintablePath(out));
  return text + "Nothing was fitted or written (--dry-run).\n";
}

}  // namespace errmap::cli
