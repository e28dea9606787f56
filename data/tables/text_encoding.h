#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace errmap::data {

/// The text of a file that is UTF-16, by its byte order mark or by the NULs of
/// its first characters, as UTF-8; "" where it is none. `name` stands for the
/// file in messages.
///
/// Throws InputError where the file is no text but what people take for a table
/// (a spreadsheet, an archive, a page), with what to do; or UTF-16 that breaks
/// off.
std::string TextOfFile(std::string_view bytes, const std::string& name);

/// Appends a character by its number, at most 10FFFF in hexadecimal.
void AppendUtf8(std::uint32_t code, std::string* text);

}  // namespace errmap::data
