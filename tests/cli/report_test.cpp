// SPDX-License-Identifier: MIT
#include "metrics/test_body.h"
#include "support/data.h"
#include "support/program.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <strut/core/file.h>
#include <strut/io/bvh.h>
#include <strut/motion/kinematics.h>

namespace strut::test {
namespace {

using metrics::test::test_motion;
using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::json;

constexpr double kFarthestOff = 1.5e-4;  // a tenth of a millimetre, and what 32 bits lose a kilometre away [m]

std::string from_base64(const std::string& text) {
  static const std::string kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t group = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    group = group << 6U | static_cast<std::uint32_t>(kDigits.find(c));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(group >> static_cast<unsigned>(bits) & 0xffU);
  }
  return bytes;
}

/// A container, read as viewer/src/data/container.ts does.
struct Contents {
  Json header;
  std::map<std::string, std::vector<float>> arrays;
};

template <typename Number>
std::vector<Number> numbers_at(const std::string& bytes, std::size_t begin, std::size_t count) {
  std::vector<Number> numbers(count);
  std::memcpy(numbers.data(), bytes.data() + begin, count * sizeof(Number));
  return numbers;
}

Contents contents_of(const std::string& base64) {
  const std::string bytes = from_base64(base64);
  const auto length = numbers_at<std::uint32_t>(bytes, 0, 1).front();
  Contents contents{Json::parse(bytes.substr(4, length)), {}};
  for (const Json& entry : contents.header.at("arrays")) {
    const std::size_t begin = 4 + length + entry.at("start").get<std::size_t>();
    const auto count = entry.at("count").get<std::size_t>();
    std::vector<float>& values = contents.arrays[entry.at("name")];
    if (entry.at("type") == "f32") {
      values = numbers_at<float>(bytes, begin, count);
      continue;
    }
    for (const std::uint16_t stored : numbers_at<std::uint16_t>(bytes, begin, count)) {
      values.push_back(stored == 0xffff ? NAN
                                        : static_cast<float>(entry.at("offset").get<double>() +
                                                             entry.at("scale").get<double>() * stored));
    }
  }
  return contents;
}

/// The JSON that a report carries.
Json data_of(const std::string& page) {
  const std::string mark = R"(<script type="application/json" id="report">)";
  const std::size_t begin = page.find(mark) + mark.size();
  return Json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

class Report : public testing::Test {
 protected:
  std::string clip(const std::string& name, double metres_per_second = 0.5, int num_frames = 90) {
    const Motion motion = test_motion(num_frames, 30.0, [=](Pose& pose, double t) {
      pose.translations[0].z() += metres_per_second * t;
      pose.translations[metrics::test::kHead].y() += 0.05 * std::sin(5.0 * t);
      // An alignment goes by how joints turn.
      pose.rotations[metrics::test::kHead] = Eigen::AngleAxisd(0.5 * std::sin(5.0 * t), Eigen::Vector3d::UnitX());
    });
    BvhLayout layout = default_layout(motion.skeleton());
    layout.channels.assign(layout.channels.size(), layout.channels.front());
    write_bvh(folder_.file(name), motion, layout, Overwrite::kAllow);
    return folder_.file(name);
  }
  [[nodiscard]] ProgramResult report(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "report");
    arguments.insert(arguments.end(), {"-o", page_});
    return run_program(STRUT_PROGRAM, arguments);
  }
  [[nodiscard]] Json data() const { return data_of(read_file(page_)); }

  TemporaryFolder folder_;
  std::string page_ = folder_.file("report.html");
};

/// The largest distance of an axis of a joint in `read` from where it is in `motion`.
double farthest_off(const Contents& read, const Motion& motion) {
  const auto& path = read.arrays.at("pelvisPath");
  const auto& around = read.arrays.at("aroundPelvis");
  const std::size_t num_points = read.header.at("points").size();
  double farthest = 0.0;
  for (int frame = 0; frame < motion.num_frames(); ++frame) {
    const auto world = motion::forward_kinematics(motion.skeleton(), motion.frame(frame));
    for (std::size_t i = 0; i < 3 * world.positions.size(); ++i) {
      const auto f = static_cast<std::size_t>(frame);
      const double x = around[f * 3 * num_points + i] + path[3 * f + i % 3];
      farthest = std::max(farthest, std::abs(x - world.positions[i / 3][static_cast<Eigen::Index>(i % 3)]));
    }
  }
  return farthest;
}

TEST_F(Report, HoldsClipsFiguresCurvesAndAlignments) {
  const ProgramResult result = report({clip("a.bvh"), clip("b.bvh", 0.7), "--title", "Two walks", "--note", "Look.",
                                       "--note", "And see.", "--name", "slow", "--name", "fast"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json data = this->data();
  const Json& session = data.at("session");
  EXPECT_EQ(session.at("report").at("title"), "Two walks");
  EXPECT_EQ(session.at("report").at("notes"), Json({"Look.", "And see."}));
  EXPECT_EQ(session.at("files").at(1).at("name"), "fast");
  const Contents clip = contents_of(data.at("clips").at("c1"));
  EXPECT_EQ(clip.header.at("name"), "fast");
  EXPECT_EQ(clip.header.at("numFrames"), 90);
  const Contents curves = contents_of(data.at("curves").at("c1"));
  ASSERT_FALSE(clip.header.at("curves").empty());
  for (const Json& curve : clip.header.at("curves")) EXPECT_EQ(curves.arrays.at(curve.at("name")).size(), 90U) << curve;
  const Json& slide = clip.header.at("figures").at(0);
  EXPECT_EQ(slide.at("name"), "Foot slide");
  EXPECT_NEAR(slide.at("value"), 70.0, 0.1);
  EXPECT_THAT(slide.at("extreme").at("joint").get<std::string>(), HasSubstr("toe_"));
  EXPECT_EQ(contents_of(data.at("alignments").at("c1")).arrays.at("moments").size(), 90U);
}

TEST_F(Report, KeepsPositionsToATenthOfAMillimetreHoweverFarAClipTravels) {
  const std::string path = clip("far.bvh", 300.0);  // 890 m
  ASSERT_EQ(report({path}).exit_code, 0);
  const Contents read = contents_of(data().at("clips").at("c0"));
  EXPECT_LT(farthest_off(read, read_bvh(path).motion), kFarthestOff);
}

TEST_F(Report, ShowsMarkupAsText) {
  const std::string evil = "</script><script>alert(1)</script><!-- \"&'";
  ASSERT_EQ(report({clip("a.bvh"), "--title", evil, "--note", evil, "--name", evil}).exit_code, 0);
  const std::string page = read_file(page_);
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  EXPECT_EQ(data().at("session").at("report").at("title"), evil);
  EXPECT_EQ(data().at("session").at("files").at(0).at("name"), evil);
}

TEST_F(Report, LoadsNothing) {
  ASSERT_EQ(report({clip("a.bvh")}).exit_code, 0);
  const std::string page = read_file(page_);
  for (const char* loading : {"src=", "@import", "<link rel=\"stylesheet", "url(http", "href=\"http"}) {
    EXPECT_THAT(page.substr(0, page.find("<!--\nThis page contains")), Not(HasSubstr(loading)));
  }
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  EXPECT_THAT(page, Not(HasSubstr(folder_.path())));  // nobody's business
}

TEST_F(Report, IsTheSameForTheSameClips) {
  const std::vector<std::string> clips = {clip("a.bvh"), clip("b.bvh", 0.7), "--force"};
  ASSERT_EQ(report(clips).exit_code, 0);
  const std::string first = read_file(page_);
  ASSERT_EQ(report(clips).exit_code, 0);
  EXPECT_TRUE(read_file(page_) == first);
}

TEST_F(Report, LeavesOutWhatIsNotAskedForAndSaysSo) {
  ASSERT_EQ(report({clip("a.bvh"), clip("b.bvh"), "--no-align", "--curves", "body"}).exit_code, 0);
  const Json data = this->data();
  EXPECT_TRUE(data.at("alignments").empty());
  const Json curves = contents_of(data.at("clips").at("c0")).header.at("curves");
  for (const Json& curve : curves) {
    EXPECT_THAT(curve.at("name").get<std::string>(), testing::StartsWith("body/"));
  }
  EXPECT_THAT(data.at("session").at("report").at("leftOut").at(0).get<std::string>(), HasSubstr("--curves all"));
}

TEST_F(Report, SaysOfAClipThatCannotBeAlignedAndOfABodyWithoutLegs) {
  ASSERT_EQ(report({clip("a.bvh"), test_file("data/two_joints.bvh")}).exit_code, 0);
  const Json data = this->data();
  EXPECT_THAT(data.at("session").at("report").at("leftOut").at(0).get<std::string>(), HasSubstr("two_joints.bvh"));
  const Json figures = contents_of(data.at("clips").at("c1")).header.at("figures");
  EXPECT_EQ(figures.at(0).at("value"), nullptr);
  EXPECT_THAT(figures.at(0).at("note").get<std::string>(), HasSubstr("two legs"));
}

TEST_F(Report, RefusesBeforeItComputesAndLeavesNothing) {
  write_file(page_, "mine");
  const std::string a = clip("a.bvh");
  EXPECT_EQ(report({a}).exit_code, 1);
  EXPECT_EQ(read_file(page_), "mine");
  EXPECT_EQ(report({a, "--force", "--name", "one", "--name", "two"}).exit_code, 1);
  std::filesystem::remove(page_);
  const ProgramResult missing = report({a, folder_.file("missing.bvh")});
  EXPECT_EQ(missing.exit_code, 3);
  EXPECT_THAT(missing.err, HasSubstr("missing.bvh"));
  write_file(folder_.file("broken.bvh"), "HIERARCHY\nROOT hips\n{\n  OFFSET 0 0 what\n");
  const ProgramResult broken = report({folder_.file("broken.bvh")});
  EXPECT_EQ(broken.exit_code, 3);
  EXPECT_THAT(broken.err, HasSubstr("broken.bvh:4:"));
  EXPECT_FALSE(std::filesystem::exists(page_));
}

}  // namespace
}  // namespace strut::test
