#include "data/tables/text_encoding.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "data/input_error.h"
#include "data/text.h"

namespace errmap::data {
namespace {

struct KnownFormat {
  std::string_view start;
  std::string_view what;
};

// What files of other programs begin with.
constexpr auto kFormats = std::to_array<KnownFormat>(
    {{"PK\x03\x04",
      "an archive or a spreadsheet other than xlsx; save it as xlsx or CSV"},
     {"\xD0\xCF\x11\xE0",
      "a spreadsheet (xls, or with a password); save it as xlsx or CSV"},
     {"BZh", "compressed (bzip2); unpack it with bunzip2"},
     {"\xFD"
      "7zXZ",
      "compressed (xz); unpack it with unxz"},
     {"7z\xBC\xAF", "an archive (7z); unpack it"},
     {"%PDF-", "a PDF; export the table as CSV"},
     {"<!DOCTYPE", "a web page; save the table as CSV"},
     {"<html", "a web page; save the table as CSV"},
     {"<?xml", "XML; export the table as CSV"},
     {"CREATE TABLE", "SQL; export the table as CSV"},
     {"INSERT INTO", "SQL; export the table as CSV"},
     {"[{", "JSON; export the table as CSV"},
     {"{", "JSON, as maps and results are; measurements are CSV or xlsx"}});

enum class Order { kNone, kLittleEndian, kBigEndian };

// By the mark, else where every other byte of the first characters is NUL.
Order OrderOf(std::string_view bytes) {
  if (bytes.starts_with("\xFF\xFE")) return Order::kLittleEndian;
  if (bytes.starts_with("\xFE\xFF")) return Order::kBigEndian;
  constexpr std::size_t kLooked = 64;
  const std::size_t size = std::min(bytes.size(), kLooked) / 2 * 2;
  if (size < 4) return Order::kNone;
  std::array<std::size_t, 2> nuls{};
  for (std::size_t i = 0; i < size; ++i) nuls[i % 2] += bytes[i] == '\0';
  if (nuls[0] == 0 && nuls[1] == size / 2) return Order::kLittleEndian;
  if (nuls[1] == 0 && nuls[0] == size / 2) return Order::kBigEndian;
  return Order::kNone;
}

}  // namespace

void AppendUtf8(std::uint32_t code, std::string* text) {
  const auto put = [&](std::uint32_t byte) {
    *text += static_cast<char>(static_cast<unsigned char>(byte));
  };
  if (code < 0x80U) {
    put(code);
  } else if (code < 0x800U) {
    put(0xC0U | (code >> 6U));
    put(0x80U | (code & 0x3FU));
  } else if (code < 0x10000U) {
    put(0xE0U | (code >> 12U));
    put(0x80U | ((code >> 6U) & 0x3FU));
    put(0x80U | (code & 0x3FU));
  } else {
    put(0xF0U | (code >> 18U));
    put(0x80U | ((code >> 12U) & 0x3FU));
    put(0x80U | ((code >> 6U) & 0x3FU));
    put(0x80U | (code & 0x3FU));
  }
}

std::string TextOfFile(std::string_view bytes, const std::string& name) {
  for (const KnownFormat& format : kFormats) {
    if (StartsWithIgnoringCase(bytes, format.start)) {
      throw InputError(PrintablePath(name) + ": this is " +
                       std::string(format.what));
    }
  }
  const Order order = OrderOf(bytes);
  if (order == Order::kNone) return "";
  const auto unit_at = [&](std::size_t i) {
    const auto first = static_cast<unsigned char>(bytes[i]);
    const auto second = static_cast<unsigned char>(bytes[i + 1]);
    return order == Order::kLittleEndian
               ? static_cast<std::uint32_t>(first | (second << 8U))
               : static_cast<std::uint32_t>((first << 8U) | second);
  };
  std::string text;
  text.reserve(bytes.size() / 2);
  for (std::size_t i = 0; i < bytes.size(); i += 2) {
    const bool whole = i + 1 < bytes.size();
    std::uint32_t code = whole ? unit_at(i) : 0xD800U;
    if (code >= 0xD800U && code < 0xDC00U && i + 3 < bytes.size()) {
      const std::uint32_t low = unit_at(i + 2);
      if (low >= 0xDC00U && low < 0xE000U) {
        code = 0x10000U + ((code - 0xD800U) << 10U) + (low - 0xDC00U);
        i += 2;
      }
    }
    if (code >= 0xD800U && code < 0xE000U) {
      throw InputError(PrintablePath(name) +
                       ": UTF-16 that breaks off at byte " + std::to_string(i) +
                       "; save it as CSV in UTF-8");
    }
    if (i > 0 || code != 0xFEFFU) AppendUtf8(code, &text);
  }
  return text;
}

}  // namespace errmap::data
