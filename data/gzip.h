#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace errmap::data {

/// Whether the bytes begin as those of gzip do.
bool IsGzip(std::string_view bytes);

/// As `gzip` writes it, without a name or a time: the same text gives the same
/// bytes.
std::string Gzip(std::string_view text);

/// Its inverse. Throws InputError where it is no gzip, is cut off, or
/// holds more than `most` bytes.
std::string Gunzip(std::string_view compressed, std::size_t most);

/// Of a deflated stream without a header (RFC 1951). Throws as Gunzip does.
std::string Inflate(std::string_view compressed, std::size_t most);

/// The sum that gzip and zip check a content by.
std::uint32_t Crc32(std::string_view bytes);

}  // namespace errmap::data
