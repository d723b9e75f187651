// SPDX-License-Identifier: MIT
#include "small_gaits.h"
#include "support/data.h"

#include <random>

#include <gtest/gtest.h>

#include <strut/blend/gait_model_io.h>
#include <strut/core/error.h>

namespace strut::blend {
namespace {

using test::small_gaits;

TEST(GaitModelFile, ComesBackAsItWas) {
  const test::TemporaryFolder folder;
  write_gait_model(folder.file("m.strutgait"), *small_gaits().model);
  const auto read = read_gait_model(folder.file("m.strutgait"));
  const Eigen::Vector3d mixture(0.2, 0.5, 0.3);
  EXPECT_EQ(read->loop(mixture, 1.0).series(), small_gaits().model->loop(mixture, 1.0).series());
  EXPECT_EQ(read->styles()[1].name, "crouch");
  EXPECT_EQ(read->frame_rate(), small_gaits().model->frame_rate());
  EXPECT_EQ(format_gait_model(*read), format_gait_model(*small_gaits().model));
}

TEST(GaitModelFile, RefusesOtherFilesAndTruncatedOnes) {
  const std::string bytes = format_gait_model(*small_gaits().model);
  EXPECT_THROW(parse_gait_model("", "x"), ParseError);
  EXPECT_THROW(parse_gait_model("HIERARCHY", "x"), ParseError);
  for (std::size_t size = 0; size < bytes.size(); size += 1 + bytes.size() / 50) {
    EXPECT_THROW(parse_gait_model(bytes.substr(0, size), "x"), ParseError);
  }
}

TEST(GaitModelFile, NeverCrashesOnDamagedBytes) {
  const std::string bytes = format_gait_model(*small_gaits().model);
  std::mt19937 engine(7);
  int refused = 0;
  for (int round = 0; round < 400; ++round) {
    std::string spoilt = bytes;
    // Mostly where the structure is: at the end the tables, at the beginning what was written last.
    const std::size_t place = engine() % (round % 2 == 0 ? bytes.size() : 600);
    spoilt[place] = static_cast<char>(engine());
    try {
      EXPECT_NE(parse_gait_model(spoilt, "x"), nullptr);
    } catch (const Error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 20);
}

}  // namespace
}  // namespace strut::blend
