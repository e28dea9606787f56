#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "cli/json_blocks.h"

namespace errmap::cli {

/// Reading of documents that may be older, incomplete or of a failed run: what
/// is missing, null or of another type reads as nothing, and nothing throws.

/// The value at the end of a path of keys, or null.
const Json& At(const Json& json, std::initializer_list<std::string_view> path);
const Json& At(const Json& json, std::string_view key);
/// The element `index` of an array, or null.
const Json& At(const Json& json, std::size_t index);

/// NaN unless a finite number.
double NumberOf(const Json& json);
double NumberAt(const Json& json, std::string_view key);

/// "" unless a string; always valid UTF-8.
std::string TextOf(const Json& json);
std::string TextAt(const Json& json, std::string_view key);

/// False unless true.
bool IsTrue(const Json& json, std::string_view key);

/// The numbers of an array, NaN for what is none; empty unless an array.
std::vector<double> NumbersOf(const Json& json);
/// The strings of an array; empty unless an array.
std::vector<std::string> TextsOf(const Json& json);

/// The object of the array `list` whose `key` is `text`, or null.
const Json& Find(const Json& list, std::string_view key, std::string_view text);

}  // namespace errmap::cli
