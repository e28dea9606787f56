#include "cli/turning_centre/simulation_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "data/argument_name.h"

namespace errmap::turning_centre {
namespace {

// A component's CSV file.
struct ComponentFile {
  Component component;
  Direction direction;
};

std::string_view DirectionWord(Slide slide, Direction direction) {
  const bool forward = direction == Direction::kForward;
  if (slide == Slide::kX) return forward ? "down" : "up";
  return forward ? "forward" : "reverse";
}

// Of the files of a component's readings, and of its map.
std::string StemOf(Component component, Direction direction) {
  const ComponentTraits& traits = TraitsOf(component);
  std::string stem(traits.stem);
  if (traits.has_direction) {
    stem += "_";
    stem += DirectionWord(traits.slide, direction);
  }
  return stem;
}

std::vector<ComponentFile> ComponentFiles() {
  std::vector<ComponentFile> files;
  for (const Component component : kComponents) {
    files.push_back({component, Direction::kForward});
    if (TraitsOf(component).has_direction) {
      files.push_back({component, Direction::kReverse});
    }
  }
  return files;
}

std::string SensorColumns() {
  std::string text;
  for (std::size_t i = 0; i < kNumThermocouples; ++i) {
    text += fmt::format(",t{:02}_degC", i);
  }
  return text;
}

void AppendReadings(const Thermocouples::Readings& readings,
                    std::string* text) {
  for (const double reading : readings) *text += "," + SevenDigits(reading);
}

// The instruments show 0.01 um and 0.01 urad.
double AsDisplayed(double value, bool is_angle) {
  const double steps = is_angle ? 1e2 : 1e5;
  return std::floor(value * steps + 0.5) / steps;
}

bool IsRowOf(const ComponentFile& file, const Stop& stop) {
  const Slide slide = TraitsOf(file.component).slide;
  if (slide == Slide::kNone) return stop.index == kStopsPerSweep - 1;
  return stop.slide() == slide && stop.direction() == file.direction;
}

std::string ComponentCsv(const Simulation& simulation,
                         const FileOptions& options,
                         const ComponentFile& file) {
  const ComponentTraits& traits = TraitsOf(file.component);
  const bool has_position = traits.slide != Slide::kNone;
  const std::string unit = traits.is_angle ? "urad" : "mm";
  std::string text = "record,day,cycle,time_s";
  if (has_position) text += ",position_mm";
  text += SensorColumns() + ",error_" + unit;
  if (options.truth) text += ",truth_" + unit;
  text += "\n";

  constexpr double kMmPerUm = 1e-3;
  const double noise_sd = traits.is_angle
                              ? simulation.options.noise_urad
                              : kMmPerUm * simulation.options.noise_um;
  const auto stream = 2 * static_cast<std::uint64_t>(file.component) +
                      static_cast<std::uint64_t>(file.direction);
  RandomStream noise(simulation.options.seed, Purpose::kReadingNoise, stream);
  const bool is_shifted = file.component == Component::kXDisplacement ||
                          file.component == Component::kZDisplacement;
  int record = 0;
  for (const Stop& stop : simulation.stops) {
    if (!IsRowOf(file, stop)) continue;
    const double position = has_position ? stop.position() : 0.0;
    const double truth =
        TrueError(file.component, position, file.direction, stop.rise) +
        (is_shifted ? stop.shift : 0.0);
    const double reading = truth + noise_sd * noise.Normal();
    text += fmt::format(
        "{},{},{},{}", ++record, stop.day, stop.cycle, stop.time_s());
    if (has_position) text += "," + SevenDigits(position);
    AppendReadings(stop.readings, &text);
    text += "," + SevenDigits(AsDisplayed(reading, traits.is_angle));
    if (options.truth) text += "," + SevenDigits(truth);
    text += "\n";
  }
  return text;
}

std::string PoseHeader(const std::string& more) {
  return "record,day,cycle,time_s" + more +
         ",x_mm,x_direction,z_mm,z_direction" + SensorColumns() +
         ",error_x_mm,error_y_mm,error_z_mm\n";
}

// `more`: cells of the columns that PoseHeader was given.
std::string PoseLine(const Simulation& simulation,
                     int record,
                     const std::string& more,
                     const ToolTipPoint& point) {
  const auto word = [](Direction direction) {
    return direction == Direction::kForward ? "forward" : "reverse";
  };
  const Stop& stop = simulation.stops[point.stop];
  const ToolTipError error = ToolTipErrorAt(
      point.x, point.x_direction, point.z, point.z_direction, stop.rise);
  std::string text = fmt::format("{},{},{},{}{},{},{},{},{}",
                                 record,
                                 stop.day,
                                 stop.cycle,
                                 stop.time_s(),
                                 more,
                                 SevenDigits(point.x),
                                 word(point.x_direction),
                                 SevenDigits(point.z),
                                 word(point.z_direction));
  AppendReadings(stop.readings, &text);
  return text + "," + SevenDigits(error.x + stop.shift) + "," +
         SevenDigits(error.y) + "," + SevenDigits(error.z + stop.shift) + "\n";
}

std::string ToolTipCsv(const Simulation& simulation, const FileOptions&) {
  std::string text = PoseHeader("");
  int record = 0;
  for (const ToolTipPoint& point : simulation.points) {
    text += PoseLine(simulation, ++record, "", point);
  }
  return text;
}

// The last stop of each cycle after which diagonals are run: five a day, or as
// many as there are.
std::vector<std::size_t> StopsOfDiagonals(const Simulation& simulation) {
  constexpr int kRunsPerDay = 5;
  const int cycles = simulation.options.cycles;
  const int runs = std::min(kRunsPerDay, cycles);
  std::vector<std::size_t> stops;
  for (int day = 0; day < simulation.options.days; ++day) {
    for (int run = 1; run <= runs; ++run) {
      const int cycle = day * cycles + run * cycles / runs;
      stops.push_back(
          static_cast<std::size_t>(cycle * kNumSweeps * kStopsPerSweep) - 1);
    }
  }
  return stops;
}

// Runs along both diagonals of the measured face, forth and back.
std::string DiagonalsCsv(const Simulation& simulation, const FileOptions&) {
  constexpr int kEvery = 2;  // stop of a sweep
  std::string text = PoseHeader(",diagonal,diagonal_direction");
  int record = 0;
  for (const std::size_t stop : StopsOfDiagonals(simulation)) {
    for (const bool z_rises : {true, false}) {
      for (const bool forth : {true, false}) {
        for (int i = 0; i < kStopsPerSweep; i += kEvery) {
          // X rises along both: towards home, which is reverse.
          const int x = forth ? kStopsPerSweep - i : i + 1;
          const int z = z_rises ? x : kStopsPerSweep + 1 - x;
          const auto direction = [](bool rises) {
            return rises ? Direction::kReverse : Direction::kForward;
          };
          text += PoseLine(simulation,
                           ++record,
                           std::string(z_rises ? ",p0p," : ",p0n,") +
                               (forth ? "forward" : "reverse"),
                           {.stop = stop,
                            .x = -kXStep * x,
                            .z = -kZStep * z,
                            .x_direction = direction(forth),
                            .z_direction = direction(forth == z_rises)});
        }
      }
    }
  }
  return text;
}

std::string TemperaturesCsv(const Simulation& simulation, const FileOptions&) {
  std::string text = "record,day,time_s" + SensorColumns() + "\n";
  int record = 0;
  for (const LogEntry& entry : simulation.log) {
    text += fmt::format("{},{},{}", ++record, entry.day, entry.time_s);
    AppendReadings(entry.readings, &text);
    text += "\n";
  }
  return text;
}

// "EXX = { forward = "...", reverse = "..." }" or "EBX = "..."".
std::string TomlError(Component component) {
  const ComponentTraits& traits = TraitsOf(component);
  const std::string forward = StemOf(component, Direction::kForward);
  if (!traits.has_direction) {
    return fmt::format("{} = \"{}.json\"", traits.letters, forward);
  }
  return fmt::format(R"({} = {{ forward = "{}.json", reverse = "{}.json" }})",
                     traits.letters,
                     forward,
                     StemOf(component, Direction::kReverse));
}

std::string TomlErrors(const std::vector<Component>& components) {
  std::vector<std::string> errors;
  for (const Component component : components) {
    errors.push_back(TomlError(component));
  }
  return fmt::format("errors = {{ {} }}", fmt::join(errors, ", "));
}

std::string MachineToml(const Simulation&, const FileOptions&) {
  return fmt::format(
      R"(# The simulated turning centre: from the bed to the tool, and to the work.
# Fit a map to each CSV file beside this and save it as STEM.json, for example
#   errmap fit x_displacement_down.csv --model poly:stepwise -o x_displacement_down.json
# Forward is away from home (X down, Z towards the spindle head).
name = "turning centre"
length = "mm"
angle = "rad"
sensitive = ["X", "Z"]

[[link]]                     # parallelism of Z to the cold spindle axis
name = "0Z"
branch = "tool"
joint = "fixed"
offset = [0, 0, 0]
{}

[[link]]
name = "Z"
branch = "tool"
joint = "linear"
axis = [0, 0, 1]
coordinate = "z_mm"
offset = [0, 0, {}]
{}

[[link]]                     # orthogonality of X to Z
name = "0X"
branch = "tool"
joint = "fixed"
offset = [0, 0, 0]
{}

[[link]]
name = "X"
branch = "tool"
joint = "linear"
axis = [1, 0, 0]
coordinate = "x_mm"
offset = [{}, 0, 0]
{}

[[link]]                     # from the X slide's measuring point to the tool tip
name = "tool"
branch = "tool"
joint = "fixed"
offset = [0, 0, {}]

[[link]]                     # thermal drift of the spindle
name = "0C"
branch = "work"
joint = "fixed"
offset = [0, 0, 0]
{}
)",
      TomlErrors({Component::kParallelism}),
      kZHomeDistance,
      TomlErrors({Component::kZDisplacement,
                  Component::kZStraightness,
                  Component::kZYaw}),
      TomlErrors({Component::kOrthogonality}),
      kXHomeHeight,
      TomlErrors({Component::kXDisplacement,
                  Component::kXStraightness,
                  Component::kXYaw}),
      kToolTipZ,
      TomlErrors({Component::kSpindleAxial,
                  Component::kSpindleRadialX,
                  Component::kSpindleRadialY,
                  Component::kSpindleTiltXz,
                  Component::kSpindleTiltYz}));
}

std::string ListOfNumbers(const std::vector<int>& numbers) {
  return numbers.empty() ? "none" : fmt::format("{}", fmt::join(numbers, ", "));
}

std::string ClockTime(int seconds) {
  constexpr int kPerMinute = 60;
  return fmt::format("{:02}:{:02}",
                     seconds / kSecondsPerHour,
                     seconds % kSecondsPerHour / kPerMinute);
}

std::string Range(std::size_t first, std::size_t last) {
  const std::string text = std::to_string(first);
  return first == last ? text : text + "-" + std::to_string(last);
}

// The days, block of like cycles by block.
std::string ProgrammeTable(const Simulation& simulation) {
  std::string text =
      "| day | start | air at start, degC | cycles | pause before, min | "
      "spindle, 1/min | feed duty | cutting load | coolant |\n"
      "|---|---|---|---|---|---|---|---|---|\n";
  constexpr double kPerHour = 3600.0;
  constexpr int kPerMinute = 60;
  std::size_t before = 0;
  for (std::size_t day = 0; day < simulation.programmes.size(); ++day) {
    const DayProgramme& programme = simulation.programmes[day];
    const std::vector<CyclePlan>& cycles = programme.cycles;
    for (std::size_t first = 0; first < cycles.size();) {
      const CyclePlan& plan = cycles[first];
      std::size_t end = first + 1;
      while (end < cycles.size() && cycles[end].pause_s == 0 &&
             cycles[end].spindle_rpm == plan.spindle_rpm &&
             cycles[end].feed_duty == plan.feed_duty &&
             cycles[end].cutting_load == plan.cutting_load &&
             cycles[end].coolant == plan.coolant) {
        ++end;
      }
      const double air = programme.climate.AirAt(programme.start_s / kPerHour);
      text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} |\n",
                          day + 1,
                          ClockTime(programme.start_s),
                          SevenDigits(std::floor(air * 100.0 + 0.5) / 100.0),
                          Range(before + first + 1, before + end),
                          plan.pause_s / kPerMinute,
                          SevenDigits(plan.spindle_rpm),
                          SevenDigits(plan.feed_duty),
                          SevenDigits(plan.cutting_load),
                          plan.coolant ? "on" : "off");
      first = end;
    }
    before += cycles.size();
  }
  return text;
}

