#include "data/formats/nesting.h"

#include <string>

#include "data/input_error.h"

namespace errmap::data {

bool IsShallowJson(std::string_view text) {
  std::size_t depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      in_string = c != '"';
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      if (++depth > kMostNesting) return false;
    } else if ((c == ']' || c == '}') && depth > 0) {
      --depth;
    }
  }
  return true;
}

void RequireShallowJson(std::string_view text) {
  if (IsShallowJson(text)) return;
  throw InputError("is nested deeper than " + std::to_string(kMostNesting) +
                   " brackets, which no file of errmap is");
}

}  // namespace errmap::data
