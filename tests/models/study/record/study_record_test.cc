#include "models/study/record/study_record.h"

#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "data/files/atomic_file.h"
#include "data/input_error.h"
#include "models/record_json.h"
#include "tests/places.h"

namespace errmap::models {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// Gives every member of a record, however deep, a value of its own.
class Filler {
 public:
  template <typename T>
  void Fill(T* value) {
    ++count_;
    if constexpr (std::same_as<T, OtherKeys>) {
      value->emplace_back("of a slice", R"([1,{"held":0.5}])");
    } else if constexpr (Record<T>) {
      VisitMembers(*value, [&](std::string_view /*key*/, auto& member) {
        Fill(&member);
      });
    } else if constexpr (IsInline<T>::value) {
      Fill(&value->value);
    } else if constexpr (std::is_enum_v<T>) {
      *value = static_cast<T>(1);
    } else if constexpr (std::same_as<T, bool>) {
      *value = true;
    } else if constexpr (std::floating_point<T>) {
      *value = 1.0 / count_;
    } else if constexpr (std::integral<T>) {
      *value = static_cast<T>(count_);
    } else if constexpr (std::same_as<T, std::string>) {
      *value = "text " + std::to_string(count_);
    } else if constexpr (requires { value->has_value(); }) {
      Fill(&value->emplace());
    } else if constexpr (requires { std::tuple_size<T>::value; }) {
      std::apply([&](auto&... held) { (Fill(&held), ...); }, *value);
    } else if constexpr (requires { value->valueless_by_exception(); }) {
      *value = 0.1 * count_;
    } else {
      value->resize(2);
      for (auto& held : *value) Fill(&held);
    }
  }

 private:
  int count_ = 0;
};

StudyRecord FilledRecord() {
  StudyRecord record;
  Filler().Fill(&record);
  record.schema = "errmap-results-2";
  // A regression is penalised or not.
  for (ComponentRecord& component : record.components) {
    component.models[0].regression->penalised.value.reset();
    component.models[1].regression->least_squares.value.reset();
  }
  return record;
}

TEST(StudyRecord, ReadsBackAsItWasWritten) {
  const StudyRecord record = FilledRecord();
  const std::string text = ToJsonText(record);
  const StudyRecord read = FromJsonText(text);
  EXPECT_TRUE(Same(read, record));
  EXPECT_EQ(ToJsonText(read), text);
}

TEST(StudyRecord, ReadsBackWhereThereIsNothing) {
  StudyRecord record;
  record.schema = "errmap-results-2";
  record.components.resize(1);
  record.components[0].models.resize(1);
  record.components[0].models[0].results.resize(1);
  record.components[0].recommendation.emplace();
  EXPECT_TRUE(Same(FromJsonText(ToJsonText(record)), record));
}

TEST(StudyRecord, KeepsEveryKindOfOption) {
  StudyRecord record = FilledRecord();
  auto& options = record.components[0].models[0].options;
  options = {{"whole", std::int64_t{3}}, {"real", 3.0}, {"text", "3"}};
  const StudyRecord read = FromJsonText(ToJsonText(record));
  EXPECT_TRUE(Same(read.components[0].models[0].options, options));
}

TEST(Same, SeesADifferenceAnywhereAndTakesNanForNan) {
  const StudyRecord record = FilledRecord();
  StudyRecord other = record;
  other.components[1].models[1].results[1].second.folds[1].test_rmse = 7.0;
  EXPECT_FALSE(Same(other, record));
  other = record;
  other.components[0].figures.position.reset();
  EXPECT_FALSE(Same(other, record));
  EXPECT_TRUE(Same(stats::ErrorMetrics(), stats::ErrorMetrics()));
}

TEST(StudyRecord, ReadsWhatIsMissingAndRefusesWhatIsOfAnotherType) {
  const StudyRecord record = FilledRecord();
  const RecordJson whole = ToJson(record.components[0]);
  const RecordJson flat = whole.flatten();
  int count = 0;
  for (const auto& [path, value] : flat.items()) {
    constexpr int kEvery = 11;  // that all are tried takes long
    if (count++ % kEvery != 0) continue;
    const RecordJson::json_pointer at(path);
    RecordJson changed = whole;
    changed[at] = RecordJson::array({RecordJson::object()});
    ComponentRecord read;
    std::string misfit;
    EXPECT_FALSE(FromJson(changed, &read, &misfit)) << path;
    EXPECT_THAT(misfit, HasSubstr(at.back())) << path;
    changed = whole;
    RecordJson& around = changed[at.parent_pointer()];
    if (!around.is_object()) continue;
    around.erase(at.back());
    ComponentRecord without;
    EXPECT_TRUE(FromJson(changed, &without)) << path;
    EXPECT_EQ(without.models.size(), 2U) << path;
  }
  for (const char* odd : {"3", "[]", "{\"components\": 5}"}) {
    ComponentRecord read;
    EXPECT_EQ(FromJson(RecordJson::parse(odd), &read), odd[0] == '{');
    EXPECT_TRUE(Same(read, ComponentRecord())) << odd;
  }
}

TEST(StudyRecord, TellsAFileThatWasChangedByHand) {
  StudyRecord record = FilledRecord();
  record.doubt.reset();
  const std::string text = ToJsonText(record);
  EXPECT_FALSE(FromJsonText(text).doubt.has_value());
  // Other indentation and other times are the same results.
  RecordJson json = RecordJson::parse(text);
  EXPECT_FALSE(FromJsonText(json.dump()).doubt.has_value());
  json["components"][0]["models"][0]["predict_ns"] = 1e9;
  EXPECT_FALSE(FromJsonText(json.dump()).doubt.has_value());

  RecordJson changed = json;
  changed["components"][0]["models"][0]["results"].front()["test"]["rmse"] =
      1e-9;
  EXPECT_EQ(FromJsonText(changed.dump()).doubt, Doubt::kChanged);
  changed = json;
  changed["components"][0]["verdict"].erase(0);
  EXPECT_EQ(FromJsonText(changed.dump()).doubt, Doubt::kChanged);
  // An older file has none.
  json["provenance"].erase("content_sha256");
  EXPECT_EQ(FromJsonText(json.dump()).doubt, Doubt::kNoHash);
}

TEST(StudyRecord, RefusesWhatIsNoResults) {
  EXPECT_THAT([] { FromJsonText("{ half"); },
              ThrowsMessage<data::InputError>(HasSubstr("is not JSON")));
  EXPECT_THAT([] { FromJsonText("{\"schema\": \"errmap-fit-1\"}"); },
              ThrowsMessage<data::InputError>(HasSubstr("'errmap-fit-1'")));
}

// Walks the record's types and the published schema side by side.
class SchemaWalk {
 public:
  template <typename T>
  void Look(const RecordJson& schema, const std::string& path) {
    const RecordJson& node = Followed(schema);
    if constexpr (Record<T>) {
      if (!node.contains("properties")) return;
      std::set<std::string> keys;
      LookAtMembers<T>(node, path, &keys);
      for (const auto& [key, value] : node["properties"].items()) {
        described_.insert(path + "." + key);
        if (!keys.contains(key)) unknown_.insert(path + "." + key);
      }
    } else if constexpr (requires(T value) { value.has_value(); }) {
      Look<typename T::value_type>(node, path);
    } else if constexpr (requires(T value) { value.front().second; }) {
      if (!node.contains("additionalProperties")) return;
      Look<typename T::value_type::second_type>(node["additionalProperties"],
                                                path + ".*");
    } else if constexpr (!std::same_as<T, std::string> &&
                         requires(T value) { value.resize(1); }) {
      if (!node.contains("items")) return;
      Look<typename T::value_type>(node["items"], path + "[]");
    }
  }

