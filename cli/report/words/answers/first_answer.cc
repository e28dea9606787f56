#include "cli/report/words/answers/first_answer.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "cli/report/number_text.h"
#include "cli/report/words/answers/component_numbers.h"
#include "cli/report/words/answers/rezero_text.h"
#include "cli/report/wrap_text.h"
#include "data/text.h"
#include "models/study/judgement/goal.h"
#include "models/study/judgement/recommendation.h"

namespace errmap::report {
namespace {

using models::Choice;
using models::Confidence;
using models::GoalStanding;
using models::HoldoutRecord;
using models::RecommendationRecord;
using models::RemarkKind;
using models::RemarkRecord;
using Tone = AnswerLine::Tone;

const RemarkRecord* FindRemark(const RecommendationRecord& advice,
                               RemarkKind kind) {
  for (const auto* remarks : {&advice.grounds, &advice.doubts}) {
    const auto found = std::ranges::find(*remarks, kind, &RemarkRecord::kind);
    if (found != remarks->end()) return &*found;
  }
  return nullptr;
}

// The lines of one component's answer, in their order.
class AnswerWriter {
 public:
  explicit AnswerWriter(const models::ComponentRecord& record)
      : numbers_(record),
        advice_(numbers_.Advice()),
        holdout_(numbers_.Holdout(advice_.holdout)) {}

  FirstAnswer Write() {
    answer_.use = Use();
    AddError();
    AddWithoutMap();
    AddRival();
    AddAnotherDay();
    AddInterrupted();
    AddWhatIsLeft();
    AddRezeroed();
    AddGrowing();
    AddRowsLearnt();
    AddBetterWithoutMap();
    AddGoal();
    for (const std::string& doubt : numbers_.record.data.doubts) {
      Add("check the data", doubt, Tone::kBad);
    }
    AddMeasureMore();
    return std::move(answer_);
  }

 private:
  ComponentNumbers numbers_;
  const RecommendationRecord& advice_;
  const HoldoutRecord& holdout_;
  FirstAnswer answer_;

  void Add(std::string label, std::string text, Tone tone = Tone::kPlain) {
    answer_.lines.push_back({std::move(label), std::move(text), tone});
  }
  const RemarkRecord* Remark(RemarkKind kind) const {
    return FindRemark(advice_, kind);
  }
  bool IsBaseline() const { return advice_.choice == Choice::kBaseline; }
  std::string RmseOf(const std::string& model) const {
    return numbers_.error.WithUnit(numbers_.Rmse(model, advice_.holdout));
  }

  std::string Use() const {
    if (advice_.model == "zero") {
      return "Do not compensate: no map does better.";
    }
    if (IsBaseline()) {
      return fmt::format("Use {}: no richer map is known to do better.",
                         advice_.model);
    }
    return fmt::format("Use {}{}.",
                       advice_.model,
                       Remark(RemarkKind::kAveragesMaps) != nullptr
                           ? ", an average of maps"
                           : "");
  }

  // "another day", "unseen cycles": where the error was measured.
  std::string WhereMeasured() const {
    if (holdout_.whole_sessions) return "another " + holdout_.unit_of_analysis;
    if (holdout_.whole_groups) return "unseen " + PluralOfUnit(holdout_);
    if (holdout_.among_neighbours) return "between rows";
    return holdout_.another_file ? "another file" : "unseen rows";
  }

  void AddError() {
    const ResultRecord& result =
        numbers_.Result(advice_.model, advice_.holdout);
    std::string text = numbers_.error.WithUnit(result.test.rmse) + " RMSE";
    // From so many on only units that resemble their neighbours give none.
    constexpr std::int64_t kFewestForRange = 3;
    // An interval that reaches below no error at all tells nothing.
    if (std::isfinite(result.ci95[0]) && result.ci95[0] > 0.0) {
      text += fmt::format(" (95 %: {} to {})",
                          numbers_.error(result.ci95[0]),
                          numbers_.error(result.ci95[1]));
    } else if (holdout_.units >= kFewestForRange &&
               !std::isfinite(result.ci95[0])) {
      text += fmt::format("; {} do not tell how sure that is",
                          CountOfUnits(holdout_.units, holdout_));
    }
    if (holdout_.among_neighbours) text += ", next to rows that it learnt from";
    Add(WhereMeasured(), text);
  }

  void AddWithoutMap() {
    if (advice_.model == "zero" || !std::isfinite(advice_.removed_share))
      return;
    const double removed = std::floor(kPercent * advice_.removed_share);
    Add("without a map",
        removed > 0.0
            ? fmt::format("{}; {:.0f} % removed", RmseOf("zero"), removed)
            : RmseOf("zero"),
        Tone::kPlain);
  }

  // How sure it is that one map errs less than another.
  std::string Certainty(const std::string& other) const {
    const models::PairRecord* const pair = models::FindPair(
        numbers_.record, advice_.holdout, advice_.model, other);
    if (pair == nullptr || !std::isfinite(pair->ci95[0])) {
      return fmt::format("{} cannot tell how sure that is",
                         CountOfUnits(holdout_.units, holdout_));
    }
    if (pair->established) return "the gap is proven";
    const auto [low, high] = pair->ci95;
    return low > 0.0 || high < 0.0 ? "the gap is likely real"
                                   : "the gap may be chance";
  }

