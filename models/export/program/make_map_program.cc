// MakeMapProgram of models/export/program/map_program.h: a fitted map laid out
// in spaces, instruction by instruction.

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>
#include <variant>

#include "data/argument_name.h"
#include "data/measurements/row_filters.h"
#include "models/export/program/map_program.h"
#include "models/export/program/safe_names.h"
#include "models/history/history.h"
#include "models/history/with_history.h"
#include "models/map_experience.h"
#include "models/polynomial/polynomial_model.h"

namespace errmap::models {
namespace {

int AsInt(std::size_t value) { return static_cast<int>(value); }

// The same terms in as many inputs more as are held within a range, which the
// terms that bend read in place of those.
PolynomialForm WithHeldInputs(const PolynomialForm& form) {
  PolynomialForm spread = form;
  for (PolynomialTerm& term : spread.terms) {
    const bool bends = Bends(form.bends_within, term.powers);
    for (const BendRange& range : form.bends_within) {
      int& power = term.powers[static_cast<std::size_t>(range.input)];
      const int held = bends ? power : 0;
      if (bends) power = 0;
      term.powers.push_back(held);
    }
  }
  return spread;
}

// ---- From readings to what the form reads ----

// What linear filters need from the input that they lag.
struct Course {
  Operand source = {};
  Operand last = {};             // state: the input a step before
  Operand change = {};           // by this step
  bool source_has_zero = false;  // which jumps when a zero is taken
};

// A derived input with the places of its numbers.
struct Derivation {
  Filter filter = Filter::kEma;
  Operand source = {};
  Operand state = {};  // of what remembers
  Operand value = {};  // kEma: the state itself
  Operand decay = {};  // of what runs in time
  /// Likewise, with Between::kLinear.
  std::optional<std::size_t> course = std::nullopt;
  double radians = 1.0;

  Operand ramp() const { return {Space::kGain, decay.index + 1}; }
};

// The history of a map laid out in spaces.
class Layout {
 public:
  explicit Layout(const FittedModel& fitted) {
    for (std::size_t i = 0; i < fitted.inputs.size(); ++i) {
      known_[fitted.inputs[i].column.name] = {{Space::kReading, AsInt(i)},
                                              fitted.inputs[i].column};
    }
    if (fitted.history == nullptr) {
      for (const TrainedInput& input : fitted.inputs) {
        form_.push_back(known_.at(input.column.name).place);
      }
      return;
    }
    for (const DerivedInput& input : fitted.history->derived) Add(input);
    for (const std::string& name : fitted.history->form_inputs) {
      form_.push_back(known_.at(name).place);
    }
  }

  const std::vector<Derivation>& derivations() const { return derivations_; }
  const std::vector<Course>& courses() const { return courses_; }
  const std::vector<double>& taus() const { return taus_; }
  // What the form reads, before any guard.
  const std::vector<Operand>& form() const { return form_; }

 private:
  struct Known {
    Operand place;
    data::ColumnInfo column;
  };

  void Add(const DerivedInput& input) {
    const Known source = known_.at(input.of);
    Derivation derivation{.filter = input.filter, .source = source.place};
    switch (input.filter) {
      case Filter::kEma:
        derivation.state = {Space::kState, num_states_++};
        derivation.value = derivation.state;
        derivation.decay = DecayOf(input.tau);
        if (input.between == Between::kLinear) {
          derivation.course = CourseOf(source.place);
        }
        break;
      case Filter::kZero:
        derivation.state = {Space::kState, num_states_++};
        derivation.value = {Space::kDerived, num_values_++};
        break;
      case Filter::kSine:
      case Filter::kCosine:
        derivation.value = {Space::kDerived, num_values_++};
        derivation.radians = RadiansPer(source.column);
        break;
    }
    known_[input.column.name] = {derivation.value, input.column};
    derivations_.push_back(derivation);
  }

  Operand DecayOf(double tau) {
    auto found = std::ranges::find(taus_, tau);
    if (found == taus_.end()) found = taus_.insert(taus_.end(), tau);
    return {Space::kGain, 2 * static_cast<int>(found - taus_.begin())};
  }

  std::size_t CourseOf(Operand source) {
    auto found = std::ranges::find(courses_, source, &Course::source);
    if (found == courses_.end()) {
      found = courses_.insert(courses_.end(),
                              {.source = source,
                               .last = {Space::kState, num_states_++},
                               .change = {Space::kDerived, num_values_++},
                               .source_has_zero = HasZero(source)});
    }
    return static_cast<std::size_t>(found - courses_.begin());
  }

