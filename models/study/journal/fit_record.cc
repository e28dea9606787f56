#include "models/study/journal/fit_record.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "data/formats/nesting.h"
#include "data/input_error.h"
#include "models/blend/form_to_model.h"
#include "models/history/history.h"
#include "models/map_experience.h"
#include "models/regression_report.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Json = nlohmann::json;

// The members of a struct, once for both directions. Only all of them, in the
// order of their declaration, compile: whoever adds one is told to add it here.
#define ERRMAP_MEMBERS(Struct, ...)                     \
  template <typename S>                                 \
  requires std::same_as<std::remove_const_t<S>, Struct> \
  auto MembersOf(S& s) {                                \
    auto& [__VA_ARGS__] = s;                            \
    return std::tie(__VA_ARGS__);                       \
  }

ERRMAP_MEMBERS(data::Unit, symbol, quantity, display_scale, display_symbol)
ERRMAP_MEMBERS(data::ColumnInfo, name, unit)
ERRMAP_MEMBERS(data::ColumnFilter, column, value)
ERRMAP_MEMBERS(TrainedInput, column, min, max, mean, sd)
ERRMAP_MEMBERS(PolynomialTerm, powers, coefficient)
ERRMAP_MEMBERS(BendRange, input, min, max)
ERRMAP_MEMBERS(
    PolynomialForm, input_offset, input_scale, intercept, terms, bends_within)
ERRMAP_MEMBERS(NetForm,
               input_offset,
               input_scale,
               w1,
               w2,
               output,
               target_slope,
               target_offset)
ERRMAP_MEMBERS(
    BlendForm::Member, name, weight, inputs, lowest, highest, parameters, form)
ERRMAP_MEMBERS(BlendForm, num_inputs, rule, members)
ERRMAP_MEMBERS(PredictionCost, multiplications, exponentials)
ERRMAP_MEMBERS(OpaqueForm, num_inputs, cost)
ERRMAP_MEMBERS(fitting::TracePoint, iteration, rms_error, gradient_norm)
ERRMAP_MEMBERS(fitting::FitSummary,
               termination,
               message,
               initial_cost,
               final_cost,
               initial_gradient_norm,
               final_gradient_norm,
               iterations,
               value_evaluations,
               gradient_evaluations,
               curvature_evaluations,
               seconds,
               mean_iteration_seconds,
               sd_iteration_seconds,
               trace)
ERRMAP_MEMBERS(EffectiveOption, key, value)
ERRMAP_MEMBERS(StartResult,
               seed,
               final_cost,
               termination,
               iterations,
               holdout_rmse,
               chosen)
ERRMAP_MEMBERS(fitting::CoefficientEstimate,
               estimate,
               standard_error,
               t,
               p,
               lower,
               upper,
               standardised,
               vif)
ERRMAP_MEMBERS(fitting::RegressionDiagnostics,
               observations,
               rank,
               has_intercept,
               aliased,
               intercept,
               coefficients,
               regression_sum_of_squares,
               residual_sum_of_squares,
               total_sum_of_squares,
               residual_degrees_of_freedom,
               f,
               f_p,
               s_of_residuals,
               r2,
               adjusted_r2,
               condition,
               effective_rank,
               triangle,
               means,
               kept,
               bits,
               sum_of_weights)
ERRMAP_MEMBERS(fitting::RowDiagnostics,
               press,
               largest_residual,
               largest_residual_row,
               largest_leverage,
               leverage_one,
               rows)
ERRMAP_MEMBERS(fitting::SelectionStep,
               candidate,
               residual_sum_of_squares,
               bic,
               entered,
               terms,
               f,
               p,
               aic,
               aicc,
               adjusted_r2,
               press,
               cp,
               cv)
ERRMAP_MEMBERS(ReportTerm, name, numbers, inclusion)
ERRMAP_MEMBERS(ReportStep, term, numbers)
ERRMAP_MEMBERS(ExcludedReport, name, f, p, inclusion)
ERRMAP_MEMBERS(AliasReport, name, why)
ERRMAP_MEMBERS(RegressionReport,
               method,
               candidates,
               steps,
               chosen_step,
               ended,
               selected,
               bootstrap,
               bootstrap_unit,
               cross_validation,
               excluded,
               aliased,
               fit,
               rows,
               intercept,
               terms,
               centres,
               weighted,
               penalised,
               strength,
               degrees_of_freedom,
               strengths,
               mean_squared_errors,
               standard_errors,
               notes)
