#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace errmap::cli {

/// An option that takes one of `words`; `choose` is told which.
void AddWordOption(CLI::App* command,
                   const std::string& flag,
                   const std::string& what,
                   const std::vector<std::string>& words,
                   const std::string& usual,
                   std::function<void(std::size_t)> choose);

/// An option of words, each of which stands for a value that ToString names.
template <typename Value>
void AddChoice(CLI::App* command,
               const std::string& flag,
               const std::string& what,
               const std::vector<Value>& values,
               Value* chosen) {
  std::vector<std::string> words;
  for (const Value value : values) words.emplace_back(ToString(value));
  AddWordOption(command,
                flag,
                what,
                words,
                std::string(ToString(*chosen)),
                [values, chosen](std::size_t i) { *chosen = values[i]; });
}

}  // namespace errmap::cli
