// Gives every reader its kept corpus, and each text of it with bytes changed,
// cut and doubled by a fixed seed: what a fuzzer found stays found without one.
//
//   fuzz_replay CORPUS_FOLDER [CHANGES_PER_FILE]

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>

#include "tests/fuzz/readers.h"

namespace {

namespace fs = std::filesystem;

std::string Changed(std::string text, std::mt19937_64* random) {
  static const std::string kMarks = "\",;:{}[]()=\n\r\t .-+eE0\xff\x1b";
  const auto below = [&](std::size_t n) {
    return static_cast<std::size_t>((*random)() % n);
  };
  for (std::size_t change = 1 + below(4); change > 0; --change) {
    const std::size_t at = below(text.size() + 1);
    const std::size_t length = std::min(below(16), text.size() - at);
    switch (below(5)) {
      case 0:
        text.erase(at, length);
        break;
      case 1:
        text.insert(at, text.substr(at, length));
        break;
      case 2:
        text.insert(at, 1, kMarks[below(kMarks.size())]);
        break;
      case 3:
        if (at < text.size()) text[at] = static_cast<char>(below(256));
        break;
      default:
        text.replace(at, length, std::to_string((*random)()));
        break;
    }
  }
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  const long changes = argc > 2 ? std::atol(argv[2]) : 100;
  int without = 0;
  for (const errmap::fuzz::Reader& reader : errmap::fuzz::Readers()) {
    const fs::path folder = fs::path(argv[1]) / reader.name;
    long texts = 0;
    if (fs::is_directory(folder)) {
      for (const auto& entry : fs::directory_iterator(folder)) {
        std::ifstream stream(entry.path(), std::ios::binary);
        std::ostringstream text;
        text << stream.rdbuf();
        reader.read(text.str());
        std::mt19937_64 random(1995);
        for (long i = 0; i < changes; ++i) {
          reader.read(Changed(text.str(), &random));
        }
        texts += 1 + changes;
      }
    }
    std::printf("%s: %ld texts\n", reader.name, texts);
    without += texts == 0 ? 1 : 0;
  }
  return without;  // a reader without a corpus
}
