// What `errmap compare` does: which map to use, and results.json.
#include <fstream>
#include <iostream>

#include <errmap/errmap.h>

int main(int argc, char** argv) {
  using namespace errmap::models;
  if (argc != 3) return 2;
  const auto table = errmap::data::ReadCsv(argv[1]);
  ComponentStudy x{.name = "x", .data = errmap::data::MakeDataset(table, {})};
  const auto& rows = x.data.dataset;
  for (const std::string& text : DefaultHoldouts(rows)) {
    const auto spec = errmap::stats::ParseHoldout(text);
    x.holdouts.push_back(MakeHoldout(spec, rows, 1, nullptr));
  }
  const auto recipes = MakeDefaultRecipes(rows, rows.num_rows() / 2).recipes;
  x.study = RunStudy(rows, x.holdouts, recipes, {.jobs = 2});
  x.judgement = JudgeStudy(rows, x.holdouts, x.study, {});
  StudyRecord record{.schema = std::string(kResultsSchema), .components = {}};
  record.components.push_back(MakeComponentRecord(x));
  std::ofstream(argv[2]) << ToJsonText(record);
  const auto& use = x.judgement.recommendation;
  std::cout << "use " << x.study.models[use->model].name << "\n";
}
