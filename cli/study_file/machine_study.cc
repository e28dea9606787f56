#include "cli/study_file/machine_study.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/study_file/data_arguments.h"
#include "cli/study_file/machine_points.h"
#include "data/input_error.h"
#include "data/measurements/column_match.h"
#include "data/measurements/dataset.h"
#include "data/text.h"
#include "models/kinematics/iso230.h"
#include "models/kinematics/volumetric.h"
#include "stats/distributions.h"
#include "stats/summary.h"

namespace errmap::cli {
namespace {

using Eigen::Index;
using Eigen::MatrixX3d;
using Eigen::VectorXd;
using models::ComponentStudy;
using models::FittedModel;
using models::MachineChoiceRecord;
using models::MachineDayRecord;

constexpr const char* kPoints = "tool_tip.csv";
constexpr const char* kLog = "temperatures.csv";

std::string InFolder(const std::string& folder, const std::string& name) {
  return (std::filesystem::path(folder) / name).string();
}

std::vector<Index> AllRows(const data::CsvTable& table) {
  std::vector<Index> rows(table.num_rows);
  std::iota(rows.begin(), rows.end(), Index{0});
  return rows;
}

std::string SessionColumn(const data::CsvTable& points,
                          const std::string& wanted) {
  for (const std::string& name :
       wanted.empty() ? std::vector<std::string>{"session", "day", "run"}
                      : std::vector<std::string>{wanted}) {
    if (points.Find(name) >= 0) return name;
  }
  throw data::InputError(fmt::format(
      "{}: no column {} that tells days apart; add one, or name it with "
      "--session",
      data::PrintablePath(points.file),
      wanted.empty() ? "session, day or run" : data::QuotedName(wanted)));
}

// ---- Which maps.

using Choose = std::function<const models::ModelResult*(const ComponentStudy&)>;

const models::ModelResult* Recommended(const ComponentStudy& component) {
  const auto& advice = component.judgement.recommendation;
  return advice ? &component.study.models[advice->model] : nullptr;
}

// The map of one kind that errs least where the recommendation is made.
const models::ModelResult* BestOf(models::ModelKind kind,
                                  const ComponentStudy& component) {
  const auto& advice = component.judgement.recommendation;
  if (!advice) return nullptr;
  const models::ModelResult* best = nullptr;
  const auto error_of = [&](const models::ModelResult& model) {
    return model.holdouts[advice->holdout].test.rmse;
  };
  for (const models::ModelResult& model : component.study.models) {
    if (model.kind != kind || !model.ok() || !model.final_fit) continue;
    if (best == nullptr || error_of(model) < error_of(*best)) best = &model;
  }
  return best;
}

// Length along the sensitive directions.
VectorXd Lengths(const models::Machine& machine, const MatrixX3d& errors) {
  VectorXd squares = VectorXd::Zero(errors.rows());
  for (std::size_t d = 0; d < machine.sensitive.size(); ++d) {
    if (machine.sensitive[d]) {
      squares += errors.col(static_cast<Index>(d)).cwiseAbs2();
    }
  }
  return squares.cwiseSqrt();
}

class MachineJudge {
 public:
  MachineJudge(const MachineStudy& study, const StudyRun& run)
      : study_(study),
        run_(run),
        sessions_(data::GroupByColumn(
            study.points, study.session, AllRows(study.points))),
        truth_(Truth()) {
    const std::string log = InFolder(study.folder, kLog);
    if (std::filesystem::exists(log)) log_ = data::ReadCsv(log);
  }

  models::MachineRecord Judge() {
    models::MachineRecord record{.name = machine().name,
                                 .file = study_.path,
                                 .unit = machine().length.symbol,
                                 .sensitive = "",
                                 .points = study_.points.file,
                                 .later = study_.later,
                                 .choices = {}};
    for (std::size_t d = 0; d < 3; ++d) {
      if (machine().sensitive[d]) {
        record.sensitive += static_cast<char>('X' + d);
      }
    }
    record.choices.push_back(Uncompensated());
    using models::ModelKind;
    record.choices.push_back(
        Compensated("polynomial", [](const ComponentStudy& component) {
          return BestOf(ModelKind::kPolynomial, component);
        }));
    record.choices.push_back(
        Compensated("neural", [](const ComponentStudy& component) {
          return BestOf(ModelKind::kNet, component);
        }));
    record.choices.push_back(Compensated("recommended", Recommended));
    return record;
  }

 private:
  const models::Machine& machine() const { return study_.file.machine; }

  MatrixX3d Truth() const {
    MatrixX3d truth(static_cast<Index>(study_.points.num_rows), 3);
    Index column = 0;
    for (const char* direction : {"x", "y", "z"}) {
      const data::ColumnInfo wanted{
          fmt::format("error_{}_{}", direction, machine().length.symbol),
          machine().length};
      const data::MatchedColumn match =
          data::MatchColumn(study_.points, wanted);
      truth.col(column++) =
          data::NumericColumn(study_.points,
                              match.of_file.name,
                              data::MissingPolicy::kError,
                              nullptr)
              .unaryExpr([&](double value) { return match.InMapUnit(value); });
    }
    return truth;
  }

