#include "cli/study_setup/plan/study_plan.h"

#include <algorithm>
#include <deque>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/report/text/commands/fault_text.h"
#include "cli/study_setup/plan/component_names.h"
#include "cli/study_setup/study_options.h"
#include "data/argument_name.h"
#include "data/csv.h"
#include "data/files/shown_path.h"
#include "data/input_error.h"
#include "data/measurements/axis/directions.h"
#include "data/measurements/joined_tables.h"
#include "data/measurements/measured_files.h"
#include "data/measurements/merged_log.h"
#include "data/measurements/reading/read_table.h"
#include "data/text.h"
#include "data/throwing_as.h"
#include "models/comparison/compare.h"
#include "models/file_recipe.h"
#include "models/record.h"
#include "models/study/split_file.h"
#include "models/study/study_defaults.h"
#include "stats/error_metrics.h"

namespace errmap::study_setup {
namespace {

// Several components may stand in one file: each is read and parsed once, or
// twice if only some of them leave out rows of another length.
class TableReader {
 public:
  explicit TableReader(std::vector<InputFile>* inputs) : inputs_(inputs) {}

  const data::CsvTable& Read(const std::string& file,
                             data::OddRows odd = data::OddRows::kRefuse) {
    const std::pair key(file, odd == data::OddRows::kLeaveOut);
    const auto found = tables_.find(key);
    if (found != tables_.end()) return found->second;
    InputFile input{.file = file, .sha256 = {}};
    data::CsvTable table = data::ReadCsv(file, &input.sha256, odd);
    if (!tables_.contains({file, !key.second})) {
      inputs_->push_back(std::move(input));
    }
    return tables_.emplace(key, std::move(table)).first->second;
  }

  /// The rows of one component: of one file, or of several as one table. What
  /// is told of the files goes to `tell`, which may be empty.
  const data::CsvTable& ReadAll(const std::vector<std::string>& files,
                                const data::DatasetSelection& selection,
                                const Remark& tell) {
    const data::OddRows odd = data::OddRowsFor(selection);
    if (files.size() == 1 && selection.with.empty()) return Read(files[0], odd);
    std::vector<data::CsvTable> tables;
    for (const std::string& file : files) tables.push_back(Read(file, odd));
    data::JoinedTable joined = data::JoinTables(std::move(tables), selection);
    for (const std::string& line : joined.remarks) {
      if (tell) tell(line);
    }
    if (!selection.with.empty()) {
      data::MergeLog(Read(selection.with), selection, &joined.table);
    }
    return joined_.emplace_back(std::move(joined.table));
  }

  const std::string& Sha256Of(const std::string& file) const {
    return std::ranges::find(*inputs_, file, &InputFile::file)->sha256;
  }

 private:
  std::vector<InputFile>* inputs_;
  // By file, and whether rows of another length are left out.
  std::map<std::pair<std::string, bool>, data::CsvTable> tables_;
  std::deque<data::CsvTable> joined_;
};

// Makes one component ready; remarks tell which if there are several.
class ComponentPlanner {
 public:
  ComponentPlanner(const StudyConfig& study,
                   const ComponentConfig& component,
                   const Remark& remark,
                   const MakeOwnRecipes& own,
                   TableReader* reader)
      : study_(study),
        component_(component),
        remark_(remark),
        own_(own),
        reader_(reader),
        files_(data::FindFiles(component.AllData())) {}