ERRMAP_MEMBERS(DerivedInput, column, of, filter, tau, between)
ERRMAP_MEMBERS(RowChange, column, largest, mean)
ERRMAP_MEMBERS(History,
               time_unit,
               session,
               derived,
               form_inputs,
               latest_start,
               longest_step,
               row_changes)
ERRMAP_MEMBERS(Guards,
               input_margin,
               error_margin,
               input_min,
               input_max,
               error_min,
               error_max)
ERRMAP_MEMBERS(PredictionInterval::Level, coverage, half_width, at_least)
ERRMAP_MEMBERS(PredictionInterval, holdout, unit, units, levels, of_sessions)
ERRMAP_MEMBERS(Applicability::Derived, column, min, max)
ERRMAP_MEMBERS(Applicability,
               derived,
               columns,
               mean,
               scale,
               directions,
               rest,
               states,
               rows,
               distance_limit,
               leverage_limit,
               relation_limit)
ERRMAP_MEMBERS(HeldOutErrors::Unit, label, rmse, elapsed, position, residuals)
ERRMAP_MEMBERS(HeldOutErrors, time_unit, position, rmse, units)
ERRMAP_MEMBERS(FittedModel,
               name,
               kind,
               target,
               align,
               where,
               inputs,
               model,
               summary,
               equation,
               remarks,
               choices,
               starts,
               regression,
               history,
               guards,
               inner_rmse,
               interval,
               applicability,
               held_out)
ERRMAP_MEMBERS(Memorisation,
               train_r2,
               shuffled_r2,
               weights_per_row,
               effective_parameters,
               effective_per_row,
               why_not)
ERRMAP_MEMBERS(FitOutcome,
               fitted,
               why_failed,
               seconds,
               train_predictions,
               test_predictions,
               memorisation,
               try_again)
ERRMAP_MEMBERS(
    FitLabel, component, holdout, fold, model, program, options, context, rows)
#undef ERRMAP_MEMBERS

template <typename T>
concept Structure = requires(T& value) {
  MembersOf(value);
};

[[noreturn]] void Refuse(const char* why) {
  throw data::InputError(fmt::format("record of a fit: {}", why));
}

constexpr std::string_view kBase64 =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::size_t kBytesPerGroup = 3;
constexpr std::size_t kLettersPerGroup = 4;
constexpr unsigned kBitsPerLetter = 6;
constexpr unsigned kBitsPerByte = 8;

constexpr auto kValueOfLetter = [] {
  std::array<std::uint8_t, 256> values{};
  values.fill(kBase64.size());  // no letter
  for (std::size_t i = 0; i < kBase64.size(); ++i) {
    values[static_cast<unsigned char>(kBase64[i])] =
        static_cast<std::uint8_t>(i);
  }
  return values;
}();

// RFC 4648, section 4.
std::string ToBase64(std::string_view bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / kBytesPerGroup * kLettersPerGroup);
  for (std::size_t i = 0; i < bytes.size(); i += kBytesPerGroup) {
    const std::size_t count = std::min(kBytesPerGroup, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < kBytesPerGroup; ++k) {
      group <<= kBitsPerByte;
      if (k < count) group |= static_cast<unsigned char>(bytes[i + k]);
    }
    for (std::size_t k = 0; k < kLettersPerGroup; ++k) {
      const auto shift = static_cast<unsigned>(kLettersPerGroup - 1 - k);
      const auto letter = (group >> (kBitsPerLetter * shift)) % kBase64.size();
      text += k <= count ? kBase64[letter] : '=';
    }
  }
  return text;
}

std::string FromBase64(std::string_view text) {
  if (text.size() % kLettersPerGroup != 0) Refuse("base64 of odd length");
  std::string bytes;
  bytes.reserve(text.size() / kLettersPerGroup * kBytesPerGroup);
  while (!text.empty()) {
    std::string_view letters = text.substr(0, kLettersPerGroup);
    text.remove_prefix(kLettersPerGroup);
    while (letters.ends_with('=')) letters.remove_suffix(1);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < kLettersPerGroup; ++k) {
      std::uint32_t value = 0;
      if (k < letters.size()) {
        value = kValueOfLetter[static_cast<unsigned char>(letters[k])];
      }
      if (value == kBase64.size()) Refuse("no base64");
      group = group << kBitsPerLetter | value;
    }
    for (std::size_t k = 0; k + 1 < letters.size(); ++k) {
      const auto shift = static_cast<unsigned>(kBytesPerGroup - 1 - k);
      bytes += static_cast<char>(group >> (kBitsPerByte * shift) & 0xffU);
    }
  }
  return bytes;
}

