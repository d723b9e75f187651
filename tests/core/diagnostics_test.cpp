// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <strut/core/diagnostics.h>

namespace strut {
namespace {

TEST(Diagnostics, KeepsReportsInTheirOrder) {
  Diagnostics first;
  first.note("walk.bvh", "lengths read as centimetres", "--unit overrides");
  Diagnostics second;
  second.warn("walk.bvh:9", "a row is cut off");
  first.append(second);
  ASSERT_EQ(first.entries().size(), 2U);
  EXPECT_EQ(first.entries()[0].severity, Severity::kNote);
  EXPECT_EQ(first.entries()[0].where, "walk.bvh");
  EXPECT_EQ(first.entries()[0].message, "lengths read as centimetres");
  EXPECT_EQ(first.entries()[0].hint, "--unit overrides");
  EXPECT_EQ(first.entries()[1].severity, Severity::kWarning);
  EXPECT_EQ(first.entries()[1].where, "walk.bvh:9");
  EXPECT_EQ(first.entries()[1].hint, "");
}

}  // namespace
}  // namespace strut