  std::vector<Index> RowsOf(const std::string& session) const {
    std::vector<Index> rows;
    for (const Index row : AllRows(study_.points)) {
      const auto code = static_cast<std::size_t>(
          sessions_.codes[static_cast<std::size_t>(row)]);
      if (sessions_.labels[code] == session) rows.push_back(row);
    }
    return rows;
  }

  MachineChoiceRecord Uncompensated() const {
    MachineChoiceRecord choice;
    choice.name = "uncompensated";
    const MatrixX3d unknown = MatrixX3d::Constant(
        truth_.rows(), 3, std::numeric_limits<double>::quiet_NaN());
    FillErrors(truth_, unknown, &choice);
    FillPositioning(nullptr, &choice);
    return choice;
  }

  MachineChoiceRecord Compensated(const std::string& name,
                                  const Choose& choose) {
    MachineChoiceRecord choice;
    choice.name = name;
    models::Machine fitted = machine();
    for (models::MachineError& error : fitted.errors) {
      for (models::ErrorSource& source : error.sources) {
        if (source.file.empty()) continue;
        const models::ModelResult* const model =
            choose(ComponentOf(source.file));
        if (model == nullptr || !model->final_fit) {
          choice.why = fmt::format("no such map of {}", StemOf(source.file));
          return choice;
        }
        source.map = std::make_shared<const FittedModel>(*model->final_fit);
      }
    }
    AddMaps(choose, &choice);
    const MachinePoints maps =
        EvaluateAt(fitted, study_.points, log_ ? &*log_ : nullptr, {});
    const models::VolumetricErrors errors = models::CombineErrors(
        fitted.chain, maps.coordinates, maps.components, {.draws = 0});
    FillErrors(truth_ - errors.exact, errors.half_widths, &choice);
    FillPositioning(&choose, &choice);
    return choice;
  }

  void AddMaps(const Choose& choose, MachineChoiceRecord* choice) const {
    for (const std::string& stem : study_.stems) {
      choice->maps.push_back(
          {.component = stem, .model = choose(Component(stem))->name});
    }
  }

  static std::string StemOf(const std::string& file) {
    return std::filesystem::path(file).replace_extension().string();
  }
  const ComponentStudy& ComponentOf(const std::string& file) const {
    return Component(StemOf(file));
  }
  const ComponentStudy& Component(const std::string& stem) const {
    return *std::ranges::find(run_.components, stem, &ComponentStudy::name);
  }

  // Of what is left of the error at the tool, and the stated half-widths.
  void FillErrors(const MatrixX3d& rest,
                  const MatrixX3d& half_widths,
                  MachineChoiceRecord* choice) const {
    std::vector<Index> all;
    for (const std::string& session : study_.later) {
      const std::vector<Index> rows = RowsOf(session);
      all.insert(all.end(), rows.begin(), rows.end());
      choice->days.push_back(DayOf(session, rest, half_widths, rows));
    }
    const MachineDayRecord together = DayOf("", rest, half_widths, all);
    choice->points = together.points;
    choice->rms = together.rms;
    choice->p95 = together.p95;
    choice->max = together.max;
    choice->within_90 = together.within_90;
    choice->p95_ci95 = IntervalOverDays(choice->days);
  }

  MachineDayRecord DayOf(const std::string& session,
                         const MatrixX3d& rest,
                         const MatrixX3d& half_widths,
                         const std::vector<Index>& rows) const {
    const auto n = static_cast<double>(rows.size());
    VectorXd lengths = Lengths(machine(), MatrixX3d(rest(rows, Eigen::all)));
    std::ranges::sort(lengths);
    constexpr double kShare = 0.95;
    MachineDayRecord day{.session = session,
                         .points = static_cast<std::int64_t>(rows.size()),
                         .rms = std::sqrt(lengths.squaredNorm() / n),
                         .p95 = stats::Quantile(lengths, kShare),
                         .max = lengths[lengths.size() - 1]};
    for (Index d = 0; d < 3; ++d) {
      double within = 0.0;
      for (const Index row : rows) {
        // NaN where a half-width is not known.
        within += std::isnan(half_widths(row, d))
                      ? half_widths(row, d)
                      : static_cast<double>(std::abs(rest(row, d)) <=
                                            half_widths(row, d));
      }
      day.within_90[static_cast<std::size_t>(d)] = within / n;
    }
    return day;
  }

  static std::array<double, 2> IntervalOverDays(
      const std::vector<MachineDayRecord>& days) {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    const auto n = static_cast<double>(days.size());
    if (days.size() < 2) return {kNaN, kNaN};
    // Of logarithms, since an error has no sign and days differ by factors.
    double mean = 0.0;
    for (const MachineDayRecord& day : days) mean += std::log(day.p95) / n;
    double squares = 0.0;
    for (const MachineDayRecord& day : days) {
      squares += std::pow(std::log(day.p95) - mean, 2);
    }
    constexpr double kUpper = 0.975;
    const double half = stats::StudentQuantile(kUpper, n - 1.0) *
                        std::sqrt(squares / (n - 1.0) / n);
    return {std::exp(mean - half), std::exp(mean + half)};
  }

