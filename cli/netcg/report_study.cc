#include "cli/netcg/report_study.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <numbers>

#include <fmt/format.h>

#include "data/csv.h"
#include "data/input_error.h"
#include "data/measurements/dataset.h"
#include "data/text.h"
#include "fitting/parallel_for.h"

namespace errmap::netcg {
namespace {

constexpr int kThermocouples = 40;
constexpr std::int64_t kSeed = 12345;  // Appendix B

// Table 4; what its OCR and the sections have otherwise stands in the notes.
constexpr std::array<ReportRun, 9> kRuns = {{
    // clang-format off
    {1, true,  60, "all",       397, 40, 41, 2581,  3.3e-6,  1.7e-4, -6.7e-4, 9.3e-4, 3.01, 0.28,  4511.6},
    {2, true,  60, "operating", 397, 36, 37, 2341,  2.5e-6,  1.7e-4, -6.7e-4, 7.6e-4, 2.69, 0.21,  4037.6},
    {3, false, 60, "operating", 298, 36, 37, 2281,  7.3e-7,  1.7e-4, -8.5e-4, 5.9e-4, 1.99, 0.11,  2979.1},
    {4, true,  60, "X-related", 397,  6,  6,  661,  1.9e-6,  3.3e-4, -2.6e-3, 1.6e-3, 1.01, 0.059, 1521.6},
    {5, true,  60, "Z-related", 397, 14, 15, 1021,  9.9e-7,  1.9e-4, -1.1e-3, 6.8e-4, 1.37, 0.027, 2053.0},
    {6, false, 60, "X-related", 298,  7,  8,  601,  6.0e-6,  3.0e-4, -1.4e-3, 1.2e-3, 0.71, 0.053, 1067.1},
    {7, false, 60, "Z-related", 298, 12, 13,  901,  1.9e-7,  3.3e-4, -2.1e-3, 1.3e-3, 0.94, 0.088, 1405.9},
    {8, true,  50, "operating", 397, 36, 37, 1951,  8.7e-7,  2.0e-4, -1.2e-3, 1.1e-3, 2.25, 0.12,  3370.9},
    {9, true,  40, "operating", 397, 36, 37, 1561,  8.3e-7,  2.4e-4, -8.0e-4, 1.3e-3, 1.81, 0.21,  2722.2},
    // clang-format on
}};

// Sections 9.1 to 9.6. The "35, and 35" of 9.3 is 35 and 38, as in 9.5.
const std::vector<int> kXDown = {0, 1, 11, 12, 13, 14, 35, 38};
const std::vector<int> kXUp = {1, 11, 12, 13, 14, 35, 38};
const std::vector<int> kZDown = {
    7, 8, 9, 10, 15, 17, 18, 20, 21, 22, 23, 36, 37, 39};
const std::vector<int> kZUp = {7, 8, 9, 10, 15, 18, 21, 22, 23, 36, 37, 39};
const std::vector<int> kFailedDown = {3, 4, 16, 19};
const std::vector<int> kFailedUp = {0, 4, 5, 17, 20};

std::vector<int> AllBut(const std::vector<int>& left_out) {
  std::vector<int> rest;
  for (int i = 0; i < kThermocouples; ++i) {
    if (std::ranges::find(left_out, i) == left_out.end()) rest.push_back(i);
  }
  return rest;
}

std::vector<int> ThermocouplesOf(const ReportRun& run) {
  if (run.selection == "all") return AllBut({});
  if (run.selection == "operating") {
    return AllBut(run.down ? kFailedDown : kFailedUp);
  }
  if (run.selection == "X-related") return run.down ? kXDown : kXUp;
  return run.down ? kZDown : kZUp;
}

// One direction's training patterns: position and all forty thermocouples.
struct Direction {
  std::string file;
  data::PatternTable training;
  std::vector<int> dead;  // one value throughout
  Index rows = 0;         // of day 1
};

std::string ColumnStarting(const data::CsvTable& table,
                           const std::string& prefix) {
  for (const data::CsvColumn& column : table.columns) {
    if (data::StartsWithIgnoringCase(column.name, prefix)) return column.name;
  }
  throw data::InputError(data::PrintablePath(table.file) +
                         ": line 1: no column '" + prefix +
                         "...', as errmap simulate turning-centre writes it");
}

VectorXd Numbers(const data::CsvTable& table, const std::string& name) {
  return data::NumericColumn(table, name);
}

// Rows of day 1; all if there is no column `day`.
std::vector<Index> FirstDay(const data::CsvTable& table) {
  std::vector<Index> rows;
  const bool has_days = table.Find("day") >= 0;
  const VectorXd days =
      has_days ? Numbers(table, "day")
               : VectorXd::Ones(static_cast<Index>(table.num_rows));
  for (Index i = 0; i < days.size(); ++i) {
    if (days[i] == 1.0) rows.push_back(i);
  }
  return rows;
}

Direction ReadDirection(const std::string& folder, bool down) {
  Direction direction;
  direction.file =
      (std::filesystem::path(folder) /
       (down ? "x_displacement_down.csv" : "x_displacement_up.csv"))
          .string();
  const data::CsvTable table = data::ReadCsv(direction.file);
  const std::vector<Index> day = FirstDay(table);
  direction.rows = std::ssize(day);
  std::vector<Index> rows;
  constexpr Index kStops = 17;
  for (Index i = 0; i < direction.rows; ++i) {
    const bool trains = down ? i % 3 != 2 : i % 2 == 0;
    if (!trains) continue;
    rows.push_back(day[static_cast<std::size_t>(i)]);
    direction.training.index.push_back(i % kStops + 1);
  }
  if (rows.size() < 2) {
    throw data::InputError(data::PrintablePath(direction.file) +
                           ": line 1: has no rows of day 1 to train on");
  }
  data::PatternTable& training = direction.training;
  training.inputs = {"position_mm"};
  training.targets = {"error_mm"};
  training.input_values.resize(std::ssize(rows), kThermocouples + 1);
  training.input_values.col(0) =
      Numbers(table, ColumnStarting(table, "position"))(rows);
  for (int i = 0; i < kThermocouples; ++i) {
    training.inputs.push_back(fmt::format("t{:02}_degC", i));
    const VectorXd readings =
        Numbers(table, ColumnStarting(table, fmt::format("t{:02}", i)))(rows);
    training.input_values.col(i + 1) = readings;
    if (readings.maxCoeff() == readings.minCoeff()) direction.dead.push_back(i);
  }
  training.target_values = Numbers(table, ColumnStarting(table, "error"))(rows);
  if (training.target_values.maxCoeff() == training.target_values.minCoeff()) {
    throw data::InputError(data::PrintablePath(direction.file) +
                           ": line 2: the errors of day 1 do not vary");
  }
  return direction;
}

std::string PatternName(bool down) {
  return down ? "down_train.pat" : "up_train.pat";
}

NetcgSpecification SpecificationOf(const NetcgStudyRun& run,
                                   const Direction& direction,
                                   std::int64_t iterations) {
  // Appendix B.
  constexpr double kWfactor = 1.3e-3;
  constexpr double kEgoal = 1e-3;
  constexpr double kGwgoal = 1e-12;
  const std::string prefix = fmt::format("run{}_", run.report.number);
  NetcgSpecification specification;
  specification.title = fmt::format("X-displacement ({}), {} thermocouples",
                                    run.report.down ? "down" : "up",
                                    run.report.selection);
  specification.files = {prefix + "report.out",
                         PatternName(run.report.down),
                         "none",
                         prefix + "weights.out",
                         prefix + "graph_err.out",
                         prefix + "graph_w1.out",
                         prefix + "graph_w2.out",
                         prefix + "graph_res.out"};
  specification.patterns = direction.training.input_values.rows();
  specification.inputs = std::ssize(run.thermocouples) + 1;
  specification.hidden = run.report.hidden;
  specification.outputs = 1;
  specification.wfactor = kWfactor;
  specification.seed = kSeed;
  specification.iterations = iterations;
  specification.egoal = kEgoal;
  specification.gwgoal = kGwgoal;
  specification.uses_column.assign(kThermocouples + 1, false);
  specification.uses_column[0] = true;
  for (const int i : run.thermocouples) {
    specification.uses_column[static_cast<std::size_t>(i) + 1] = true;
  }
  return specification;
}

// Seven columns; what no iteration measured is not there.
std::string Milli(double value) {
  return std::isfinite(value) ? fmt::format("{:7.3f}", value) : "      -";
}

std::string ListOf(const std::vector<int>& numbers) {
  return fmt::format("{}", fmt::join(numbers, ", "));
}

// Trains from the first seed on with which the program does not give up.
void Train(const Direction& direction,
           NetcgPrecision precision,
           NetcgStudyRun* run) {
  constexpr int kMostStarts = 10;
  constexpr int kSlow = 3;
  NetcgSpecification& specification = run->record.specification;
  const NetcgData data = DataOf(specification, direction.training);
  NetcgResult& result = run->record.result;
  for (; run->starts < kMostStarts; ++run->starts) {
    NetcgSpecification trial = specification;
    trial.seed = kSeed + 2 * run->starts;
    NetcgResult found = RunNetcg(trial, data, precision);
    const bool gives_up = found.ierr == kSlow;
    if (run->starts == 0 || !gives_up || found.error < result.error) {
      specification = trial;
      result = std::move(found);
    }
    if (!gives_up) {
      ++run->starts;
      return;
    }
  }
}

void AddNotes(const Direction& down, const Direction& up, NetcgStudy* study) {
  std::vector<std::string>& notes = study->notes;
  constexpr Index kReportRows = 595;
  for (const Direction* direction : {&down, &up}) {
    if (direction->rows != kReportRows) {
      notes.push_back(fmt::format("{} has {} rows of day 1, the report had {}",
                                  data::PrintablePath(direction->file),
                                  direction->rows,
                                  kReportRows));
    }
    if (!direction->dead.empty()) {
      notes.push_back(
          fmt::format("thermocouples {} are dead in {}: left out of all runs "
                      "but 1",
                      ListOf(direction->dead),
                      data::PrintablePath(direction->file)));
    }
  }
  for (const NetcgStudyRun& run : study->runs) {
    const ReportRun& report = run.report;
    if (report.implied_thermocouples() != report.thermocouples ||
        report.thermocouples + 1 != report.input_nodes) {
      notes.push_back(fmt::format(
          "run {}: Table 4 prints {} thermocouples and {} input nodes; its {} "
          "weights are those of {} and {}",
          report.number,
          report.thermocouples,
          report.input_nodes,
          report.weights,
          report.implied_thermocouples(),
          report.implied_thermocouples() + 1));
    }
    if (static_cast<int>(run.thermocouples.size()) !=
        report.implied_thermocouples()) {
      notes.push_back(
          fmt::format("run {}: {} thermocouples here, {} in the report",
                      report.number,
                      run.thermocouples.size(),
                      report.implied_thermocouples()));
    }
    if (run.starts > 1) {
      notes.push_back(
          fmt::format("run {}: from seed {} the program gives up before the "
                      "last iteration; shown is seed {} of {} tried",
                      report.number,
                      kSeed,
                      run.record.specification.seed,
                      run.starts));
    }
  }
  notes.push_back(
      "sections 9.2 and 9.3 print an sd of 0.134 and 0.377 um for runs 3 and "
      "4, Table 4 0.17 and 0.33");
  notes.push_back(
      "the report's data were measured on its machine; these are simulated");
}

constexpr double kUm = 1e3;  // from mm

// How large the nets are, here and in Tables 3 and 4.
constexpr const char* kSizesHead =
    "                        patterns    thermocouples    input nodes   "
    "weights\n"
    "run motion hid. inputs   here 1995  here print impl. here print impl. "
    "here 1995\n";
std::string SizesRow(const NetcgStudyRun& run) {
  const ReportRun& report = run.report;
  const NetcgSpecification& s = run.record.specification;
  return fmt::format(
      "{:3} {:6} {:4} {:9}{:4} {:4}  {:4} {:5} {:5} {:4} {:5} {:5} {:4} "
      "{:4}\n",
      report.number,
      report.down ? "down" : "up",
      report.hidden,
      report.selection,
      s.patterns,
      report.patterns,
      run.thermocouples.size(),
      report.thermocouples,
      report.implied_thermocouples(),
      s.inputs,
      report.input_nodes,
      report.implied_thermocouples() + 1,
      s.num_weights(),
      report.weights);
}

// Means and standard deviations of the residual errors.
constexpr const char* kErrorsHead =
    "\nResidual error, as the program prints it and right (here), or the "
    "printed sd\ntimes sqrt(2) and mean times 2 (1995):\n"
    "       sd here        sd 1995      mean here       mean 1995\n"
    "run print  right   print  right  print   right   print   right\n";
std::string ErrorsRow(const NetcgStudyRun& run) {
  const NetcgResult& result = run.record.result;
  return fmt::format(
      "{:3} {:5.3f}  {:5.3f}   {:5.3f}  {:5.3f} {:7.4f} {:7.4f} {:7.4f} "
      "{:7.4f}\n",
      run.report.number,
      kUm * result.printed.sd,
      kUm * result.corrected.sd,
      kUm * run.report.sd,
      kUm * run.report.sd * std::numbers::sqrt2,
      kUm * result.printed.mean,
      kUm * result.corrected.mean,
      kUm * run.report.mean,
      kUm * run.report.mean * 2.0);
}

// Their extremes, and how the runs ended.
constexpr const char* kExtremesHead =
    "\n      minimum        maximum     iterations           rms of scaled\n"
    "run  here   1995    here   1995  here  1995  ending   error, here\n";
std::string ExtremesRow(const NetcgStudyRun& run) {
  const NetcgResult& result = run.record.result;
  return fmt::format(
      "{:3} {:6.2f} {:6.2f} {:6.2f} {:6.2f} {:5} {:5}  ierr {}  {:.5f}\n",
      run.report.number,
      kUm * result.printed.min,
      kUm * run.report.min,
      kUm * result.printed.max,
      kUm * run.report.max,
      result.iterations,
      1500,
      result.ierr,
      std::sqrt(2.0 * result.error));
}

// What the runs cost, here and in 1995; `{}`: all of them together.
constexpr const char* kTimesHead =
    "\nTimes; 1995 on a CONVEX C3820. All nine here together: {:.1f} s.\n"
    "      of an iteration, mean and sd      elapsed, s      of an "
    "iteration\n"
    "       here, ms          1995, s                      per weight, us\n"
    "run   mean      sd     mean     sd     here   1995     here   1995\n";
std::string TimesRow(const NetcgStudyRun& run) {
  const fitting::FitSummary& summary = run.record.result.summary;
  constexpr double kMs = 1e3;
  constexpr double kUs = 1e6;
  return fmt::format(
      "{:3}{} {}    {:5.2f}  {:5.3f}  {:7.2f} {:6.1f}  {} {:6.0f}\n",
      run.report.number,
      Milli(kMs * summary.mean_iteration_seconds),
      Milli(kMs * summary.sd_iteration_seconds),
      run.report.iteration_seconds,
      run.report.iteration_seconds_sd,
      summary.seconds,
      run.report.elapsed_seconds,
      Milli(kUs * summary.mean_iteration_seconds /
            static_cast<double>(run.record.specification.num_weights())),
      kUs * run.report.iteration_seconds /
          static_cast<double>(run.report.weights));
}

}  // namespace

NetcgStudy RunReportStudy(const std::string& folder,
                          const NetcgStudyOptions& options) {
  const Direction down = ReadDirection(folder, true);
  const Direction up = ReadDirection(folder, false);
  NetcgStudy study{.folder = folder, .options = options};
  for (const ReportRun& report : kRuns) {
    const Direction& direction = report.down ? down : up;
    NetcgStudyRun& run = study.runs.emplace_back();
    run.report = report;
    run.thermocouples = ThermocouplesOf(report);
    if (report.selection != "all") {
      std::erase_if(run.thermocouples, [&](int i) {
        return std::ranges::find(direction.dead, i) != direction.dead.end();
      });
    }
    run.record.specification =
        SpecificationOf(run, direction, options.iterations);
  }

  // The longest first.
  std::vector<NetcgStudyRun*> order;
  for (NetcgStudyRun& run : study.runs) order.push_back(&run);
  std::ranges::stable_sort(order, std::greater{}, [](const NetcgStudyRun* run) {
    const NetcgSpecification& s = run->record.specification;
    return s.patterns * s.num_weights();
  });
  const auto begin = std::chrono::steady_clock::now();
  fitting::ParallelFor(options.jobs, order.size(), [&](std::size_t i) {
    Train(order[i]->report.down ? down : up, options.netcg.precision, order[i]);
  });
  study.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin)
          .count();

