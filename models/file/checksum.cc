#include "models/file/checksum.h"

#include <fmt/format.h>

#include "data/sha256.h"

namespace errmap::models {
namespace {

// Numbers are kept as written: a digit may differ although the double read is
// the same.
std::string WithoutBlanks(std::string_view json) {
  std::string kept;
  kept.reserve(json.size());
  bool in_text = false;
  bool is_escaped = false;
  for (const char c : json) {
    const bool is_blank = c == ' ' || c == '\t' || c == '\r' || c == '\n';
    if (in_text || !is_blank) kept += c;
    if (c == '"' && !is_escaped) in_text = !in_text;
    is_escaped = in_text && c == '\\' && !is_escaped;
  }
  return kept;
}

}  // namespace

std::string WithChecksum(std::string json) {
  json.erase(json.find_last_of('}'));
  const std::string sum = data::Sha256(WithoutBlanks(json));
  json.erase(json.find_last_not_of(" \t\r\n") + 1);
  return fmt::format("{},\n \"{}\": \"{}\"\n}}\n", json, kChecksumKey, sum);
}

bool HasChecksum(std::string_view json, std::string_view checksum) {
  std::string before = WithoutBlanks(json);
  const std::string end =
      fmt::format(",\"{}\":\"{}\"}}", kChecksumKey, checksum);
  if (!before.ends_with(end)) return false;
  before.resize(before.size() - end.size());
  return data::Sha256(before) == checksum;
}

}  // namespace errmap::models