std::string Readme(const Simulation& simulation, const FileOptions& options) {
  const SimulationOptions& run = simulation.options;
  std::string text =
      R"(# A simulated turning centre

Not measured: made by `errmap simulate turning-centre`, which describes the model in
`cli/turning_centre/model.md` of its source. The same options give the same bytes.

| option | value |
|---|---|
)";
  const auto row = [&](const std::string& name, const std::string& value) {
    text += "| `" + data::ArgumentName(name) + "` | " + value + " |\n";
  };
  row("seed", std::to_string(run.seed));
  row("days", std::to_string(run.days));
  row("cycles", std::to_string(run.cycles));
  row("duty", SevenDigits(run.workload.duty));
  row("speed", SevenDigits(run.workload.speed));
  row("warm", SevenDigits(run.warm_hours) + " h");
  row("air", SevenDigits(run.air_factor));
  row("noise", SevenDigits(run.noise_um) + " um");
  row("angle_noise", SevenDigits(run.noise_urad) + " urad");
  row("sensor_noise", SevenDigits(run.sensor_noise) + " degC");
  row("dead", ListOfNumbers(run.dead));
  row("stuck", ListOfNumbers(run.stuck));
  row("drifting", ListOfNumbers(run.drifting));
  row("noisy", ListOfNumbers(run.noisy));
  if (run.from_day > 1) row("from_day", std::to_string(run.from_day));
  if (run.shift_um != 0.0) row("shift_um", SevenDigits(run.shift_um));
  row("points", std::to_string(run.points_per_day));
  row("truth", options.truth ? "yes" : "no");
  text += R"(
