// SPDX-License-Identifier: MIT
// A stream that lasts, with everything in it that comes out of broken trackers and games: every output is finite and of
// unit length, no frame takes memory, and afterwards a walk looks as if nothing had happened. 20,000 frames each;
// STRUT_SOAK_FRAMES asks for more.
#include "learn/example_walks.h"
#include "support/allocations.h"
#include "support/data.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/io/bvh.h>
#include <strut/math/rotation.h>
#include <strut/translate/translator.h>

namespace strut {
namespace {

constexpr int kSegment = 90;            // frames: three seconds
constexpr int kRecovery = 1800;         // frames: a minute, for what fades
constexpr double kRecovered = 1e-4;     // largest difference of a number of a unit quaternion: what has not faded
constexpr double kRecoveredFeet = 0.1;  // legs besides: jumps have left the body far away, where floats are centimetres

int num_frames() {
  const char* asked = std::getenv("STRUT_SOAK_FRAMES");
  return asked != nullptr ? std::atoi(asked) : 20000;
}

/// How far from 1 the length of an output's quaternion may be: rounding.
template <typename Scalar>
constexpr double kUnit = sizeof(Scalar) == sizeof(float) ? 1e-5 : 1e-12;

enum Kind { kWalk, kTeleport, kFarAway, kSpin, kFrozen, kNoise, kWrongRest, kBroken, kNumKinds };

/// Frames of every kind, three seconds of one, then of another.
class Trouble {
 public:
  explicit Trouble(const Motion& walk) : walk_(walk), pose_(walk.frame(0)) {}

  const Pose& next() {
    if (count_++ % kSegment == 0) begin();
    if (kind_ == kFrozen) return pose_;
    pose_ = walk_.frame(count_ % walk_.num_frames());
    is_broken_ = kind_ == kBroken;
    spoil();
    return pose_;
  }
  /// Whether the latest frame must be refused.
  [[nodiscard]] bool is_broken() const { return is_broken_; }

 private:
  void begin() {
    kind_ = static_cast<Kind>(random_() % kNumKinds);
    for (double& number : place_) number = normal_(random_);
    turn_ = math::exp_map({normal_(random_), normal_(random_), normal_(random_)});
  }

  void spoil() {
    const double t = count_ % kSegment;
    const Eigen::Vector3d place(place_[0], place_[1], place_[2]);
    auto& root = pose_.translations[0];
    switch (kind_) {
      case kTeleport:
        root += (count_ % 7 == 0 ? 1e3 : 1.0) * place;
        break;
      case kFarAway:
        root += 3e5 * place;
        break;
      case kSpin:
        pose_.rotations[0] = math::exp_map(t * place) * pose_.rotations[0];
        break;
      case kNoise:
        shake();
        break;
      case kWrongRest:
        for (auto& rotation : pose_.rotations) rotation = turn_ * rotation;
        break;
      case kBroken:
        damage();
        break;
      default:
        break;
    }
  }

  void shake() {
    for (auto& rotation : pose_.rotations)
      rotation = math::exp_map({3 * normal_(random_), 3 * normal_(random_), 3 * normal_(random_)});
    for (auto& translation : pose_.translations) translation *= normal_(random_);
  }

  /// Something that no pose has, at some joint.
  void damage() {
    const auto joint = static_cast<std::size_t>(count_) % pose_.rotations.size();
    switch (count_ % 5) {
      case 0:
        pose_.translations[joint].x() = std::numeric_limits<double>::quiet_NaN();
        break;
      case 1:
        pose_.translations[joint].z() = std::numeric_limits<double>::infinity();
        break;
      case 2:
        pose_.translations[joint].y() = -1e8;
        break;
      case 3:
        pose_.rotations[joint].coeffs() *= 1.1;
        break;
      default:
        pose_.rotations[joint].coeffs()[2] = std::numeric_limits<double>::quiet_NaN();
    }
  }

