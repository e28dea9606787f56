#include "cli/report/documents/study_table.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "cli/report/figures/figures.h"
#include "cli/report/number_text.h"
#include "cli/report/shell_word.h"
#include "cli/report/tables/report_tables.h"
#include "cli/report/text/answers/component_numbers.h"
#include "cli/report/text/answers/data_words.h"
#include "cli/report/text/answers/first_answer.h"
#include "cli/report/text/answers/mark_words.h"
#include "cli/report/text/answers/next_steps.h"
#include "cli/report/text/answers/rezero_text.h"
#include "cli/report/text/answers/verdict_text.h"
#include "cli/report/wrap_text.h"
#include "data/text.h"

namespace errmap::report {
namespace {

constexpr std::size_t kMostRows = 12;

constexpr const char* kSign =
    "Error = actual - nominal; the compensation is minus the predicted error.";

// "net:scg: 7 of 7 fits ended without converging (iteration_limit 7)": such
// figures are usable, but another run length or start would give others.
std::string UnconvergedNote(const ModelRecord& model) {
  std::map<std::string, int> reasons;
  int fits = 0;
  int unconverged = 0;
  const auto count = [&](const models::FitRecord& fit) {
    ++fits;
    if (fit.summary.value.converged) return;
    ++unconverged;
    ++reasons[std::string(fitting::ToString(fit.summary.value.stop))];
  };
  for (const auto& [holdout, result] : model.results) {
    for (const models::FoldRecord& fold : result.folds) count(fold.fit.value);
  }
  if (model.final) count(*model.final);
  if (unconverged == 0) return "";
  std::vector<std::string> parts;
  for (const auto& [reason, times] : reasons) {
    parts.push_back(fmt::format("{} {}", reason, times));
  }
  return fmt::format("{}: {} of {} ended without converging ({}).",
                     model.name,
                     unconverged,
                     Count(fits, "fit"),
                     data::JoinWords(parts, ", "));
}

std::string WhereWords(const ReportView& view, const std::string& holdout) {
  return fmt::format("{} ({})", UnseenWords(view, holdout), holdout);
}

// What is written about one component, line by line.
class ComponentScreen {
 public:
  ComponentScreen(const models::StudyRecord& record,
                  std::size_t index,
                  const StudyTableOptions& options,
                  Screen* screen)
      : study_(record),
        index_(index),
        record_(record.components[index]),
        view_(ViewOf(record_)),
        options_(options),
        screen_(screen) {}

  // What to use, of which data, and the table.
  void Answer();
  void Next(const std::vector<std::string>& data);
  // Call after Answer: it adds the remarks that did not fit there.
  void Details();

 private:
  const models::StudyRecord& study_;
  std::size_t index_;
  const models::ComponentRecord& record_;
  ReportView view_;
  const StudyTableOptions& options_;
  Screen* screen_;
  std::vector<Remark> left_out_;  // remarks that did not fit the answer

  void Leaderboard();

