#include "cli/commands/fleet/fleet_plan_text.h"

#include <fmt/format.h>

#include "cli/desk/plan/rough_time.h"
#include "cli/report/number_text.h"
#include "data/text.h"

namespace errmap::cli {

std::string FleetPlanText(const fleet::FleetPlan& plan,
                          std::int64_t tasks,
                          int jobs,
                          const std::string& out) {
  std::string text = fmt::format(
      "{}, of which {} were looked at\nsome {:.0f} fits in all; roughly {} on "
      "{} of {}\n",
      report::Count(plan.components, "component"),
      plan.looked_at,
      plan.fits,
      desk::RoughTimeText(plan.seconds / static_cast<double>(tasks * jobs)),
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
