// SPDX-License-Identifier: MIT
// Footskate cleanup as a stream: when what comes out, snapshots, memory, and what is refused.
#include "sliding_walk.h"
#include "support/allocations.h"

#include <limits>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/postprocess/footskate.h>

namespace strut::postprocess {
namespace {

TEST(FootskateCleaner, AStreamEqualsTheClipToTheBit) {
  const Sliding sliding(0.02, 30.0);
  FootskateCleaner cleaner(sliding.clip.shared_skeleton(), sliding.legs, 30.0);
  const Flags flags = flags_of(sliding.walk.footplants, sliding.clip.num_frames());
  EXPECT_TRUE(streamed(cleaner, sliding.clip, flags) == sliding.cleaned().frames());
}

TEST(FootskateCleaner, ComesAsLateAsItSays) {
  const Sliding sliding(0.0, 30.0);
  FootskateCleaner cleaner(sliding.clip.shared_skeleton(), sliding.legs, 30.0, {.look_ahead = 0.2});
  EXPECT_EQ(cleaner.look_ahead(), 6);
  Pose pose;
  for (int f = 0; f < 20; ++f) {
    ASSERT_EQ(cleaner.push(sliding.clip.frame(f), {false, false}, pose), f >= 6) << f;
    if (f >= 6) {
      EXPECT_TRUE(pose == sliding.clip.frame(f - 6));
    }
  }
  for (int f = 14; f < 20; ++f) {
    ASSERT_TRUE(cleaner.flush(pose));
    EXPECT_TRUE(pose == sliding.clip.frame(f));
  }
  EXPECT_FALSE(cleaner.flush(pose));
  EXPECT_FALSE(cleaner.flush(pose));
}

TEST(FootskateCleaner, GivesShortStreamsBackWhole) {
  const Sliding sliding(0.02, 30.0);
  for (const int length : {0, 1, 2, 5}) {
    const Motion clip = sliding.clip.slice(0, length);
    EXPECT_EQ(clean_footskate(clip, sliding.legs, always(length)).num_frames(), length);
  }
}

TEST(FootskateCleaner, BeginsAnewAfterResetAndAfterFlush) {
  const Sliding sliding(0.02, 30.0);
  const Flags flags = flags_of(sliding.walk.footplants, sliding.clip.num_frames());
  FootskateCleaner cleaner(sliding.clip.shared_skeleton(), sliding.legs, 30.0);
  const auto first = streamed(cleaner, sliding.clip, flags);
  EXPECT_TRUE(streamed(cleaner, sliding.clip, flags) == first);  // after flush
  Pose pose;
  for (int f = 40; f < 70; ++f) cleaner.push(sliding.clip.frame(f), flags[at(f)], pose);
  cleaner.reset();
  EXPECT_TRUE(streamed(cleaner, sliding.clip, flags) == first);
}

TEST(FootskateCleaner, ACopyGoesOnByItself) {
  const Sliding sliding(0.02, 30.0);
  const Flags flags = flags_of(sliding.walk.footplants, sliding.clip.num_frames());
  FootskateCleaner cleaner(sliding.clip.shared_skeleton(), sliding.legs, 30.0);
  Pose pose, expected;
  for (int f = 0; f < 60; ++f) cleaner.push(sliding.clip.frame(f), flags[at(f)], pose);
  FootskateCleaner copy = cleaner;
  for (int f = 0; f < 30; ++f) copy.push(sliding.clip.frame(f), {true, true}, pose);
  copy = cleaner;
  for (int f = 60; f < 90; ++f) {
    cleaner.push(sliding.clip.frame(f), flags[at(f)], expected);
    copy.push(sliding.clip.frame(f), flags[at(f)], pose);
    ASSERT_TRUE(pose == expected) << f;
  }
}

TEST(FootskateCleaner, AllocatesNothing) {
  const Sliding sliding(0.02, 30.0);
  const Flags flags = flags_of(sliding.walk.footplants, sliding.clip.num_frames());
  FootskateCleaner cleaner(sliding.clip.shared_skeleton(), sliding.legs, 30.0);
  Pose pose = sliding.clip.frame(0);
  const auto run = [&] {
    for (int f = 0; f < sliding.clip.num_frames(); ++f) cleaner.push(sliding.clip.frame(f), flags[at(f)], pose);
    while (cleaner.flush(pose)) {
    }
    cleaner.reset();
  };
  EXPECT_EQ(test::count_allocations(run), 0);
  EXPECT_GT(test::count_allocations([&] { const FootskateCleaner copy = cleaner; }), 0) << "the counter does not count";
}

TEST(FootskateCleaner, RefusesWhatItCannotWorkWith) {
  const Sliding sliding(0.0, 30.0);
  const auto skeleton = sliding.clip.shared_skeleton();
  EXPECT_THROW(FootskateCleaner(nullptr, sliding.legs, 30.0), InvalidArgument);
  for (const double rate : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), 1.0}) {
    EXPECT_THROW(FootskateCleaner(skeleton, sliding.legs, rate), InvalidArgument) << rate;
  }
  motion::Legs legs = sliding.legs;
  legs.right.knee = legs.left.knee;
  EXPECT_THROW(FootskateCleaner(skeleton, legs, 30.0), InvalidArgument);
  legs.right = motion::Leg{};
  EXPECT_THROW(FootskateCleaner(skeleton, legs, 30.0), InvalidArgument);
}

TEST(FootskateCleaner, RefusesOptionsOutOfRange) {
  const Sliding sliding(0.0, 30.0);
  for (const FootskateOptions& options : std::vector<FootskateOptions>{{.look_ahead = 0.05},
                                                                       {.look_ahead = 3.0},
                                                                       {.shortest_plant = -0.1},
                                                                       {.shortest_gap = 0.6},
                                                                       {.max_stretch = 0.2},
                                                                       {.reach = 1.1},
                                                                       {.body_follows = -1.0},
                                                                       {.max_drag = 0.0}}) {
    EXPECT_THROW(FootskateCleaner(sliding.clip.shared_skeleton(), sliding.legs, 30.0, options), InvalidArgument);
  }
}

}  // namespace
}  // namespace strut::postprocess