  const Motion& walk_;
  Pose pose_;
  Kind kind_ = kWalk;
  std::array<double, 3> place_{};
  Eigen::Quaterniond turn_{1, 0, 0, 0};
  bool is_broken_ = false;
  int count_ = 0;
  std::mt19937 random_{1};
  std::normal_distribution<double> normal_;
};

/// A frame of a translator's own precision.
template <typename Scalar>
struct Frame {
  explicit Frame(std::size_t num_joints) : rotations(4 * num_joints), translations(3 * num_joints) {}
  void take(const Pose& pose) {
    for (std::size_t j = 0; j < pose.rotations.size(); ++j) {
      for (int i = 0; i < 4; ++i) rotations[4 * j + i] = static_cast<Scalar>(pose.rotations[j].coeffs()[i]);
      for (int i = 0; i < 3; ++i) translations[3 * j + i] = static_cast<Scalar>(pose.translations[j][i]);
    }
  }
  [[nodiscard]] PoseView<Scalar> view() {
    return {rotations.data(), translations.data(), static_cast<int>(rotations.size() / 4)};
  }
  [[nodiscard]] bool is_sound() const {
    const bool is_finite =
        std::all_of(translations.begin(), translations.end(), [](Scalar x) { return std::isfinite(x); });
    double most = 0.0;
    for (std::size_t j = 0; j < rotations.size(); j += 4) {
      const double length = std::hypot(std::hypot(double(rotations[j]), double(rotations[j + 1])),
                                       std::hypot(double(rotations[j + 2]), double(rotations[j + 3])));
      most = std::max(most, std::isfinite(length) ? std::abs(length - 1.0) : 1.0);
    }
    return is_finite && most < kUnit<Scalar>;
  }
  std::vector<Scalar> rotations, translations;
};

/// What may and may not come of `pose`.
template <typename Scalar>
void push(BasicTranslator<Scalar>& translator, const Trouble& trouble, Frame<Scalar>& input, Frame<Scalar>& output) {
  if (trouble.is_broken()) {
    ASSERT_THROW(translator.push(input.view(), output.view()), InvalidArgument);
    return;
  }
  bool is_written = false;
  ASSERT_EQ(test::count_allocations([&] { is_written = translator.push(input.view(), output.view()); }), 0);
  ASSERT_TRUE(output.is_sound() || !is_written);
  const double share = translator.input_share();
  ASSERT_TRUE(share >= 0.0 && share <= 1.0) << share;
  ASSERT_TRUE(std::isfinite(translator.time_warp()) && translator.time_warp() > 0.0) << translator.time_warp();
}

/// The largest difference of the joints' rotations but the root's, after both have walked for a minute.
template <typename Scalar>
double difference_after_a_walk(BasicTranslator<Scalar> a, BasicTranslator<Scalar> b, const Motion& walk) {
  Frame<Scalar> input(walk.frame(0).rotations.size());
  Frame<Scalar> of_a = input;
  Frame<Scalar> of_b = input;
  for (int t = 0; t < kRecovery; ++t) {
    input.take(walk.frame(t % walk.num_frames()));
    a.push(input.view(), of_a.view());
    b.push(input.view(), of_b.view());
  }
  double most = 0.0;
  for (std::size_t i = static_cast<std::size_t>(4 * (walk.skeleton().pelvis() + 1)); i < of_a.rotations.size(); ++i) {
    // A quaternion and its negative are the same rotation.
    const double x = std::abs(static_cast<double>(of_a.rotations[i]));
    most = std::max(most, std::abs(x - std::abs(static_cast<double>(of_b.rotations[i]))));
  }
  return most;
}

template <typename Scalar>
void soak(const std::shared_ptr<const StyleModel>& model, const Motion& walk, bool clean_feet) {
  BasicTranslator<Scalar> translator(model, {.clean_feet = clean_feet});
  const BasicTranslator<Scalar> fresh = translator;
  Trouble trouble(walk);
  Frame<Scalar> input(walk.frame(0).rotations.size());
  Frame<Scalar> output = input;
  for (int t = 0; t < num_frames(); ++t) {
    input.take(trouble.next());
    push(translator, trouble, input, output);
    ASSERT_FALSE(testing::Test::HasFatalFailure()) << "frame " << t;
  }
  EXPECT_LT(difference_after_a_walk(translator, fresh, walk), clean_feet ? kRecoveredFeet : kRecovered);
}

/// Both precisions, of both kinds of model.
void soak_all(const test::Clips& clips, const Motion& walk) {
  for (const LearnMethod method : {LearnMethod::kRadial, LearnMethod::kLinear}) {
    const auto model = test::learn_from(clips, {.method = method, .identification = {.max_order = 4}}).model;
    for (const bool clean_feet : {false, true}) {
      SCOPED_TRACE(testing::Message() << "method " << static_cast<int>(method) << (clean_feet ? ", feet held" : ""));
      soak<double>(model, walk, clean_feet);
      soak<float>(model, walk, clean_feet);
    }
  }
}

TEST(Soak, LeavesATranslatorOfGeneratedWalksUnharmed) {
  const auto walk = generate::generate_walk(test::content(1.2, 0.1, 10.0), {.seed = 7}, test::kExampleRate).motion;
  soak_all(test::make_clips({test::content(1.0, 0.0), test::content(1.3, 0.2), test::content(1.2, -0.3)}), walk);
}

TEST(Soak, LeavesATranslatorOfRealWalksUnharmed) {
  STRUT_REQUIRE_REAL_DATA();
  const auto take = [](const char* style, int number) {
    const std::string digits = std::to_string(1000 + number).substr(1);
    return read_bvh(test::real_data() + "/bandai-namco/dataset-2_walk_" + style + "_" + digits + ".bvh").motion;
  };
  test::Clips clips;
  for (int number = 1; number <= 4; ++number) {
    clips.inputs.push_back(take("normal", number));
    clips.outputs.push_back(take("elderly", number));
  }
  clips.pairs = learn::find_pairs(clips.inputs, clips.outputs).pairs;
  soak_all(clips, take("normal", 5));
}

}  // namespace
}  // namespace strut
