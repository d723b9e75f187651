// SPDX-License-Identifier: MIT
// The figure that strut align draws: what is in it, that any program can read it, and that it stays small.
#include "cli/align_clips.h"
#include "support/data.h"
#include "support/program.h"
#include "support/xml.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <strut/core/file.h>

namespace strut::test {
namespace {

using testing::HasSubstr;

constexpr std::size_t kLargestFile = 400'000;  // [bytes] what a web page or a paper's source takes without thought

/// Unlike a matcher it does not print the whole figure where it fails.
bool has(const std::string& svg, const std::string& text) {
  return svg.find(text) != std::string::npos;
}

class AlignFigure : public AlignClips {
 protected:
  /// The figure of two clips, drawn with `options`.
  std::string figure(const std::string& input, const std::string& output, std::vector<std::string> options = {}) {
    const std::string plot = folder_.file("plot.svg");
    options.insert(options.begin(), {input, output, "--force", "--plot", plot});
    const ProgramResult result = align(options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    report_ = result.out;
    return read_file(plot);
  }
  std::string report_;
};

TEST(XmlError, FindsWhatIsNotWellFormed) {
  EXPECT_EQ(xml_error("<a b=\"1 &amp; 2\"><c/>text<d id=\"e\">&lt;</d><f g=\"url(#e)\"/></a>\n"), "");
  for (const char* wrong : {"", "text", "<a>", "</a>", "<a></b>", "<a><b></a></b>", "<a/><b/>", "<a b=1/>",
                            "<a b=\"1\" b=\"2\"/>", "<a b=\"<\"/>", "<a>&</a>", "<a>&nbsp;</a>", "<a>\x01</a>",
                            "<a b=\"url(#c)\"/>", "<a><b id=\"c\"/><b id=\"c\"/></a>", "<a/>text", "<a"}) {
    EXPECT_NE(xml_error(wrong), "") << wrong;
  }
}

TEST_F(AlignFigure, HoldsEveryPart) {
  const std::string svg =
      figure(clip("walk & run.bvh", 1.0), clip("slow.bvh", 0.8), {"--dof", "leftupleg", "--method", "imw"});
  EXPECT_EQ(xml_error(svg), "");
  for (const char* text : {"Correspondence by IMW", "Time-warped by DTW, Type I", "Time-warped by IMW", "LeftUpLeg x",
                           "[degrees]", "walk &amp; run.bvh", "Distance of the clips", "spatial warp of the input",
                           "squared distance [deviations", "slope limit 2", "Time warp<", "Against an even stretch",
                           ">Slope<", "Footplants", "mean error", "(a)", "(d)"}) {
    EXPECT_TRUE(has(svg, text)) << text;
  }
  for (const char* text : {"nan", "inf\"", "<script", "<image", "@import", "href", "<style"}) {
    EXPECT_FALSE(has(svg, text)) << text;
  }
}

TEST_F(AlignFigure, DrawsOnePartAlone) {
  const std::string walk = clip("walk.bvh", 1.0), slow = clip("slow.bvh", 0.8);
  const std::vector<std::pair<std::string, std::string>> parts{
      {"curves", "Correspondence by"}, {"matrix", "Distance of"}, {"warp", ">Slope<"}, {"footplants", ">Footplants<"}};
  for (const auto& [part, text] : parts) {
    const std::string svg = figure(walk, slow, {"--figure", part});
    EXPECT_EQ(xml_error(svg), "") << part;
    for (const auto& [other, title] : parts) {
      EXPECT_EQ(svg.find(title) != std::string::npos, other == part) << part << " " << title;
    }
    EXPECT_FALSE(has(svg, "(a)</text>")) << part;
  }
}

TEST_F(AlignFigure, ComparesEveryMethodWithAnother) {
  const std::string walk = clip("walk.bvh", 1.0), slow = clip("slow.bvh", 0.8);
  for (const auto& [method, title] : {std::pair("dtw1", "DTW, Type I"), std::pair("dtw3", "DTW, Type III"),
                                      std::pair("timewarp", "time warp alone")}) {
    const std::string svg = figure(walk, slow, {"--method", method});
    EXPECT_EQ(xml_error(svg), "");
    EXPECT_TRUE(has(svg, std::string("Correspondence by ") + title));
    EXPECT_LT(svg.find(std::string("Time-warped by ") + title), svg.find("Time-warped by IMW"));
    EXPECT_EQ(svg.find("slope limit") != std::string::npos, std::string(method) != "dtw1");
  }
}

TEST_F(AlignFigure, ShowsTheContinuousWarpAfterIterativeMotionWarpingOfTheSameSignals) {
  const std::string svg = figure(clip("walk.bvh", 1.0), clip("slow.bvh", 0.8));
  EXPECT_EQ(xml_error(svg), "");
  for (const char* text : {"Correspondence by continuous warp", "slope limit 3",
                           "signals of posture, movement and feet", "IMW compares the same."}) {
    EXPECT_TRUE(has(svg, text)) << text;
  }
  EXPECT_FALSE(has(svg, "smoothed (black)"));
  EXPECT_LT(svg.find("Time-warped by IMW"), svg.find("Time-warped by continuous warp"));
}

TEST_F(AlignFigure, GivesTheErrorsOfTheReport) {
  const std::string walk = clip("walk.bvh", 1.0, 4.0), slow = clip("slow.bvh", 0.8, 4.0);
  const std::string svg = figure(walk, slow, {"--json"});
  const auto found = nlohmann::json::parse(report_).at("alignments").at(0).at("footplants");
  const auto ms = [&](const char* key) { return std::to_string(std::lround(1e3 * found.at(key).get<double>())); };
  const int paired = found.at("paired"), onsets = paired + found.at("unpaired_input").get<int>();
  EXPECT_TRUE(has(svg, "mean error " + ms("mean_error_s") + " ms, largest " + ms("largest_error_s") + " ms, " +
                           std::to_string(paired) + " of " + std::to_string(onsets) + " paired"));
}

TEST_F(AlignFigure, SpellsOutAndShortensNames) {
  const std::string odd = clip("a<b>&\"c'\x07.bvh", 1.0);
  const std::string many = clip(std::string(150, 'x') + "_and_the_end.bvh", 0.8);
  const std::string svg = figure(odd, many);
  EXPECT_EQ(xml_error(svg), "");
  EXPECT_TRUE(has(svg, "a&lt;b&gt;&amp;&quot;c'"));
  EXPECT_TRUE(has(svg, "\u2026xx"));
  EXPECT_TRUE(has(svg, "_and_the_end.bvh"));
  // Once in full, for who asks what the picture is.
  EXPECT_EQ(svg.find(std::string(150, 'x')), svg.rfind(std::string(150, 'x')));
}

TEST_F(AlignFigure, StaysSmall) {
  const std::string walk = clip("walk.bvh", 1.0, 20.0), brisk = clip("brisk.bvh", 1.02, 20.0);
  EXPECT_LT(figure(walk, brisk).size(), kLargestFile);
  const std::string longer = clip("long.bvh", 1.0, 70.0), slower = clip("slow.bvh", 0.9, 70.0);
  const std::string svg = figure(longer, slower);
  EXPECT_LT(svg.size(), kLargestFile);
  EXPECT_TRUE(has(svg, "show the first 12 s"));
  EXPECT_LT(figure(longer, slower, {"--window", "0,60"}).size(), kLargestFile);
}

TEST_F(AlignFigure, ShowsAWindow) {
  const std::string walk = clip("walk.bvh", 1.0, 4.0), slow = clip("slow.bvh", 0.8, 4.0);
  const std::string svg = figure(walk, slow, {"--window", "1,2.5"});
  EXPECT_EQ(xml_error(svg), "");
  EXPECT_TRUE(has(svg, "from 1 s"));
  EXPECT_FALSE(has(svg, ">4<"));  // nothing is there at 4 s
  const std::string plot = folder_.file("none.svg");
  EXPECT_EQ(align({walk, slow, "--plot", plot, "--window", "9,10"}).exit_code, 1);
  for (const char* wrong : {"2,1", "1", "a,b", "-1,2", "1,nan", "0,inf"}) {
    EXPECT_EQ(align({walk, slow, "--plot", plot, std::string("--window=") + wrong}).exit_code, 2) << wrong;
  }
  EXPECT_THAT(align({walk, slow, "--window", "0,1"}).err, HasSubstr("--plot"));
}

TEST_F(AlignFigure, DrawsOpenEndsAndPairsThatTheOtherMethodCannotAlign) {
  const std::string walk = clip("walk.bvh", 1.0, 2.5), part = beginning("part.bvh", walk, 30);
  for (const char* ends : {"open", "open-end", "open-begin"}) {
    const std::string svg = figure(part, walk, {"--ends", ends});
    EXPECT_EQ(xml_error(svg), "") << ends;
    EXPECT_TRUE(has(svg, "Time-warped by time warp alone")) << ends;
    EXPECT_TRUE(has(svg, "; found from ")) << ends;
  }
  const std::string svg = figure(part, walk, {"--method", "dtw1"});  // the walk is more than twice as long
  EXPECT_EQ(xml_error(svg), "");
  EXPECT_TRUE(has(svg, "Time-warped by even stretch"));
}

TEST_F(AlignFigure, LeavesFootplantsOutWhereThereAreNoLegs) {
  std::string text =
      "HIERARCHY\nROOT hips\n{\nOFFSET 0 0 0\nCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n"
      "JOINT spine\n{\nOFFSET 0 50 0\nCHANNELS 3 Zrotation Xrotation Yrotation\nEnd Site\n{\nOFFSET 0 50 0\n}\n}\n}\n"
      "MOTION\nFrames: 40\nFrame Time: 0.033333\n";
  for (int t = 0; t < 40; ++t) {
    text += "0 100 0 0 0 0 " + std::to_string((t * t) % 37) + " " + std::to_string(t % 9) + " 0\n";
  }
  write_file(folder_.file("arm.bvh"), text);
  const std::string svg = figure(folder_.file("arm.bvh"), folder_.file("arm.bvh"));
  EXPECT_EQ(xml_error(svg), "");
  EXPECT_TRUE(has(svg, "no two legs were found"));
  EXPECT_THAT(report_, HasSubstr("none to judge by"));
  EXPECT_FALSE(has(svg, "Line: where"));
}

TEST_F(AlignFigure, DrawsADegreeOfFreedomThatDoesNotMove) {
  const std::string walk = clip("walk.bvh", 1.0);
  const std::string svg = figure(walk, walk, {"--dof", "LeftHand z"});
  EXPECT_EQ(xml_error(svg), "");
  EXPECT_FALSE(has(svg, "e-0"));  // no ticks between roundings
}

TEST_F(AlignFigure, IsNotWrittenUnderAnotherPicturesName) {
  const std::string walk = clip("walk.bvh", 1.0);
  const ProgramResult result = align({walk, walk, "--plot", folder_.file("plot.PNG")});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("--plot: expected a name in .svg"));
}

TEST_F(AlignFigure, DrawsTwoFrames) {
  const std::string two = beginning("two.bvh", clip("walk.bvh", 1.0), 2);
  const std::string svg = figure(two, two);
  EXPECT_EQ(xml_error(svg), "");
  EXPECT_FALSE(has(svg, "nan"));
}

}  // namespace
}  // namespace strut::test
