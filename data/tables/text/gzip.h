#pragma once

#include <cstddef>
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

/// What so many packed bytes of a table hold at most: a hundred times as many
/// beside 64 MiB. Measurements pack to a tenth or so; what holds more was made
/// to fill the memory.
std::size_t MostUnpacked(std::size_t packed);

}  // namespace errmap::data
