#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "cli/machine/machine_points.h"
#include "cli/machine/machine_study.h"
#include "cli/machine/true_poses.h"
#include "data/files/shown_path.h"
#include "data/measurements/dataset.h"
#include "models/comparison/compare.h"
#include "models/kinematics/iso230.h"
#include "models/kinematics/plane_cells.h"
#include "models/kinematics/volumetric.h"
#include "models/uncertainty/held_out_errors.h"
#include "stats/distributions.h"
#include "stats/error_metrics.h"
#include "stats/not_a_number.h"
#include "stats/summary.h"

namespace errmap::machine {
namespace {

using Eigen::MatrixX3d;
using models::ComponentStudy;
using models::FittedModel;
using models::Holdout;

constexpr const char* kLog = "temperatures.csv";

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

// The true error less what maps say of it, and the stated half-widths; NaN
// without maps.
struct Rest {
  MatrixX3d errors;
  MatrixX3d half_widths;
};

// Readings of a component on the later sessions, less its map.
struct Readings {
  VectorXd positions;  // (n), or (0) if there are none
  VectorXd rest;       // (n)
};

PositioningRecord RecordOf(const std::string& name,
                           const models::PositioningFigures& figures) {
  return {.component = name,
          .systematic = figures.systematic,
          .mean_bidirectional = figures.mean_bidirectional,
          .reversal = figures.reversal,
          .repeatability = figures.repeatability,
          .accuracy = figures.accuracy};
}

class MachineJudge {
 public:
  MachineJudge(const MachineStudy& study, const study_setup::StudyRun& run)
      : study_(study),
        run_(run),
        poses_(MakeTruePoses(study.points, study.file.machine, study.session)),
        later_(poses_.RowsOf(study.later)) {
    const std::string log = study.FileNamed(kLog);
    if (std::filesystem::exists(log)) log_ = data::ReadCsv(log);
    if (study.diagonals) {
      runs_ = ReadDiagonalRuns(*study.diagonals);
      along_ = MakeTruePoses(*study.diagonals, machine(), study.session);
    }
    for (const std::string& stem : study.stems) {
      datasets_.emplace(stem, DatasetOf(Component(stem)));
    }
  }

  MachineRecord Judge() {
    MachineRecord record{.name = machine().name,
                         .file = data::ShownPath(study_.path),
                         .unit = machine().length.symbol,
                         .points = data::ShownPath(study_.points.file),
                         .later = study_.later};
    for (std::size_t d = 0; d < 3; ++d) {
      if (machine().sensitive[d]) record.sensitive += Letter(d);
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
    record.plane = Plane();
    return record;
  }

 private:
  const models::Machine& machine() const { return study_.file.machine; }

  static char Letter(std::size_t direction) {
    return static_cast<char>('X' + direction);
  }

  MachineChoiceRecord Uncompensated() const {
    MachineChoiceRecord choice;
    choice.name = "uncompensated";
    const auto alone = [](const TruePoses& poses) {
      return Rest{poses.errors,
                  MatrixX3d::Constant(poses.errors.rows(), 3, stats::kNaN)};
    };
    FillErrors(alone(poses_), &choice);
    if (along_) FillDiagonals(alone(*along_), &choice);
    FillReadings(nullptr, &choice);
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
            choose(Component(StemOf(source.file)));
        if (model == nullptr || !model->final_fit) {
          choice.why =
              fmt::format("no {} map of {}", name, StemOf(source.file));
          return choice;
        }
        source.map = std::make_shared<const FittedModel>(
            MapOf(Component(StemOf(source.file)), *model));
      }
    }
    AddMaps(choose, &choice);
    Rest rest = Compensate(fitted, poses_);
    Calibrate(choose, &rest, &choice);
    FillErrors(rest, &choice);
    if (along_) FillDiagonals(Compensate(fitted, *along_), &choice);
    FillReadings(&choose, &choice);
    return choice;
  }

