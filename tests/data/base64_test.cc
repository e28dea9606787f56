#include "data/base64.h"

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace errmap::data {
namespace {

TEST(Base64, HasTheTestVectorsOfRfc4648) {
  const std::vector<std::pair<std::string, std::string>> vectors = {
      {"", ""},
      {"f", "Zg=="},
      {"fo", "Zm8="},
      {"foo", "Zm9v"},
      {"foob", "Zm9vYg=="},
      {"fooba", "Zm9vYmE="},
      {"foobar", "Zm9vYmFy"},
      {std::string("\0\xff\xfe", 3), "AP/+"}};
  for (const auto& [bytes, text] : vectors) {
    EXPECT_EQ(ToBase64(bytes), text);
    EXPECT_EQ(FromBase64(text), bytes);
  }
}

TEST(Base64, BringsBackWhatIsLongerThanAPiece) {
  for (const std::size_t more : {0U, 1U, 2U, 3U}) {
    std::string bytes((std::size_t{3} << 20U) + more, 'x');
    for (std::size_t i = 0; i < bytes.size(); i += 7) {
      bytes[i] = static_cast<char>(i);
    }
    EXPECT_TRUE(FromBase64(ToBase64(bytes)) == bytes) << more;
  }
}

TEST(Base64, RefusesWhatItDidNotWrite) {
  for (const char* text : {"Z",
                           "Zg",
                           "Zg=",
                           "Zg===",
                           "====",
                           "Z===",
                           "Zg==Zg==",
                           " Zg=",
                           "Zm9v\n",
                           "Zm-_",
                           "Zm9\x80"}) {
    EXPECT_THROW(FromBase64(text), std::invalid_argument) << text;
  }
}

}  // namespace
}  // namespace errmap::data
