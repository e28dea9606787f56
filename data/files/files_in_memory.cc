#include "data/files_in_memory.h"

#include <utility>
#include <vector>

#include "data/files/atomic_file.h"
#include "data/sha256.h"

namespace errmap::data {
namespace {

thread_local const FilesInMemory* innermost = nullptr;

template <typename Value>
void AddBytes(const Value* values, std::size_t size, Sha256Stream* stream) {
  stream->Add(
      {reinterpret_cast<const char*>(values), size * sizeof(Value)});  // NOLINT
}

std::string Sha256OfTable(const CsvTable& table) {
  constexpr std::size_t kAtOnce = 4096;
  Sha256Stream stream;
  std::vector<double> some;
  for (const CsvColumn& column : table.columns) {
    stream.Add(column.name);
    stream.Add("\n");
    for (const double value : column.values) {
      some.push_back(value);
      if (some.size() < kAtOnce) continue;
      AddBytes(some.data(), some.size(), &stream);
      some.clear();
    }
    AddBytes(some.data(), some.size(), &stream);
    some.clear();
    for (const auto& [row, text] : column.exceptions) {
      AddBytes(&row, 1, &stream);
      stream.Add(column.texts[text]);
      stream.Add("\n");
    }
  }
  return Hexadecimal(stream.Finish());
}

}  // namespace

FilesInMemory::FilesInMemory(Tables tables, Texts texts)
    : tables_(std::move(tables)), texts_(std::move(texts)), outer_(innermost) {
  innermost = this;
}

FilesInMemory::~FilesInMemory() { innermost = outer_; }

const CsvTable* FilesInMemory::FindTable(const std::string& name) {
  if (innermost == nullptr) return nullptr;
  const auto found = innermost->tables_.find(name);
  return found == innermost->tables_.end() ? nullptr : found->second.get();
}

const std::string* FilesInMemory::FindText(const std::string& name) {
  if (innermost == nullptr) return nullptr;
  const auto found = innermost->texts_.find(name);
  return found == innermost->texts_.end() ? nullptr : &found->second;
}

std::string Sha256OfFile(const std::string& path) {
  const CsvTable* const table = FilesInMemory::FindTable(path);
  return table != nullptr ? Sha256OfTable(*table) : Sha256(ReadFile(path));
}

}  // namespace errmap::data
