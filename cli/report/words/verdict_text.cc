#include "cli/report/words/verdict_text.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/report/words/interval_text.h"
#include "cli/shell/wrap_text.h"
#include "data/text.h"
#include "stats/comparison/paired_comparison.h"

namespace errmap::cli {

const char* const kIntervalCoverage =
    "95 % is nominal: simulated, 90-94 % (normal errors), 70-86 % (heavy "
    "tails)";

namespace {

using models::Choice;
using models::Confidence;
using models::FindNamed;
using models::GoalStanding;
using models::HoldoutRecord;
using models::PairRecord;
using models::RecommendationRecord;
using models::RemarkKind;
using models::RemarkRecord;
using models::VerdictRecord;
using Kind = models::Obstacle::Kind;

constexpr double kPercent = 100.0;

// "4.5"; a ratio beyond a thousand has no decimals that mean anything.
std::string RatioText(double ratio) {
  constexpr double kLarge = 1000.0;
  return ratio < kLarge ? fmt::format("{:.1f}", ratio)
                        : fmt::format("{:.2g}", ratio);
}

// "cycles", "blocks of rows": what the tests count.
std::string PluralOfUnit(const HoldoutRecord& holdout) {
  return holdout.unit_of_analysis == models::kBlockOfRows
             ? "blocks of rows"
             : holdout.unit_of_analysis + "s";
}

// What one more session of measurements may bring.
std::string OneMoreText(const models::SessionWorthRecord& worth,
                        const std::string& unit) {
  constexpr double kWorthSaying = 0.02;
  const double saved = 1.0 - worth.ratio_of_one_more;
  if (!(saved > kWorthSaying)) {
    return fmt::format(
        "With one {0} fewer to learn from it erred {1:.2f} times as much: one "
        "more {0} of the same kind promises little.",
        unit,
        worth.ratio_of_one_fewer);
  }
  return fmt::format(
      "With one {0} fewer to learn from it erred {1:.2f} times as much: one "
      "more {0} may take {2:.0f} % off its error.",
      unit,
      worth.ratio_of_one_fewer,
      kPercent * saved);
}

std::string ListBesides(const std::vector<std::string>& names,
                        const std::string& besides) {
  std::vector<std::string> others = names;
  std::erase(others, besides);
  return fmt::format("{}", fmt::join(others, ", "));
}

// "10 cycles, at least 12 are needed where they may be of one session".
std::string ObstacleText(const models::ObstacleRecord& obstacle) {
  const std::string found = Count(obstacle.units, "unit");
  switch (obstacle.kind) {
    case Kind::kNone:
      return "";
    case Kind::kTooFewUnits:
      return fmt::format(
          "{}, at least {} are needed: with fewer, no sign-flip p can be below "
          "0.05",
          found,
          obstacle.needed);
    case Kind::kPerhapsOneSession:
      return fmt::format(
          "{}, not known to be separate sessions: at least {} are needed to "
          "see whether they resemble each other",
          found,
          obstacle.needed);
    case Kind::kTooManyPairs:
      return fmt::format(
          "{} for {} pairs: at least {} are needed for a p below 0.05 after "
          "Holm's adjustment",
          found,
          obstacle.pairs,
          obstacle.needed);
    case Kind::kTooFewSignPatterns:
      return fmt::format("the sign patterns drawn are too few for {} pairs",
                         obstacle.pairs);
  }
  return "";
}

std::string MemorisationSentence(const ModelRecord& model) {
  const models::MemorisationRecord& found = *model.memorisation;
  std::string effective;
  if (std::isfinite(found.effective_parameters)) {
    effective =
        fmt::format(", {:.0f} of them effective", found.effective_parameters);
  }
  const std::string figures = fmt::format(
      "{:.2g} weights per row{}; fitted to shuffled targets it still explains "
      "{:.0f} % of them",
      found.weights_per_row,
      effective,
      kPercent * std::max(0.0, found.shuffled_r2));
  switch (found.learning) {
    case models::NoiseLearning::kUnknown:
      return fmt::format("Whether {} learns noise is not known: {}.",
                         model.name,
                         found.why_not.value_or(""));
    case models::NoiseLearning::kLittle:
      return fmt::format("{} learns little noise: {}.", model.name, figures);
    case models::NoiseLearning::kSome:
      return fmt::format("{} learns some noise: {}.", model.name, figures);
    case models::NoiseLearning::kMuch:
      return fmt::format(
          "{} can learn its rows by heart: {}. Its training error says "
          "nothing; a larger wfactor or fewer hidden nodes would.",
          model.name,
          figures);
  }
  return "";
}

// After how long a step of temperature is forgotten, and the zero.
std::string MemoryText(const models::MemoryRecord& memory) {
  // After three time constants 5 % of a step is left.
  constexpr double kForgotten = 3.0;
  constexpr double kSecondsPerMinute = 60.0;
  constexpr double kMinutesPerHour = 60.0;
  std::string text;
  if (memory.longest > 0.0) {
    const double span = kForgotten * memory.longest;
    const double minutes = span / kSecondsPerMinute;
    text +=
        memory.time_unit != "s"
            ? fmt::format(" over the last {:.0f} rows", span)
        : minutes < 2.0 * kMinutesPerHour
            ? fmt::format(" over the last {:.0f} min", minutes)
            : fmt::format(" over the last {:.2g} h", minutes / kMinutesPerHour);
  }
  if (memory.zeroed) text += ", zeroed at the start of a session";
  return text;
}

std::string CostSentence(const RecommendationRecord& advice) {
  constexpr std::size_t kMostNamed = 8;
  std::string sensors = "no sensor";
  if (!advice.sensors.empty()) {
    sensors = Count(std::ssize(advice.sensors), "sensor");
    if (advice.sensors.size() <= kMostNamed) {
      sensors += fmt::format(" ({})", fmt::join(advice.sensors, ", "));
    }
  }
  std::string cost = Count(advice.cost.multiplications, "multiplication");
  if (advice.cost.exponentials > 0) {
    cost += " and " + Count(advice.cost.exponentials, "exponential");
  }
  return fmt::format("It needs {}{}; a prediction costs {}.",
                     sensors,
                     advice.memory ? MemoryText(*advice.memory) : "",
                     cost);
}

// ", with elapsed_cycles below 7 or above 27"; "" where nothing is known.
std::string WhereToMeasure(const RemarkRecord& remark) {
  if (!remark.columns || !remark.below || !remark.above ||
      remark.below->size() != remark.columns->size() ||
      remark.above->size() != remark.columns->size()) {
    return "";  // of an older record
  }
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < remark.columns->size(); ++i) {
    const std::string& name = (*remark.columns)[i];
    const double below = (*remark.below)[i];
    const double above = (*remark.above)[i];
    std::string part = data::Printable(name, name.size());
    if (std::isfinite(below)) part += fmt::format(" below {:.4g}", below);
    if (std::isfinite(above)) {
      part += fmt::format(
          "{} above {:.4g}", std::isfinite(below) ? " or" : "", above);
    }
    parts.push_back(std::move(part));
  }
  return parts.empty() ? "" : fmt::format(", with {}", fmt::join(parts, ", "));
}

// The sentences about one component.
class Sentences {
 public:
  explicit Sentences(const models::ComponentRecord& record)
      : record_(record), error_(ErrorTextOf(record)) {}

