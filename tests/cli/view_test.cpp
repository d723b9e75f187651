// SPDX-License-Identifier: MIT
// strut view: which files a session is about, and what is answered about clips and alignments. Who is answered at all:
// view_server_test.cpp.
#include "csv_columns.h"
#include "support/program.h"
#include "support/small_model.h"
#include "support/walks.h"
#include "view_session.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/file.h>
#include <strut/effort/fragment_database.h>
#include <strut/io/bvh.h>
#include <strut/model/style_model_io.h>
#include <strut/motion/kinematics.h>
#include <strut/motion/resample.h>

namespace strut::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kPlaces = 1e-5;    // [m] angles and lengths in a BVH file have six digits, numbers sent are float
constexpr double kInTables = 1e-4;  // [frames] tables have six digits after the point, numbers sent are float

class View : public testing::Test {
 protected:
  View() { write_clip(here_.file("walk.bvh"), walk_); }

  [[nodiscard]] std::string file(const std::string& name) const { return here_.file(name); }
  std::string folder(const std::string& name) const {
    std::filesystem::create_directories(file(name));
    return file(name) + "/";
  }

  Workplace here_;
  Motion walk_ = short_walk(0.0);
};

/// The session's files by `what` of them.
std::vector<std::string> all(const json& files, const char* what) {
  std::vector<std::string> values;
  for (const json& file : files) values.push_back(file.value(what, ""));
  return values;
}

json files_of(const ViewSession& session) {
  return session.json("session").at("files");
}

// ---- files ----------------------------------------------------------------------------------------------------------

TEST_F(View, TellsKindsOfFilesByWhatIsInThem) {
  write_style_model(file("style.bvh"), StyleModel(exaggerating_parts(walk_, 0.3, 1.5)));
  effort::FragmentDatabase::create(file("moves"), walk_.shared_skeleton(), 30.0);
  write_file(file("list.txt"), "# made by hand\n[[pair]]\ninput = \"walk.bvh\"\noutput = \"walk.bvh\"\n");
  const ViewSession session({file("walk.bvh"), file("style.bvh"), file("moves"), file("list.txt")});
  const json files = files_of(session);
  EXPECT_THAT(all(files, "kind"), ElementsAre("clip", "model", "database", "pairs"));
  EXPECT_THAT(all(files, "id"), ElementsAre("c0", "m0", "d0", "p0"));
  for (const json& entry : files) EXPECT_FALSE(entry.contains("problem")) << entry;
}

TEST_F(View, NamesFilesAsShortAsTellsThemApart) {
  std::filesystem::copy(file("walk.bvh"), folder("old") + "a.bvh");
  std::filesystem::copy(file("walk.bvh"), folder("new") + "a.bvh");
  std::filesystem::copy(file("walk.bvh"), folder("new/old") + "a.bvh");
  const ViewSession session({file("walk.bvh"), file("old/a.bvh"), file("new/a.bvh"), file("new/old/a.bvh")});
  const std::string here = std::filesystem::path(file("walk.bvh")).parent_path().filename().string();
  EXPECT_THAT(all(files_of(session), "name"),
              ElementsAre("walk.bvh", here + "/old/a.bvh", "new/a.bvh", "new/old/a.bvh"));
}

TEST_F(View, TakesAFileThatIsNamedTwiceOnce) {
  std::filesystem::create_symlink(file("walk.bvh"), file("link.bvh"));
  const ViewSession session({file("walk.bvh"), folder("x") + "../walk.bvh", file("link.bvh")});
  EXPECT_THAT(all(files_of(session), "name"), ElementsAre("walk.bvh"));
}

TEST_F(View, AddsTheClipsOfAPairList) {
  write_clip(folder("clips") + "limp.bvh", short_walk(1.0));
  write_file(folder("lists") + "pairs.toml",
             "[[pair]]\ninput = \"../walk.bvh\"\noutput = \"../clips/limp.bvh\"\n"
             "[[pair]]\ninput = \"../walk.bvh\"\noutput = \"../clips/gone.bvh\"\n");
  const ViewSession session({file("lists/pairs.toml"), file("walk.bvh")});
  const json files = files_of(session);
  EXPECT_THAT(all(files, "name"), ElementsAre("pairs.toml", "walk.bvh", "limp.bvh", "gone.bvh"));
  EXPECT_THAT(all(files, "listedBy"), ElementsAre("", "", "p0", "p0"));
  EXPECT_THAT(files[3].at("problem").at("message"), HasSubstr("gone.bvh"));
  EXPECT_EQ(session.container("clips/" + files[2].at("id").get<std::string>()).header.at("name"), "limp.bvh");
}