  // With the errors on whole sessions held out, as the machine is judged on
  // others: also where they are too few to decide which map to take.
  static FittedModel MapOf(const ComponentStudy& component,
                           const models::ModelResult& model) {
    FittedModel map = *model.final_fit;
    for (std::size_t h = 0; h < component.holdouts.size(); ++h) {
      if (!component.holdouts[h].whole_sessions) continue;
      if (auto errors = models::HeldOutErrorsOf(component.data.dataset,
                                                component.holdouts[h],
                                                model.holdouts[h],
                                                map.inputs)) {
        map.held_out =
            std::make_shared<const models::HeldOutErrors>(*std::move(errors));
      }
    }
    return map;
  }

  Rest Compensate(const models::Machine& fitted, const TruePoses& poses) const {
    const MachinePoints maps =
        EvaluateAt(fitted, poses.table, log_ ? &*log_ : nullptr, {});
    const models::VolumetricErrors errors = models::CombineErrors(
        fitted.chain, maps.coordinates, maps.components, {.draws = 0});
    return {poses.errors - errors.exact, errors.half_widths};
  }

  // ---- What the intervals at the tool are.

  // The fold of that component that held the session out; -1 without.
  static std::ptrdiff_t FoldWithout(const std::string& session,
                                    const ComponentStudy& component,
                                    const Holdout& holdout) {
    const data::Dataset& dataset = component.data.dataset;
    const std::vector<std::string>& labels = dataset.log()->sessions.labels;
    const std::vector<Index> codes = dataset.session_codes();
    for (std::size_t fold = 0; fold < holdout.folds.size(); ++fold) {
      for (const Index row : holdout.folds[fold].test) {
        const auto code = codes[static_cast<std::size_t>(row)];
        if (labels[static_cast<std::size_t>(code)] == session) {
          return static_cast<std::ptrdiff_t>(fold);
        }
      }
    }
    return -1;
  }

  // The chosen map as it was fitted without that session, or null.
  static std::shared_ptr<const FittedModel> MapWithout(
      const std::string& session,
      const ComponentStudy& component,
      const models::ModelResult& model) {
    for (std::size_t h = 0; h < component.holdouts.size(); ++h) {
      const Holdout& holdout = component.holdouts[h];
      if (!holdout.whole_sessions || holdout.forward) continue;
      const std::ptrdiff_t fold = FoldWithout(session, component, holdout);
      if (fold < 0 || !model.holdouts[h].ok()) continue;
      return model.holdouts[h].folds[static_cast<std::size_t>(fold)].map;
    }
    return nullptr;
  }

  // The machine by the maps that did not see that session; nothing where a
  // component has none.
  std::optional<models::Machine> MachineWithout(const std::string& session,
                                                const Choose& choose) const {
    models::Machine without = machine();
    for (models::MachineError& error : without.errors) {
      for (models::ErrorSource& source : error.sources) {
        if (source.file.empty()) continue;
        const ComponentStudy& component = Component(StemOf(source.file));
        source.map = MapWithout(session, component, *choose(component));
        if (source.map == nullptr) return std::nullopt;
      }
    }
    return without;
  }

  // Half-widths by the sessions of the fits at their own poses, each held out
  // in its turn; those of the components where fewer than two can be.
  void Calibrate(const Choose& choose,
                 Rest* rest,
                 MachineChoiceRecord* choice) const {
    std::vector<models::HeldOutToolTip> sessions;
    std::vector<std::string> held_out;
    for (const std::string& session : poses_.sessions.labels) {
      if (std::ranges::find(study_.later, session) != study_.later.end()) {
        continue;
      }
      const std::optional<models::Machine> without =
          MachineWithout(session, choose);
      if (!without) continue;
      const std::vector<Index> rows = poses_.RowsOf({session});
      const MatrixX3d errors = Compensate(*without, poses_).errors;
      sessions.push_back({.errors = errors(rows, Eigen::all),
                          .half_widths = rest->half_widths(rows, Eigen::all)});
      held_out.push_back(session);
    }
    if (sessions.size() < 2) return;
    choice->held_out = std::move(held_out);
    constexpr double kCoverage = 0.9;
    rest->half_widths =
        models::ToolTipHalfWidths(sessions, rest->half_widths, kCoverage);
  }

  void AddMaps(const Choose& choose, MachineChoiceRecord* choice) const {
    for (const std::string& stem : study_.stems) {
      choice->maps.push_back(
          {.component = stem, .model = choose(Component(stem))->name});
    }
  }

  const ComponentStudy& Component(const std::string& stem) const {
    return *std::ranges::find(run_.components, stem, &ComponentStudy::name);
  }

