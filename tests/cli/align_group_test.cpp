// SPDX-License-Identifier: MIT
// strut align --groupwise: clips on a timeline that none of them sets.
#include "cli/align_clips.h"
#include "cli/csv_columns.h"
#include "support/data.h"
#include "support/program.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <strut/core/error.h>
#include <strut/core/file.h>
#include <strut/io/bvh.h>

namespace strut::test {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

constexpr double kPrinted = 1e-6;  // tables have six decimals
constexpr double kSummed = 2e-4;   // of a column's sum: its rows' roundings
constexpr double kRetimed = 0.02;  // shares of a duration: the timeline is re-timed by a curve through whole frames

class AlignGroup : public AlignClips {
 protected:
  void SetUp() override {
    clips_ = {clip("walk.bvh", 1.0, 3.0), clip("slow.bvh", 0.8, 3.0), clip("brisk.bvh", 1.2, 3.0)};
    std::filesystem::create_directory(folder_.file("there"));
    std::filesystem::create_directory(folder_.file("back"));
  }
  /// Aligns all three.
  ProgramResult group(const std::vector<std::string>& options = {}) {
    std::vector<std::string> all{"--groupwise"};
    all.insert(all.end(), clips_.begin(), clips_.end());
    all.insert(all.end(), options.begin(), options.end());
    return align(all);
  }
  std::vector<std::string> clips_;
};

TEST_F(AlignGroup, PutsEveryClipOnOneTimeline) {
  for (const char* method : {"continuous", "imw"}) {
    const ProgramResult result = group({"--method", method, "--csv", folder_.file("there"), "--json", "--force"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const Json told = Json::parse(result.out);
    EXPECT_EQ(told.at("method"), method);
    EXPECT_TRUE(told.at("converged")) << method;
    EXPECT_EQ(told.at("spread").size(), told.at("rounds").get<std::size_t>());
    const auto frames = told.at("timeline").at("frames").get<std::size_t>();
    std::vector<double> mean_share(frames, 0.0);
    for (std::size_t k = 0; k < clips_.size(); ++k) {
      const double clip_frames = read_bvh(clips_[k]).motion.num_frames();
      const Json& clip = told.at("clips").at(k);
      EXPECT_EQ(clip.at("path"), clips_[k]);
      const auto columns =
          columns_of(folder_.file("there/" + std::filesystem::path(clips_[k]).stem().string() + ".csv"));
      const std::vector<double>&place = columns.at("clip_frame"), &slope = columns.at("differential_warp");
      ASSERT_EQ(place.size(), frames);
      EXPECT_EQ(std::adjacent_find(place.begin(), place.end(), std::greater_equal<>()), place.end()) << method;
      EXPECT_NEAR(std::accumulate(slope.begin(), slope.end(), 0.0), clip_frames, kSummed);
      EXPECT_NEAR(clip.at("warp").at("most"), *std::max_element(slope.begin(), slope.end()), kPrinted);
      for (std::size_t t = 0; t < frames; ++t) mean_share[t] += (place[t] + 0.5) / clip_frames / 3.0;
    }
    // No clip sets the timing: at every moment the timeline is as far on as the clips are in the mean.
    for (std::size_t t = 0; t < frames; ++t) {
      EXPECT_NEAR(mean_share[t], (static_cast<double>(t) + 0.5) / static_cast<double>(frames), kRetimed) << t;
    }
  }
}

TEST_F(AlignGroup, BringsFootplantsTogether) {
  const Json told = Json::parse(group({"--json"}).out);
  EXPECT_GE(told.at("footplants").at("paired"), 12);
  EXPECT_EQ(told.at("footplants").at("unpaired"), 0);
  EXPECT_LT(told.at("footplants").at("mean_error_s"), 1.0 / 30.0);
}

TEST_F(AlignGroup, InvertsEveryWarp) {
  const ProgramResult result = group({"--csv", folder_.file("there"), "--inverse-csv", folder_.file("back")});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const char* name : {"walk", "slow", "brisk"}) {
    const auto there = columns_of(folder_.file(std::string("there/") + name + ".csv"));
    const auto back = columns_of(folder_.file(std::string("back/") + name + ".inverse.csv"));
    const std::vector<double>&to_clip = there.at("clip_frame"), &to_timeline = back.at("timeline_frame");
    ASSERT_EQ(to_timeline.size(),
              static_cast<std::size_t>(read_bvh(folder_.file(std::string(name) + ".bvh")).motion.num_frames()));
    for (std::size_t j = 1; j + 1 < to_timeline.size(); ++j) {
      const auto t = std::min(static_cast<std::size_t>(to_timeline[j]), to_clip.size() - 2);
      const double place = to_clip[t] + (to_timeline[j] - static_cast<double>(t)) * (to_clip[t + 1] - to_clip[t]);
      EXPECT_NEAR(place, static_cast<double>(j), 0.1) << name;  // a straight line between rows of a curve
    }
  }
}

TEST_F(AlignGroup, TellsInWordsWhatItFound) {
  const ProgramResult result = group();
  EXPECT_EQ(result.exit_code, 0);
  for (const char* text : {"timeline ", "rounds ", "converged", "after the first round", "brisk.bvh per timeline frame",
                           "over all pairs of clips", "aligned by continuous warp on "}) {
    EXPECT_THAT(result.out, HasSubstr(text));
  }
}

TEST_F(AlignGroup, DoesNotDependOnTheOrder) {
  const Json told = Json::parse(group({"--json"}).out);
  std::reverse(clips_.begin(), clips_.end());
  const Json reversed = Json::parse(group({"--json"}).out);
  EXPECT_EQ(told.at("timeline"), reversed.at("timeline"));
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(told.at("clips").at(k).at("warp").at("most"), reversed.at("clips").at(2 - k).at("warp").at("most"),
                kPrinted);
  }
}

TEST_F(AlignGroup, TakesClipsOfOtherFrameRates) {
  generate::WalkContent content;
  content.duration = 3.0;
  clips_.push_back(write("fine.bvh", generate::generate_walk(content, {}, 60.0).motion));
  const ProgramResult result = group({"--json"});
  EXPECT_THAT(result.err, HasSubstr("fine.bvh: note: resampled from 60 to 30 frames/s"));
  EXPECT_EQ(Json::parse(result.out).at("clips").at(3).at("frame_rate"), 30.0);
}

TEST_F(AlignGroup, RefusesWhatIsOfTwoClipsOnly) {
  const std::string plot = folder_.file("plot.svg");
  for (const auto& options :
       {std::vector<std::string>{"--plot", plot}, {"--signals", "posture", "--shared-units"}, {"--ends", "open"}}) {
    const ProgramResult result = group(options);
    EXPECT_EQ(result.exit_code, 1) << options.front();
    EXPECT_THAT(result.err, HasSubstr("with --groupwise")) << options.front();
  }
  EXPECT_THROW(read_file(plot), FileError);
}

TEST_F(AlignGroup, NamesTheClipThatCannotBeAligned) {
  EXPECT_EQ(align({"--groupwise", clips_.front()}).exit_code, 2);
  const std::vector<std::string> well = clips_;
  clips_.push_back(test_file("data/person.bvh"));
  const ProgramResult skeleton = group();
  EXPECT_EQ(skeleton.exit_code, 4);
  EXPECT_THAT(skeleton.err, testing::AllOf(HasSubstr("person.bvh: error"), HasSubstr("walk.bvh")));
  clips_ = well;
  clips_.push_back(still("still.bvh", clips_.front(), 60));
  const ProgramResult unmoved = group();
  EXPECT_EQ(unmoved.exit_code, 3);
  EXPECT_THAT(unmoved.err, HasSubstr("still.bvh: error: nothing moves in it"));
  clips_ = well;
  clips_.push_back(beginning("brief.bvh", clips_.front(), 12));
  const ProgramResult lengths = group({"--csv", folder_.file("there")});
  EXPECT_EQ(lengths.exit_code, 3);
  EXPECT_THAT(lengths.err, HasSubstr("brief.bvh: error: does not fit the timeline"));
  EXPECT_TRUE(std::filesystem::is_empty(folder_.file("there")));
  const ProgramResult no_folder = group({"--csv", folder_.file("missing")});
  EXPECT_EQ(no_folder.exit_code, 1);
  EXPECT_THAT(no_folder.err, HasSubstr("make a folder of this name first"));
}

}  // namespace
}  // namespace strut::test