  // The best of the simple maps; for a simple map the best of the others.
  std::optional<std::string> Rival() const {
    if (!IsBaseline()) return advice_.best_baseline;
    std::optional<std::string> best;
    for (const ModelRecord& model : numbers_.record.models) {
      const double rmse = TestRmse(model, advice_.holdout);
      if (model.name == advice_.model || model.baseline ||
          !std::isfinite(rmse)) {
        continue;
      }
      if (!best || rmse < numbers_.Rmse(*best, advice_.holdout)) {
        best = model.name;
      }
    }
    return best;
  }

  void AddRival() {
    const std::optional<std::string> rival = Rival();
    if (!rival || *rival == advice_.model) return;
    const bool errs_less = numbers_.Rmse(*rival, advice_.holdout) <
                           numbers_.Rmse(advice_.model, advice_.holdout);
    if (*rival == "zero" && !errs_less) return;  // has a line of its own
    const bool alike = RmseOf(*rival) == RmseOf(advice_.model);
    Add(IsBaseline() ? "best other map" : "simplest rival",
        alike ? fmt::format("{}, {}: as good", RmseOf(*rival), *rival)
              : fmt::format("{}, {}{}; {}",
                            RmseOf(*rival),
                            *rival,
                            errs_less ? ", which errs less" : "",
                            Certainty(*rival)));
  }

  void AddAnotherDay() {
    const auto unknown = [&](const char* why) {
      Add("another day", std::string("not known: ") + why, Tone::kBad);
    };
    if (Remark(RemarkKind::kOneRunOnly) != nullptr) {
      Add("another day",
          "not measured: this is one run. Measure again on other days.",
          Tone::kBad);
    } else if (Remark(RemarkKind::kGroupFitsFailed) != nullptr) {
      unknown("no fit with whole groups held out succeeded");
    } else if (Remark(RemarkKind::kNoGroupsHeldOut) != nullptr) {
      unknown("hold out whole groups, as by --holdout groups:5");
    } else if (Remark(RemarkKind::kNoGroups) != nullptr) {
      unknown("name the column of cycles with --group");
    }
    if (const auto& promise = advice_.promise; promise && promise->good_for) {
      Add("good for",
          fmt::format("the next {}: neighbouring {} may err alike",
                      Count(*promise->good_for, promise->unit),
                      PluralOf(promise->unit)));
    }
  }

  void AddInterrupted() {
    if (Remark(RemarkKind::kInterrupted) == nullptr) return;
    Add("interrupted", "the fits are incomplete", Tone::kBad);
  }

  void AddWhatIsLeft() {
    const RemarkRecord* const left = Remark(RemarkKind::kNotNoise);
    if (left == nullptr) return;
    const auto& by_group =
        numbers_.Result(advice_.model, advice_.holdout).randomness.by_group;
    const auto& columns = There(left->columns);
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const double percent = kPercent * Part(There(left->shares), i);
      if (by_group && by_group->column == columns[i]) {
        std::string text = fmt::format(
            "{:.0f} % shifts whole {}", percent, PluralOf(columns[i]));
        if (left->add_sensor) {
          text +=
              fmt::format(": re-zero each {}{}",
                          columns[i],
                          *left->add_sensor ? ", or add a thermometer" : "");
        }
        Add("what is left", text);
      } else {
        Add("what is left",
            fmt::format(
                "{:.0f} % repeats along {}: the map is too smooth there",
                percent,
                columns[i]));
      }
    }
  }

  void AddRezeroed() {
    const auto& rezero = numbers_.record.rezero;
    if (!rezero) return;
    const auto map = std::ranges::find(
        rezero->models, advice_.model, &models::RezeroedModelRecord::model);
    if (map == rezero->models.end()) return;
    Add("re-zeroed",
        fmt::format("all of this is {}; never re-zeroed: {}, no map: {}",
                    RezeroedWords(numbers_.record),
                    numbers_.error.WithUnit(map->never),
                    numbers_.error.WithUnit(rezero->no_map)));
  }

  void AddGrowing() {
    const RemarkRecord* const growing = Remark(RemarkKind::kOnlyGrows);
    if (growing == nullptr) return;
    const auto& columns = There(growing->columns);
    Add("extrapolated",
        fmt::format("{} only {}, so future {} lie outside the data",
                    data::JoinWords(columns, " and "),
                    columns.size() == 1 ? "increases" : "increase",
                    PluralOfUnit(holdout_)),
        Tone::kBad);
  }

  void AddRowsLearnt() {
    const RemarkRecord* const learnt = Remark(RemarkKind::kRowsLearnt);
    if (learnt == nullptr) return;
    for (const std::string& name : There(learnt->holdouts)) {
      Add("ignore " + name,
          fmt::format("{} of its rows were learnt; give a file of another day",
                      There(numbers_.Holdout(name).rows_of_training)),
          Tone::kBad);
    }
  }

