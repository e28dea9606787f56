#include "cli/json_blocks.h"

#include "models/record_json.h"

namespace errmap::cli {

std::string DumpJson(const Json& document) {
  constexpr int kIndent = 1;
  // Names from files may hold any bytes: what is not UTF-8 is replaced.
  return document.dump(kIndent, ' ', false, Json::error_handler_t::replace) +
         "\n";
}

Json ProvenanceJson(const std::string& command_line,
                    const Json& configuration,
                    const std::vector<study_setup::InputFile>& inputs) {
  Json json = models::ToJson(study_setup::MakeProvenance(command_line, inputs));
  json["configuration"] = configuration;
  return json;
}

}  // namespace errmap::cli