std::string NumbersToBase64(const double* numbers, Index count) {
  std::string bytes(static_cast<std::size_t>(count) * sizeof(double), '\0');
  if (count > 0) std::memcpy(bytes.data(), numbers, bytes.size());
  return ToBase64(bytes);
}

void NumbersFromBase64(const Json& json, double* numbers, Index count) {
  const std::string bytes = FromBase64(json.get_ref<const std::string&>());
  if (bytes.size() != static_cast<std::size_t>(count) * sizeof(double)) {
    Refuse("a matrix of another shape");
  }
  if (count > 0) std::memcpy(numbers, bytes.data(), bytes.size());
}

// Names from files may hold any bytes and JSON holds UTF-8, so each byte is
// taken for a character of Latin-1.
constexpr unsigned char kTwoBytes = 0xc0;
constexpr unsigned char kFollower = 0x80;
constexpr unsigned char kLowBits = 0x3f;

std::string BytesToUtf8(std::string_view bytes) {
  std::string text;
  text.reserve(bytes.size());
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < kFollower) {
      text += c;
    } else {
      text += static_cast<char>(kTwoBytes | byte >> kBitsPerLetter);
      text += static_cast<char>(kFollower | (byte & kLowBits));
    }
  }
  return text;
}

std::string BytesFromUtf8(std::string_view text) {
  std::string bytes;
  bytes.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto lead = static_cast<unsigned char>(text[i]);
    if (lead < kFollower) {
      bytes += text[i];
      continue;
    }
    if (++i == text.size()) Refuse("a text is cut off");
    const auto follower = static_cast<unsigned char>(text[i]);
    bytes += static_cast<char>(lead << kBitsPerLetter | (follower & kLowBits));
  }
  return bytes;
}

constexpr int kHexadecimal = 16;

Json NumberToJson(double value) {
  if (std::isfinite(value)) return value;
  return fmt::format("{:016x}", std::bit_cast<std::uint64_t>(value));
}

double NumberFromJson(const Json& json) {
  if (!json.is_string()) return json.get<double>();
  const auto& text = json.get_ref<const std::string&>();
  return std::bit_cast<double>(
      static_cast<std::uint64_t>(std::stoull(text, nullptr, kHexadecimal)));
}

// Overloads for every type of member; in a class they see one another.
class Writer {
 public:
  static Json Of(double value) { return NumberToJson(value); }
  static Json Of(const std::string& text) { return BytesToUtf8(text); }

  template <std::integral T>
  static Json Of(T value) {
    return value;
  }

  template <typename T>
  requires std::is_enum_v<T>
  static Json Of(T value) {
    return static_cast<std::underlying_type_t<T>>(value);
  }

  static Json Of(const Eigen::VectorXd& vector) {
    return NumbersToBase64(vector.data(), vector.size());
  }

  static Json Of(const Eigen::MatrixXd& matrix) {
    return Json::array({matrix.rows(),
                        matrix.cols(),
                        NumbersToBase64(matrix.data(), matrix.size())});
  }

  template <typename T>
  static Json Of(const std::vector<T>& list) {
    Json json = Json::array();
    for (const T& element : list) json.push_back(Of(element));
    return json;
  }

  template <typename T>
  static Json Of(const std::optional<T>& value) {
    return value ? Of(*value) : Json();
  }

  template <typename A, typename B>
  static Json Of(const std::pair<A, B>& pair) {
    return Json::array({Of(pair.first), Of(pair.second)});
  }

  template <typename... T>
  static Json Of(const std::variant<T...>& value) {
    return Json::array(
        {value.index(),
         std::visit([](const auto& v) { return Of(v); }, value)});
  }

  template <typename T>
  static Json Of(const std::shared_ptr<const T>& value) {
    return value == nullptr ? Json() : Of(*value);
  }

  static Json Of(const std::shared_ptr<const ErrorModel>& model) {
    if (model == nullptr) return nullptr;
    return Json::array({model->num_parameters(), Of(model->Describe())});
  }

  template <Structure T>
  static Json Of(const T& structure) {
    Json json = Json::array();
    std::apply(
        [&](const auto&... member) { (json.push_back(Of(member)), ...); },
        MembersOf(structure));
    return json;
  }
};

