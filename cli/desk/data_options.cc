#include "cli/desk/data_options.h"

#include "cli/desk/study_config.h"

namespace errmap::desk {

models::ByName<std::string> DataOptions(const data::DatasetSelection& selection,
                                        std::uint64_t seed) {
  const data::DatasetSelection defaults;
  models::ByName<std::string> options;
  const auto add = [&](const char* name, std::string value) {
    if (!value.empty()) options.emplace_back(name, std::move(value));
  };
  const auto add_choice = [&](const char* name, auto value, auto by_default) {
    if (value != by_default) add(name, std::string(ToString(value)));
  };
  add("target", selection.target);
  add("inputs", NameList(selection.inputs));
  add("exclude", NameList(selection.exclude));
  add("group", selection.group);
  add("session", selection.session);
  add("time", selection.time);
  add_choice("align", selection.align, defaults.align);
  add("weight", selection.weight);
  add_choice("missing", selection.missing, defaults.missing);
  add_choice("faults", selection.faults, defaults.faults);
  if (selection.keep_dead) options.emplace_back("keep_dead", "");
  if (seed != StudyConfig{}.seed) add("seed", std::to_string(seed));
  return options;
}

std::string NameList(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) {
    list += list.empty() ? "" : ",";
    if (name.find_first_of(",\"") == std::string::npos) {
      list += name;
      continue;
    }
    // RFC 4180: two quotes stand for one.
    list += '"';
    for (const char c : name) list += c == '"' ? "\"\"" : std::string(1, c);
    list += '"';
  }
  return list;
}

}  // namespace errmap::desk
