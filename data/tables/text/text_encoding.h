#pragma once

#include <string>
#include <string_view>

namespace errmap::data {

/// The text of a file in another encoding, as UTF-8.
struct EncodedText {
  std::string text;      // "": the file is UTF-8, or Latin-1
  std::string encoding;  // to be told; "" where the file itself says it
};

/// UTF-16 by its byte order mark or by the NULs of its first characters;
/// what is no UTF-8 by the encoding in which most words of its first lines are
/// ones that tables have (those of DOS, of eastern Europe, Cyrillic, Japanese,
/// Chinese, Korean). `name` stands for the file in messages.
///
/// Throws InputError where the file is no text but what people take for a table
/// (a spreadsheet, an archive, a page), with what to do; or where the text
/// breaks off.
EncodedText TextOfFile(std::string_view bytes, const std::string& name);

}  // namespace errmap::data
