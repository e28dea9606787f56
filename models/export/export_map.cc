#include "models/export/export_map.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "data/argument_name.h"
#include "data/measurements/row_filters.h"
#include "data/way_words.h"
#include "models/export/program/map_program.h"
#include "models/export/program/run_program.h"
#include "models/export/program/safe_names.h"

namespace errmap::models {

double MapExport::tolerance() const {
  constexpr double kOtherCompiler = 2.0;
  return error_range * std::max(AllowedDeviation(precision),
                                kOtherCompiler * deviations.anywhere);
}

void RequireMadeFor(const FittedModel& fitted, Motion motion) {
  const data::ColumnFilter* filter = data::DirectionFilter(fitted.where);
  if (filter == nullptr) return;
  const std::string made_for = data::FiltersText({filter, 1});
  const std::string both = data::ArgumentName("increasing") + " and " +
                           data::ArgumentName("decreasing");
  if (motion == Motion::kAny) {
    throw std::invalid_argument(
        fmt::format("it is made for {} alone and would act in the other "
                    "direction, too; name the maps of both, {}",
                    made_for,
                    both));
  }
  const auto upwards = data::IsUpwards(ValueText(*filter));
  if (upwards && *upwards != (motion == Motion::kIncreasing)) {
    throw std::invalid_argument(
        fmt::format("it is made for {}; exchange {}", made_for, both));
  }
}

MapExport PrepareExport(const std::vector<const FittedModel*>& maps,
                        const std::string& name,
                        Precision precision,
                        const LimitOptions& limits) {
  const std::string safe = SafeIdentifier(name, kLongestMapName);
  if (safe != name) {
    throw std::invalid_argument(fmt::format(
        "a map's name has letters, digits and single '_' only, begins with a "
        "letter and has at most {} characters; such as '{}'",
        kLongestMapName,
        safe));
  }
  std::vector<MapProgram> programs;
  for (const FittedModel* map : maps) {
    programs.push_back(MakeMapProgram(*map));
  }
  MapExport made{.name = name,
                 .precision = precision,
                 .program = maps.size() == 1
                                ? programs.front()
                                : JoinedPrograms(programs[0], programs[1])};
  AddController(maps, limits, &made.program);
  made.program.export_id = ExportId(made.program, name, precision);
  for (std::size_t k = 0; k < maps.size(); ++k) {
    const std::vector<SelfTestRow> rows = SelfTestRows(*maps[k], programs[k]);
    const double range = ErrorRange(*maps[k], rows);
    const Deviations found = FindDeviations(
        made.program, precision, rows, range, static_cast<int>(k));
    made.num_checked += rows.size();
    made.error_range = std::max(made.error_range, range);
    made.deviations.inside = std::max(made.deviations.inside, found.inside);
    made.deviations.anywhere =
        std::max(made.deviations.anywhere, found.anywhere);
  }
  DropIdleGuards(&made.program);
  made.rows = ControllerSession(*maps.front(), made.program, precision);
  if (precision == Precision::kSingle &&
      !(made.deviations.inside <= AllowedDeviation(precision))) {
    throw std::invalid_argument(
        fmt::format("in single precision it errs by {:.1e} of the target's "
                    "range, {:.0e} is allowed: export it in double",
                    made.deviations.inside,
                    AllowedDeviation(precision)));
  }
  return made;
}

}  // namespace errmap::models
