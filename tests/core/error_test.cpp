// SPDX-License-Identifier: MIT
// The words people read when something goes wrong, to the letter.
#include <gtest/gtest.h>

#include <strut/core/error.h>

namespace strut {
namespace {

TEST(ParseError, NamesFileLineColumnExpectedAndFound) {
  const ParseError error("walk.bvh", 214, 7, "a number", "'abc'", "use a point");
  EXPECT_STREQ(error.what(), "walk.bvh:214:7: error: expected a number, found 'abc'");
  EXPECT_EQ(error.path(), "walk.bvh");
  EXPECT_EQ(error.line(), 214U);
  EXPECT_EQ(error.column(), 7U);
  EXPECT_EQ(error.expected(), "a number");
  EXPECT_EQ(error.found(), "'abc'");
  EXPECT_EQ(error.hint(), "use a point");
}

TEST(ParseError, LeavesOutAnUnknownPlace) {
  EXPECT_STREQ(ParseError("a.bvh", 3, 0, "x", "y").what(), "a.bvh:3: error: expected x, found y");
  EXPECT_STREQ(ParseError("a.bvh", 0, 0, "x", "y").what(), "a.bvh: error: expected x, found y");
  EXPECT_STREQ(ParseError("a.bvh", 0, 5, "x", "y").what(), "a.bvh: error: expected x, found y");
}

TEST(FileError, NamesThePathAndTheReason) {
  const FileError error(FileAction::kRead, "no/such.bvh", "cannot open: No such file or directory");
  EXPECT_STREQ(error.what(), "no/such.bvh: error: cannot open: No such file or directory");
  EXPECT_EQ(error.action(), FileAction::kRead);
  EXPECT_EQ(error.path(), "no/such.bvh");
  EXPECT_EQ(error.hint(), "");
}

TEST(VersionError, SaysWhichSideIsTooOld) {
  const VersionError newer("limp.strut", 3, 2);
  EXPECT_STREQ(newer.what(), "limp.strut: error: the file has format version 3, this strut reads version 2");
  EXPECT_EQ(newer.hint(), "use a newer strut");
  EXPECT_EQ(VersionError("limp.strut", 1, 2).hint(), "learn the model again with this strut");
}

TEST(InvalidArgument, NamesTheArgumentWhatWasExpectedAndWhatCame) {
  const InvalidArgument error("slope_limit", "a number of at least 1", "0", "leave it out for 2");
  EXPECT_STREQ(error.what(), "slope_limit: expected a number of at least 1, got 0");
  EXPECT_EQ(error.argument(), "slope_limit");
  EXPECT_EQ(error.hint(), "leave it out for 2");
}

TEST(InvalidArgument, OfOneOfSeveralNamesItFirst) {
  const InvalidArgument error("clip 3", InvalidArgument("output", "a frame", "none", "record it again"));
  EXPECT_STREQ(error.what(), "clip 3: output: expected a frame, got none");
  EXPECT_EQ(error.argument(), "output");
  EXPECT_EQ(error.hint(), "record it again");
}

TEST(NumericalError, GivesValueAndBound) {
  EXPECT_STREQ(NumericalError("n4sid", "the condition number", 1e12, 1e10).what(),
               "n4sid: the condition number is 1e+12, beyond its bound of 1e+10");
}

TEST(Error, IsWhatEveryOtherErrorIs) {
  EXPECT_THROW(throw ParseError("a", 1, 1, "x", "y"), Error);
  EXPECT_THROW(throw FileError(FileAction::kWrite, "a", "b"), Error);
  EXPECT_THROW(throw VersionError("a", 1, 2), Error);
  EXPECT_THROW(throw InvalidArgument("a", "x", "y"), Error);
  EXPECT_THROW(throw SkeletonMismatch("missing 'Hips'"), Error);
  EXPECT_THROW(throw NumericalError("a", "b", 1, 2), Error);
}

}  // namespace
}  // namespace strut