  // ---- What is left of the error at the tool.

  void FillErrors(const Rest& rest, MachineChoiceRecord* choice) const {
    for (const std::string& session : study_.later) {
      choice->days.push_back(DayOf(session, rest, poses_.RowsOf({session})));
    }
    const MachineDayRecord together = DayOf("", rest, later_);
    choice->points = together.points;
    choice->rms = together.rms;
    choice->p95 = together.p95;
    choice->max = together.max;
    choice->within_90 = together.within_90;
    for (Index d = 0; d < 3; ++d) {
      choice->half_width_90[static_cast<std::size_t>(d)] =
          VectorXd(rest.half_widths.col(d)(later_)).mean();
    }
    choice->p95_ci95 = IntervalOverDays(choice->days);
    if (const auto plane = models::WorkingPlaneOf(machine().sensitive)) {
      choice->cells =
          models::CellsOf(*plane,
                          MatrixX3d(poses_.places(later_, Eigen::all)),
                          MatrixX3d(rest.errors(later_, Eigen::all)))
              .cells;
    }
  }

  std::optional<PlaneRecord> Plane() const {
    const auto plane = models::WorkingPlaneOf(machine().sensitive);
    if (!plane) return std::nullopt;
    const MatrixX3d places = poses_.places(later_, Eigen::all);
    const models::PlaneCells cells = models::CellsOf(*plane, places, places);
    return PlaneRecord{
        .across = {Letter(static_cast<std::size_t>(plane->across))},
        .up = {Letter(static_cast<std::size_t>(plane->up))},
        .cell_width = cells.width,
        .cell_height = cells.height};
  }

  MachineDayRecord DayOf(const std::string& session,
                         const Rest& rest,
                         const std::vector<Index>& rows) const {
    VectorXd lengths = models::SensitiveLengths(
        machine(), MatrixX3d(rest.errors(rows, Eigen::all)));
    std::ranges::sort(lengths);
    constexpr double kShare = 0.95;
    MachineDayRecord day{.session = session,
                         .points = std::ssize(rows),
                         .rms = stats::RootMeanSquare(lengths),
                         .p95 = stats::Quantile(lengths, kShare),
                         .max = lengths[lengths.size() - 1]};
    for (Index d = 0; d < 3; ++d) {
      double within = 0.0;
      for (const Index row : rows) {
        const double half_width = rest.half_widths(row, d);
        // NaN where a half-width is not known.
        within += std::isnan(half_width)
                      ? half_width
                      : static_cast<double>(std::abs(rest.errors(row, d)) <=
                                            half_width);
      }
      day.within_90[static_cast<std::size_t>(d)] =
          within / static_cast<double>(rows.size());
    }
    return day;
  }

