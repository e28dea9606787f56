#pragma once

// What the suites of the program share: fixture, tables, expected statuses.

#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/cli_runner.h"

namespace errmap {

inline constexpr int kFailure = 1;
inline constexpr int kWrongCommandLine = 2;
inline constexpr int kUnusable = 3;
inline constexpr int kNothingJudged = 5;
inline constexpr int kEveryFitFailed = 4;
inline constexpr int kInterrupted = 130;

inline constexpr double kUmPerMm = 1000.0;

inline const std::string kDown = SetPath("nistir5367_xdisp_down.csv");
// A net that trains on `kDown` for minutes on any machine: fewer nodes are soon
// at the floor of rounding and end by themselves.
inline const std::string kEndlessNet =
    "net:scg:hidden=600:iterations=100000000";
inline const std::string kAppendixB = SetPath("nistir5367_appendix_b.csv");

class Cli : public CliTest {
 protected:
  /// The component of `compare kDown --format json` with these words added.
  Json Compare(const std::vector<std::string>& more) const {
    std::vector<std::string> words{"compare", kDown, "--format", "json"};
    words.insert(words.end(), more.begin(), more.end());
    return RunJson(words)["components"][0];
  }

  static Json Model(const Json& component, const std::string& name) {
    for (const Json& model : component["models"]) {
      if (model["name"] == name) return model;
    }
    ADD_FAILURE() << "no model " << name;
    return nullptr;
  }

  /// 60 rows of two inputs, none of them a position.
  void WriteWithoutPosition(const std::string& name, int rows = 60) const {
    std::string text = "t1,t2,error_um\n";
    for (int i = 0; i < rows; ++i) {
      const int t2 = (i * 7) % 11;
      text += std::to_string(i) + "," + std::to_string(20 + t2) + "," +
              std::to_string(0.001 * i * i + 0.01 * t2) + "\n";
    }
    Write(name, text);
  }

  /// A saved poly:eq8 or net:scg map of kDown.
  Json Fit(const std::string& model, const std::string& file) const {
    const Outcome outcome =
        Run({"fit", kDown, "--model", model, "-o", file, "--quiet"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return Json::parse(Read(file));
  }
};

inline std::vector<std::string> SplitLines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

inline std::vector<std::string> SplitFields(const std::string& line) {
  std::vector<std::string> fields{""};
  for (const char c : line) {
    if (c == ',') {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

/// Rows of a CSV file without quotes, by column name.
inline std::vector<std::map<std::string, std::string>> Records(
    const std::string& text) {
  const std::vector<std::string> lines = SplitLines(text);
  std::vector<std::map<std::string, std::string>> records;
  if (lines.empty()) return records;
  const std::vector<std::string> names = SplitFields(lines.front());
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string> fields = SplitFields(lines[i]);
    EXPECT_EQ(fields.size(), names.size()) << lines[i];
    if (fields.size() != names.size()) continue;
    auto& record = records.emplace_back();
    for (std::size_t j = 0; j < names.size(); ++j) record[names[j]] = fields[j];
  }
  return records;
}

/// Measured times out of a document.
inline void DropTimes(nlohmann::ordered_json* node) {
  if (node->is_object()) {
    std::vector<std::string> times;
    for (const auto& [key, value] : node->items()) {
      if (key.find("seconds") != std::string::npos || key.ends_with("_ns")) {
        times.push_back(key);
      }
    }
    for (const std::string& key : times) node->erase(key);
  }
  if (node->is_structured()) {
    for (auto& child : *node) DropTimes(&child);
  }
}

}  // namespace errmap