  models::ComponentPlan Plan() const {
    data::PreparedDataset prepared = PrepareData();
    std::vector<models::Holdout> holdouts = MakeHoldouts(prepared);
    if (holdouts.empty()) {
      throw data::InputError(
          fmt::format("{}: names no hold-out", component_.split));
    }
    std::vector<std::string> left_out;
    models::ComponentPlan plan =
        models::PlanModels({.name = component_.name,
                            .files = FilesRead(),
                            .data = std::move(prepared),
                            .holdouts = std::move(holdouts)},
                           study_.models,
                           &left_out,
                           own_ ? own_() : models::OwnRecipes{});
    for (const std::string& line : left_out) Tell(line);
    plan.given = ReadGiven();
    plan.comparison.rezero = Rezero(plan.comparison);
    const data::Dataset& dataset = plan.comparison.data.dataset;
    const data::Unit& unit = dataset.target().unit;
    plan.comparison.choose = study_.choose;
    plan.comparison.prefer = study_.prefer;
    plan.comparison.goal = SizeOf("goal", component_.goal, study_.goal, dataset)
                               .value_or(models::kNotKnown);
    plan.comparison.indifference =
        SizeOf("indifference",
               component_.indifference,
               study_.indifference,
               dataset)
            .value_or(models::DefaultIndifference(unit));
    return plan;
  }

 private:
  void Tell(const std::string& line) const {
    if (!remark_) return;
    remark_(study_.components.size() > 1
                ? data::Printable(component_.name, line.max_size()) + ": " +
                      line
                : line);
  }

  data::PreparedDataset PrepareData() const {
    for (const std::string& line : files_.remarks) Tell(line);
    const data::CsvTable& table = reader_->ReadAll(
        files_.paths, component_.selection, [this](const std::string& line) {
          Tell(line);
        });
    data::PreparedDataset prepared =
        data::MakeDataset(table, component_.selection);
    TellWhatWasFound(prepared, report::FaultUse::kFit);
    if (!component_.later.empty()) {
      prepared.dataset = WithoutLater(prepared.dataset);
    }
    return prepared;
  }

  std::vector<models::InputFileRecord> FilesRead() const {
    std::vector<models::InputFileRecord> files;
    for (const std::string& path : files_.paths) {
      files.push_back(
          {.file = data::ShownPath(path), .sha256 = reader_->Sha256Of(path)});
    }
    return files;
  }

  // Less the sessions that are to judge maps put together.
  data::Dataset WithoutLater(const data::Dataset& dataset) const {
    const std::vector<Index> codes = dataset.session_codes();
    std::vector<Index> rows;
    for (std::size_t i = 0; i < codes.size(); ++i) {
      const std::string& session =
          dataset.log()->sessions.labels[static_cast<std::size_t>(codes[i])];
      if (std::ranges::find(component_.later, session) !=
          component_.later.end()) {
        rows.push_back(dataset.rows()[i]);
      }
    }
    if (rows.size() == codes.size()) {
      throw data::InputError(fmt::format(
          "{}: all sessions are kept for judging; more days are needed",
          data::PrintablePath(component_.data)));
    }
    return data::WithoutRows(dataset, rows);
  }

  void TellWhatWasFound(const data::PreparedDataset& prepared,
                        report::FaultUse use) const {
    if (!remark_) return;
    for (const std::string& line : prepared.remarks) Tell(line);
    for (const std::string& line :
         report::FaultLines(prepared, component_.selection.faults, use)) {
      Tell(line);
    }
  }

  void TellOfLoneGroup(const data::Dataset& dataset) const {
    if (!dataset.has_groups() || dataset.groups().labels.size() > 1) return;
    Tell(
        fmt::format("column '{}' has one group only; more cycles are needed "
                    "to hold them out whole",
                    dataset.groups().column));
  }

