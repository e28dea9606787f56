#include "models/study/record/study_record.h"

#include <algorithm>
#include <array>
#include <initializer_list>

#include <fmt/format.h>

#include "data/argument_name.h"
#include "data/sha256.h"
#include "data/text.h"
#include "models/record_json.h"

namespace errmap::models {
namespace {

constexpr std::string_view kHash = "content_sha256";

std::string HashOf(const RecordJson& results) {
  data::Sha256Stream stream;
  record_json::ForText(
      results,
      [](std::string_view key) {
        return key != kHash && !key.ends_with("_ns") &&
               key.find("seconds") == std::string_view::npos;
      },
      [&](std::string_view text) { stream.Add(text); });
  return data::Hexadecimal(stream.Finish());
}

LeftOut<Doubt> DoubtOf(const RecordJson& results) {
  const RecordJson* provenance = record_json::Find(results, "provenance");
  const RecordJson* stated =
      provenance == nullptr ? nullptr : record_json::Find(*provenance, kHash);
  std::string hash;
  if (stated == nullptr || !FromJson(*stated, &hash)) return Doubt::kNoHash;
  if (hash != HashOf(results)) return Doubt::kChanged;
  return {};
}

StudyRecord FromSchemas(std::string_view text,
                        std::initializer_list<std::string_view> schemas) {
  const std::string remedy = fmt::format("errmap compare with {} rewrites it",
                                         data::ArgumentName("out"));
  record_json::Tree json;
  record_json::ParseAs(text, schemas, remedy, &json);
  auto record = RecordOf<StudyRecord>(*json.root(), kResultsSchema, remedy);
  if (!record.doubt) record.doubt = DoubtOf(*json.root());
  return record;
}

}  // namespace

const PairRecord* FindPair(const ComponentRecord& component,
                           std::string_view holdout,
                           std::string_view one,
                           std::string_view other) {
  const auto found =
      std::ranges::find_if(component.comparisons, [&](const PairRecord& pair) {
        return pair.holdout == holdout && ((pair.a == one && pair.b == other) ||
                                           (pair.a == other && pair.b == one));
      });
  return found == component.comparisons.end() ? nullptr : &*found;
}

std::string_view ToString(Doubt doubt) {
  constexpr auto kNames =
      std::to_array<std::string_view>({"no hash", "changed"});
  return data::NameOf(kNames, doubt);
}

std::string ToJsonText(const StudyRecord& record) {
  constexpr int kIndent = 1;
  record_json::Tree json;
  record_json::Write(record, json.root());
  const std::string hash = HashOf(*json.root());
  record_json::Set(std::string_view(hash),
                   record_json::Member(
                       kHash, record_json::Member("provenance", json.root())));
  return json.Text(kIndent) + "\n";
}

std::string ToJsonLine(const StudyRecord& record) {
  return JsonText(record, -1);
}

StudyRecord FromJsonText(std::string_view text) {
  return FromSchemas(text, {kResultsSchema});
}

StudyRecord FromStoredJsonText(std::string_view text) {
  return FromSchemas(text, {kResultsSchema, kStoredResultsSchema});
}

}  // namespace errmap::models
