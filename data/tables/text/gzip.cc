#include "data/tables/text/gzip.h"

#include <algorithm>
#include <array>
#include <limits>
#include <new>
#include <zlib.h>

#include "data/input_error.h"

namespace errmap::data {
namespace {

constexpr int kGzipWindow = 15 + 16;  // zlib's word for gzip's own header

// zlib reads through a pointer that it does not declare const, and counts in
// unsigned int.
void Feed(std::string_view* rest, z_stream* stream) {
  const std::size_t count =
      std::min<std::size_t>(rest->size(), std::numeric_limits<unsigned>::max());
  stream->next_in = reinterpret_cast<Bytef*>(const_cast<char*>(rest->data()));
  stream->avail_in = static_cast<unsigned>(count);
  rest->remove_prefix(count);
}

}  // namespace

bool IsGzip(std::string_view bytes) { return bytes.starts_with("\x1F\x8B"); }

std::string Gzip(std::string_view text) {
  z_stream stream{};
  constexpr int kMemory = 9;
  if (deflateInit2(&stream,
                   Z_BEST_COMPRESSION,
                   Z_DEFLATED,
                   kGzipWindow,
                   kMemory,
                   Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::bad_alloc();
  }
  std::string compressed;
  std::array<char, 1U << 16U> buffer{};
  int state = Z_OK;
  while (state != Z_STREAM_END) {
    if (stream.avail_in == 0) Feed(&text, &stream);
    stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
    stream.avail_out = static_cast<unsigned>(buffer.size());
    state = deflate(&stream, text.empty() ? Z_FINISH : Z_NO_FLUSH);
    compressed.append(buffer.data(), buffer.size() - stream.avail_out);
  }
  deflateEnd(&stream);
  return compressed;
}

std::size_t MostUnpacked(std::size_t packed) {
  constexpr std::size_t kAlways = std::size_t{64} << 20U;
  constexpr std::size_t kTimes = 100;
  return kAlways + kTimes * packed;
}

std::string Gunzip(std::string_view compressed, std::size_t most) {
  z_stream stream{};
  if (inflateInit2(&stream, kGzipWindow) != Z_OK) throw std::bad_alloc();
  std::string text;
  std::array<char, 1U << 16U> buffer{};
  int state = Z_OK;
  while (state == Z_OK && text.size() <= most) {
    if (stream.avail_in == 0) Feed(&compressed, &stream);
    stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
    stream.avail_out = static_cast<unsigned>(buffer.size());
    state = inflate(&stream, Z_NO_FLUSH);
    text.append(buffer.data(), buffer.size() - stream.avail_out);
    if (state != Z_STREAM_END) continue;
    // Another member, or zeros up to the end of a block.
    std::string_view rest(compressed.data() - stream.avail_in,
                          compressed.size() + stream.avail_in);
    rest.remove_prefix(std::min(rest.find_first_not_of('\0'), rest.size()));
    if (rest.empty()) break;
    stream.avail_in = 0;
    compressed = rest;
    state = inflateReset(&stream);
  }
  inflateEnd(&stream);
  if (text.size() > most) throw InputError("is too long when unpacked");
  if (state != Z_STREAM_END) {
    throw InputError("is not gzip, or is cut off");
  }
  return text;
}

}  // namespace errmap::data