  // Those of the split file first; it takes the place of the default ones.
  std::vector<models::Holdout> MakeHoldouts(
      const data::PreparedDataset& prepared) const {
    const data::Dataset& dataset = prepared.dataset;
    std::vector<models::Holdout> holdouts;
    std::vector<std::string> specs = study_.holdouts;
    if (!component_.split.empty()) {
      holdouts =
          models::ReadSplitFile(reader_->Read(component_.split), dataset);
    } else if (specs.empty()) {
      specs = models::DefaultHoldouts(dataset);
      TellOfLoneGroup(dataset);
    }
    for (const std::string& text : specs) {
      if (std::ranges::find(holdouts, text, &models::Holdout::name) !=
          holdouts.end()) {
        throw data::InputError(
            fmt::format("{}: has a hold-out {}, which {} names, too",
                        component_.split,
                        text,
                        data::ArgumentName("holdout")));
      }
      const stats::HoldoutSpec spec = stats::ParseHoldout(text);
      std::shared_ptr<const data::Dataset> test_data;
      if (spec.kind == stats::HoldoutKind::kFile) {
        const data::PreparedDataset test = data::MakeDataset(
            reader_->Read(spec.file),
            models::SelectionLike(dataset, component_.selection));
        TellWhatWasFound(test, report::FaultUse::kJudge);
        test_data = std::make_shared<const data::Dataset>(test.dataset);
      }
      holdouts.push_back(MakeOne(spec, dataset, std::move(test_data)));
      TellOfRowsLearnt(holdouts.back());
    }
    for (const std::string& text : models::HoldoutsBeside(holdouts, dataset)) {
      holdouts.push_back(MakeOne(stats::ParseHoldout(text), dataset, nullptr));
    }
    return holdouts;
  }

  models::Holdout MakeOne(
      const stats::HoldoutSpec& spec,
      const data::Dataset& dataset,
      std::shared_ptr<const data::Dataset> test_data) const {
    return data::ThrowingAs<data::InputError>(component_.data + ": ", [&] {
      return models::MakeHoldout(
          spec, dataset, study_.seed, std::move(test_data));
    });
  }

  void TellOfRowsLearnt(const models::Holdout& holdout) const {
    if (holdout.rows_of_training == 0) return;
    Tell(
        fmt::format("{}: {} of its {} rows are also in {}; its figures say "
                    "nothing about another day",
                    data::PrintablePath(holdout.test_data->source()),
                    holdout.rows_of_training,
                    holdout.test_data->num_rows(),
                    data::PrintablePath(component_.data)));
  }

  std::vector<models::GivenPredictions> ReadGiven() const {
    std::vector<models::GivenPredictions> given;
    for (const PredictionsFile& predictions : component_.predictions) {
      given.push_back(models::ReadGivenPredictions(
          predictions.name, reader_->Read(predictions.file)));
    }
    return given;
  }

  // Refused before anything is fitted where it leaves nothing to judge.
  std::optional<models::RezeroRule> Rezero(
      const models::ComponentStudy& component) const {
    if (study_.rezero.empty()) return std::nullopt;
    const data::Dataset& dataset = component.data.dataset;
    return data::ThrowingAs<data::InputError>(component_.data + ": ", [&] {
      models::RezeroRule rule = RezeroIn(dataset.target().unit, study_.rezero);
      models::RequireRezero(dataset, component.holdouts, rule);
      return rule;
    });
  }

  // The component's own, else the study's, in the target's unit.
  std::optional<double> SizeOf(const char* what,
                               const GivenError& own,
                               const GivenError& of_study,
                               const data::Dataset& dataset) const {
    const GivenError& given = own.is_given() ? own : of_study;
    if (!given.is_given()) return std::nullopt;
    const std::string remark =
        BareNumberRemark(what,
                         given,
                         dataset.target(),
                         stats::RootMeanSquare(dataset.target_values()));
    if (remark_ && !remark.empty()) Tell(remark);
    return data::ThrowingAs<data::InputError>(
        fmt::format("{}: {} ", component_.data, what),
        [&] { return InUnitOf(dataset.target().unit, given); });
  }

