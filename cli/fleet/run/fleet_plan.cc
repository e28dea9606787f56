#include <algorithm>
#include <exception>
#include <new>

#include "cli/fleet/run/fleet_run.h"
#include "cli/study_setup/plan/study_forecast.h"
#include "cli/study_setup/plan/study_plan.h"
#include "data/text.h"

namespace errmap::fleet {
namespace {

// Rows and inputs as numbers, in some copies, designs of a few hundred columns,
// and the program itself.
double MebibytesOf(const models::ComponentPlan& component) {
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

FleetPlan PlanFleet(const study_setup::StudyConfig& config) {
  constexpr std::size_t kMostLookedAt = 24;
  FleetPlan plan;
  const std::size_t count = config.components.size();
  plan.components = static_cast<std::int64_t>(count);
  const std::size_t sample = std::min(count, kMostLookedAt);
  for (std::size_t i = 0; i < sample; ++i) {
    const study_setup::ComponentConfig& component =
        config.components[i * count / sample];
    study_setup::StudyConfig study = config;
    study.components = {component};
    ++plan.looked_at;
    try {
      const study_setup::StudyPlan one = study_setup::PlanStudy(study);
      plan.fits += one.num_fits();
      for (const models::ComponentPlan& way : one.components) {
        plan.seconds += study_setup::RoughSeconds(way, 1);
        plan.largest_mib = std::max(plan.largest_mib, MebibytesOf(way));
      }
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      plan.unusable.push_back(data::Printable(component.name) + ": " +
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

}  // namespace errmap::fleet