// The same the other way.
class Reader {
 public:
  static void Get(const Json& json, double* value) {
    *value = NumberFromJson(json);
  }

  static void Get(const Json& json, std::string* text) {
    *text = BytesFromUtf8(json.get_ref<const std::string&>());
  }

  template <std::integral T>
  static void Get(const Json& json, T* value) {
    *value = json.get<T>();
  }

  template <typename T>
  requires std::is_enum_v<T>
  static void Get(const Json& json, T* value) {
    *value = static_cast<T>(json.get<std::underlying_type_t<T>>());
  }

  static void Get(const Json& json, Eigen::VectorXd* vector) {
    const auto letters = json.get_ref<const std::string&>().size();
    const auto most = letters / kLettersPerGroup * kBytesPerGroup;
    vector->resize(static_cast<Index>(most / sizeof(double)));
    NumbersFromBase64(json, vector->data(), vector->size());
  }

  static void Get(const Json& json, Eigen::MatrixXd* matrix) {
    constexpr std::size_t kParts = 3;
    RequireSize(json, kParts);
    const auto rows = json[0].get<Index>();
    const auto columns = json[1].get<Index>();
    // A letter stands for less than a byte: no product can overflow.
    const auto most =
        static_cast<Index>(json[2].get_ref<const std::string&>().size());
    if (rows < 0 || columns < 0 || (columns > 0 && rows > most / columns)) {
      Refuse("a matrix of another shape");
    }
    matrix->resize(rows, columns);
    NumbersFromBase64(json[2], matrix->data(), matrix->size());
  }

  template <typename T>
  static void Get(const Json& json, std::vector<T>* list) {
    RequireSize(json, json.size());
    for (const Json& element : json) Get(element, &list->emplace_back());
  }

  template <typename T>
  static void Get(const Json& json, std::optional<T>* value) {
    if (!json.is_null()) Get(json, &value->emplace());
  }

  template <typename A, typename B>
  static void Get(const Json& json, std::pair<A, B>* pair) {
    RequireSize(json, 2);
    Get(json[0], &pair->first);
    Get(json[1], &pair->second);
  }

  template <typename... T>
  static void Get(const Json& json, std::variant<T...>* value) {
    RequireSize(json, 2);
    const auto index = json[0].get<std::size_t>();
    if (index >= sizeof...(T)) Refuse("an unknown kind of value");
    GetAlternative(json[1], index, value, std::index_sequence_for<T...>());
  }

  template <typename T>
  static void Get(const Json& json, std::shared_ptr<const T>* value) {
    if (json.is_null()) return;
    auto read = std::make_shared<T>();
    Get(json, read.get());
    *value = std::move(read);
  }

  static void Get(const Json& json, std::shared_ptr<const ErrorModel>* model) {
    if (json.is_null()) return;
    RequireSize(json, 2);
    ModelDescription description;
    Get(json[1], &description);
    *model = ModelOfForm(std::move(description), json[0].get<Index>());
  }

  template <Structure T>
  static void Get(const Json& json, T* structure) {
    std::apply(
        [&](auto&... member) {
          RequireSize(json, sizeof...(member));
          std::size_t next = 0;
          (Get(json[next++], &member), ...);
        },
        MembersOf(*structure));
  }

 private:
  static void RequireSize(const Json& json, std::size_t size) {
    if (!json.is_array() || json.size() != size) Refuse("another layout");
  }

  template <typename Variant, std::size_t... I>
  static void GetAlternative(const Json& json,
                             std::size_t index,
                             Variant* value,
                             std::index_sequence<I...> /*all*/) {
    (void)((index == I && (Get(json, &value->template emplace<I>()), true)) ||
           ...);
  }
};

template <typename T>
T FromText(std::string_view text) {
  T value;
  try {
    data::RequireShallowJson(text);
    Reader::Get(Json::parse(text), &value);
  } catch (const Json::exception& error) {
    Refuse(error.what());
  } catch (const std::logic_error& error) {  // of a number or of a model
    Refuse(error.what());
  }
  return value;
}

}  // namespace

std::string FitToText(const FitOutcome& outcome) {
  return Writer::Of(outcome).dump();
}

FitOutcome FitFromText(std::string_view text) {
  return FromText<FitOutcome>(text);
}

std::string LabelToText(const FitLabel& label) {
  return Writer::Of(label).dump();
}

FitLabel LabelFromText(std::string_view text) {
  return FromText<FitLabel>(text);
}

}  // namespace errmap::models
