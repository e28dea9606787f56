#include "models/study/journal/fit_record.h"

#include <concepts>
#include <cstdint>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "data/input_error.h"
#include "data/sha256.h"
#include "models/blend/form_to_model.h"
#include "models/history/history.h"
#include "models/map_experience.h"
#include "models/members.h"
#include "models/regression_record.h"

namespace errmap::models {

namespace {

[[noreturn]] void Refuse(const char* why) {
  throw data::InputError(fmt::format("record of a fit: {}", why));
}

// Every member of a record, one after another, to bytes or back from them. What
// is read and no such record asks for no more memory than it has bytes.
template <bool kReads>
class Archive {
 public:
  explicit Archive(std::string_view bytes) : rest_(bytes) {}

  const std::string& written() const { return written_; }
  void RequireEnd() const {
    if (!rest_.empty()) Refuse("another layout");
  }

  template <typename T>
  void Do(T& value) {
    using Held = std::remove_const_t<T>;
    if constexpr (std::same_as<Held, bool>) {
      auto byte = static_cast<std::uint8_t>(value);
      DoBytes(&byte, sizeof byte);
      if constexpr (kReads) value = byte != 0;
    } else if constexpr (std::is_arithmetic_v<Held> || std::is_enum_v<Held>) {
      DoBytes(&value, sizeof value);
    } else if constexpr (Record<Held>) {
      members::Apply([this](auto&... member) { (Do(member), ...); },
                     MembersOf(value));
    } else if constexpr (requires { value.array(); }) {
      DoMatrix(value);
    } else if constexpr (requires { value.has_value(); }) {
      DoOptional(value);
    } else if constexpr (requires { value.first; }) {
      Do(value.first);
      Do(value.second);
    } else if constexpr (requires { value.index(); }) {
      DoVariant(value, std::make_index_sequence<std::variant_size_v<Held>>());
    } else if constexpr (requires { value.use_count(); }) {
      DoPointer(value);
    } else if constexpr (std::same_as<Held, std::string>) {
      const std::size_t size = DoCount(value);
      if constexpr (kReads) value.resize(size);
      DoBytes(value.data(), size);
    } else if constexpr (requires { std::tuple_size<Held>::value; }) {
      for (auto& element : value) Do(element);
    } else {
      DoList(value);
    }
  }

 private:
  template <typename T>
  void DoBytes(T* data, std::size_t size) {
    if constexpr (kReads) {
      if (size > rest_.size()) Refuse("cut off");
      if (size > 0) std::memcpy(data, rest_.data(), size);
      rest_.remove_prefix(size);
    } else {
      const void* const from = data;
      written_.append(static_cast<const char*>(from), size);
    }
  }

  // Of elements, each of which takes a byte at least.
  std::size_t DoCount(const auto& held) {
    std::size_t count = held.size();
    Do(count);
    if (kReads && count > rest_.size()) Refuse("cut off");
    return count;
  }

  void DoList(auto& list) {
    const std::size_t count = DoCount(list);
    for (std::size_t i = 0; i < count; ++i) {
      if constexpr (kReads) list.emplace_back();
      Do(list[i]);
    }
  }

  template <typename Matrix>
  void DoMatrix(Matrix& matrix) {
    constexpr std::size_t kSize = sizeof(typename Matrix::Scalar);
    Index rows = matrix.rows();
    Index columns = matrix.cols();
    Do(rows);
    Do(columns);
    if constexpr (kReads) {
      const auto most = static_cast<Index>(rest_.size() / kSize);
      if (rows < 0 || columns < 0 || (columns > 0 && rows > most / columns) ||
          (Matrix::ColsAtCompileTime == 1 && columns != 1)) {
        Refuse("a matrix of another shape");
      }
      matrix.resize(rows, columns);
    }
    DoBytes(matrix.data(), static_cast<std::size_t>(matrix.size()) * kSize);
  }

  template <typename Optional>
  void DoOptional(Optional& value) {
    bool is_there = value.has_value();
    Do(is_there);
    if (!is_there) return;
    if constexpr (kReads) value = typename Optional::value_type{};
    Do(*value);
  }

  template <typename Variant, std::size_t... I>
  void DoVariant(Variant& value, std::index_sequence<I...> /*all*/) {
    std::size_t index = value.index();
    Do(index);
    if constexpr (kReads) {
      if (index >= sizeof...(I)) Refuse("an unknown kind of value");
      (void)((index == I && (value.template emplace<I>(), true)) || ...);
    }
    std::visit([this](auto& held) { Do(held); }, value);
  }

  template <typename Pointer>
  void DoPointer(Pointer& value) {
    using Held = std::remove_const_t<typename Pointer::element_type>;
    bool is_there = value != nullptr;
    Do(is_there);
    if (!is_there) return;
    if constexpr (std::same_as<Held, ErrorModel>) {
      Index parameters = kReads ? 0 : value->num_parameters();
      ModelDescription form;
      if constexpr (!kReads) form = value->Describe();
      Do(parameters);
      Do(form);
      if constexpr (kReads) value = ModelOfForm(std::move(form), parameters);
    } else if constexpr (kReads) {
      auto read = std::make_shared<Held>();
      Do(*read);
      value = std::move(read);
    } else {
      Do(*value);
    }
  }

  std::string_view rest_;
  std::string written_;
};

std::string SumOf(std::string_view key, std::string_view bytes) {
  data::Sha256Stream stream;
  stream.Add(key);
  stream.Add(bytes);
  return stream.Finish();
}

}  // namespace

std::string FitToBytes(std::string_view key, const FitOutcome& outcome) {
  Archive<false> archive("");
  archive.Do(outcome);
  return SumOf(key, archive.written()) + archive.written();
}

FitOutcome FitFromBytes(std::string_view key, std::string_view bytes) {
  constexpr std::size_t kSum = 32;
  if (bytes.size() < kSum) Refuse("cut off");
  const std::string_view rest = bytes.substr(kSum);
  if (SumOf(key, rest) != bytes.substr(0, kSum)) Refuse("damaged");
  FitOutcome outcome;
  try {
    Archive<true> archive(rest);
    archive.Do(outcome);
    archive.RequireEnd();
  } catch (const std::logic_error& error) {  // of a model
    Refuse(error.what());
  }
  return outcome;
}

}  // namespace errmap::models