  std::string OfVerdict(const VerdictRecord& verdict) const;
  std::string OfAdvice() const;
  std::string OfGap() const;
  std::string OfRemark(const RemarkRecord& remark) const;

 private:
  const models::ComponentRecord& record_;
  ErrorText error_;

  const RecommendationRecord& Advice() const { return *record_.recommendation; }
  const HoldoutRecord& Holdout(const std::string& name) const {
    return *FindNamed(record_.holdouts, name);
  }
  const ResultRecord& Result(const std::string& model,
                             const std::string& holdout) const {
    return *ResultOf(*FindNamed(record_.models, model), holdout);
  }
  double Rmse(const std::string& model, const std::string& holdout) const {
    return Result(model, holdout).test.rmse;
  }
  // "0.938 um RMSE (95 % 0.786 to 1.093)"
  std::string RmseWithInterval(const std::string& model,
                               const std::string& holdout) const;
  std::string WhereJudged(const HoldoutRecord& holdout) const;
  std::string OfTest(const VerdictRecord& verdict) const;
  std::string OfChoice(const VerdictRecord& verdict) const;
  std::string OfSimplest(const RemarkRecord& remark) const;
  std::string OfGoal() const;
  std::string OfDisagreement(const RemarkRecord& remark) const;
  std::string OfCorrelation(const RemarkRecord& remark) const;
  std::string OfTooFew(const RemarkRecord& remark) const;
  std::string OfWhatIsLeft(const RemarkRecord& remark) const;
  std::string OfFlattered(const std::string& model) const;
  std::string OfOtherCuts() const;
};

std::string Sentences::RmseWithInterval(const std::string& model,
                                        const std::string& holdout) const {
  const ResultRecord& result = Result(model, holdout);
  std::string text = error_.WithUnit(result.test.rmse) + " RMSE";
  if (std::isfinite(result.ci95[0])) {
    text += fmt::format(
        " (95 % {} to {})", error_(result.ci95[0]), error_(result.ci95[1]));
  }
  return text;
}

// "on cycles it never saw", "on another file (test.csv)", ...
std::string Sentences::WhereJudged(const HoldoutRecord& holdout) const {
  if (holdout.whole_groups || holdout.whole_sessions) {
    return fmt::format("on {} it never saw", PluralOfUnit(holdout));
  }
  if (holdout.another_file) {
    return fmt::format("on another file ({})", holdout.name);
  }
  if (holdout.among_neighbours) {
    return fmt::format("next to rows that it knew ({})", holdout.name);
  }
  return fmt::format("on rows it never saw ({})", holdout.name);
}

// "0.707 um less RMSE than net:scg (95 % 0.4 to 1.1), p 0.0002 ..."
std::string Sentences::OfTest(const VerdictRecord& verdict) const {
  const std::string& better = verdict.model;
  const std::string& worse = *verdict.rival;
  const PairRecord& pair =
      *models::FindPair(record_, verdict.holdout, better, worse);
  const HoldoutRecord& held = Holdout(verdict.holdout);
  const std::string units = PluralOfUnit(held);
  // The pair may stand the other way round.
  const bool straight = pair.a == better;
  const double low = straight ? -pair.ci95[1] : pair.ci95[0];
  const double high = straight ? -pair.ci95[0] : pair.ci95[1];
  std::string text = fmt::format(
      "{} has {} less than {}",
      better,
      error_.WithUnit(straight ? -pair.difference : pair.difference),
      worse);
  if (std::isfinite(pair.ci95[0])) {
    text += fmt::format(" (95 % {} to {})", error_(low), error_(high));
  }
  text += fmt::format(
      "; sign-flip p {} over {}, {} after Holm for {}",
      PWords(pair.p),
      pair.units == 1 ? "1 " + held.unit_of_analysis
                      : fmt::format("{} {}", pair.units, units),
      PWords(pair.p_holm),
      Count(std::ranges::count(
                record_.comparisons, verdict.holdout, &PairRecord::holdout),
            "pair"));
  switch (*verdict.against_rival) {
    case Confidence::kEstablished:
      return text + ": established.";
    case Confidence::kUnitsCorrelated:
      return text + fmt::format(
                        ", as if {} were independent; neighbouring ones "
                        "resemble each other: not established.",
                        units);
    case Confidence::kMemoryNotExcluded:
      return text + fmt::format(
                        ", as if {} were independent; with the memory that "
                        "their order cannot exclude {}: not established.",
                        units,
                        PWords(pair.tests.memory_t.p_holm));
    case Confidence::kBlocksDisagree:
      return text + fmt::format(
                        ", as if {} were independent; {} runs of neighbouring "
                        "ones differ too much (p {}): not established.",
                        units,
                        stats::kBlocksOfUnits,
                        PWords(pair.tests.block_t.p));
    default:
      return text + ": not established.";
  }
}

std::string Sentences::OfChoice(const VerdictRecord& verdict) const {
  switch (verdict.choice) {
    case Choice::kNoPracticalDifference:
      return fmt::format(
          "A polynomial and a net share its first tier: no practical "
          "difference, {}established.",
          verdict.established ? "" : "not ");
    case Choice::kBaseline:
      return verdict.established
                 ? "A baseline shares its first tier: no map is worth more "
                   "there, established."
                 : "A baseline shares its first tier: no map is known to be "
                   "worth more there.";
    default:
      break;
  }
  if (verdict.obstacle) {
    return fmt::format(
        "Whether that is more than chance cannot be "
        "established: {}.",
        ObstacleText(*verdict.obstacle));
  }
  if (!verdict.rival) return "";
  std::string text = OfTest(verdict);
  if (!verdict.established &&
      *verdict.against_rival == Confidence::kEstablished) {
    text += fmt::format(" That it beats the best baseline, {}, is not.",
                        verdict.best_baseline.value_or(""));
  }
  return text;
}

std::string Sentences::OfVerdict(const VerdictRecord& verdict) const {
  std::string text =
      fmt::format("Under {} {} has the lowest error, {}",
                  verdict.holdout,
                  verdict.model,
                  RmseWithInterval(verdict.model, verdict.holdout));
  const std::vector<std::string>& first =
      FindNamed(record_.tiers, verdict.holdout)->front();
  if (first.size() > 1) {
    text += fmt::format("; without practical difference to it: {}",
                        ListBesides(first, verdict.model));
  }
  const std::string choice = OfChoice(verdict);
  return text + "." + (choice.empty() ? "" : " " + choice);
}

std::string Sentences::OfAdvice() const {
  const RecommendationRecord& advice = Advice();
  const std::string use =
      fmt::format("Use {}: {} {}.",
                  advice.model,
                  RmseWithInterval(advice.model, advice.holdout),
                  WhereJudged(Holdout(advice.holdout)));
  const bool sure = !advice.against_baseline ||
                    *advice.against_baseline == Confidence::kEstablished;
  if (advice.choice == Choice::kBaseline) {
    const char* const proven = advice.against_baseline && sure
                                   ? ", and that is proven"
                                   : ", as far as these data tell";
    if (advice.model == "zero") {
      return fmt::format(
          "No map is worth its effort here{}. Compensate with nothing: {} {}.",
          proven,
          RmseWithInterval(advice.model, advice.holdout),
          WhereJudged(Holdout(advice.holdout)));
    }
    return fmt::format("{} here{}. {}",
                       advice.sensors.empty()
                           ? "No temperature map earns its sensors"
                           : "No richer map earns its effort",
                       proven,
                       use);
  }
  std::string text;
  if (advice.choice == Choice::kNoPracticalDifference) {
    text = "Polynomial or net makes no practical difference. ";
  }
  text += use;
  // What the headline owes where the map is not surely worth its sensors.
  if (sure) return text;
  return text +
         fmt::format(
             " That it beats {} ({}), the best baseline, is not proven.",
             *advice.best_baseline,
             error_.WithUnit(Rmse(*advice.best_baseline, advice.holdout)));
}

std::string Sentences::OfGap() const {
  std::vector<models::GapModelRecord> flattered;
  std::ranges::copy_if(
      record_.gap->models, std::back_inserter(flattered), [&](const auto& row) {
        return row.flatters && !FindNamed(record_.models, row.model)->baseline;
      });
  if (flattered.empty()) return "";
  std::ranges::stable_sort(
      flattered, std::greater(), &models::GapModelRecord::ratio);
  constexpr std::size_t kMostNamed = 4;
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < std::min(flattered.size(), kMostNamed); ++i) {
    const models::GapModelRecord& row = flattered[i];
    parts.push_back(fmt::format("{} ({} against {}, {} times)",
                                row.model,
                                error_(row.neighbours_rmse),
                                error_.WithUnit(row.unseen_rmse),
                                RatioText(row.ratio)));
  }
  std::string text = fmt::format("Warning: {} flatters {}",
                                 record_.gap->neighbours,
                                 fmt::join(parts, ", "));
  if (flattered.size() > kMostNamed) {
    text += fmt::format(" and {} more", flattered.size() - kMostNamed);
  }
  return text +
         ": its held-out rows have neighbours in the training rows, whole " +
         PluralOfUnit(Holdout(record_.gap->unseen)) + " (" +
         record_.gap->unseen + ") have not.";
}

