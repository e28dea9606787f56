#pragma once

#include <string>
#include <string_view>

namespace errmap::data {

/// Returns the name of an argument in messages, such as of a member of
/// DatasetSelection. By default it is "keep_dead", or with a value "exclude =
/// t3".
std::string ArgumentName(std::string_view member, std::string_view value = "");

/// Sets other names of arguments for a program, such as the flags of a command
/// line. Call it once, before any other function. Null: the default names.
void NameArgumentsBy(std::string (*name_of)(std::string_view member,
                                            std::string_view value));

}  // namespace errmap::data
