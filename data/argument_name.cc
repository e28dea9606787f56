#include "data/argument_name.h"

#include <atomic>

namespace errmap::data {
namespace {

std::string NameOfMember(std::string_view member, std::string_view value) {
  std::string name(member);
  if (!value.empty()) name.append(" = ").append(value);
  return name;
}

std::atomic<std::string (*)(std::string_view, std::string_view)>
    name_of_argument = NameOfMember;

}  // namespace

std::string ArgumentName(std::string_view member, std::string_view value) {
  return name_of_argument.load()(member, value);
}

void NameArgumentsBy(std::string (*name_of)(std::string_view,
                                            std::string_view)) {
  name_of_argument = name_of == nullptr ? NameOfMember : name_of;
}

}  // namespace errmap::data