  const std::set<std::string>& missing() const { return missing_; }
  const std::set<std::string>& unknown() const { return unknown_; }
  std::size_t num_described() const { return described_.size(); }

 private:
  std::set<std::string> missing_;  // in the schema
  std::set<std::string> unknown_;  // to the record
  std::set<std::string> described_;

  template <typename T>
  void LookAtMembers(const RecordJson& node,
                     const std::string& path,
                     std::set<std::string>* keys) {
    const T record{};
    VisitMembers(record, [&](std::string_view name, const auto& member) {
      using Member = std::decay_t<decltype(member)>;
      const std::string key(name);
      if constexpr (std::same_as<Member, OtherKeys>) {
        return;  // the slices' own
      } else if constexpr (IsInline<Member>::value) {
        using Held = std::decay_t<decltype(member.value)>;
        if constexpr (requires { member.value.has_value(); }) {
          LookAtMembers<typename Held::value_type>(node, path, keys);
        } else {
          LookAtMembers<Held>(node, path, keys);
        }
      } else {
        keys->insert(key);
        if (node["properties"].contains(key)) {
          Look<Member>(node["properties"][key], path + "." + key);
        } else if (!node.contains("additionalProperties")) {
          missing_.insert(path + "." + key);
        }
      }
    });
  }

  static const RecordJson& File(const std::string& name) {
    static std::map<std::string, RecordJson> files;
    auto [at, is_new] = files.try_emplace(name);
    if (is_new) {
      at->second = RecordJson::parse(
          data::ReadFile(errmap::tests::SourceDir() + "/cli/schemas/" + name));
    }
    return at->second;
  }

  // What a reference, or the one of several that is an object, stands for.
  static const RecordJson& Followed(const RecordJson& schema) {
    if (schema.contains("$ref")) {
      const std::string reference = schema["$ref"];
      const std::size_t hash = reference.find('#');
      const std::string file = hash == 0 ? "errmap-results-2.schema.json"
                                         : reference.substr(0, hash);
      const RecordJson::json_pointer place(reference.substr(hash + 1));
      const RecordJson& inside = File(file);
      return Followed(inside.contains(place) ? inside[place]
                                             : File("errmap-blocks-1.schema."
                                                    "json")[place]);
    }
    if (schema.contains("anyOf")) return Followed(schema["anyOf"][0]);
    return schema;
  }
};

TEST(StudyRecord, HasTheKeysOfItsSchemaAndNoOthers) {
  SchemaWalk walk;
  walk.Look<StudyRecord>({{"$ref", "errmap-results-2.schema.json#"}}, "");
  EXPECT_THAT(walk.missing(), ::testing::IsEmpty());
  // Described for errmap residuals, which shares the block of figures.
  for (const std::string& path : walk.unknown()) {
    if (path == ".provenance.content_sha256") continue;  // of the text
    if (path == ".machine") continue;                    // of a slice
    EXPECT_THAT(path,
                ::testing::ContainsRegex("\\.(train|test)\\.[a-z0-9_]+$"));
  }
  EXPECT_GT(walk.num_described(), 150U);
}

}  // namespace
}  // namespace errmap::models
