// SPDX-License-Identifier: MIT
#include "small_effort.h"
#include "support/data.h"

#include <random>

#include <gtest/gtest.h>

#include <strut/core/error.h>
#include <strut/effort/effort_model_io.h>

namespace strut::effort {
namespace {

using test::small_effort_model;

TEST(EffortModelFile, ComesBackAsItWas) {
  const test::TemporaryFolder folder;
  const EffortModel& model = *small_effort_model();
  write_effort_model(folder.file("m.struteffort"), model);
  const auto read = read_effort_model(folder.file("m.struteffort"));
  ASSERT_EQ(read->fragments().size(), model.fragments().size());
  for (std::size_t i = 0; i < model.fragments().size(); ++i) {
    EXPECT_EQ(read->fragments()[i].motion.frames(), model.fragments()[i].motion.frames());
    EXPECT_EQ(read->fragments()[i].effort, model.fragments()[i].effort);
    EXPECT_EQ(read->fragments()[i].name, model.fragments()[i].name);
  }
  EXPECT_EQ(read->parts().pairs, model.parts().pairs);
  EXPECT_EQ(read->parts().threshold, model.parts().threshold);
  const Eigen::VectorXd alphas = Eigen::VectorXd::LinSpaced(9, -0.5, 1.5);
  const auto before = model.parts().regression.predict(0, 3, alphas),
             after = read->parts().regression.predict(0, 3, alphas);
  for (std::size_t a = 0; a < before.size(); ++a) {
    EXPECT_EQ(before[a].effort, after[a].effort);
    EXPECT_EQ(before[a].deviation, after[a].deviation);
  }
  EXPECT_EQ(format_effort_model(*read), format_effort_model(model));
}

TEST(EffortModelFile, KeepsWhatWasNotRated) {
  EffortExamples examples = test::small_examples();
  for (ModelFragment& fragment : examples.fragments) fragment.effort[kWeight] = kNotRated;
  const auto model = learn_effort(examples, {});
  const auto read = parse_effort_model(format_effort_model(*model), "x");
  EXPECT_FALSE(is_rated(read->fragment(0).effort[kWeight]));
  EXPECT_EQ(read->fragment(0).effort[kTime], model->fragment(0).effort[kTime]);
}

TEST(EffortModelFile, RefusesOtherFilesAndTruncatedOnes) {
  const std::string bytes = format_effort_model(*small_effort_model());
  EXPECT_THROW(parse_effort_model("", "x"), ParseError);
  EXPECT_THROW(parse_effort_model("HIERARCHY", "x"), ParseError);
  for (std::size_t size = 0; size < bytes.size(); size += 1 + bytes.size() / 50) {
    EXPECT_THROW(parse_effort_model(bytes.substr(0, size), "x"), ParseError);
  }
}

TEST(EffortModelFile, NeverCrashesOnDamagedBytes) {
  const std::string bytes = format_effort_model(*small_effort_model());
  std::mt19937 engine(7);
  int refused = 0;
  for (int round = 0; round < 150; ++round) {
    std::string spoilt = bytes;
    // Mostly where the structure is: at the end the tables, at the beginning what was written last.
    const std::size_t place = engine() % (round % 2 == 0 ? bytes.size() : 1500);
    spoilt[place] = static_cast<char>(engine());
    try {
      EXPECT_NE(parse_effort_model(spoilt, "x"), nullptr);
    } catch (const Error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 10);
}

}  // namespace
}  // namespace strut::effort