  bool HasZero(Operand value) const {
    const auto found =
        std::ranges::find(derivations_, value, &Derivation::value);
    return found != derivations_.end() && found->filter == Filter::kZero;
  }

  std::map<std::string, Known> known_;
  std::vector<Derivation> derivations_;
  std::vector<Course> courses_;
  std::vector<double> taus_;
  std::vector<Operand> form_;
  int num_states_ = 0;
  int num_values_ = 0;
};

enum class Moment { kBegin, kAdvance, kZero, kEvaluate };

// As in models/history/lag.h.
Instructions Lag(const Layout& layout, const Derivation& derivation) {
  Instruction decay{.op = Op::kLag,
                    .to = derivation.state,
                    .a = derivation.decay,
                    .b = derivation.source};
  if (!derivation.course) return {decay};
  const Course& course = layout.courses()[*derivation.course];
  decay.b = course.last;
  return {decay,
          {.op = Op::kAddProduct,
           .to = derivation.state,
           .a = derivation.ramp(),
           .b = course.change}};
}

Instructions StateUpdate(const Layout& layout,
                         const Derivation& derivation,
                         Moment moment) {
  if (!Remembers(derivation.filter)) return {};
  const bool is_filter = RunsInTime(derivation.filter);
  if (is_filter && moment == Moment::kAdvance) return Lag(layout, derivation);
  // The first reading is the filter's steady state; a zero is where it is
  // taken.
  if (moment == Moment::kBegin || (!is_filter && moment == Moment::kZero)) {
    return {{.op = Op::kCopy, .to = derivation.state, .a = derivation.source}};
  }
  return {};
}

std::optional<Instruction> ValueOf(const Derivation& derivation) {
  switch (derivation.filter) {
    case Filter::kEma:
      return std::nullopt;  // the state is the value
    case Filter::kZero:
      return Instruction{.op = Op::kSubtract,
                         .to = derivation.value,
                         .a = derivation.source,
                         .b = derivation.state};
    case Filter::kSine:
    case Filter::kCosine:
      break;
  }
  return Instruction{
      .op = derivation.filter == Filter::kSine ? Op::kSine : Op::kCosine,
      .to = derivation.value,
      .a = derivation.source,
      .c = derivation.radians};
}

// Derived values and gains that neither the state nor the form (`read`) needs
// go.
Instructions WithoutUnread(const Instructions& instructions,
                           std::vector<Operand> read) {
  Instructions kept;
  for (auto it = instructions.rbegin(); it != instructions.rend(); ++it) {
    if ((it->to.space == Space::kDerived || it->to.space == Space::kGain) &&
        std::ranges::find(read, it->to) == read.end()) {
      continue;
    }
    read.push_back(it->a);
    read.push_back(it->b);
    kept.push_back(*it);
  }
  std::ranges::reverse(kept);
  return kept;
}

// As in models/history/lag.h.
void AddGains(const std::vector<double>& taus, Instructions* instructions) {
  constexpr Operand kTime{Space::kTime, 0};
  int index = 0;
  for (const double tau : taus) {
    const Operand decay{Space::kGain, index++};
    const Operand ramp{Space::kGain, index++};
    instructions->push_back(
        {.op = Op::kMeanDecay, .to = ramp, .a = kTime, .c = tau});
    instructions->push_back(
        {.op = Op::kGain, .to = decay, .a = kTime, .b = ramp, .c = tau});
    instructions->push_back(
        {.op = Op::kLinear, .to = ramp, .a = ramp, .c = -1.0, .d = 1.0});
  }
}

Instructions Derive(const Layout& layout, Moment moment) {
  Instructions instructions;
  if (moment == Moment::kAdvance) {
    AddGains(layout.taus(), &instructions);
  }
  std::vector<bool> is_followed(layout.courses().size());
  for (const Derivation& derivation : layout.derivations()) {
    if (moment == Moment::kAdvance && derivation.course &&
        !is_followed[*derivation.course]) {
      is_followed[*derivation.course] = true;
      const Course& course = layout.courses()[*derivation.course];
      instructions.push_back({.op = Op::kSubtract,
                              .to = course.change,
                              .a = course.source,
                              .b = course.last});
    }
    std::ranges::copy(StateUpdate(layout, derivation, moment),
                      std::back_inserter(instructions));
    if (const auto value = ValueOf(derivation)) instructions.push_back(*value);
  }
  for (const Course& course : layout.courses()) {
    const bool leaps = moment == Moment::kZero && course.source_has_zero;
    if (moment == Moment::kBegin || moment == Moment::kAdvance || leaps) {
      instructions.push_back(
          {.op = Op::kCopy, .to = course.last, .a = course.source});
    }
  }
  return WithoutUnread(
      instructions,
      moment == Moment::kEvaluate ? layout.form() : std::vector<Operand>{});
}

// ---- From what the form reads to the error ----

class FormWriter {
 public:
  explicit FormWriter(MapProgram* program) : program_(program) {}