TEST_F(View, ShowsWhatIsWrongWithFilesAndServesTheOthers) {
  write_file(file("bad.strut"), std::string("STRT") + std::string(20, 'x'));
  write_file(file("bad.toml"), "[[pair]]\ninput = 3\n");
  folder("clips");
  const ViewSession session({file("bad.strut"), file("bad.toml"), file("gone.bvh"), file("clips"), file("walk.bvh")});
  const json files = files_of(session);
  ASSERT_EQ(files.size(), 5U);
  EXPECT_THAT(files[0].at("problem").at("message"), HasSubstr("bad.strut"));
  EXPECT_THAT(files[1].at("problem").at("message"), HasSubstr("bad.toml:2:9: error: expected a file name"));
  EXPECT_THAT(files[2].at("problem").at("message"), HasSubstr("gone.bvh"));
  EXPECT_THAT(files[3].at("problem").at("message"), HasSubstr("is a folder"));
  EXPECT_THAT(files[3].at("problem").at("hint"), HasSubstr("clips/*.bvh"));
  EXPECT_FALSE(files[4].contains("problem"));
}

TEST_F(View, SaysWhichCommandTakesAModelOfAnotherKind) {
  const std::string size(4, '\0');  // what stands before a model's mark
  write_file(file("gaits.strutgait"), size + "STRG");
  write_file(file("moves.struteffort"), size + "STRE");
  const ViewSession session({file("gaits.strutgait"), file("moves.struteffort")});
  const json files = files_of(session);
  EXPECT_THAT(files[0].at("problem").at("message"), AllOf(HasSubstr("found a gait model"), HasSubstr("a clip (BVH)")));
  EXPECT_THAT(files[0].at("problem").at("hint"), HasSubstr("strut blend"));
  EXPECT_THAT(files[1].at("problem").at("message"), HasSubstr("found an Effort model"));
  EXPECT_THAT(files[1].at("problem").at("hint"), HasSubstr("strut effort apply"));
}

TEST_F(View, OpensThePageThoughEveryFileIsBad) {
  const ViewSession session({file("gone.bvh")});
  EXPECT_EQ(session.request("GET", "/" + session.token() + "/").status, 200);
  EXPECT_EQ(files_of(session).size(), 1U);
}

TEST_F(View, SendsNamesThatAreNoText) {
  const std::string name = "w\xe4lk.bvh";
  write_clip(file(name), walk_);
  const ViewSession session({file(name)});
  EXPECT_EQ(files_of(session).at(0).at("name"), "w\xef\xbf\xbdlk.bvh");
  EXPECT_EQ(session.get("clips/c0").status, 200);
}

TEST_F(View, PassesTheRaterOn) {
  EXPECT_EQ(ViewSession({file("walk.bvh"), "--rater", "Ann O'Nym"}).json("session").at("rater"), "Ann O'Nym");
  EXPECT_FALSE(ViewSession({file("walk.bvh")}).json("session").contains("rater"));
}

// ---- clips ----------------------------------------------------------------------------------------------------------

TEST_F(View, SendsWhereEveryPointOfAClipIs) {
  const ViewSession session({file("walk.bvh")});
  const ViewContainer clip = session.container("clips/c0");
  const json& points = clip.header.at("points");
  EXPECT_EQ(clip.header.at("numFrames"), walk_.num_frames());
  EXPECT_EQ(clip.header.at("frameRate"), 30.0);
  const std::vector<float>& positions = clip.arrays.at("positions");
  ASSERT_EQ(positions.size(), points.size() * 3U * static_cast<std::size_t>(walk_.num_frames()));
  const Motion read = read_bvh(file("walk.bvh")).motion;
  const auto world = motion::joint_positions_world(read);
  for (std::size_t frame = 0; frame < world.size(); frame += 10) {
    for (std::size_t joint = 0; joint < world[frame].size(); ++joint) {
      for (const int axis : {0, 1, 2}) {
        const auto at = 3 * (frame * points.size() + joint) + static_cast<std::size_t>(axis);
        EXPECT_NEAR(positions[at], world[frame][joint][axis], kPlaces) << frame << " " << joint;
      }
    }
  }
}