std::string Sentences::OfSimplest(const RemarkRecord& remark) const {
  const RecommendationRecord& advice = Advice();
  if (remark.kind == RemarkKind::kLowestAndSimplest) {
    return fmt::format(
        "It has the lowest error and is the simplest of its "
        "tier (the others: {}).",
        ListBesides(advice.first_tier, advice.model));
  }
  const std::string& model = *remark.model;
  const std::string rmse = error_(Rmse(model, advice.holdout));
  switch (remark.kind) {
    case RemarkKind::kAveragesMaps:
      return fmt::format(
          "It averages maps that see the inputs differently, which gambles "
          "less than the choice of one; the {} single map is {} ({}).",
          std::ranges::find(Advice().first_tier, model) ==
                  Advice().first_tier.end()
              ? "best"
              : "simplest",
          model,
          rmse);
    case RemarkKind::kSimplestNearLowest:
      return fmt::format(
          "It is the simplest of those that are near the lowest "
          "error ({} of {}); more is not known.",
          rmse,
          model);
    default:
      return fmt::format(
          "It is the simplest of a tier without practical difference: {} has "
          "the lowest error ({}), and with 95 % certainty{} it loses at most "
          "{} to it.",
          model,
          rmse,
          *remark.confidence != Confidence::kEstablished
              ? fmt::format(", as if {} were independent,",
                            PluralOfUnit(Holdout(advice.holdout)))
              : "",
          error_.WithUnit(*remark.excess));
  }
}