  AddNotes(down, up, &study);

  if (options.netcg.out.empty()) return study;
  std::vector<NetcgSpecification> specifications;
  for (const NetcgStudyRun& run : study.runs) {
    specifications.push_back(run.record.specification);
    std::ranges::move(
        NetcgOutputs(
            specifications.back(), run.record.result, options.netcg, ""),
        std::back_inserter(study.files));
  }
  const std::filesystem::path out(options.netcg.out);
  study.files.push_back(
      {(out / "netcg.in").string(), RunFileText(specifications)});
  for (const Direction* direction : {&down, &up}) {
    study.files.push_back(
        {(out / PatternName(direction == &down)).string(),
         data::PatternText(direction->training, data::PatternForm::kStacked)});
  }
  return study;
}

std::string StudyText(const NetcgStudy& study) {
  std::string text = fmt::format(
      "The nine experiments of NISTIR 5367 (Tables 3 and 4) on {}, day 1:\n"
      "{} iterations, {} precision, seed 12345. Errors in um.\n\n",
      data::PrintablePath(study.folder),
      study.options.iterations,
      ToString(study.options.netcg.precision));
  const auto add = [&](std::string_view head,
                       std::string (*row)(const NetcgStudyRun&)) {
    text += head;
    for (const NetcgStudyRun& run : study.runs) text += row(run);
  };
  add(kSizesHead, SizesRow);
  add(kErrorsHead, ErrorsRow);
  add(kExtremesHead, ExtremesRow);
  add(fmt::format(kTimesHead, study.seconds), TimesRow);
  text += "\nDifferences:\n";
  for (const std::string& note : study.notes) text += "- " + note + "\n";
  return text;
}

}  // namespace errmap::netcg
