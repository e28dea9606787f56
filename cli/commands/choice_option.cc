#include "cli/commands/choice_option.h"

#include <algorithm>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace errmap::cli {

void AddWordOption(CLI::App* command,
                   const std::string& flag,
                   const std::string& what,
                   const std::vector<std::string>& words,
                   const std::string& usual,
                   std::function<void(std::size_t)> choose) {
  command
      ->add_option_function<std::string>(
          flag,
          [words, choose = std::move(choose)](const std::string& word) {
            choose(static_cast<std::size_t>(std::ranges::find(words, word) -
                                            words.begin()));
          },
          what)
      ->check(CLI::IsMember(words))
      ->type_name(fmt::format("{}", fmt::join(words, "|")))
      ->default_str(usual);
}

}  // namespace errmap::cli