  // ---- ISO 230-2 of what was measured on the later days, less the map.

  void FillPositioning(const Choose* choose,
                       MachineChoiceRecord* choice) const {
    for (std::size_t k = 0; k < machine().errors.size(); ++k) {
      const models::MachineError& error = machine().errors[k];
      const auto direction = machine().chain.errors()[k].direction;
      if (error.sources.size() != 2 || models::IsRotation(direction) ||
          error.sources[0].file.empty() || error.sources[1].file.empty()) {
        continue;
      }
      models::PositioningTest test;
      // Forward is one direction of approach, reverse the other.
      AddDeviations(error.sources[0].file, true, choose, &test);
      AddDeviations(error.sources[1].file, false, choose, &test);
      const models::PositioningFigures figures =
          models::PositioningFiguresOf(test);
      choice->positioning.push_back(
          {.component = error.name,
           .systematic = figures.systematic,
           .mean_bidirectional = figures.mean_bidirectional,
           .reversal = figures.reversal,
           .repeatability = figures.repeatability,
           .accuracy = figures.accuracy});
    }
  }

  void AddDeviations(const std::string& file,
                     bool upwards,
                     const Choose* choose,
                     models::PositioningTest* test) const {
    const ComponentStudy& component = ComponentOf(file);
    const auto config = std::ranges::find(
        run_.config.components, component.name, &ComponentConfig::name);
    const data::Dataset dataset =
        MakeDataLike(data::ReadCsv(component.file), component.data, *config)
            .dataset;
    const Index position = models::FindPosition(dataset, "");
    if (position < 0) return;
    const VectorXd predicted =
        choose == nullptr ? VectorXd(VectorXd::Zero(dataset.num_rows()))
                          : (*choose)(component)->final_fit->Predict(dataset);
    const double factor =
        data::Converted(1.0, dataset.target().unit, machine().length);
    const std::vector<Index> codes = dataset.session_codes();
    for (Index row = 0; row < dataset.num_rows(); ++row) {
      const std::string& label =
          dataset.log()->sessions.labels[static_cast<std::size_t>(
              codes[static_cast<std::size_t>(row)])];
      if (std::ranges::find(study_.later, label) == study_.later.end()) {
        continue;
      }
      const Index n = test->deviations.size();
      test->positions.conservativeResize(n + 1);
      test->deviations.conservativeResize(n + 1);
      test->positions[n] = dataset.input_values()(row, position);
      test->deviations[n] =
          factor * (dataset.target_values()[row] - predicted[row]);
      test->upwards.push_back(upwards);
    }
  }

  const MachineStudy& study_;
  const StudyRun& run_;
  data::Grouping sessions_;  // of the points
  MatrixX3d truth_;
  std::optional<data::CsvTable> log_;
};

}  // namespace

MachineStudy ReadMachineStudy(const std::string& machine,
                              const std::string& folder,
                              int later,
                              const std::string& session) {
  MachineStudy study{.path = machine,
                     .folder = folder,
                     .file = ReadMachineOutline(machine),
                     .stems = {},
                     .points = data::ReadCsv(InFolder(folder, kPoints)),
                     .session = "",
                     .later = {}};
  for (const models::MachineError& error : study.file.machine.errors) {
    for (const models::ErrorSource& source : error.sources) {
      if (source.file.empty()) continue;
      const std::string stem =
          std::filesystem::path(source.file).replace_extension().string();
      if (std::ranges::find(study.stems, stem) == study.stems.end()) {
        study.stems.push_back(stem);
      }
    }
  }
  if (study.stems.empty()) {
    throw data::InputError(fmt::format(
        "{}: names no map STEM.json, and so no data STEM.csv to compare",
        data::PrintablePath(machine)));
  }
  study.session = SessionColumn(study.points, session);
  const data::Grouping sessions =
      data::GroupByColumn(study.points, study.session, AllRows(study.points));
  const auto count = static_cast<int>(sessions.labels.size());
  if (count <= later) {
    throw data::InputError(fmt::format(
        "{}: {} by {}, and --later {} of them are to judge; more days are "
        "needed",
        data::PrintablePath(study.points.file),
        count == 1 ? "1 session" : fmt::format("{} sessions", count),
        data::QuotedName(study.session),
        later));
  }
  study.later.assign(sessions.labels.end() - later, sessions.labels.end());
  return study;
}

StudyConfig ConfigOfMachine(const MachineStudy& study, StudyConfig config) {
  const ComponentConfig like =
      config.components.empty() ? ComponentConfig{} : config.components.front();
  config.components.clear();
  for (const std::string& stem : study.stems) {
    ComponentConfig component = like;
    component.name = stem;
    component.data = InFolder(study.folder, stem + ".csv");
    component.session = study.session;
    component.later = study.later;
    config.components.push_back(std::move(component));
  }
  return config;
}

models::MachineRecord JudgeMachine(const MachineStudy& study,
                                   const StudyRun& run) {
  return MachineJudge(study, run).Judge();
}

}  // namespace errmap::cli
