#include "models/record_json.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "data/formats/nesting.h"
#include "data/input_error.h"
#include "data/measurements/dataset.h"
#include "data/text.h"

namespace errmap::models::record_json {

struct ColumnRecord {
  std::string name;
  std::string unit;
  LeftOut<data::Role> role;
};

void AddColumn(const data::ColumnInfo& column, RecordJson* json) {
  ColumnRecord record{column.name, column.unit.symbol, {}};
  if (column.role != data::Role::kUnknown) record.role.emplace(column.role);
  Add(record, json);
}

bool ColumnFrom(const RecordJson& json,
                data::ColumnInfo* column,
                std::string* misfit) {
  ColumnRecord record;
  if (!MembersFrom(json, &record, misfit)) return false;
  *column = {.name = record.name,
             .unit = data::UnitOfSymbol(record.unit),
             .role = record.role.value_or(data::Role::kUnknown)};
  return true;
}

void SetNull(RecordJson* json) { *json = nullptr; }
void Set(double value, RecordJson* json) {
  *json = std::isfinite(value) ? RecordJson(value) : RecordJson();
}
void Set(bool value, RecordJson* json) { *json = value; }
void Set(std::int64_t value, RecordJson* json) { *json = value; }
void Set(std::uint64_t value, RecordJson* json) { *json = value; }
void Set(std::string_view value, RecordJson* json) { *json = value; }
void SetObject(RecordJson* json) { *json = RecordJson::object(); }
void SetArray(RecordJson* json) { *json = RecordJson::array(); }
void SetText(std::string_view text, RecordJson* json) {
  *json = RecordJson::parse(text);
}

RecordJson* Member(std::string_view key, RecordJson* object) {
  return &(*object)[std::string(key)];
}
RecordJson* Append(RecordJson* array) { return &array->emplace_back(); }

bool IsObject(const RecordJson& json) { return json.is_object(); }
bool IsArray(const RecordJson& json) { return json.is_array(); }
bool IsText(const RecordJson& json) { return json.is_string(); }
bool IsInteger(const RecordJson& json) { return json.is_number_integer(); }
bool IsNull(const RecordJson& json) { return json.is_null(); }
std::size_t Size(const RecordJson& json) { return json.size(); }
const RecordJson& At(const RecordJson& array, std::size_t i) {
  return array[i];
}

const RecordJson* Find(const RecordJson& json, std::string_view key) {
  if (!json.is_object()) return nullptr;
  const auto found = json.find(key);
  return found == json.end() ? nullptr : &*found;
}

void ForMembers(const RecordJson& object,
                const std::function<void(std::string name,
                                         const RecordJson& value)>& visit) {
  for (const auto& [name, value] : object.items()) {
    visit(data::AsUtf8(name), value);
  }
}

std::string OneLine(const RecordJson& json) {
  return json.dump(-1, ' ', false, RecordJson::error_handler_t::replace);
}

void ForText(const RecordJson& json,
             const std::function<bool(std::string_view key)>& kept,
             const std::function<void(std::string_view text)>& take) {
  if (!json.is_structured()) {
    take(OneLine(json));
    return;
  }
  take(json.is_object() ? "{" : "[");
  bool is_first = true;
  for (auto at = json.begin(); at != json.end(); ++at) {
    if (json.is_object() && !kept(at.key())) continue;
    if (!is_first) take(",");
    is_first = false;
    if (json.is_object()) take(OneLine(RecordJson(at.key())) + ":");
    ForText(*at, kept, take);
  }
  take(json.is_object() ? "}" : "]");
}

bool Get(const RecordJson& json, double* value) {
  if (json.is_number()) *value = json.get<double>();
  return json.is_number();
}
bool Get(const RecordJson& json, bool* value) {
  if (json.is_boolean()) *value = json.get<bool>();
  return json.is_boolean();
}
bool Get(const RecordJson& json, std::int64_t* value) {
  if (json.is_number_integer()) *value = json.get<std::int64_t>();
  return json.is_number_integer();
}
bool Get(const RecordJson& json, std::uint64_t* value) {
  if (json.is_number_integer()) *value = json.get<std::uint64_t>();
  return json.is_number_integer();
}
bool Get(const RecordJson& json, std::string* value) {
  if (!json.is_string()) return false;
  *value = data::AsUtf8(json.get_ref<const std::string&>());
  return true;
}
bool IsWord(const RecordJson& json, std::string_view word) {
  return json.is_string() && json.get_ref<const std::string&>() == word;
}

std::string PlaceOf(std::string_view key) {
  return fmt::format(".{}", data::AsUtf8(key));
}
std::string PlaceOf(std::size_t i) { return fmt::format("[{}]", i); }

void ParseAs(std::string_view text,
             std::initializer_list<std::string_view> schemas,
             std::string_view remedy,
             Tree* json) {
  data::RequireShallowJson(text);
  if (!json->Parse(text)) {
    throw data::InputError(fmt::format("is not JSON; {}", remedy));
  }
  const RecordJson* found = Find(*json->root(), "schema");
  if (found != nullptr &&
      std::ranges::any_of(schemas, [&](std::string_view schema) {
        return IsWord(*found, schema);
      })) {
    return;
  }
  std::string other;
  throw data::InputError(fmt::format("schema is {}, this version reads {}; {}",
                                     found != nullptr && Get(*found, &other)
                                         ? data::QuotedText(other)
                                         : "not there",
                                     *schemas.begin(),
                                     remedy));
}

void RefuseMisfit(std::string_view misfit,
                  std::string_view schema,
                  std::string_view remedy) {
  // A place that begins with a member's name needs no point before it.
  const bool is_member = misfit.starts_with('.');
  throw data::InputError(fmt::format(
      "{} is not what {} has there; {}",
      misfit.empty() ? "the whole"
                     : data::PrintablePath(misfit.substr(is_member ? 1 : 0)),
      schema,
      remedy));
}

Tree::Tree() : root_(std::make_unique<RecordJson>()) {}
Tree::~Tree() = default;

bool Tree::Parse(std::string_view text) {
  *root_ = RecordJson::parse(text, nullptr, false);
  return !root_->is_discarded();
}

std::string Tree::Text(int indent) const {
  return root_->dump(indent, ' ', false, RecordJson::error_handler_t::replace);
}

}  // namespace errmap::models::record_json
