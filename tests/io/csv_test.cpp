// SPDX-License-Identifier: MIT
// Tables of comma-separated values: what is read, where things stand, and what is refused.
#include "support/data.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/io/csv.h>

namespace strut::test {
namespace {

using testing::HasSubstr;

std::string refusal(const std::string& text) {
  try {
    parse_csv(text, "t.csv");
  } catch (const ParseError& error) {
    return error.what();
  }
  return "taken";
}

TEST(Csv, KnowsWhereEveryFieldStands) {
  const CsvTable table = parse_csv("\xEF\xBB\xBFname, value\r\n \"a, b\" ,2\r\nc,\r\n\r\n", "t.csv");
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.place_of("value"), 1U);
  EXPECT_EQ(table.header.fields[1].column, 7U);
  EXPECT_EQ(table.rows[0].fields[0].text, "a, b");
  EXPECT_EQ(table.rows[0].fields[0].column, 2U);
  EXPECT_EQ(table.rows[1].line, 3U);
  EXPECT_EQ(table.rows[1].fields[1].text, "");
  EXPECT_FALSE(table.find("other"));
}

TEST(Csv, ReadsBackWhatItWrites) {
  for (const std::string text : {"", "plain", "a,b", "says \"no\"", "\"", " blank ", "\xc3\xbc"}) {
    const CsvTable table = parse_csv("x,y\n" + csv_field(text) + ",1\n", "t.csv");
    EXPECT_EQ(table.rows.at(0).fields.at(0).text, text);
  }
}

TEST(Csv, SaysWhatIsWrongWhere) {
  EXPECT_EQ(refusal("x,y\n1,2\n"), "taken");
  EXPECT_THAT(refusal(""), HasSubstr("t.csv:1: error: expected a line of column names"));
  EXPECT_THAT(refusal("x,y\n1\n"), HasSubstr("t.csv:2: error: expected 2 fields, found 1"));
  EXPECT_THAT(refusal("x,y\n1,\"2\n"), HasSubstr("t.csv:2:3: error: expected a closing quote"));
  EXPECT_THAT(refusal("x,y\n\"1\" 2,3\n"), HasSubstr("t.csv:2:1: error: expected a field that ends with its quote"));
  EXPECT_THAT(refusal("x,y\n\n1,2\n"), HasSubstr("t.csv:2: error:")) << "a blank line in the middle";
  EXPECT_THROW((void)parse_csv("x,x\n1,2\n", "t.csv").find("x"), ParseError);
  EXPECT_THROW((void)parse_csv("x,y\n1,2\n", "t.csv").place_of("z"), ParseError);
}

TEST(Csv, NumbersAreFiniteAndWhole) {
  EXPECT_EQ(csv_number({"+1.5e1", 1}, 2, "t.csv"), 15.0);
  for (const char* text : {"", "nan", "inf", "1x", "0x10", "1,5", "1e999"}) {
    EXPECT_THROW((void)csv_number({text, 1}, 2, "t.csv"), ParseError) << text;
  }
}

}  // namespace
}  // namespace strut::test
