#pragma once

#include <string>
#include <string_view>

namespace errmap::data {

/// Returns the name of an argument, such as a member of DatasetSelection, as
/// messages show it. By default it is "keep_dead", and with a value "exclude =
/// t3".
std::string ArgumentName(std::string_view member, std::string_view value = "");

/// Sets the names of arguments for a program whose users know them by other
/// names, such as flags of a command line. Call it once, before anything else.
/// Null: the default names.
void NameArgumentsBy(std::string (*name_of)(std::string_view member,
                                            std::string_view value));

}  // namespace errmap::data