std::string Sentences::OfGoal() const {
  const RecommendationRecord& advice = Advice();
  return fmt::format("The goal (RMSE at most {:g}{}{}) is {}: {}.",
                     record_.goal * record_.display.scale,
                     record_.display.unit.empty() ? "" : " ",
                     record_.display.unit,
                     models::ToString(advice.goal_standing),
                     GoalFigures(Result(advice.model, advice.holdout), error_));
}

std::string Sentences::OfDisagreement(const RemarkRecord& remark) const {
  std::vector<std::string> parts;
  for (const std::string& holdout : *remark.holdouts) {
    const std::string& best =
        std::ranges::find(record_.verdict, holdout, &VerdictRecord::holdout)
            ->model;
    parts.push_back(fmt::format("under {} it has {}, {} has {}",
                                holdout,
                                error_.WithUnit(Rmse(Advice().model, holdout)),
                                best,
                                error_(Rmse(best, holdout))));
  }
  return fmt::format("The hold-outs of unseen rows disagree: {}.",
                     fmt::join(parts, "; "));
}

std::string Sentences::OfCorrelation(const RemarkRecord& remark) const {
  return fmt::format(
      "Neighbouring {} resemble each other (lag-1 correlation {:.2f} of the "
      "loss differences), so their number proves little, and {} is called "
      "established; more days, held out whole, would tell.",
      PluralOfUnit(Holdout(Advice().holdout)),
      *remark.lag1,
      *remark.established == 0
          ? "nothing"
          : fmt::format("only what is free of that, {} of {},",
                        *remark.established,
                        Count(*remark.pairs, "difference")));
}