TEST_F(View, SendsWhichPointsHangOnWhichAndWhichAreLegs) {
  const ViewContainer clip = ViewSession({file("walk.bvh")}).container("clips/c0");
  const json& points = clip.header.at("points");
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_LT(points[i].at("parent"), static_cast<int>(i));
  const json& legs = clip.header.at("legs");
  ASSERT_EQ(legs.size(), 2U);
  for (const json& leg : legs) {
    EXPECT_EQ(points[leg.at("knee").get<std::size_t>()].at("parent"), leg.at("hip"));
    EXPECT_EQ(points[leg.at("toe").get<std::size_t>()].at("parent"), leg.at("ankle"));
  }
  EXPECT_EQ(points[legs[0].at("knee").get<std::size_t>()].at("side"), "left");
  EXPECT_FALSE(clip.header.at("plants").empty());
}

TEST_F(View, ReadsClipsAsTheOptionsSay) {
  const auto height = [&](const std::vector<std::string>& options) {
    std::vector<std::string> arguments{file("walk.bvh")};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const std::vector<float> positions = ViewSession(arguments).container("clips/c0").arrays.at("positions");
    return positions.at(1);
  };
  constexpr float kInchesPerCm = 2.54F;
  EXPECT_NEAR(height({"--unit", "in"}) / height({}), kInchesPerCm, 1e-4F);
}

TEST_F(View, TellsWhereAClipHasNotTheFeetThatWereNamed) {
  const ViewSession session({file("walk.bvh"), "--feet", "Nose,Ear"});
  const json header = session.container("clips/c0").header;
  EXPECT_FALSE(header.contains("legs"));
  EXPECT_THAT(header.at("notes").dump(), HasSubstr("Nose"));
}

TEST_F(View, PlantsTheFeetThatWereNamedAndMeasuresThoseOfItsShape) {
  const ViewContainer usual = ViewSession({file("walk.bvh")}).container("clips/c0");
  const auto ankle = [&](std::size_t foot) {
    const auto point = usual.header.at("legs")[foot].at("ankle").get<std::size_t>();
    return usual.header.at("points")[point].at("name").get<std::string>();
  };
  const ViewContainer crossed =
      ViewSession({file("walk.bvh"), "--feet", ankle(1) + "," + ankle(0)}).container("clips/c0");
  EXPECT_EQ(crossed.header.at("legs")[0].at("ankle"), usual.header.at("legs")[1].at("ankle"));
  EXPECT_NE(crossed.header.at("plants"), usual.header.at("plants"));
  EXPECT_EQ(crossed.header.at("figures"), usual.header.at("figures"));
  for (const float speed : crossed.arrays.at("slide")) EXPECT_TRUE(std::isnan(speed));  // it would be another foot's
  EXPECT_THAT(crossed.header.at("notes").dump(), HasSubstr("are of the feet found by shape"));
  const ViewContainer same = ViewSession({file("walk.bvh"), "--feet", ankle(0) + "," + ankle(1)}).container("clips/c0");
  EXPECT_EQ(same.header.at("notes"), usual.header.at("notes"));
}

TEST_F(View, ShowsTheParsersMessageForMalformedClips) {
  std::map<std::string, std::string> expected;
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(test_file("malformed"))) {
    if (entry.path().extension() == ".bvh") files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  const ViewSession session(files);
  int num_refused = 0;
  for (const json& entry : files_of(session)) {
    const std::string path = entry.at("path");
    std::string message;
    try {
      static_cast<void>(read_bvh(path));
    } catch (const std::exception& error) {
      message = error.what();
    }
    const ViewAnswer answer = session.get("clips/" + entry.at("id").get<std::string>());
    if (!message.empty()) ++num_refused;
    EXPECT_EQ(answer.status, message.empty() ? 200 : 400) << path;
    EXPECT_EQ(answer.problem(), message) << path;
  }
  EXPECT_GT(num_refused, 20);
}

TEST_F(View, ReadsABadClipAgainOnceItWasMended) {
  write_file(file("clip.bvh"), "HIERARCHY\nnothing\n");
  const ViewSession session({file("clip.bvh")});
  EXPECT_THAT(session.get("clips/c0").problem(), HasSubstr("clip.bvh:2:1: error: "));
  write_file(file("clip.bvh"), read_file(file("walk.bvh")), Overwrite::kAllow);
  EXPECT_EQ(session.get("clips/c0").status, 200);
}

TEST_F(View, ReadsAClipOnce) {
  const ViewSession session({file("walk.bvh")});
  const std::string first = session.get("clips/c0").body;
  std::filesystem::remove(file("walk.bvh"));
  EXPECT_EQ(session.get("clips/c0").body, first);
}

