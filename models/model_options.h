#pragma once

#include <string>
#include <string_view>

namespace errmap::models {

// Each family of models has a type of options, an aggregate that is filled by
// designated initialisers and makes a recipe: MakeRecipe(NetOptions{.hidden =
// 12, .wfactor = 1e-4}). What may be said of them in a SPEC is listed once,
// beside the family (option_list.h).

/// The options of a SPEC such as "net:scg:hidden=60". Throws
/// std::invalid_argument where it is of another family, or naming the option,
/// its value and what it may be.
template <typename Options>
Options OptionsOf(std::string_view spec);

/// The SPEC of these options, without those that are the default of its model:
/// OptionsOf<Options>(SpecOf(options)) == options.
template <typename Options>
std::string SpecOf(const Options& options);

}  // namespace errmap::models
