#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace errmap::cli {

/// An option of words, each of which stands for a value that ToString names.
template <typename Value>
CLI::Option* AddChoice(CLI::App* command,
                       const std::string& flag,
                       const std::string& what,
                       std::initializer_list<Value> values,
                       Value* chosen) {
  std::vector<std::string> words;
  for (const Value value : values) words.emplace_back(ToString(value));
  const std::vector<Value> meant(values);
  return command
      ->add_option_function<std::string>(
          flag,
          [words, meant, chosen](const std::string& word) {
            *chosen = meant[static_cast<std::size_t>(
                std::ranges::find(words, word) - words.begin())];
          },
          what)
      ->check(CLI::IsMember(words))
      ->type_name(fmt::format("{}", fmt::join(words, "|")))
      ->default_str(std::string(ToString(*chosen)));
}

}  // namespace errmap::cli