  // Guards of the inputs; `inputs` become the places of what they let through.
  void ClipInputs(const ClampLimits& guards, std::vector<Operand>* inputs) {
    for (std::size_t i = 0; i < inputs->size(); ++i) {
      const Operand to{Space::kForm, AsInt(i)};
      const auto at = static_cast<Index>(i);
      Add({.op = Op::kCopy, .to = to, .a = (*inputs)[i]});
      Clip(to, guards.InputBounds(at), true);
      (*inputs)[i] = to;
    }
  }

  void ClipError(const ClampLimits& guards) {
    Clip(kError, guards.ErrorBounds(), true);
  }

  void Form(const ModelDescription& form, const std::vector<Operand>& inputs) {
    std::visit([&](const auto& known) { ErrorOf(known, inputs); }, form);
  }

 private:
  static constexpr Operand kError{Space::kError, 0};
  static constexpr Operand kOutput{Space::kTerm, 0};

  void Add(const Instruction& instruction) {
    program_->forms.front().evaluate.push_back(instruction);
  }

  // One for each form: a new one does not compile without its own.
  void ErrorOf(const PolynomialForm& form, const std::vector<Operand>& inputs) {
    Add({.op = Op::kCopy, .to = kError, .a = OutputOf(form, inputs)});
  }
  void ErrorOf(const NetForm& form, const std::vector<Operand>& inputs) {
    Add({.op = Op::kCopy, .to = kError, .a = OutputOf(form, inputs)});
  }
  void ErrorOf(const OpaqueForm& form, const std::vector<Operand>& /*inputs*/) {
    RequireFormula(form, "an exported map");
  }

  void Clip(Operand to, const Bounds& bounds, bool guards) {
    if (std::isfinite(bounds.low)) {
      Add({.op = Op::kFloor, .to = to, .c = bounds.low, .guards = guards});
    }
    if (std::isfinite(bounds.high)) {
      Add({.op = Op::kCeiling, .to = to, .c = bounds.high, .guards = guards});
    }
  }

  Operand OutputOf(const PolynomialForm& form,
                   const std::vector<Operand>& inputs) {
    const PolynomialForm spread = WithHeldInputs(form);
    const auto is_read = [&](std::size_t place) {
      return std::ranges::any_of(spread.terms,
                                 [place](const PolynomialTerm& term) {
                                   return term.powers[place] > 0;
                                 });
    };
    const auto scale = [&](std::size_t input, std::size_t place) {
      const auto at = static_cast<Index>(input);
      Add({.op = Op::kScale,
           .to = {Space::kScaled, AsInt(place)},
           .a = inputs[input],
           .c = form.input_offset[at],
           .d = form.input_scale[at]});
    };
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      if (is_read(i)) scale(i, i);
    }
    for (std::size_t h = 0; h < form.bends_within.size(); ++h) {
      const std::size_t place = inputs.size() + h;
      if (!is_read(place)) continue;
      const BendRange& range = form.bends_within[h];
      scale(static_cast<std::size_t>(range.input), place);
      const auto scaled = [&](double value) {
        return (value - form.input_offset[range.input]) *
               form.input_scale[range.input];
      };
      const auto [low, high] =
          std::minmax({scaled(range.min), scaled(range.max)});
      Clip({Space::kScaled, AsInt(place)}, {low, high}, false);
    }
    for (const Instruction& instruction : NestedPolynomial(spread)) {
      Add(instruction);
    }
    return kOutput;
  }

  // The scales become part of the weights. The offsets do not: 20 degC that
  // vary by 0.1 K would cancel in the bias, and single precision with them.
  Operand OutputOf(const NetForm& form, const std::vector<Operand>& inputs) {
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      Add({.op = Op::kShift,
           .to = {Space::kScaled, AsInt(i)},
           .a = inputs[i],
           .c = form.input_offset[static_cast<Index>(i)]});
    }
    MatrixXd w1 = form.w1;
    w1.leftCols(form.input_scale.size()) *= form.input_scale.asDiagonal();
    const Operand hidden{Space::kHidden, 0};
    const auto num_hidden = static_cast<int>(w1.rows());
    Affine(hidden, {Space::kScaled, 0}, std::move(w1));
    Add({.op = Op::kSigmoid, .to = hidden, .count = num_hidden});

