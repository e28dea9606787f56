#pragma once

#include <string>
#include <string_view>

namespace errmap::data {

/// What a message calls an argument, such as a member of DatasetSelection, that
/// its reader may want to change: by default "keep_dead", and "exclude = t3"
/// with a value.
std::string ArgumentName(std::string_view member, std::string_view value = "");

/// For a program whose users know arguments by other names, such as the flags
/// of a command line; called once, before all else. Null: those by default.
void NameArgumentsBy(std::string (*name_of)(std::string_view member,
                                            std::string_view value));

}  // namespace errmap::data
