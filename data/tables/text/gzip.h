#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace errmap::data {

/// True if the bytes begin like a gzip file.
bool IsGzip(std::string_view bytes);

/// Compresses as `gzip` does, without a name or a time: the same text gives the
/// same bytes.
std::string Gzip(std::string_view text);

/// Unpacks gzip data, also if it has several members one after another (RFC
/// 1952). Throws InputError if the bytes are not gzip, are cut off, or hold
/// more than `most` bytes.
std::string Gunzip(std::string_view compressed, std::size_t most);

/// Returns the largest content accepted for this many packed bytes of a table:
/// a hundred times as many plus 64 MiB. Measurements pack to about a tenth; a
/// larger content is an attempt to exhaust memory.
std::size_t MostUnpacked(std::size_t packed);

}  // namespace errmap::data
