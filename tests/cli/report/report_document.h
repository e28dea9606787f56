#pragma once

// A results.json for tests of the report: synthetic, complete, of any size.

#include <cmath>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "models/record_json.h"
#include "models/study/record/study_record.h"

namespace errmap {

using Json = models::RecordJson;

/// As results.json has it.
inline std::string FileText(const Json& document) {
  return document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

struct DocumentSpec {
  std::size_t components = 1;
  std::size_t rows = 60;
  std::size_t groups = 6;
  std::vector<std::string> models = {"mean", "poly:eq8", "net:scg"};
  std::string name = "x displacement, down";
  std::string file = "xdown.csv";
  std::string position = "position_mm";
  std::string temperature = "t12_degC";
  std::string group = "cycle";
  std::string group_prefix = "";
  std::string target = "error_mm";
  std::string unit = "mm";
};

class ReportDocument {
 public:
  explicit ReportDocument(DocumentSpec spec) : spec_(std::move(spec)) {}

  Json Make() const {
    Json components = Json::array();
    Json configured = Json::array();
    for (std::size_t i = 0; i < spec_.components; ++i) {
      components.push_back(Component(i));
      configured.push_back({{"data", spec_.file}});
    }
    return {{"schema", "errmap-results-2"},
            {"version", "0.1.0"},
            {"seed", 1},
            {"interrupted", false},
            {"provenance",
             {{"command_line", "errmap compare " + spec_.file},
              {"configuration", {{"component", std::move(configured)}}},
              {"compiler", "g++"},
              {"inputs",
               Json::array({{{"file", spec_.file}, {"sha256", "abc"}}})}}},
            {"components", std::move(components)}};
  }

 private:
  DocumentSpec spec_;

  static constexpr const char* kNear = "every:3";
  static constexpr const char* kFar = "groups:5";

  static Json Metrics(double rmse, std::size_t n) {
    return {{"n", n},
            {"mean", 0.1 * rmse},
            {"sd", 0.99 * rmse},
            {"rmse", rmse},
            {"mae", 0.8 * rmse},
            {"min", -2.5 * rmse},
            {"max", 2.7 * rmse},
            {"range", 5.2 * rmse},
            {"r2", 0.99}};
  }

  double Rmse(std::size_t model, bool far) const {
    return 1e-4 * static_cast<double>(4 * (model + 2) + (far ? 7 * model : 0));
  }

  Json Result(std::size_t model, bool far) const {
    const double rmse = Rmse(model, far);
    const auto test = [](const char* key, double value) {
      return Json{{key, value}, {"p", 0.04}};
    };
    Json unit_rmse = Json::array();
    for (std::size_t g = 0; g < spec_.groups; ++g) {
      unit_rmse.push_back(rmse * (1.0 + 0.3 * Noise(g)));
    }
    return {
        {"unit_rmse", std::move(unit_rmse)},
        {"train", Metrics(0.8 * rmse, spec_.rows)},
        {"test", Metrics(rmse, spec_.rows)},
        {"ci95", {0.8 * rmse, 1.3 * rmse}},
        {"meets_goal", rmse < 5e-4},
        {"goal_standing", rmse < 5e-4 ? "met" : "not met"},
        {"tier", model + 1},
        {"folds",
         Json::array({{{"train_rmse", rmse},
                       {"test_rmse", rmse},
                       {"fit_seconds", 0.1},
                       {"iterations", 10},
                       {"stop", "gradient"},
                       {"converged", true}}})},
        {"normality",
         {{"ks", {{"d", 0.05}, {"p_given", 0.4}}},
          {"lilliefors", test("d", 0.05)},
          {"shapiro_wilk", test("w", 0.98)},
          {"ppcc", {{"lambda", 0.1}, {"r_max", 0.99}, {"r_normal", 0.98}}}}},
        {"randomness", {{"in_order", {{"runs", test("z", -1.0)}}}}}};
  }

  Json Model(std::size_t i) const {
    const std::string& name = spec_.models[i];
    const bool net = name.starts_with("net");
    Json model = {
        {"name", name},
        {"kind",
         net      ? "net"
         : i == 0 ? "baseline"
                  : "polynomial"},
        {"options", {{"hidden", 20}}},
        {"parameters", 10 * i + 1},
        {"equation", net ? Json() : Json("error_mm = 1 + 2*x")},
        {"sensors", Json::array({spec_.temperature})},
        {"inputs_used", Json::array({spec_.position, spec_.temperature})},
        {"status", "ok"},
        {"why", nullptr},
        {"predict_ns", 12.0},
        {"step_cost",
         {{"additions", 10 * i + 2},
          {"multiplications", 10 * i + 3},
          {"divisions", 0},
          {"exponentials", net ? 5 : 0},
          {"state_bytes", 0}}},
        {"results", {{kNear, Result(i, false)}, {kFar, Result(i, true)}}}};
    Json fit = {{"fit_seconds", 0.5},
                {"stop", "iteration_limit"},
                {"converged", false},
                {"message", "a limit was reached"},
                {"iterations", 100},
                {"mean_iteration_seconds", 1e-5},
                {"initial_cost", 0.5},
                {"final_cost", 0.001}};
    if (net) {
      Json trace = Json::array();
      for (int step = 0; step < 100; ++step) {
        trace.push_back({step, std::exp(-0.05 * step), 0.1});
      }
      fit["trace"] = std::move(trace);
      Json starts = Json::array();
      for (int start = 0; start < 5; ++start) {
        starts.push_back({{"seed", start},
                          {"final_cost", 0.001 * (start + 1)},
                          {"stop", "iteration_limit"},
                          {"iterations", 100},
                          {"holdout_rmse", 0.001},
                          {"chosen", start == 0}});
      }
      fit["starts"] = {{"table", std::move(starts)}};
    }
    model["final"] = std::move(fit);
    return model;
  }

  Json UnitLabels() const {
    Json labels = Json::array();
    for (std::size_t g = 0; g < spec_.groups; ++g) {
      labels.push_back(spec_.group_prefix + std::to_string(g + 1));
    }
    return labels;
  }

  // Reproducible figures between -1 and 1.
  static double Noise(std::size_t i) {
    return std::sin(12.9898 * static_cast<double>(i) + 78.233);
  }

  Json Figures() const {
    Json rows = Json::array();
    Json groups = Json::array();
    Json labels = Json::array();
    Json target = Json::array();
    Json position = Json::array();
    Json temperature = Json::array();
    for (std::size_t g = 0; g < spec_.groups; ++g) {
      labels.push_back(spec_.group_prefix + std::to_string(g + 1));
    }
    for (std::size_t i = 0; i < spec_.rows; ++i) {
      rows.push_back(i);
      groups.push_back(i * spec_.groups / spec_.rows);
      target.push_back(1e-3 * (Noise(i) + 0.02 * static_cast<double>(i)));
      position.push_back(-12.7 * static_cast<double>(i % 17 + 1));
      temperature.push_back(22.0 + 0.05 * static_cast<double>(i));
    }
    Json near = Json::object();
    Json far = Json::object();
    for (std::size_t m = 0; m < spec_.models.size(); ++m) {
      Json a = Json::array();
      Json b = Json::array();
      for (std::size_t i = 0; i < spec_.rows; ++i) {
        const double value = target[i].get<double>();
        a.push_back(i % 3 == 2 ? Json(value + Rmse(m, false) * Noise(i + 7 * m))
                               : Json());
        b.push_back(value + Rmse(m, true) * Noise(2 * i + 5 * m));
      }
      near[spec_.models[m]] = std::move(a);
      far[spec_.models[m]] = std::move(b);
    }
    Json fitted = Json::array();
    for (std::size_t i = 0; i < spec_.rows; ++i) {
      fitted.push_back(target[i].get<double>() + 1e-4 * Noise(3 * i));
    }
    Json outside = Json::array({0, spec_.rows - 1});
    return {
        {"fitted", std::move(fitted)},
        {"inputs",
         Json::array({{{"name", spec_.position}, {"unit", "mm"}},
                      {{"name", spec_.temperature}, {"unit", "degC"}}})},
        {"inputs_left_out", 0},
        {"position", spec_.position},
        {"group", spec_.group},
        {"tables",
         Json::array({{{"file", spec_.file},
                       {"rows_total", spec_.rows},
                       {"rows", rows},
                       {"labels", labels},
                       {"groups", groups},
                       {"target", target},
                       {"inputs", Json::array({position, temperature})}}})},
        {"holdouts",
         Json::array({{{"name", kNear}, {"table", 0}, {"predictions", near}},
                      {{"name", kFar},
                       {"table", 0},
                       {"predictions", far},
                       {"outside", std::move(outside)}}})}};
  }

  Json Component(std::size_t index) const {
    Json models = Json::array();
    for (std::size_t i = 0; i < spec_.models.size(); ++i) {
      models.push_back(Model(i));
    }
    const std::size_t best = spec_.models.size() > 1 ? 1 : 0;
    const double rmse = Rmse(best, true);
    return {{"name",
             spec_.name +
                 (spec_.components > 1 ? " " + std::to_string(index + 1) : "")},
            {"data",
             {{"file", spec_.file},
              {"sha256", "abc"},
              {"rows", spec_.rows},
              {"target", spec_.target},
              {"unit", spec_.unit},
              {"inputs", Json::array({spec_.position, spec_.temperature})},
              {"group", spec_.group},
              {"dropped",
               Json::array({{{"column", "t99_degC"}, {"why", "all zero"}}})}}},
            {"goal", 5e-4},
            {"display", {{"unit", "um"}, {"scale", 1000.0}}},
            {"holdouts",
             Json::array({{{"name", kNear},
                           {"folds", 1},
                           {"whole_groups", false},
                           {"unit_of_analysis", spec_.group}},
                          {{"name", kFar},
                           {"folds", 5},
                           {"whole_groups", true},
                           {"unit_of_analysis", spec_.group},
                           {"units", spec_.groups},
                           {"unit_labels", UnitLabels()}}})},
            {"models", std::move(models)},
            {"comparisons",
             Json::array({{{"a", spec_.models[best]},
                           {"b", spec_.models.back()},
                           {"holdout", kFar},
                           {"rmse_a", rmse},
                           {"rmse_b", 2.0 * rmse},
                           {"difference", -rmse},
                           {"ci95", {-1.5 * rmse, -0.5 * rmse}},
                           {"p", 0.001},
                           {"p_holm", 0.003},
                           {"units", 6},
                           {"established", true}}})},
            {"verdict",
             Json::array({{{"holdout", kFar},
                           {"choice", "polynomial"},
                           {"model", spec_.models[best]},
                           {"established", true},
                           {"why", "It has the lowest error."}}})},
            {"recommendation",
             {{"choice", "polynomial"},
              {"model", spec_.models[best]},
              {"holdout", kFar},
              {"rmse", rmse},
              {"ci95", {0.8 * rmse, 1.3 * rmse}},
              {"sensors", Json::array({spec_.temperature})},
              {"parameters", 11},
              {"predict_ns", 12.0},
              {"meets_goal", false},
              {"goal_standing", "not met"},
              {"sentence", "Use " + spec_.models[best] + " on another day."},
              {"why", "It is the simplest of the first tier."},
              {"reasons", Json::array({"A reason."})},
              {"caveats", Json::array({"A caveat."})}}},
            {"figures", Figures()}};
  }
};

inline models::RecordJson MakeReportDocument(const DocumentSpec& spec = {}) {
  return ReportDocument(spec).Make();
}

/// The document as a record.
inline models::StudyRecord Recorded(const models::RecordJson& document) {
  models::StudyRecord record;
  models::FromJson(document, &record);
  return record;
}

/// Names that try to leave their place in HTML, SVG and Markdown.
inline const std::vector<std::string>& HostileNames() {
  static const std::vector<std::string> names = {
      "<script>alert(1)</script>",
      "\"; system(\"touch pwned\"); \"",
      "`touch pwned`",
      "'; system('touch pwned') #",
      "$(touch pwned)",
      "line\nset output 'pwned'\n",
      "back\\slash\\",
      "%d %s %n 100 %",
      "\u202eright to left \u05d0\u05d1",
      "{/Symbol a}_b^c @macro",
      std::string(200, 'W'),
      "\xff\xfe no UTF-8",
      "END\nEND",
      "</title></svg><img src=x onerror=alert(1)>",
      "\" onload=\"alert(1)"};
  return names;
}

}  // namespace errmap
