// SPDX-License-Identifier: MIT
#include "support/data.h"
#include "support/small_model.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/core/file.h>
#include <strut/model/model_step.h>
#include <strut/model/style_model_io.h>
#include <strut/translate/translate_motion.h>

namespace strut {
namespace {

constexpr double kOtherCompiler = 1e-9;  // sums of numbers of size one, added up in another order

/// A clip in which the small models move, and one of every kind: blocks, blocks that see a context, a radial map.
const Motion& small_clip() {
  static const Motion clip = test::turning_motion(30.0, 1.0);
  return clip;
}

/// Boundaries whose numbers are of no meaning but all different.
postprocess::FootplantClassifier some_footplants(Eigen::Index states) {
  const Eigen::VectorXd projection = Eigen::VectorXd::LinSpaced(states, 0.1, 0.9);
  return postprocess::FootplantClassifier({postprocess::FootplantBoundary{projection, 0.25, true},
                                           postprocess::FootplantBoundary{-projection, -0.5, false}});
}

std::vector<StyleModelParts> small_models() {
  StyleModelParts seeing = test::radial_parts(small_clip());
  seeing.radial_map.reset();
  const int first_context = seeing.input.num_dofs();
  const Eigen::MatrixXd half = Eigen::MatrixXd::Constant(1, 1, 0.5);
  seeing.blocks.push_back({"head",
                           {first_context - 1, first_context + 1},
                           {first_context - 1},
                           {half, Eigen::RowVector2d(0.3, 0.7), half, Eigen::RowVector2d(1.0, -0.2)}});
  StyleModelParts planting = test::radial_parts(small_clip());
  planting.footplants = some_footplants(planting.radial_map->basis.num_features());
  return {test::copying_parts(small_clip(), 0.1), seeing, test::radial_parts(small_clip()), planting};
}

std::vector<std::string> small_files() {
  std::vector<std::string> files;
  for (const StyleModelParts& parts : small_models()) files.push_back(format_style_model(StyleModel(parts)));
  return files;
}

/// Rows of numbers between commas.
std::vector<Eigen::RowVectorXd> read_rows(const std::string& path) {
  std::vector<Eigen::RowVectorXd> rows;
  std::istringstream text(read_file(path));
  for (std::string line; std::getline(text, line);) {
    std::vector<double> numbers;
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) numbers.push_back(std::stod(cell));
    rows.emplace_back(Eigen::Map<Eigen::RowVectorXd>(numbers.data(), std::ssize(numbers)));
  }
  return rows;
}

TEST(StyleModelFile, GivesBackTheModelToTheBit) {
  for (const StyleModelParts& parts : small_models()) {
    const auto model = std::make_shared<const StyleModel>(parts);
    const auto back = parse_style_model(format_style_model(*model), "a.strut");
    EXPECT_EQ(back->provenance(), model->provenance());
    EXPECT_EQ(back->blocks().size(), model->blocks().size());
    EXPECT_EQ(back->context(), model->context());
    EXPECT_EQ(back->radial_map().has_value(), model->radial_map().has_value());
    ASSERT_EQ(back->footplants().has_value(), model->footplants().has_value());
    for (int foot = 0; model->footplants() && foot < 2; ++foot) {
      EXPECT_EQ(back->footplants()->foot(foot).projection, model->footplants()->foot(foot).projection);
      EXPECT_EQ(back->footplants()->foot(foot).boundary, model->footplants()->foot(foot).boundary);
      EXPECT_EQ(back->footplants()->foot(foot).is_planted_above, model->footplants()->foot(foot).is_planted_above);
    }
    EXPECT_EQ(describe_mismatch(back->skeleton(), model->skeleton()), "");
    const Motion a = translate_motion(model, small_clip());
    const Motion b = translate_motion(back, small_clip());
    EXPECT_EQ(a.frames(), b.frames());
    EXPECT_EQ(format_style_model(*back), format_style_model(*model));
  }
}

TEST(StyleModelFile, OfFormatVersion1TranslatesAsItDid) {
  // Learnt from generated walks, and stepped, by strut 0.1.0 before version 2; its first and its twentieth row.
  const auto model = read_style_model(test::test_file("data/version_1.strut"));
  EXPECT_FALSE(model->radial_map());
  EXPECT_EQ(model->context().rows(), 0);
  EXPECT_FALSE(model->footplants());
  EXPECT_GT(model->num_states(), 0);
  const std::vector<Eigen::RowVectorXd> expected = read_rows(test::test_file("data/version_1.csv"));
  ASSERT_EQ(expected.size(), 2U);
  ModelStep<double> translator(model);
  Eigen::RowVectorXd input(model->num_dofs()), output(model->num_dofs() + 1);
  for (int frame = 0; frame < 20; ++frame) {
    for (int dof = 0; dof < model->num_dofs(); ++dof) input[dof] = std::sin(0.3 * frame + dof);
    translator.step(input, output);
    if (frame == 0 || frame == 19) {
      EXPECT_LT((output - expected[frame == 0 ? 0 : 1]).norm(), kOtherCompiler) << frame;
    }
  }
}

TEST(StyleModelFile, RefusesOtherFiles) {
  EXPECT_FALSE(is_style_model(""));
  EXPECT_FALSE(is_style_model("HIERARCHY\nROOT a\n"));
  for (const std::string& file : small_files()) EXPECT_TRUE(is_style_model(file));
  try {
    parse_style_model("HIERARCHY\nROOT a\n", "walk.bvh");
    FAIL();
  } catch (const ParseError& error) {
    EXPECT_STREQ(error.what(),
                 "walk.bvh: error: expected a style model made by strut learn, found another kind of file");
  }
}

TEST(StyleModelFile, RefusesEveryTruncation) {
  constexpr std::size_t kPadding = 8;  // of a file's end at most
  for (const std::string& bytes : small_files()) {
    for (std::size_t size = 0; size + kPadding <= bytes.size(); size += 7) {
      EXPECT_THROW(parse_style_model(bytes.substr(0, size), "cut.strut"), Error) << size;
    }
  }
}

TEST(StyleModelFile, NeverCrashesOnDamagedBytes) {
  const std::vector<std::string> files = small_files();
  std::mt19937 random(3);
  for (std::size_t trial = 0; trial < 3000; ++trial) {
    std::string damaged = files[trial % files.size()];
    for (int hits = 0; hits < 3; ++hits) damaged[random() % damaged.size()] = static_cast<char>(random());
    try {
      parse_style_model(damaged, "damaged.strut");
    } catch (const Error&) {
      continue;  // refused; a hit in a number or a name may as well be read
    }
  }
}

/// What is said of a file with another version in it. The only 32-bit 2 that, made another number, turns the refusal
/// into one of the version is the version itself.
std::string version_refusal(char version) {
  const std::string bytes = small_files().front();
  for (std::size_t i = 0; i + 4 <= bytes.size(); i += 4) {
    if (bytes.compare(i, 4, std::string("\x02\0\0\0", 4)) != 0) continue;
    std::string changed = bytes;
    changed[i] = version;
    try {
      parse_style_model(changed, "a.strut");
    } catch (const VersionError& error) {
      return std::string(error.what()) + "; " + error.hint();
    } catch (const Error&) {
      continue;
    }
  }
  return "none";
}

TEST(StyleModelFile, RefusesAnotherFormatVersion) {
  EXPECT_EQ(version_refusal(3),
            "a.strut: error: the file has format version 3, this strut reads version 2; use a newer strut");
  EXPECT_EQ(
      version_refusal(0),
      "a.strut: error: the file has format version 0, this strut reads version 2; learn the model again with this "
      "strut");
}

/// The model with footplants, the first number of its left projection or the count of them made another.
std::string footplant_refusal(std::uint32_t count, double first) {
  const std::string bytes = small_files().back();
  std::string left(4 + sizeof(double), '\0');
  const std::uint32_t states = 4;
  const double number = 0.1;
  std::memcpy(left.data(), &states, 4);
  std::memcpy(left.data() + 4, &number, sizeof number);
  const std::size_t place = bytes.find(left);
  if (place == std::string::npos) return "there is no such projection";
  std::string changed = bytes;
  std::memcpy(changed.data() + place, &count, 4);
  std::memcpy(changed.data() + place + 4, &first, sizeof first);
  try {
    parse_style_model(changed, "a.strut");
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(StyleModelFile, RefusesFootplantsThatDoNotFit) {
  const std::string beginning = "a.strut: error: expected an intact style model, found parts that do not fit: ";
  EXPECT_EQ(footplant_refusal(4, 0.3), "accepted");
  EXPECT_EQ(footplant_refusal(3, 0.1), beginning + "projection: expected as many states for both feet, got 3 and 4");
  EXPECT_EQ(footplant_refusal(4, NAN), beginning + "footplants: expected finite numbers, got NaN or infinity");
}

TEST(StyleModelFile, OfAMissingPathIsAFileError) {
  const test::TemporaryFolder folder;
  EXPECT_THROW(read_style_model(folder.file("none.strut")), FileError);
}

}  // namespace
}  // namespace strut