// "6 cycles cannot prove a difference between 9 maps: ..."
std::string Sentences::OfTooFew(const RemarkRecord& remark) const {
  const RecommendationRecord& advice = Advice();
  const HoldoutRecord& holdout = Holdout(advice.holdout);
  const models::ObstacleRecord& obstacle =
      *std::ranges::find(
           record_.verdict, advice.holdout, &VerdictRecord::holdout)
           ->obstacle;
  const std::string found = Count(obstacle.units, holdout.unit_of_analysis);
  const bool one = obstacle.units == 1;
  if (remark.kind == RemarkKind::kTooManyMaps) {
    std::size_t maps = 0;
    for (const auto& tier : *FindNamed(record_.tiers, advice.holdout)) {
      maps += tier.size();
    }
    return fmt::format(
        "{} cannot prove a difference between {} maps: {}compare fewer.",
        found,
        maps,
        obstacle.needed > 0
            ? fmt::format("measure {} or more, or ", obstacle.needed)
            : "");
  }
  if (obstacle.kind == Kind::kPerhapsOneSession) {
    return fmt::format(
        "{} that may be of one day cannot prove which map is better: measure "
        "{} or more, or on several days (a column day or session).",
        found,
        obstacle.needed);
  }
  return fmt::format(
      "{} alone cannot prove which map is better: measure {} or more.",
      one ? "One " + holdout.unit_of_analysis : found,
      obstacle.needed);
}