    const double slope = form.target_slope[0];
    const double offset = form.target_offset[0];
    MatrixXd w2 = form.w2;
    if (form.output == OutputFunction::kLinear) {
      w2(0, w2.cols() - 1) -= offset;
      w2 /= slope;
    }
    Affine(kOutput, hidden, std::move(w2));
    if (form.output == OutputFunction::kSigmoid) {
      Add({.op = Op::kSigmoid, .to = kOutput});
      Add({.op = Op::kLinear,
           .to = kOutput,
           .a = kOutput,
           .c = 1.0 / slope,
           .d = -offset / slope});
    }
    return kOutput;
  }

  void ErrorOf(const BlendForm& form, const std::vector<Operand>& inputs) {
    Add({.op = Op::kSet, .to = kError, .c = 0.0});
    for (const BlendForm::Member& member : form.members) {
      std::vector<Operand> read;
      for (const Index input : member.inputs) {
        read.push_back(inputs[static_cast<std::size_t>(input)]);
      }
      const Operand output =
          std::visit([&](const auto& known) { return OutputOf(known, read); },
                     member.form);
      Clip(output, {member.lowest, member.highest}, false);
      Add({.op = Op::kAccumulate,
           .to = kError,
           .a = output,
           .c = member.weight});
    }
  }

  void Affine(Operand to, Operand from, MatrixXd table) {
    Add({.op = Op::kAffine,
         .to = to,
         .a = from,
         .table = program_->tables.size(),
         .count = static_cast<int>(table.rows())});
    program_->tables.push_back(std::move(table));
  }

  MapProgram* program_;
};

TrainedRange RangeOf(Operand place, double min, double max) {
  const double little = kRangeTolerance * (max - min);
  return {place, min - little, max + little};
}

void AddDerivedRanges(const FittedModel& fitted,
                      const std::vector<Operand>& places,
                      std::vector<TrainedRange>* ranges) {
  for (const Applicability::Derived& derived : fitted.applicability->derived) {
    const std::vector<std::string>& names = fitted.history->form_inputs;
    const auto found = std::ranges::find(names, derived.column.name);
    if (found == names.end()) continue;
    ranges->push_back(
        RangeOf(places[static_cast<std::size_t>(found - names.begin())],
                derived.min,
                derived.max));
  }
}

}  // namespace

MapProgram MakeMapProgram(const FittedModel& fitted) {
  if (CountsRows(fitted)) {
    throw std::invalid_argument(
        "its memory counts rows, and a controller seconds; say how often a row "
        "came (" +
        data::ArgumentName("every", "30s") +
        "), or fit it with a column of times");
  }
  MapProgram program;
  program.model = fitted.name;
  program.target = fitted.target;
  program.since_first_row = fitted.align == data::Alignment::kFirst;
  program.made_for = CommentText(data::FiltersText(fitted.where));
  MapForm& form = program.forms.front();
  for (const TrainedInput& input : fitted.inputs) {
    form.readings.push_back(AsInt(program.readings.size()));
    form.ranges.push_back(
        RangeOf({Space::kReading, form.readings.back()}, input.min, input.max));
    program.readings.push_back({.column = input.column,
                                .trained_min = input.min,
                                .trained_max = input.max,
                                .trained_mean = input.mean});
  }
  const Layout layout(fitted);
  program.begin = Derive(layout, Moment::kBegin);
  program.advance = Derive(layout, Moment::kAdvance);
  program.zero = Derive(layout, Moment::kZero);
  form.evaluate = Derive(layout, Moment::kEvaluate);
  if (fitted.history != nullptr) {
    // A zero is never right again by itself; 1e9 s are for ever.
    constexpr double kForEver = 1e9;
    program.longest_bridged = fitted.history->longest_bridged();
    program.settles_after = std::min(fitted.history->settles_after(), kForEver);
  }
  if (fitted.applicability != nullptr) {
    AddDerivedRanges(fitted, layout.form(), &form.ranges);
  }
  std::vector<Operand> inputs = layout.form();
  FormWriter writer(&program);
  if (fitted.guards) writer.ClipInputs(*fitted.guards, &inputs);
  writer.Form(fitted.model->Describe(), inputs);
  if (fitted.guards) writer.ClipError(*fitted.guards);
  program.MeasureSpaces();
  return program;
}

}  // namespace errmap::models