  void AddBetterWithoutMap() {
    const RemarkRecord* const better = Remark(RemarkKind::kBetterWithoutMap);
    if (better == nullptr) return;
    Add("errs less",
        fmt::format("{}, {}: predictions without a map to use",
                    RmseOf(There(better->model)),
                    *better->model));
  }

  void AddGoal() {
    const double goal = numbers_.record.goal;
    if (!std::isfinite(goal)) {
      if (numbers_.record.display.unit.ends_with("m")) {
        Add("goal", "none given; --goal 2um judges by one");
      }
      return;
    }
    const std::string wanted =
        fmt::format("{:g}{}{}",
                    goal * numbers_.record.display.scale,
                    numbers_.record.display.unit.empty() ? "" : " ",
                    numbers_.record.display.unit);
    const models::MetricsRecord& found =
        numbers_.Result(advice_.model, advice_.holdout).test;
    switch (advice_.goal_standing) {
      case GoalStanding::kMet:
        Add("goal", wanted + ": reached", Tone::kGood);
        return;
      case GoalStanding::kMetAfterRezeroing:
        Add("goal",
            fmt::format("{}: reached after re-zeroing; the scatter is {}",
                        wanted,
                        numbers_.error.WithUnit(found.sd)),
            Tone::kGood);
        return;
      case GoalStanding::kMissed:
        Add("goal", wanted + ": not reached", Tone::kBad);
        return;
      case GoalStanding::kNotJudged:
        Add("goal",
            wanted + (found.n < models::kFewestRowsForGoal
                          ? fmt::format(": not judged on {} rows; it takes {}",
                                        found.n,
                                        models::kFewestRowsForGoal)
                          : ": not judged, since fits are missing"));
        return;
      case GoalStanding::kNone:
        return;
    }
  }

  // How much so few units tell, and how many would settle which map is best.
  void AddMeasureMore() {
    const bool little = Remark(RemarkKind::kFewSessions) != nullptr;
    const bool apart = Remark(RemarkKind::kTooFewUnits) == nullptr &&
                       Remark(RemarkKind::kTooManyMaps) == nullptr;
    if (!little && apart) return;
    std::string text = fmt::format(
        "{} {}",
        CountOfUnits(holdout_.units, holdout_),
        little ? "say little about another" : "do not tell these maps apart");
    const auto needed =
        apart ? 0 : There(numbers_.Verdict(advice_.holdout).obstacle).needed;
    if (needed > 0) {
      text += fmt::format("; {} would{}",
                          CountOfUnits(needed, holdout_),
                          little ? " tell the maps apart" : "");
    }
    Add("how sure", text, little ? Tone::kBad : Tone::kPlain);
  }
};

FirstAnswer WithoutAMap(const models::ComponentRecord& record) {
  const std::string why =
      record.interrupted ? "the run was interrupted."
      : record.data.rows < models::kFewestRowsToRecommend
          ? fmt::format(
                "{} rows are too few to judge one. Measure {} or more, best "
                "ten cycles on each of two days.",
                record.data.rows,
                models::kFewestRowsToRecommend)
          : "none could be judged.";
  FirstAnswer answer{.use = "No map can be recommended: " + why, .lines = {}};
  for (const std::string& doubt : record.data.doubts) {
    answer.lines.push_back(
        {.label = "check the data", .text = doubt, .tone = Tone::kBad});
  }
  return answer;
}

}  // namespace

FirstAnswer FirstAnswerOf(const models::ComponentRecord& record) {
  if (!record.recommendation) return WithoutAMap(record);
  return AnswerWriter(record).Write();
}

std::string FirstAnswer::Sentence() const {
  if (lines.empty()) return use;
  std::string label = lines.front().label;
  label.front() = static_cast<char>(
      std::toupper(static_cast<unsigned char>(label.front())));
  return fmt::format("{} {}: {}.", use, label, lines.front().text);
}

std::vector<std::string> AnswerLines(const FirstAnswer& answer,
                                     std::size_t width,
                                     const std::vector<std::string>& above) {
  constexpr std::size_t kMostLines = 12;
  constexpr std::ptrdiff_t kMostWords = 110;
  constexpr std::size_t kIndent = 19;  // two blanks, a label, two blanks
  const auto words_in = [](const std::string& text) {
    return 1 + std::ranges::count(text, ' ');
  };
  std::vector<std::string> lines = WrapLines(answer.use, width);
  std::ptrdiff_t words = words_in(answer.use);
  for (const std::string& line : above) words += words_in(line);
  for (const AnswerLine& line : answer.lines) {
    const std::vector<std::string> wrapped =
        WrapLines(data::Printable(line.text, line.text.size()),
                  width > 2 * kIndent ? width - kIndent : width);
    const std::ptrdiff_t more = words_in(line.label) + words_in(line.text);
    if (above.size() + lines.size() + wrapped.size() > kMostLines ||
        words + more > kMostWords) {
      continue;
    }
    words += more;
    std::string begin = fmt::format("  {:<15}  ", line.label);
    for (const std::string& text : wrapped) {
      lines.push_back(begin + text);
      begin.assign(kIndent, ' ');
    }
  }
  return lines;
}

}  // namespace errmap::report