TEST_F(View, AnswersManyAtOnceAlike) {
  write_clip(file("limp.bvh"), short_walk(1.0));
  const ViewSession session({file("walk.bvh"), file("limp.bvh")});
  std::vector<std::string> bodies(24);
  std::vector<std::thread> pages;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    pages.emplace_back([&, i] { bodies[i] = session.get(i % 2 == 0 ? "clips/c0" : "clips/c1").body; });
  }
  for (std::thread& page : pages) page.join();
  for (std::size_t i = 0; i < bodies.size(); ++i) EXPECT_TRUE(!bodies[i].empty() && bodies[i] == bodies[i % 2]) << i;
}

TEST_F(View, RefusesClipsItHasNot) {
  const ViewSession session({file("walk.bvh")});
  for (const char* path : {"clips/c1", "clips/m0", "clips/walk.bvh", "alignment?reference=c0&clip=c9"}) {
    const ViewAnswer answer = session.get(path);
    EXPECT_EQ(answer.status, 404) << path;
    EXPECT_THAT(answer.problem(), HasSubstr("there is no file")) << path;
  }
  EXPECT_THAT(session.get("alignment?reference=c0").problem(), HasSubstr("'clip' is missing"));
}

// ---- alignments -----------------------------------------------------------------------------------------------------

TEST_F(View, AlignsAsStrutAlignDoes) {
  write_clip(file("limp.bvh"), short_walk(0.8));
  const ViewSession session({file("walk.bvh"), file("limp.bvh")});
  const ViewContainer found = session.container("alignment?reference=c0&clip=c1");
  EXPECT_EQ(found.header.at("reference"), "c0");
  EXPECT_EQ(found.header.at("clip"), "c1");
  EXPECT_EQ(found.header.at("method"), "continuous warp");
  ASSERT_EQ(here_.run(STRUT_PROGRAM, {"align", "@walk.bvh", "@limp.bvh", "--csv", "@warp.csv"}).exit_code, 0);
  const std::vector<double> expected = columns_of(file("warp.csv")).at("output_frame");
  const std::vector<float>& moments = found.arrays.at("moments");
  ASSERT_EQ(moments.size(), expected.size());
  EXPECT_TRUE(std::is_sorted(moments.begin(), moments.end()));
  for (std::size_t i = 0; i < moments.size(); ++i) EXPECT_NEAR(moments[i], expected[i], kInTables) << i;
}

TEST_F(View, AlignsInTheClipsOwnFrames) {
  write_clip(file("fast.bvh"), motion::resample(walk_, 60.0));
  const ViewSession session({file("walk.bvh"), file("fast.bvh")});
  const ViewContainer found = session.container("alignment?reference=c0&clip=c1");
  const std::vector<float>& moments = found.arrays.at("moments");
  ASSERT_EQ(moments.size(), static_cast<std::size_t>(walk_.num_frames()));
  constexpr float kFrame = 1.0F;  // of 60 in a second: the same motion is found within a frame
  for (std::size_t i = 0; i < moments.size(); ++i) EXPECT_NEAR(moments[i], 2.0F * static_cast<float>(i), kFrame) << i;
  EXPECT_THAT(found.header.at("warnings").dump(), HasSubstr("resampled from 60 to 30 frames/s"));
}

TEST_F(View, RefusesToAlignWhatStrutAlignRefuses) {
  write_clip(file("other.bvh"), renamed(walk_, 1, "Bone"));
  write_clip(file("still.bvh"), held(walk_, 30));
  write_clip(file("one.bvh"), held(walk_, 1));
  write_clip(file("long.bvh"), short_walk(0.0, 12.0));
  const std::vector<std::string> others{"other.bvh", "still.bvh", "one.bvh", "long.bvh"};
  std::vector<std::string> arguments{file("walk.bvh")};
  for (const std::string& other : others) arguments.push_back(file(other));
  const ViewSession session(arguments);
  for (std::size_t i = 0; i < others.size(); ++i) {
    const ViewAnswer answer = session.get("alignment?reference=c0&clip=c" + std::to_string(i + 1));
    const ProgramResult align = here_.run(STRUT_PROGRAM, {"align", "@walk.bvh", "@" + others[i]});
    EXPECT_EQ(answer.status, 400) << others[i];
    EXPECT_THAT(align.err, HasSubstr(answer.problem())) << others[i];
    EXPECT_FALSE(answer.problem().empty());
  }
}

}  // namespace
}  // namespace strut::test