  static std::array<double, 2> IntervalOverDays(
      const std::vector<MachineDayRecord>& days) {
    const auto n = static_cast<double>(days.size());
    if (days.size() < 2) return {stats::kNaN, stats::kNaN};
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

  // ---- ISO 230-6: along the diagonals on the later days.

  void FillDiagonals(const Rest& rest, MachineChoiceRecord* choice) const {
    for (const DiagonalFigures& diagonal :
         DiagonalFiguresOf(along_->table,
                           *runs_,
                           along_->RowsOf(study_.later),
                           along_->places,
                           rest.errors)) {
      choice->diagonals.push_back(RecordOf(diagonal.name, diagonal.figures));
    }
  }

  // ---- Of what was measured on the later days, less the map.

  // ISO 230-2 of each axis, and what each component leaves at the tool.
  void FillReadings(const Choose* choose, MachineChoiceRecord* choice) const {
    const VectorXd arms = RmsSensitivities();
    for (std::size_t k = 0; k < machine().errors.size(); ++k) {
      const models::MachineError& error = machine().errors[k];
      const auto direction = machine().chain.errors()[k].direction;
      std::vector<Readings> of_sources;
      for (const models::ErrorSource& source : error.sources) {
        if (source.file.empty()) continue;
        of_sources.push_back(ReadingsOf(
            StemOf(source.file), choose, models::UnitOf(machine(), direction)));
      }
      if (of_sources.empty()) continue;
      AddPart(error.name, of_sources, arms[static_cast<Index>(k)], choice);
      if (of_sources.size() == 2 && !models::IsRotation(direction) &&
          of_sources[0].positions.size() > 0 &&
          of_sources[1].positions.size() > 0) {
        choice->positioning.push_back(
            RecordOf(error.name,
                     models::PositioningFiguresOf(
                         PositioningOf(of_sources[0], of_sources[1]))));
      }
    }
    std::ranges::stable_sort(
        choice->parts, std::greater{}, &MachinePartRecord::rms);
  }

  // In the sensitive directions, over the later poses (errors).
  VectorXd RmsSensitivities() const {
    VectorXd squares = VectorXd::Zero(machine().chain.num_errors());
    for (const Index row : later_) {
      const Eigen::Matrix3Xd sensitivities =
          machine().chain.Sensitivities(poses_.coordinates.row(row));
      for (std::size_t d = 0; d < 3; ++d) {
        if (!machine().sensitive[d]) continue;
        squares +=
            sensitivities.row(static_cast<Index>(d)).cwiseAbs2().transpose();
      }
    }
    return (squares / static_cast<double>(later_.size())).cwiseSqrt();
  }

  static void AddPart(const std::string& name,
                      const std::vector<Readings>& of_sources,
                      double arm,
                      MachineChoiceRecord* choice) {
    double squares = 0.0;
    double count = 0.0;
    for (const Readings& readings : of_sources) {
      squares += readings.rest.squaredNorm();
      count += static_cast<double>(readings.rest.size());
    }
    if (count == 0.0) return;
    choice->parts.push_back(
        {.error = name, .rms = arm * std::sqrt(squares / count)});
  }

  // Forward is one direction of approach, reverse the other.
  static models::PositioningTest PositioningOf(const Readings& forward,
                                               const Readings& reverse) {
    models::PositioningTest test;
    const Index n = forward.rest.size() + reverse.rest.size();
    test.positions.resize(n);
    test.deviations.resize(n);
    test.positions << forward.positions, reverse.positions;
    test.deviations << forward.rest, reverse.rest;
    test.upwards.assign(static_cast<std::size_t>(forward.rest.size()), true);
    test.upwards.resize(static_cast<std::size_t>(n), false);
    return test;
  }

  // All rows, those of the later sessions too.
  data::Dataset DatasetOf(const ComponentStudy& component) const {
    const auto config = std::ranges::find(run_.config.components,
                                          component.name,
                                          &study_setup::ComponentConfig::name);
    return data::MakeDataset(
               data::ReadCsv(config->data),
               models::SelectionLike(component.data.dataset, config->selection))
        .dataset;
  }

  Readings ReadingsOf(const std::string& stem,
                      const Choose* choose,
                      const data::Unit& unit) const {
    const data::Dataset& dataset = datasets_.at(stem);
    VectorXd rest = dataset.target_values();
    if (choose != nullptr) {
      rest -= (*choose)(Component(stem))->final_fit->Predict(dataset);
    }
    const std::vector<Index> codes = dataset.session_codes();
    std::vector<Index> rows;
    for (Index row = 0; row < dataset.num_rows(); ++row) {
      const std::string& label =
          dataset.log()->sessions.labels[static_cast<std::size_t>(
              codes[static_cast<std::size_t>(row)])];
      if (std::ranges::find(study_.later, label) != study_.later.end()) {
        rows.push_back(row);
      }
    }
    const Index position = models::FindPosition(dataset, "");
    return {
        .positions = position < 0
                         ? VectorXd()
                         : VectorXd(dataset.input_values()(rows, position)),
        .rest = data::Converted(1.0, dataset.target().unit, unit) * rest(rows)};
  }

  const MachineStudy& study_;
  const study_setup::StudyRun& run_;
  TruePoses poses_;
  std::vector<Index> later_;  // rows of the poses
  std::optional<TruePoses> along_;
  std::optional<DiagonalRuns> runs_;
  std::map<std::string, data::Dataset> datasets_;  // by stem
  std::optional<data::CsvTable> log_;
};

}  // namespace

MachineRecord JudgeMachine(const MachineStudy& study,
                           const study_setup::StudyRun& run) {
  return MachineJudge(study, run).Judge();
}

}  // namespace errmap::machine