## Files

Error = actual - nominal, so the compensation is -error. Temperatures `t00_degC` to
`t39_degC` are those of Table 1 of NISTIR 5367. `cycle` counts on through the days, `time_s` from
midnight before the first, breaks and nights included; a day is a session.

| file | ISO 230-1 | positive where |
|---|---|---|
)";
  for (const ComponentFile& file : ComponentFiles()) {
    const ComponentTraits& traits = TraitsOf(file.component);
    text += fmt::format("| `{}.csv` | {} | {} |\n",
                        StemOf(file.component, file.direction),
                        traits.letters,
                        traits.meaning);
  }
  text +=
      R"(| `tool_tip.csv` | | random poses, the true error of the tool tip against the work |
| `diagonals.csv` | | the same along both diagonals of the face (ISO 230-6), `p0p` and `p0n` by the signs of X, Y and Z, forth and back five times a day |
| `temperatures.csv` | | the logger's: all channels every 60 s from when the machine is switched on, by day |
| `machine.toml` | | the kinematic chain |

## Days

Day 1 is the one on which the X displacement is calibrated to the report; the others
are drawn. Each cycle: pause, exercise of 440 s, then four sweeps of 17 stops.

)";
  return text + ProgrammeTable(simulation);
}

struct OtherFile {
  const char* name;
  std::string (*content)(const Simulation&, const FileOptions&);
};
constexpr std::array kOtherFiles = std::to_array<OtherFile>({
    {"tool_tip.csv", ToolTipCsv},
    {"diagonals.csv", DiagonalsCsv},
    {"temperatures.csv", TemperaturesCsv},
    {"machine.toml", MachineToml},
    {"README.md", Readme},
});

}  // namespace

std::string SevenDigits(double value) {
  return value == 0.0 ? "0" : fmt::format("{:.7g}", value);  // never "-0"
}

std::vector<std::string> SimulationFileNames() {
  std::vector<std::string> names;
  for (const ComponentFile& file : ComponentFiles()) {
    names.push_back(StemOf(file.component, file.direction) + ".csv");
  }
  for (const OtherFile& file : kOtherFiles) names.emplace_back(file.name);
  return names;
}

std::string SimulationFile(const Simulation& simulation,
                           const FileOptions& options,
                           const std::string& name) {
  for (const ComponentFile& file : ComponentFiles()) {
    if (StemOf(file.component, file.direction) + ".csv" == name) {
      return ComponentCsv(simulation, options, file);
    }
  }
  for (const OtherFile& file : kOtherFiles) {
    if (name == file.name) return file.content(simulation, options);
  }
  throw std::invalid_argument("SimulationFile: no file '" + name + "'");
}

}  // namespace errmap::turning_centre
