#include "cli/report/text/answers/next_steps.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "cli/report/text/answers/remarks.h"
#include "cli/report/text/answers/verdict_text.h"
#include "data/text.h"

namespace errmap::report {
namespace {

// The options by which the study read the component's measurements.
void AddDataOptions(const models::StudyRecord& record,
                    std::size_t component,
                    Words* words) {
  const auto& configured = record.provenance.configuration.component;
  if (component < configured.size() && configured[component].options) {
    AddOptions(*configured[component].options, words);
  }
}

Words CommandOn(const char* command, const Words& data) {
  Words words{"errmap", command};
  words.insert(words.end(), data.begin(), data.end());
  return words;
}

// The sensors that the recommended map reads, the most needed one first where
// the record knows.
Words SensorsByNeed(const models::RecommendationRecord& advice) {
  if (!advice.importance) return advice.sensors;
  Words sensors;
  for (const auto& without : advice.importance->one_by_one) {
    sensors.push_back(First(without.sensors));
  }
  return sensors;
}

}  // namespace

void AddOptions(const models::ByName<std::string>& options, Words* words) {
  for (const auto& [name, value] : options) {
    std::string flag = "--" + name;
    std::ranges::replace(flag, '_', '-');
    words->push_back(std::move(flag));
    if (!value.empty()) words->push_back(value);
  }
}

std::vector<NextStep> NextSteps(const models::StudyRecord& record,
                                std::size_t component,
                                const Words& data,
                                const std::string& folder) {
  const models::ComponentRecord& of = record.components[component];
  std::vector<NextStep> steps;
  const models::ModelRecord* found =
      of.recommendation ? models::FindNamed(of.models, of.recommendation->model)
                        : nullptr;
  if (found != nullptr && found->name != "zero") {
    const models::ModelRecord& model = *found;
    std::string map = "map.json";
    if (model.kind == models::ModelKind::kFile) {
      map = model.name.substr(model.name.find(':') + 1);
      steps.push_back({"the map", {}, map});
    } else if (model.file && !folder.empty()) {
      map = (std::filesystem::path(folder) / *model.file)
                .lexically_normal()
                .string();
      steps.push_back({"the map", {}, map});
    } else if (data.empty() || record.components.size() > 1) {
      // Rows of a part of a file, or defaults of a study file: no other command
      // has them.
      map = "STUDY/models/...json";
      steps.push_back(
          {"write the map", {}, "the same command with --out STUDY"});
    } else {
      Words words = CommandOn("fit", data);
      words.insert(words.end(), {"--model", model.name});
      AddDataOptions(record, component, &words);
      words.insert(words.end(), {"-o", map});
      steps.push_back({"write the map", std::move(words)});
    }
    steps.push_back(
        {"does it hold?", {"errmap", "check", map, "NEW_READINGS.csv"}});
    steps.push_back({"run it", {"errmap", "predict", map, "NEW_INPUTS.csv"}});
    Words to_control{"errmap", "export", map, "--c", "-o", "control"};
    if (model.counts_rows) {
      to_control.insert(to_control.end(), {"--every", "SECONDS"});
    }
    steps.push_back({"to the control", std::move(to_control)});
  }
  if (std::string measure = MeasureNext(of); !measure.empty()) {
    steps.push_back({"measure next", {}, std::move(measure)});
  }
  return steps;
}

std::vector<NextStep> PlacesToLook(const models::StudyRecord& record,
                                   std::size_t component,
                                   const Words& data,
                                   const std::string& folder,
                                   const std::string& page) {
  constexpr std::size_t kMostNamed = 6;
  const models::ComponentRecord& of = record.components[component];
  const auto& advice = of.recommendation;
  std::vector<NextStep> steps;
  const models::ModelRecord* found =
      advice ? models::FindNamed(of.models, advice->model) : nullptr;
  if (found != nullptr) {
    for (Remark& remark : RemarksOf(ComponentNumbers(of))) {
      if (remark.place != Remark::Place::kNextSteps) continue;
      steps.push_back({std::move(remark.label), {}, std::move(remark.text)});
    }
  }
  if (advice && !advice->sensors.empty()) {
    const Words sensors = SensorsByNeed(*advice);
    const std::size_t all = sensors.size();
    std::string text = data::ShortList(sensors, kMostNamed);
    if (all > 1) text += "; --exclude leaves some out";
    steps.push_back({"its sensors", {}, data::Printable(text)});
    if (all > 1 && !data.empty()) {
      Words words = CommandOn("learn", data);
      words.insert(words.end(), {"--by", "sensors"});
      AddDataOptions(record, component, &words);
      if (!folder.empty()) words.insert(words.end(), {"--out", folder});
      steps.push_back({"fewer of them", std::move(words)});
    }
  }
  steps.push_back({"the page",
                   {},
                   !page.empty() ? page
                   : folder.empty()
                       ? "the same command with -o page.html"
                       : (std::filesystem::path(folder) / "report.html")
                             .lexically_normal()
                             .string()});
  return steps;
}

}  // namespace errmap::report
