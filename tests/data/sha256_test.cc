#include "data/sha256.h"

#include <string>

#include <gtest/gtest.h>

namespace errmap::data {
namespace {

// FIPS 180-4 examples (NIST, "SHA256.pdf"), and the digest of nothing.
constexpr const char* kOfAbc =
    "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
constexpr const char* kOfTwoBlocks =
    "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1";
constexpr const char* kOfNothing =
    "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";

TEST(Sha256, GivesThePublishedDigests) {
  EXPECT_EQ(Sha256("abc"), kOfAbc);
  EXPECT_EQ(Sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            kOfTwoBlocks);
  EXPECT_EQ(Sha256(""), kOfNothing);
}

TEST(Sha256, GivesOfPiecesTheDigestOfTheWhole) {
  Sha256Stream stream;
  stream.Add("a");
  stream.Add("");
  stream.Add("bc");
  EXPECT_EQ(Hexadecimal(stream.Finish()), kOfAbc);
}

TEST(Sha256, BeginsAnewAfterADigest) {
  Sha256Stream stream;
  stream.Add("something else");
  EXPECT_NE(Hexadecimal(stream.Finish()), kOfAbc);
  stream.Add("abc");
  EXPECT_EQ(Hexadecimal(stream.Finish()), kOfAbc);
  EXPECT_EQ(Hexadecimal(stream.Finish()), kOfNothing);
}

TEST(Hexadecimal, WritesEveryByteWithTwoDigits) {
  EXPECT_EQ(Hexadecimal(std::string("\x00\x0f\xa5\xff", 4)), "000fa5ff");
  EXPECT_EQ(Hexadecimal(""), "");
}

}  // namespace
}  // namespace errmap::data
