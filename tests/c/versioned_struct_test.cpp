// SPDX-License-Identifier: MIT
// Structs of older and newer callers: the library reads and writes no byte beyond the size they give.
#include "c/handles.h"
#include "support/small_model.h"

#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace strut::test {
namespace {

using testing::Each;
using testing::HasSubstr;

constexpr unsigned char kUntouched = 0xAB;

/// A caller's struct of `size` bytes, on the heap, where the sanitizers see every byte beyond it.
template <typename Struct>
struct Sized {
  explicit Sized(std::size_t size) : bytes(size, kUntouched) {}
  [[nodiscard]] Struct* get() { return reinterpret_cast<Struct*>(bytes.data()); }
  template <typename Number>
  void set(std::size_t offset, Number number) {
    std::memcpy(bytes.data() + offset, &number, sizeof number);
  }
  template <typename Number>
  [[nodiscard]] Number at(std::size_t offset) const {
    Number number;
    std::memcpy(&number, bytes.data() + offset, sizeof number);
    return number;
  }
  std::vector<unsigned char> bytes;
};

class VersionedStructs : public testing::Test {
 protected:
  ModelHandle model_ = handle_of(StyleModel(radial_parts(turning_motion(30.0, 2.0))));
  TranslatorHandle translator_ = translator_of({model_.get()});
};

TEST_F(VersionedStructs, OfOlderCallersHaveDefaultsForWhatTheyLack) {
  // A caller who knows no more than strength.
  constexpr std::size_t kOld = offsetof(strut_controls, strength) + sizeof(double);
  Sized<strut_controls> old(kOld);
  ASSERT_EQ(strut_controls_init(old.get(), kOld), STRUT_OK);
  EXPECT_EQ(old.at<std::uint32_t>(0), kOld);
  old.set(offsetof(strut_controls, strength), 0.5);
  ASSERT_EQ(strut_translator_set_controls(translator_.get(), old.get()), STRUT_OK) << strut_last_error();
  strut_controls now;
  now.struct_size = sizeof now;
  ASSERT_EQ(strut_translator_get_controls(translator_.get(), &now), STRUT_OK);
  EXPECT_EQ(now.strength, 0.5);
  EXPECT_EQ(now.movement, 1.0);
  EXPECT_THAT(now.parts, Each(1.0));
}

TEST_F(VersionedStructs, OfEveryShorterSizeAreReadAndWrittenWithinIt) {
  for (std::size_t size = sizeof(std::uint32_t); size <= sizeof(strut_translator_options); ++size) {
    Sized<strut_translator_options> options(size);
    ASSERT_EQ(strut_translator_options_init(options.get(), size), STRUT_OK) << size;
    EXPECT_NO_THROW(translator_of({model_.get()}, options.get())) << size;
  }
  for (std::size_t size = sizeof(std::uint32_t); size <= sizeof(strut_model_info); ++size) {
    Sized<strut_model_info> info(size);
    info.set(0, static_cast<std::uint32_t>(size));
    ASSERT_EQ(strut_model_get_info(model_.get(), info.get()), STRUT_OK) << size;
    if (size >= 8) {
      EXPECT_EQ(info.at<std::int32_t>(offsetof(strut_model_info, num_joints)), 6) << size;
    }
  }
  for (std::size_t size = sizeof(std::uint32_t); size <= sizeof(strut_axes); ++size) {
    Sized<strut_axes> axes(size);
    ASSERT_EQ(strut_axes_init(axes.get(), size, STRUT_CONVENTION_STRUT), STRUT_OK);
    strut_joint joint;
    joint.struct_size = sizeof joint;
    EXPECT_EQ(strut_model_get_joint(model_.get(), 1, axes.get(), &joint), STRUT_OK) << strut_last_error();
  }
}

TEST_F(VersionedStructs, ThatEndWithinAFieldHaveItsDefault) {
  constexpr std::size_t kSize = offsetof(strut_controls, strength) + 4;
  Sized<strut_controls> controls(kSize);
  controls.set(0, static_cast<std::uint32_t>(kSize));
  controls.set(offsetof(strut_controls, num_weights), 0);
  ASSERT_EQ(strut_translator_set_controls(translator_.get(), controls.get()), STRUT_OK) << strut_last_error();
  strut_controls now;
  now.struct_size = sizeof now;
  ASSERT_EQ(strut_translator_get_controls(translator_.get(), &now), STRUT_OK);
  EXPECT_EQ(now.strength, 1.0);
}

TEST_F(VersionedStructs, OfNewerCallersAreTakenOnlyIfTheyAskForNothingUnknown) {
  constexpr std::size_t kNew = sizeof(strut_controls) + 16;
  Sized<strut_controls> newer(kNew);
  ASSERT_EQ(strut_controls_init(newer.get(), kNew), STRUT_OK);
  EXPECT_EQ(newer.at<double>(sizeof(strut_controls) + 8), 0.0);
  EXPECT_EQ(strut_translator_set_controls(translator_.get(), newer.get()), STRUT_OK) << strut_last_error();
  newer.set(sizeof(strut_controls) + 15, '\1');
  EXPECT_EQ(strut_translator_set_controls(translator_.get(), newer.get()), STRUT_INVALID_ARGUMENT);
  EXPECT_THAT(strut_last_error(), HasSubstr("controls"));
}

TEST_F(VersionedStructs, OfNewerCallersAreFilledWithZerosWhereNothingIsKnown) {
  constexpr std::size_t kNew = sizeof(strut_joint) + 8;
  Sized<strut_joint> newer(kNew);
  newer.set(0, static_cast<std::uint32_t>(kNew));
  ASSERT_EQ(strut_model_get_joint(model_.get(), 5, nullptr, newer.get()), STRUT_OK);
  EXPECT_EQ(newer.at<std::uint32_t>(0), kNew);
  EXPECT_EQ(newer.at<std::int32_t>(offsetof(strut_joint, parent)), 4);
  EXPECT_EQ(newer.at<std::uint64_t>(sizeof(strut_joint)), 0U);
}

TEST_F(VersionedStructs, OfImpossibleSizesAreRefused) {
  strut_controls controls{};
  for (const std::uint32_t size : {0U, 1U, 3U, 4097U, 0xFFFFFFFFU}) {
    controls.struct_size = size;
    EXPECT_EQ(strut_translator_set_controls(translator_.get(), &controls), STRUT_INVALID_ARGUMENT) << size;
    EXPECT_EQ(strut_translator_get_controls(translator_.get(), &controls), STRUT_INVALID_ARGUMENT) << size;
    EXPECT_EQ(strut_controls_init(&controls, size), STRUT_INVALID_ARGUMENT) << size;
    EXPECT_THAT(strut_last_error(), HasSubstr("controls.struct_size"));
  }
}

}  // namespace
}  // namespace strut::test