  const StudyConfig& study_;
  const ComponentConfig& component_;
  const Remark& remark_;
  const MakeOwnRecipes& own_;
  TableReader* reader_;
  data::MeasuredFiles files_;
};

// Rows that go both ways along the axis are two components. What a file of
// folds or predictions was made for stays whole.
void PartByDirection(StudyConfig* config, TableReader* reader) {
  std::vector<ComponentConfig> parted;
  for (const ComponentConfig& component : config->components) {
    std::vector<data::DatasetSelection> ways;
    std::vector<std::string> names;  // of the ways; empty: as by default
    if (component.split.empty() && component.save_split.empty() &&
        component.predictions.empty()) {
      try {
        const data::CsvTable& table =
            reader->ReadAll(data::FindFiles(component.AllData()).paths,
                            component.selection,
                            {});
        for (const data::ColumnFilter& way : data::DirectionsOf(
                 data::ReadRoles(table, component.selection).reading,
                 component.selection)) {
          ways.emplace_back(component.selection).where.push_back(way);
        }
        if (component.name.empty()) names = NamesByFile(table, ways);
      } catch (const data::InputError&) {
        // Said where the component is planned.
      }
    }
    if (ways.empty()) parted.push_back(component);
    for (std::size_t i = 0; i < ways.size(); ++i) {
      ComponentConfig& one = parted.emplace_back(component);
      one.selection = ways[i];
      if (!one.name.empty()) {
        one.name += ", " + ValueText(one.selection.where.back());
      } else if (!names.empty()) {
        one.name = names[i];
      }
    }
  }
  config->components = std::move(parted);
}

// What defaults became, so that a study with these words would do the same.
// Hold-outs and models that differ between components stay unsaid.
void FillInDefaults(StudyPlan* plan) {
  for (std::size_t i = 0; i < plan->components.size(); ++i) {
    const models::ComponentStudy& planned = plan->components[i].comparison;
    const data::Dataset& dataset = planned.data.dataset;
    ComponentConfig& component = plan->config.components[i];
    component.options = DataOptions(component.selection, plan->config.seed);
    component.selection.target = dataset.target().name;
    component.selection.group = dataset.groups().column;
    // "none" stays where nothing was found.
    const std::string& session = dataset.log()->sessions.column;
    if (!session.empty()) component.selection.session = session;
    const std::string& time = planned.data.time_column;
    if (!time.empty()) component.selection.time = time;
    component.goal = {.value = planned.goal};
    component.indifference = {.value = planned.indifference};
    component.selection.inputs.clear();
    for (const data::ColumnInfo& input : dataset.inputs()) {
      component.selection.inputs.push_back(input.name);
    }
  }
  const auto alike = [&](const auto& list_of) {
    std::vector<std::string> first = list_of(plan->components.front());
    for (const models::ComponentPlan& component : plan->components) {
      if (list_of(component) != first) return std::vector<std::string>{};
    }
    return first;
  };
  plan->config.holdouts =
      alike([](const models::ComponentPlan& c) { return c.HoldoutNames(); });
  plan->config.models =
      alike([](const models::ComponentPlan& c) { return c.ModelNames(); });
}

}  // namespace

int StudyPlan::num_fits() const {
  return std::transform_reduce(components.begin(),
                               components.end(),
                               0,
                               std::plus<>(),
                               [](const models::ComponentPlan& component) {
                                 return component.num_fits();
                               });
}

std::vector<std::string> StudyPlan::InputPaths() const {
  std::vector<std::string> paths;
  for (const InputFile& input : inputs) paths.push_back(input.file);
  for (const models::ComponentPlan& component : components) {
    for (const std::string& spec : component.ModelNames()) {
      const std::string file = models::FileOfSpec(spec);
      if (!file.empty()) paths.push_back(file);
    }
  }
  return paths;
}

StudyConfig PartedByDirection(StudyConfig config) {
  std::vector<InputFile> inputs;
  TableReader reader(&inputs);
  PartByDirection(&config, &reader);
  return config;
}

StudyPlan PlanStudy(const StudyConfig& config,
                    const Remark& remark,
                    const MakeOwnRecipes& own) {
  StudyPlan plan{.config = config, .inputs = {}, .components = {}};
  TableReader reader(&plan.inputs);
  PartByDirection(&plan.config, &reader);
  NameComponents(&plan.config);
  for (const ComponentConfig& component : plan.config.components) {
    plan.components.push_back(
        ComponentPlanner(plan.config, component, remark, own, &reader).Plan());
  }
  FillInDefaults(&plan);
  return plan;
}

}  // namespace errmap::study_setup