std::string Sentences::OfOtherCuts() const {
  std::vector<std::string> parts;
  for (const models::StabilityRecord& cuts : record_.stability) {
    constexpr std::size_t kMostNamed = 3;
    std::vector<std::string> shares;
    for (std::size_t i = 0; i < std::min(cuts.wins.size(), kMostNamed); ++i) {
      shares.push_back(fmt::format(
          "{} {:.0f} %", cuts.wins[i].model, kPercent * cuts.wins[i].share));
    }
    parts.push_back(fmt::format("of {} cuts of {} the lowest error went to {}",
                                cuts.repeats,
                                cuts.holdout,
                                fmt::join(shares, ", ")));
  }
  std::string text = fmt::format("{}.", fmt::join(parts, "; "));
  text.front() = 'O';
  return text;
}

// What is left is no noise where it has an offset per cycle, or repeats along
// the position.
std::string Sentences::OfWhatIsLeft(const RemarkRecord& remark) const {
  const auto& by_group =
      Result(Advice().model, Advice().holdout).randomness.by_group;
  std::string text;
  for (std::size_t i = 0; i < remark.columns->size(); ++i) {
    const std::string& column = (*remark.columns)[i];
    const double percent = kPercent * (*remark.shares)[i];
    text += text.empty() ? "" : " ";
    text += by_group && by_group->column == column
                ? fmt::format(
                      "{:.0f} % of what is left is an offset per {}: a thermal "
                      "state that the sensors do not see. Add a sensor, or "
                      "re-zero each {}.",
                      percent,
                      column,
                      column)
                : fmt::format(
                      "{:.0f} % of what is left repeats along {}: the map is "
                      "too smooth there.",
                      percent,
                      column);
  }
  return text;
}

std::string Sentences::OfFlattered(const std::string& model) const {
  const models::GapModelRecord& row = *std::ranges::find(
      record_.gap->models, model, &models::GapModelRecord::model);
  return fmt::format(
      "Ignore the {} column for {}: {} next to known rows, {} on a {} it "
      "never saw.",
      record_.gap->neighbours,
      model,
      error_.WithUnit(row.neighbours_rmse),
      error_.WithUnit(row.unseen_rmse),
      Holdout(record_.gap->unseen).unit_of_analysis);
}

