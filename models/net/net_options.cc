#include "models/net/net_options.h"

#include <algorithm>

#include "fitting/minimisers/levenberg_marquardt.h"
#include "models/history/view_options.h"
#include "models/option_list.h"

namespace errmap::models {
namespace {

constexpr double kDefaultWfactor = 1e-5;
// Nodes of a net in a view: as many as the widest vector holds in single
// precision, which compares its wfactors.
constexpr std::int64_t kFewNodes = 16;

fitting::StoppingRules DefaultRules(const NetMethod& method) {
  return std::holds_alternative<LmTraining>(method)
             ? fitting::LevenbergMarquardtOptions().stopping
             : fitting::StoppingRules();
}

// By its Jacobian, damped by one number for all weights.
bool SolvesLeastSquares(const NetMethod& method) {
  return std::holds_alternative<LmTraining>(method) ||
         std::holds_alternative<CeresTraining>(method);
}

std::string Contradiction(const NetOptions& options) {
  const bool by_discrepancy = options.discrepancy.has_value();
  const bool many_starts = options.starts && *options.starts > 1;
  if (by_discrepancy && options.wfactor) {
    return "discrepancy= finds the wfactor, which wfactor= fixes";
  }
  if (options.choose && !many_starts) {
    return "choose= chooses among several starts; give starts=N";
  }
  if (by_discrepancy && options.hidden && options.hidden->by_cv()) {
    return "discrepancy= needs a number of hidden nodes; choose it with "
           "wfactor=cv first";
  }
  if (by_discrepancy && many_starts) {
    return "discrepancy= follows one start; use its wfactor with starts=";
  }
  if (options.members && *options.members > 1 &&
      (many_starts || by_discrepancy)) {
    return "members= averages several starts; starts= and discrepancy= choose "
           "one";
  }
  if (options.decay == Decay::kWeights && SolvesLeastSquares(options.method)) {
    return "decay=weights is not for net:lm and net:ceres, which shrink all";
  }
  if (by_discrepancy && options.path == true) {
    return "discrepancy= walks a path of its own";
  }
  return "";
}

// Options of every net.
OptionList<NetOptions> CommonList() {
  using Options = NetOptions;
  constexpr std::int64_t kMostNodes = 10'000;
  constexpr std::int64_t kMostSteps = 1'000'000'000;
  constexpr std::int64_t kMostStarts = 10'000;
  constexpr std::int64_t kMostMembers = 100;
  constexpr std::int64_t kFewestRows = 100;
  constexpr std::int64_t kNoLimit = std::numeric_limits<std::int64_t>::max();
  constexpr Number kWfactors{0.0, 1e6};
  constexpr Number kDeltas{1e-300, 1e300};
  constexpr Number kGoals{0.0, 1e12};
  constexpr Number kRatios{1e-6, 1e12};
  constexpr Number kSeconds{1e-3, 1e12};
  constexpr Number kSlopes{1e-3, 1e3};
  const auto several = [](const Options& options) {
    return *options.starts > 1;
  };
  OptionList<Options> list = {
      OptionFor("hidden",
                "hidden nodes",
                &Options::hidden,
                WordOr<GivenOrByCv<std::int64_t>, IntegerRange>{
                    "cv", kByCrossValidation, IntegerRange{1, kMostNodes}})
          .Always(),
      OptionFor("wfactor",
                "weight decay",
                &Options::wfactor,
                WordOr<GivenOrByCv<double>, Number>{
                    "cv", kByCrossValidation, kWfactors})
          .Always(),
      OptionFor("decay",
                "what wfactor shrinks: all, or not biases",
                &Options::decay,
                EnumWords<Decay>({"all", "weights"}))
          .When([](const Options& options) {
            return options.decay == Decay::kWeights;
          }),
      OptionFor("discrepancy",
                "RMS residual that the wfactor is set to reach",
                &Options::discrepancy,
                kDeltas),
      OptionFor("path",
                "fits from a strong wfactor down to its own",
                &Options::path,
                OneOf<std::optional<bool>>{
                    {{"auto", std::nullopt}, {"yes", true}, {"no", false}}})
          .When([](const Options& options) { return *options.path; }),
      OptionFor("iterations",
                "the most steps",
                &Options::iterations,
                IntegerRange{1, kMostSteps})
          .Always(),
      OptionFor("egoal",
                "ends at a root-mean-square error below it",
                &Options::egoal,
                kGoals)
          .Always(),
      OptionFor("gwgoal",
                "ends at a gradient below it, relative to the weights",
                &Options::gwgoal,
                kGoals)
          .Always(),
      OptionFor("scale",
                "of the inputs",
                &Options::scale,
                EnumWords<InputScaling>({"standard", "range", "none"}))
          .Always(),
      OptionFor("output",
                "of the net: bounded, or not",
                &Options::output,
                EnumWords<OutputFunction>({"sigmoid", "linear"}))
          .Always(),
      OptionFor("slope", "of the sigmoid", &Options::slope, kSlopes).Always(),
      OptionFor("evaluations",
                "the most evaluations",
                &Options::evaluations,
                IntegerRange{1, kNoLimit}),
      OptionFor("errdel",
                "ends where the error stays above this share of it",
                &Options::errdel,
                kRatios),
      OptionFor("nfreq",
                "steps between looks at errdel",
                &Options::nfreq,
                IntegerRange{1, kMostSteps})
          .When([](const Options& options) {
            return options.errdel.has_value();
          }),
      OptionFor(
          "seconds", "the most time of a fit", &Options::seconds, kSeconds),
      OptionFor("starts",
                "starts of which one is taken",
                &Options::starts,
                IntegerRange{1, kMostStarts})
          .When(several),
      OptionFor("choose",
                "which start: of lowest cost, by inner hold-outs",
                &Options::choose,
                EnumWords<StartRule>({"cost", "cv"}))
          .When(several),
      OptionFor("members",
                "starts that are averaged",
                &Options::members,
                IntegerRange{1, kMostMembers})
          .When([](const Options& options) { return *options.members > 1; }),
      OptionFor("rows",
                "the most rows to train on",
                &Options::rows,
                WordOr<std::int64_t, IntegerRange>{
                    "all",
                    NetOptions::kAllRows,
                    IntegerRange{kFewestRows, kNoLimit}})};
  AddWithin(ViewOptionList(), &Options::view, &list);
  list.push_back(ClipOption<Options>());
  return list;
}

template <typename Training>
constexpr auto kOf =
    [](auto& options) { return std::get_if<Training>(&options.method); };

OptionList<ScgTraining> ListOf(const ScgTraining& /*method*/) {
  return {OptionFor("variant",
                    "Moller's algorithm, or the report's program",
                    &ScgTraining::variant,
                    EnumWords<fitting::ScgVariant>({"moller", "netcg"}))
              .Always(),
          OptionFor("precision",
                    "of its arithmetic",
                    &ScgTraining::is_single,
                    OneOf<bool>{{{"double", false}, {"single", true}}})
              .Always()};
}

OptionList<LmTraining> ListOf(const LmTraining& /*method*/) { return {}; }

OptionList<CgTraining> ListOf(const CgTraining& /*method*/) { return {}; }

OptionList<BackpropTraining> ListOf(const BackpropTraining& /*method*/) {
  constexpr Number kRates{1e-12, 1e12};
  constexpr Number kMomenta{0.0, 0.999999};
  return {OptionFor("learning_rate",
                    "eta of Eq. 68",
                    &BackpropTraining::learning_rate,
                    kRates)
              .Always(),
          OptionFor("momentum",
                    "share of the last step that is added",
                    &BackpropTraining::momentum,
                    kMomenta)
              .Always()};
}

constexpr const char* kAboutMethod = "the solver's method";
constexpr const char* kAboutMemory = "pairs of vectors that it keeps";
// Pairs of vectors that a quasi-Newton method may be asked to keep.
constexpr IntegerRange kMemories{1, 1000};

OptionList<CeresTraining> ListOf(const CeresTraining& /*method*/) {
  return {
      OptionFor("method",
                kAboutMethod,
                &CeresTraining::method,
                EnumWords<fitting::CeresMethod>(fitting::CeresMethodNames()))
          .Always(),
      OptionFor("memory", kAboutMemory, &CeresTraining::memory, kMemories)
          .Always()};
}

OptionList<NloptTraining> ListOf(const NloptTraining& /*method*/) {
  constexpr Number kBoxes{1e-6, 1e6};
  return {
      OptionFor("method",
                kAboutMethod,
                &NloptTraining::method,
                EnumWords<fitting::NloptMethod>(fitting::NloptMethodNames()))
          .Always(),
      OptionFor("memory", kAboutMemory, &NloptTraining::memory, kMemories)
          .Always(),
      OptionFor("box",
                "how far from the start crs2_lm searches",
                &NloptTraining::box,
                kBoxes)
          .When([](const NloptTraining& method) {
            return method.method == fitting::NloptMethod::kCrs2Lm;
          })};
}

template <typename Training>
ListedModel<NetOptions> ModelOf(std::string_view name, std::string_view about) {
  const auto list = [] {
    OptionList<NetOptions> options = CommonList();
    AddWithin(ListOf(Training()), kOf<Training>, &options);
    return options;
  };
  return {.name = std::string(name),
          .about = std::string(about),
          .defaults = {.method = Training()},
          .options = list,
          .contradiction = Contradiction,
          .complete = NameTheViewOf,
          .is_compared = std::is_same_v<Training, ScgTraining>};
}

}  // namespace

template <>
const std::vector<ListedModel<NetOptions>>& ListedModels() {
  // In the order of NetMethod.
  static const std::vector<ListedModel<NetOptions>> models = {
      ModelOf<ScgTraining>("net:scg",
                           "a neural net, scaled conjugate gradients (1995)"),
      ModelOf<LmTraining>("net:lm", "a neural net, Levenberg-Marquardt"),
      ModelOf<CgTraining>("net:cg", "a neural net, conjugate gradients"),
      ModelOf<BackpropTraining>("net:backprop",
                                "a neural net, gradient descent"),
      ModelOf<CeresTraining>("net:ceres", "a neural net, a solver of Ceres"),
      ModelOf<NloptTraining>("net:nlopt", "a neural net, a solver of NLopt")};
  return models;
}

std::string_view NetOptions::type() const {
  return ListedModels<NetOptions>()[method.index()].name;
}

void NetOptions::Validate() const { ValidateOptions(*this); }

NetOptions NetOptions::Resolved() const {
  constexpr std::int64_t kFewSteps = 500;
  constexpr std::int64_t kSomeMembers = 3;
  NetOptions all = *this;
  if (!hidden) all.hidden = view ? kFewNodes : NetDesign().hidden;
  if (!wfactor && !discrepancy) {
    if (view) {
      all.wfactor = kByCrossValidation;
    } else {
      all.wfactor = kDefaultWfactor;
    }
  }
  if (!decay) {
    all.decay =
        view && !SolvesLeastSquares(method) ? Decay::kWeights : Decay::kAll;
  }
  if (!path) all.path = all.tunes_wfactor() && view.has_value();
  if (!iterations) {
    const std::int64_t usual = DefaultRules(method).iterations;
    all.iterations = view ? std::min(usual, kFewSteps) : usual;
  }
  if (!members) {
    all.members = view && !starts && !discrepancy ? kSomeMembers : 1;
  }
  if (!starts) all.starts = 1;
  if (!choose && *all.starts > 1) all.choose = StartRule::kCost;
  return all;
}

NetDesign NetOptions::design() const {
  const std::int64_t usual = view ? kFewNodes : NetDesign().hidden;
  return {.hidden = tunes_hidden() ? usual : std::int64_t{*hidden},
          .scaling = scale,
          .output = output,
          .slope = slope,
          .free_biases = *decay == Decay::kWeights};
}

fitting::StoppingRules NetOptions::stopping() const {
  fitting::StoppingRules rules = DefaultRules(method);
  rules.iterations = *iterations;
  rules.evaluations = evaluations;
  if (seconds) rules.seconds = *seconds;
  rules.cost_goal = egoal;
  rules.gradient_goal = gwgoal;
  if (errdel) rules.slow_ratio = *errdel;
  rules.progress_interval = nfreq;
  return rules;
}

double NetOptions::given_wfactor() const {
  return !wfactor || wfactor->by_cv() ? kDefaultWfactor : double{*wfactor};
}

template NetOptions OptionsOf(std::string_view spec);
template std::string SpecOf(const NetOptions& options);

}  // namespace errmap::models
