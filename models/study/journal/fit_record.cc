#include <array>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "data/input_error.h"
#include "data/sha256.h"
#include "models/blend/form_to_model.h"
#include "models/history/history.h"
#include "models/map_experience.h"
#include "models/members.h"
#include "models/regression_record.h"
#include "models/study/journal/kept_fits.h"

namespace errmap::models {

namespace {

template <typename T>
concept Plain = std::is_arithmetic_v<T> || std::is_enum_v<T>;

[[noreturn]] void Refuse(const char* why) {
  throw data::InputError(fmt::format("record of a fit: {}", why));
}

// Bytes of every member, one after another: overloads for every type of member,
// in a class so that they see one another.
class Writer {
 public:
  const std::string& bytes() const { return bytes_; }

  template <Plain T>
  void Put(T value) {
    PutBytes(&value, sizeof value);
  }

  void Put(const std::string& text) {
    Put(text.size());
    PutBytes(text.data(), text.size());
  }

  template <typename Scalar, int kRows, int kColumns>
  void Put(const Eigen::Matrix<Scalar, kRows, kColumns>& matrix) {
    Put(matrix.rows());
    Put(matrix.cols());
    PutBytes(matrix.data(),
             static_cast<std::size_t>(matrix.size()) * sizeof(Scalar));
  }

  template <typename T>
  void Put(const std::vector<T>& list) {
    Put(list.size());
    for (const T& element : list) Put(element);
  }

  template <typename T, std::size_t kSize>
  void Put(const std::array<T, kSize>& values) {
    for (const T& value : values) Put(value);
  }

  template <typename T>
  void Put(const std::optional<T>& value) {
    Put(value.has_value());
    if (value) Put(*value);
  }

  template <typename A, typename B>
  void Put(const std::pair<A, B>& pair) {
    Put(pair.first);
    Put(pair.second);
  }

  template <typename... T>
  void Put(const std::variant<T...>& value) {
    Put(value.index());
    std::visit([this](const auto& held) { Put(held); }, value);
  }

  template <typename T>
  void Put(const std::shared_ptr<const T>& value) {
    Put(value != nullptr);
    if (value != nullptr) Put(*value);
  }

  void Put(const ErrorModel& model) {
    Put(model.num_parameters());
    Put(model.Describe());
  }

  template <Record T>
  void Put(const T& record) {
    members::Apply([this](const auto&... member) { (Put(member), ...); },
                   MembersOf(record));
  }

 private:
  void PutBytes(const void* from, std::size_t size) {
    bytes_.append(static_cast<const char*>(from), size);
  }

  std::string bytes_;
};

// The same the other way. What is no such record asks for no more memory than
// it has bytes.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}

  void RequireEnd() const {
    if (!rest_.empty()) Refuse("another layout");
  }

  template <Plain T>
  void Get(T* value) {
    GetBytes(value, sizeof *value);
  }

  void Get(bool* value) {
    std::uint8_t byte = 0;
    Get(&byte);
    *value = byte != 0;
  }

  void Get(std::string* text) {
    text->resize(GetCount());
    GetBytes(text->data(), text->size());
  }

  template <typename Scalar, int kRows, int kColumns>
  void Get(Eigen::Matrix<Scalar, kRows, kColumns>* matrix) {
    Index rows = 0;
    Index columns = 0;
    Get(&rows);
    Get(&columns);
    const auto most = static_cast<Index>(rest_.size() / sizeof(Scalar));
    if (rows < 0 || columns < 0 || (columns > 0 && rows > most / columns) ||
        (kColumns == 1 && columns != 1)) {
      Refuse("a matrix of another shape");
    }
    matrix->resize(rows, columns);
    GetBytes(matrix->data(),
             static_cast<std::size_t>(matrix->size()) * sizeof(Scalar));
  }

  template <typename T>
  void Get(std::vector<T>* list) {
    const std::size_t size = GetCount();
    for (std::size_t i = 0; i < size; ++i) Get(&list->emplace_back());
  }

  template <typename T, std::size_t kSize>
  void Get(std::array<T, kSize>* values) {
    for (T& value : *values) Get(&value);
  }

  template <typename T>
  void Get(std::optional<T>* value) {
    bool is_there = false;
    Get(&is_there);
    if (!is_there) return;
    T read{};
    Get(&read);
    *value = std::move(read);
  }

  template <typename A, typename B>
  void Get(std::pair<A, B>* pair) {
    Get(&pair->first);
    Get(&pair->second);
  }

  template <typename... T>
  void Get(std::variant<T...>* value) {
    std::size_t index = 0;
    Get(&index);
    if (index >= sizeof...(T)) Refuse("an unknown kind of value");
    GetAlternative(index, value, std::index_sequence_for<T...>());
  }

  template <typename T>
  void Get(std::shared_ptr<const T>* value) {
    bool is_there = false;
    Get(&is_there);
    if (!is_there) return;
    if constexpr (std::same_as<T, ErrorModel>) {
      Index parameters = 0;
      ModelDescription description;
      Get(&parameters);
      Get(&description);
      *value = ModelOfForm(std::move(description), parameters);
    } else {
      auto read = std::make_shared<T>();
      Get(read.get());
      *value = std::move(read);
    }
  }

  template <Record T>
  void Get(T* record) {
    members::Apply([this](auto&... member) { (Get(&member), ...); },
                   MembersOf(*record));
  }

 private:
  void GetBytes(void* to, std::size_t size) {
    if (size > rest_.size()) Refuse("cut off");
    if (size > 0) std::memcpy(to, rest_.data(), size);
    rest_.remove_prefix(size);
  }

  // Of elements, each of which takes a byte at least.
  std::size_t GetCount() {
    std::size_t count = 0;
    Get(&count);
    if (count > rest_.size()) Refuse("cut off");
    return count;
  }

  template <typename Variant, std::size_t... I>
  void GetAlternative(std::size_t index,
                      Variant* value,
                      std::index_sequence<I...> /*all*/) {
    (void)((index == I && (Get(&value->template emplace<I>()), true)) || ...);
  }

  std::string_view rest_;
};

std::string SumOf(std::string_view key, std::string_view bytes) {
  data::Sha256Stream stream;
  stream.Add(key);
  stream.Add(bytes);
  return stream.Finish();
}

}  // namespace

std::string FitToBytes(std::string_view key, const FitOutcome& outcome) {
  Writer writer;
  writer.Put(outcome);
  return SumOf(key, writer.bytes()) + writer.bytes();
}

FitOutcome FitFromBytes(std::string_view key, std::string_view bytes) {
  constexpr std::size_t kSum = 32;
  if (bytes.size() < kSum) Refuse("cut off");
  const std::string_view rest = bytes.substr(kSum);
  if (SumOf(key, rest) != bytes.substr(0, kSum)) Refuse("damaged");
  FitOutcome outcome;
  try {
    Reader reader(rest);
    reader.Get(&outcome);
    reader.RequireEnd();
  } catch (const std::logic_error& error) {  // of a model
    Refuse(error.what());
  }
  return outcome;
}

}  // namespace errmap::models
