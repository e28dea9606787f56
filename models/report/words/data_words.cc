#include "models/report/words/data_words.h"

#include <fmt/format.h>

#include "models/report/number_text.h"

namespace errmap::report {

std::string UnitsWords(const models::DataRecord& data) {
  std::string text = ", no groups";
  if (data.group) {
    text = fmt::format(", {} ({})", Count(data.groups, "group"), *data.group);
  }
  if (data.sessions < 2) return text + ", one run";
  return text + ", " + Count(data.sessions, "session") +
         (data.session ? " (" + *data.session + ")" : "");
}

std::string TargetWords(const models::DataRecord& data) {
  return data.target + (data.align == data::Alignment::kFirst
                            ? " less each session's first value"
                            : "");
}

}  // namespace errmap::report