  std::size_t Width() const { return options_.terminal.text_columns(); }
  void Paragraph(const std::string& text) {
    for (const std::string& line : WrapLines(text, Width())) {
      screen_->Add(line + "\n");
    }
  }
  // The marked row stands out.
  void Add(const Table& table) {
    const std::vector<std::string> lines =
        TerminalLines(table, options_.terminal.columns);
    const std::size_t head = lines.size() - table.rows.size();
    for (std::size_t i = 0; i < lines.size(); ++i) {
      screen_->Add(
          lines[i] + "\n",
          table.marked != std::string::npos && i == head + table.marked);
    }
  }
};

void ComponentScreen::Answer() {
  const models::DataRecord& data = record_.data;
  std::vector<std::string> above;
  const auto add = [&](const std::string& text) {
    for (std::string& line : WrapLines(text, Width())) {
      above.push_back(std::move(line));
    }
  };
  if (data.reading.rows > 0) {
    for (const std::string& line : data::ReadingLines(data.reading)) add(line);
  }
  // What these lines do not say.
  if (data.reading.rows == 0) {
    add(fmt::format("{}: {}{}; {}",
                    data.file,
                    Count(data.rows, "row"),
                    UnitsWords(data),
                    TargetWords(data)));
  } else if (data.align != data::Alignment::kNone) {
    add(fmt::format("Target: {}.", TargetWords(data)));
  }
  for (const std::string& line : above) screen_->Add(line + "\n");
  screen_->Add("\n");
  bool first = true;
  ShownAnswer answer = AnswerLines(FirstAnswerOf(record_), Width(), above);
  for (const std::string& line : answer.lines) {
    screen_->Add(line + "\n", first);
    first = false;
  }
  left_out_ = std::move(answer.left_out);
  screen_->Add("\n");
  Leaderboard();
  screen_->Add("\n");
}

void ComponentScreen::Leaderboard() {
  const std::size_t most = options_.all ? view_.models.size() : kMostRows;
  Add(TerminalLeaderboard(view_, most));
  screen_->Add("\n");
  std::vector<std::string> legend;
  if (!view_.recommended.empty()) legend.push_back(MarkWords(view_));
  std::string where =
      fmt::format("RMSE: {}", WhereWords(view_, view_.decisive));
  if (!view_.neighbours.empty() && !record_.rezero) {
    where += "; " + WhereWords(view_, view_.neighbours);
  }
  if (!view_.later.empty()) {
    where += fmt::format("; {}, fitted to those before ({})",
                         UnseenWords(view_, view_.later),
                         view_.later);
  }
  if (std::isfinite(record_.goal)) {
    where += fmt::format("; goal {:g}{}{} (--goal)",
                         record_.goal * record_.display.scale,
                         record_.display.unit.empty() ? "" : " ",
                         record_.display.unit);
  }
  legend.push_back(where + ".");
  if (record_.rezero) {
    legend.push_back(fmt::format(
        "All {} (--rezero), but no re-zero: the same rows without it.",
        RezeroedWords(record_)));
  }
  if (std::string drawn = DrawnRowsWords(view_); !drawn.empty()) {
    legend.push_back(std::move(drawn));
  }
  if (std::string other = StandInWords(view_, most); !other.empty()) {
    legend.push_back(std::move(other));
  }
  if (std::ranges::any_of(view_.models, [&](const ModelRecord* model) {
        const ResultRecord* const result = ResultOf(*model, view_.decisive);
        return result != nullptr && !std::isfinite(result->ci95[0]);
      })) {
    legend.emplace_back("95 % -: no range.");
  }
  if (view_.models.size() > most) {
    legend.push_back(
        fmt::format("{} more with --all.", view_.models.size() - most));
  }
  if (!options_.details) {
    legend.emplace_back("p values and times with --details.");
  }
  Paragraph(data::JoinWords(legend, " "));
  for (const ModelRecord& model : record_.models) {
    if (model.why) {
      Paragraph(fmt::format("{} failed, {}", model.name, *model.why));
    }
  }
}

void ComponentScreen::Next(const std::vector<std::string>& data) {
  constexpr std::size_t kIndent = 16;
  std::vector<NextStep> steps =
      NextSteps(study_, index_, data, options_.folder);
  for (NextStep& step :
       PlacesToLook(study_, index_, data, options_.folder, options_.page)) {
    steps.push_back(std::move(step));
  }
  for (const NextStep& step : steps) {
    const std::string begin = fmt::format("{:{}}", step.purpose, kIndent);
    if (!step.words.empty()) {
      screen_->Add(
          begin + ShellCommand(step.words, options_.terminal.columns, kIndent) +
          "\n");
      continue;
    }
    screen_->Add(Hanging(begin, step.text, Width()));
  }
}

void ComponentScreen::Details() {
  for (const std::string& holdout : view_.holdouts) {
    const models::HoldoutRecord& held = *HoldoutOf(view_, holdout);
    screen_->Add("\n");
    Paragraph(fmt::format(
        "{}: RMSE{}. p: against the recommended map, by {}, with Holm's "
        "correction, one-sided against a baseline. Proven only if "
        "'established'; -: too few for so many pairs.",
        holdout,
        record_.display.unit.empty() ? "" : " in " + record_.display.unit,
        CountOfUnits(held.units, held)));
    Add(TerminalDetails(view_, holdout));
  }
  Paragraph(fmt::format(
      "{}. Compare two maps by p, not by their ranges. Tier 1: as good in "
      "practice as the lowest error. Ratio, below: RMSE on unseen rows over "
      "that among neighbours.",
      kIntervalCoverage));
  screen_->Add("\n");
  Add(TerminalTimes(view_));
  screen_->Add("\n");
  for (const ModelRecord& model : record_.models) {
    Paragraph(UnconvergedNote(model));
    if (model.memorisation) Paragraph(model.memorisation->sentence);
  }
  screen_->Add("\n" + VerdictParagraphs(record_, Width(), options_.next_steps));
  for (const Remark& remark : left_out_) {
    for (const std::string& line : LabelledLines(remark, Width())) {
      screen_->Add(line + "\n");
    }
  }
}

// How many meet their goal, and for how many nothing is proven.
std::string OverallWords(const models::StudyRecord& record) {
  std::map<models::GoalStanding, std::size_t> standings;
  std::size_t proven = 0;
  std::size_t maps = 0;
  for (const models::ComponentRecord& component : record.components) {
    if (!component.recommendation) continue;
    const models::RecommendationRecord& advice = *component.recommendation;
    ++standings[advice.goal_standing];
    if (advice.choice == models::Choice::kBaseline) continue;
    ++maps;
    if (advice.against_baseline == models::Confidence::kEstablished) ++proven;
  }
  using models::GoalStanding;
  std::vector<std::string> goals;
  for (const auto& [standing, words] :
       {std::pair(GoalStanding::kMet, "met by {}"),
        std::pair(GoalStanding::kMetAfterRezeroing, "by {} if re-zeroed"),
        std::pair(GoalStanding::kMissed, "missed by {}"),
        std::pair(GoalStanding::kNone, "not set for {}")}) {
    if (const auto n = standings[standing]; n > 0) {
      goals.push_back(fmt::format(fmt::runtime(words), n));
    }
  }
  std::string text = Count(std::ssize(record.components), "component");
  // Where none has a goal there is nothing to say of it.
  if (!goals.empty() &&
      (goals.size() > 1 || standings[GoalStanding::kNone] == 0)) {
    text += fmt::format(": goal {}", data::JoinWords(goals, ", "));
  }
  text += ".";
  if (maps > 0) {
    text += fmt::format(
        " {} of the {} maps that are no baseline are proven better than one.",
        proven,
        maps);
  }
  return text;
}

void AddPart(const RecordPart& part, const Terminal& terminal, Screen* screen) {
  const std::size_t width = terminal.text_columns();
  screen->Add("\n" + WrapText(part.answer, width) + "\n");
  for (Table table : part.screen) {
    // Its last columns are on the page.
    TakeColumns(terminal.columns, 4, &table);
    screen->Add("\n" + WrapText(table.title, width) + "\n\n" +
                TerminalTable(table, terminal.columns) +
                WrapText(table.note, width) + "\n");
  }
}

// How the one file was read that all components are of, each of some of its
// rows, with the ways of all; else nothing.
std::vector<std::string> SharedReading(const models::StudyRecord& record) {
  std::vector<std::string> shared;
  std::set<std::string> ways;
  data::Reading reading;
  for (const models::ComponentRecord& component : record.components) {
    reading = component.data.reading;
    if (reading.rows == 0) return {};
    reading.rows += reading.rows_filtered;
    reading.direction.chosen.clear();
    ways.insert(reading.direction.values.begin(),
                reading.direction.values.end());
    reading.direction.values.clear();
    std::vector<std::string> lines = data::ReadingLines(reading);
    if (!shared.empty() && lines != shared) return {};
    shared = std::move(lines);
  }
  reading.direction.values.assign(ways.begin(), ways.end());
  return shared.empty() ? shared : data::ReadingLines(reading);
}

std::string WhereMapsAre(const StudyTableOptions& options) {
  std::string words =
      options.folder.empty()
          ? "To write the maps and draw a page, add --out DIR."
          : fmt::format(
                "The maps are in {0}/models, the page is {0}/report.html.",
                options.folder);
  if (!options.details) {
    words += " Each component's verdict, table and next steps: --details.";
  }
  return words;
}

}  // namespace

Screen StudyTable(const models::StudyRecord& record,
                  const StudyTableOptions& options) {
  Screen screen;
  const auto component = [&](std::size_t i) {
    return ComponentScreen(record, i, options, &screen);
  };
  const std::size_t asked_for =
      record.provenance.configuration.component.size();
  if (asked_for <= 1 && record.components.size() == 1) {
    ComponentScreen one = component(0);
    one.Answer();
    if (options.next_steps) one.Next(options.data);
    if (options.details) one.Details();
  } else {
    const std::size_t width = options.terminal.text_columns();
    const std::vector<std::string> reading = SharedReading(record);
    for (const std::string& line : reading) {
      screen.Add(WrapText(line, width) + "\n");
    }
    if (!reading.empty()) screen.Add("\n");
    screen.Add(WrapText(OverallWords(record), width) + "\n\n", true);
    screen.Add(TerminalTable(SummaryRows(record), options.terminal.columns));
    screen.Add("\n");
    for (std::size_t i = 0; i < record.components.size(); ++i) {
      if (!options.details) break;
      const std::string& name = record.components[i].name;
      screen.Add("== " + data::Printable(name) + " ==\n", true);
      ComponentScreen one = component(i);
      one.Answer();
      one.Next({});
      one.Details();
      screen.Add("\n");
    }
    screen.Add(WrapText(WhereMapsAre(options), width) + "\n");
  }
  for (const RecordPart& part : PartsOf(record)) {
    AddPart(part, options.terminal, &screen);
  }
  screen.Add(std::string("\n") + kSign + "\n");
  return screen;
}

}  // namespace errmap::report
