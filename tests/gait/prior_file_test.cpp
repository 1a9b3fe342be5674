#include "gait/prior/prior_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.h"

namespace walktrack {
namespace {

GaitPrior small_prior() {
  GaitPrior prior;
  prior.speeds = {0.3, 0.4};
  prior.ratios = {1};
  prior.slopes = {0};
  prior.nodes.resize(2);
  prior.nodes[1].cyclic = prior.nodes[1].valid = true;
  prior.nodes[1].clearance = 0.0125;
  for (int i = 0; i < kGaitSize; ++i) prior.nodes[1].gait[i] = 0.1 * i - 0.3;
  prior.nodes[1].gain(2, 3) = 0.75;
  return prior;
}

std::string message_of(const std::string& text) {
  try {
    parse_gait_prior(text, "table");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(PriorFile, RoundTrip) {
  const GaitPrior prior = small_prior();
  const GaitPrior read = parse_gait_prior(gait_prior_text(prior, "1.2"), "table");
  EXPECT_EQ(read.speeds, prior.speeds);
  ASSERT_EQ(read.nodes.size(), 2u);
  EXPECT_FALSE(read.nodes[0].valid);
  EXPECT_TRUE(read.nodes[1].cyclic);
  EXPECT_TRUE(read.nodes[1].valid);
  EXPECT_EQ(read.nodes[1].clearance, 0.0125);
  EXPECT_LT((read.nodes[1].gait - prior.nodes[1].gait).norm(), 1e-9);
  EXPECT_EQ(read.nodes[1].gain, prior.nodes[1].gain);
}

TEST(PriorFile, DamagedTextIsRefusedWithItsPlace) {
  const std::string text = gait_prior_text(small_prior(), "1.2");
  EXPECT_THAT(message_of("walktrack gait prior, version 9\n"),
              testing::AllOf(testing::HasSubstr("table:1"), testing::HasSubstr("version 1")));
  std::string altered = text;
  altered.replace(altered.find("0.75"), 4, "0.76");
  EXPECT_THAT(message_of(altered), testing::HasSubstr("checksum"));
  altered.replace(altered.find("0.76"), 4, "x.76");
  EXPECT_THAT(message_of(altered),
              testing::AllOf(testing::HasSubstr("'x.76'"), testing::HasSubstr("a number")));
  EXPECT_NE(message_of(text.substr(0, text.size() / 2)), "");
  EXPECT_NE(message_of(""), "");
}

TEST(PriorFile, AnthropomorphicRoundTrip) {
  StraightPrior prior{{{0.3}, {1}, {0, 0.04}}, std::vector<StraightNode>(2)};
  prior.nodes[1].cyclic = prior.nodes[1].valid = true;
  prior.nodes[1].least_normal = 0.75;
  prior.nodes[1].gait << 0.1, 0.2, 0.3, 0.4, 0.5;
  prior.nodes[1].gain(1, 2) = -0.25;
  const std::string text = straight_prior_text(prior, "1.2");
  const StraightPrior read = parse_straight_prior(text, "table");
  EXPECT_EQ(read.slopes, prior.slopes);
  EXPECT_TRUE(read.nodes[1].valid && read.nodes[1].cyclic && !read.nodes[0].valid);
  EXPECT_EQ(read.nodes[1].gait, prior.nodes[1].gait);
  EXPECT_EQ(read.nodes[1].gain, prior.nodes[1].gain);
  EXPECT_EQ(read.nodes[1].least_normal, 0.75);
  // The table of one walker is not accepted for the other.
  EXPECT_THROW(parse_gait_prior(text, "table"), InputError);
  EXPECT_THROW(parse_straight_prior(shipped_gait_prior_text(), "table"), InputError);
}

}  // namespace
}  // namespace walktrack