std::string Sentences::OfRemark(const RemarkRecord& remark) const {
  const RecommendationRecord& advice = Advice();
  const HoldoutRecord& holdout = Holdout(advice.holdout);
  const ModelRecord& model = *FindNamed(record_.models, advice.model);
  const auto unknown_day = [](const char* why) {
    return fmt::format("How it does on another day is not known, since {}.",
                       why);
  };
  switch (remark.kind) {
    case RemarkKind::kAveragesMaps:
    case RemarkKind::kLowestAndSimplest:
    case RemarkKind::kSimplestNearLowest:
    case RemarkKind::kSimplestOfTier:
      return OfSimplest(remark);
    case RemarkKind::kRemoves:
      return fmt::format("It removes {:.0f} % of the error ({} without a map).",
                         std::floor(kPercent * advice.removed_share),
                         error_.WithUnit(Rmse("zero", advice.holdout)));
    case RemarkKind::kBeatsBaseline:
      return fmt::format("The best baseline, {}, has {}.",
                         *remark.model,
                         error_.WithUnit(Rmse(*remark.model, advice.holdout)));
    case RemarkKind::kGap: {
      const models::GapModelRecord& row = *std::ranges::find(
          record_.gap->models, advice.model, &models::GapModelRecord::model);
      return fmt::format(
          "Between neighbours ({}) it has {}, on unseen {} {} times that.",
          record_.gap->neighbours,
          error_.WithUnit(row.neighbours_rmse),
          PluralOfUnit(Holdout(record_.gap->unseen)),
          RatioText(row.ratio));
    }
    case RemarkKind::kPromise:
      return IntervalText(*advice.promise, error_) + ".";
    case RemarkKind::kOneMoreSession:
      return OneMoreText(*advice.session_worth, holdout.unit_of_analysis);
    case RemarkKind::kGoal:
      return OfGoal();
    case RemarkKind::kCost:
      return CostSentence(advice);
    case RemarkKind::kNotNoise:
      return OfWhatIsLeft(remark);
    case RemarkKind::kInterrupted:
      return "The run was interrupted; fits are incomplete.";
    case RemarkKind::kOneRunOnly:
      return "One run only: nothing is known of another day.";
    case RemarkKind::kGroupFitsFailed:
      return unknown_day("no fit for whole groups held out succeeded");
    case RemarkKind::kNoGroupsHeldOut:
      return unknown_day("no whole groups were held out (--holdout groups:K)");
    case RemarkKind::kNoGroups:
      return unknown_day(
          "no whole cycles were held out (name their column with --group)");
    case RemarkKind::kBlocksForUnits:
      return fmt::format(
          "There are no groups: the tests count {} of held-out rows in order, "
          "which may still resemble each other.",
          Count(holdout.units, "block"));
    case RemarkKind::kTooFewUnits:
    case RemarkKind::kTooManyMaps:
      return OfTooFew(remark);
    case RemarkKind::kIgnoreNeighbours:
      return OfFlattered(*remark.model);
    case RemarkKind::kHoldoutsDisagree:
      return OfDisagreement(remark);
    case RemarkKind::kUnitsCorrelated:
      return OfCorrelation(remark);
    case RemarkKind::kExtrapolates:
      return fmt::format(
          "In {:.0f} % of the held-out rows an input lies outside what the "
          "fold was trained on, and the map extrapolates: measure more thermal "
          "states{}.",
          kPercent * advice.extrapolated_share,
          WhereToMeasure(remark));
    case RemarkKind::kNotConverged:
      return fmt::format(
          "Its fit ended without converging ({}): another start or run length "
          "would give another map.",
          fitting::ToString(model.final->summary.value.stop));
    case RemarkKind::kNoiseLearning:
      return model.memorisation->sentence;
    case RemarkKind::kOtherCuts:
      return OfOtherCuts();
    case RemarkKind::kBetterWithoutMap:
      return fmt::format(
          "The predictions {} are better ({}), but there is no map of them "
          "here to use.",
          *remark.model,
          error_.WithUnit(Rmse(*remark.model, advice.holdout)));
  }
  return "";
}

}  // namespace

std::string GoalFigures(const models::ResultRecord& result,
                        const ErrorText& error) {
  if (result.goal_standing == GoalStanding::kNone) return "";
  if (result.goal_standing == GoalStanding::kNotJudged) {
    return "the run was interrupted or a fit failed";
  }
  std::string text = "RMSE " + error.WithUnit(result.test.rmse);
  if (std::isfinite(result.test.sd)) {
    text += fmt::format(", scatter {} about an offset of {}",
                        error.WithUnit(result.test.sd),
                        error.WithUnit(result.test.mean));
  }
  return text;
}

void AddSentences(models::ComponentRecord* record) {
  for (ModelRecord& model : record->models) {
    if (!model.memorisation) continue;
    model.memorisation->sentence = MemorisationSentence(model);
  }
  const Sentences sentences(*record);
  if (record->gap) record->gap->warning = sentences.OfGap();
  for (VerdictRecord& verdict : record->verdict) {
    verdict.why = sentences.OfVerdict(verdict);
  }
  if (!record->recommendation) return;
  RecommendationRecord& advice = *record->recommendation;
  advice.sentence = sentences.OfAdvice();
  advice.why = advice.sentence;
  for (const RemarkRecord& ground : advice.grounds) {
    advice.reasons.push_back(sentences.OfRemark(ground));
    advice.why += " " + advice.reasons.back();
  }
  for (const RemarkRecord& doubt : advice.doubts) {
    advice.caveats.push_back(sentences.OfRemark(doubt));
  }
}

