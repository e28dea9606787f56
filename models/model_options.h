#pragma once

#include <string>
#include <string_view>

namespace errmap::models {

// Each family of models has an options type: an aggregate, set by designated
// initialisers, that makes a recipe: MakeRecipe(NetOptions{.hidden = 12,
// .wfactor = 1e-4}). The options allowed in a SPEC are listed once, next to the
// family (option_list.h).

/// Returns the options in a SPEC such as "net:scg:hidden=60". Throws
/// std::invalid_argument if the SPEC is of another family. For a wrong option
/// it names the option, its value and the allowed values.
template <typename Options>
Options OptionsOf(std::string_view spec);

/// Returns the SPEC of these options, without those that have their default:
/// OptionsOf<Options>(SpecOf(options)) == options.
template <typename Options>
std::string SpecOf(const Options& options);

}  // namespace errmap::models
