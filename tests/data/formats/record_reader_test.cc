#include "data/formats/record_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/input_error.h"

namespace errmap::data {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(RecordReader, ReadsNumbersAsListDirectedInputDoes) {
  RecordReader reader("1, 2.5\n\n  3.0d-3 2*0.5 ! a comment\n7\n", "f");
  EXPECT_THAT(reader.Numbers(5, "numbers"),
              ElementsAre(1.0, 2.5, 3e-3, 0.5, 0.5));
  EXPECT_EQ(reader.line(), 3U);
  EXPECT_THAT(reader.Integers(1, "one"), ElementsAre(7));
  EXPECT_TRUE(reader.AtEnd());
}

TEST(RecordReader, ReadsTextsInAndWithoutQuotes) {
  RecordReader reader("'it''s a title' rest\r\n no quotes here \r\nrun.out x\n",
                      "f");
  EXPECT_EQ(reader.Text("a title"), "it's a title");
  EXPECT_EQ(reader.Text("a title"), "no quotes here");
  EXPECT_THAT(reader.Words(1, "a name"), ElementsAre("run.out"));
}

void ExpectRefusalInRecordReader(const std::string& text,
                                 std::size_t count,
                                 const std::string& message) {
  RecordReader reader(text, "netcg.in");
  EXPECT_THAT([&] { reader.Numbers(count, "3 numbers"); },
              ThrowsMessage<InputError>(HasSubstr(message)));
}

TEST(RecordReader, NamesLineExpectedAndFound) {
  ExpectRefusalInRecordReader("\n1 2 x\n",
                              3,
                              "netcg.in: line 2: expected 3 numbers, found "
                              "'x'");
  ExpectRefusalInRecordReader(
      "1 2\n", 3, "line 2: expected 3 numbers from line 1 on, but the file");
  ExpectRefusalInRecordReader(
      "1 2 3 4\n", 3, "line 1: expected 3 numbers, found one more");
  ExpectRefusalInRecordReader("1 3*2\n", 3, "found more: '3*2'");
  ExpectRefusalInRecordReader("1 1e999 3\n", 3, "found '1e999'");
  ExpectRefusalInRecordReader(
      std::string(1 << 20, '\xff'), 3, "line 1: expected 3 numbers");
  RecordReader reader("1.5", "f");
  EXPECT_THAT([&] { reader.Integers(1, "a count"); },
              ThrowsMessage<InputError>(HasSubstr("not whole")));
  RecordReader open("'never closed\n", "f");
  EXPECT_THAT([&] { open.Text("a title"); },
              ThrowsMessage<InputError>(HasSubstr("not closed")));
}

}  // namespace
}  // namespace errmap::data