std::vector<std::string> FirstWords(const models::ComponentRecord& record) {
  if (!record.recommendation) {
    return {record.interrupted
                ? "The run was interrupted before a map could be recommended."
                : "No map can be recommended: none could be judged."};
  }
  const RecommendationRecord& advice = *record.recommendation;
  std::vector<std::pair<std::int64_t, const std::string*>> ranked;
  const auto add = [&](const std::vector<RemarkRecord>& remarks,
                       const std::vector<std::string>& words) {
    for (std::size_t i = 0; i < std::min(remarks.size(), words.size()); ++i) {
      if (remarks[i].rank) ranked.emplace_back(*remarks[i].rank, &words[i]);
    }
  };
  add(advice.grounds, advice.reasons);
  add(advice.doubts, advice.caveats);
  std::ranges::sort(ranked, {}, [](const auto& one) { return one.first; });
  std::vector<std::string> words{advice.sentence};
  for (const auto& [rank, text] : ranked) words.push_back(*text);
  return words;
}

std::vector<std::string> VerdictLines(const models::ComponentRecord& record,
                                      std::size_t width) {
  std::string told;
  for (const std::string& sentence : FirstWords(record)) {
    const std::string longer = told + (told.empty() ? "" : " ") + sentence;
    if (!told.empty() && WrapLines(longer, width).size() > kMostVerdictLines) {
      continue;  // a later one may be shorter
    }
    told = longer;
  }
  return WrapLines(told, width);
}

std::string MeasureNext(const models::ComponentRecord& record) {
  if (!record.recommendation) return "";
  std::vector<std::string> wanted;
  const auto want = [&](std::string what) {
    if (std::ranges::find(wanted, what) == wanted.end()) {
      wanted.push_back(std::move(what));
    }
  };
  const RecommendationRecord& advice = *record.recommendation;
  const HoldoutRecord* holdout = FindNamed(record.holdouts, advice.holdout);
  const auto verdict = std::ranges::find(
      record.verdict, advice.holdout, &VerdictRecord::holdout);
  const bool hindered = verdict != record.verdict.end() && verdict->obstacle &&
                        verdict->obstacle->needed > 0 && holdout != nullptr;
  for (const RemarkRecord& doubt : advice.doubts) {
    switch (doubt.kind) {
      case RemarkKind::kOneRunOnly:
      case RemarkKind::kUnitsCorrelated:
        want("other days");
        break;
      case RemarkKind::kTooFewUnits:
      case RemarkKind::kTooManyMaps:
        if (hindered) {
          want(fmt::format("{} {} or more",
                           verdict->obstacle->needed,
                           PluralOfUnit(*holdout)));
        }
        break;
      case RemarkKind::kExtrapolates:
        if (const std::string where = WhereToMeasure(doubt); !where.empty()) {
          want("states" + where.substr(where.find(' ')));
        }
        break;
      default:
        break;
    }
  }
  return fmt::format("{}", fmt::join(wanted, "; "));
}

std::string VerdictParagraphs(const models::ComponentRecord& record,
                              std::size_t width) {
  std::vector<std::string> paragraphs;
  for (const HoldoutRecord& holdout : record.holdouts) {
    const auto verdict = std::ranges::find(
        record.verdict, holdout.name, &VerdictRecord::holdout);
    paragraphs.push_back(
        verdict != record.verdict.end()
            ? verdict->why
            : fmt::format("Under {} no model could be fitted.", holdout.name));
  }
  if (record.gap) paragraphs.push_back(record.gap->warning);
  if (record.recommendation) {
    const RecommendationRecord& advice = *record.recommendation;
    paragraphs.push_back(advice.why);
    paragraphs.push_back(fmt::format("{}", fmt::join(advice.caveats, " ")));
  }
  std::string text;
  for (const std::string& paragraph : paragraphs) {
    if (paragraph.empty()) continue;
    text += (text.empty() ? "" : "\n") + WrapText(paragraph, width) + "\n";
  }
  return text;
}

}  // namespace errmap::cli
