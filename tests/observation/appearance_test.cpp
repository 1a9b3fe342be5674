#include "observation/background/appearance.h"

#include <cmath>

#include <gtest/gtest.h>

namespace walktrack {
namespace {

constexpr std::array<bool, kAppearanceCount> kAllClasses{true, true, true, true, true};

double density_sum(const ColourBins& bins, const ColourTable& table) {
  double sum = 0;
  for (int bin = 0; bin < kColourBins; ++bin)
    sum += std::exp(static_cast<double>(table[static_cast<size_t>(bin)])) * bins.volume(bin);
  return sum;
}

// `pixels` pixels of one colour, all certainly foreground, in one class.
AppearanceModel::Counts counts_of(const AppearanceModel& model, int cls, int bin, float pixels) {
  AppearanceModel::Counts counts = model.empty_counts();
  counts.weights[static_cast<size_t>(cls)][static_cast<size_t>(bin)] = pixels;
  counts.seen[static_cast<size_t>(cls)] = static_cast<double>(pixels);
  return counts;
}

TEST(AppearanceModel, BroadModelIsADensity) {
  const ColourBins bins;
  // Chromas are mid-point values of a Laplace density over bins of finite width.
  EXPECT_NEAR(density_sum(bins, broad_table(bins)), 1, 0.03);
}

TEST(AppearanceModel, LearnedModelsAreDensitiesAndKnowTheirColour) {
  const ColourBins bins;
  AppearanceModel model({}, kAllClasses);
  const int red = bins.bin(90, 80, -20), blue = bins.bin(90, -80, -10);
  model.learn(bins, counts_of(model, 1, red, 500));
  EXPECT_TRUE(model.learned(1));
  EXPECT_FALSE(model.learned(0));
  const ColourTable& table = model.table(1);
  EXPECT_NEAR(density_sum(bins, table), 1, 0.03);
  const ColourTable broad = broad_table(bins);
  const auto gain = [&](int bin) {
    return table[static_cast<size_t>(bin)] - broad[static_cast<size_t>(bin)];
  };
  EXPECT_GT(gain(red), 3);
  EXPECT_LT(gain(blue), -1);
  EXPECT_GT(gain(bins.bin(75, 85, -22)), 2) << "a neighbouring shade";
}

TEST(AppearanceModel, FewPixelsConvinceLess) {
  const ColourBins bins;
  AppearanceModel few({}, kAllClasses), many({}, kAllClasses);
  const int red = bins.bin(90, 80, -20);
  few.learn(bins, counts_of(few, 0, red, 20));
  many.learn(bins, counts_of(many, 0, red, 2000));
  EXPECT_LT(few.table(0)[static_cast<size_t>(red)], many.table(0)[static_cast<size_t>(red)]);
}

TEST(AppearanceModel, DoesNotLearnFromMisses) {
  const ColourBins bins;
  AppearanceModel model({}, kAllClasses);
  const int red = bins.bin(90, 80, -20);
  AppearanceModel::Counts counts = counts_of(model, 0, red, 100);
  counts.seen[0] = 1000;  // nine pixels in ten were background
  model.learn(bins, counts);
  model.learn(bins, counts_of(model, 2, red, 4));  // a foot that is almost hidden
  EXPECT_FALSE(model.any_learned());
}

// Brown trousers before a lawn are taken for its shadow until their colours are known. The pose is
// right if everything else is foreground.
TEST(AppearanceModel, LearnsWhatLooksMuchLikeTheBackground) {
  const ColourBins bins;
  const int brown = bins.bin(90, 80, -20);
  const auto learns = [&](float trousers, float shirt, int frames = 10) {
    AppearanceModel model({}, kAllClasses);
    for (int i = 0; i < frames; ++i) model.learn(bins, counts_of(model, 2, brown, 600));
    AppearanceModel::Counts counts = counts_of(model, 0, brown, trousers);
    counts.weights[2][static_cast<size_t>(brown)] = shirt;
    counts.seen[0] = 600;
    counts.seen[2] = 700;
    model.learn(bins, counts);
    return model.learned(0);
  };
  EXPECT_TRUE(learns(100, 600));
  EXPECT_FALSE(learns(100, 300)) << "the figure may be beside the person";
  EXPECT_FALSE(learns(20, 600)) << "hidden";
  EXPECT_FALSE(learns(100, 600, 9)) << "the first poses are uncertain";
}

TEST(AppearanceModel, NeverForgetsItsFirstFrames) {
  const ColourBins bins;
  AppearanceModel model({}, kAllClasses);
  const int red = bins.bin(90, 80, -20), blue = bins.bin(90, -80, -10);
  for (int i = 0; i < 10; ++i) model.learn(bins, counts_of(model, 0, red, 300));
  const float at_first = model.table(0)[static_cast<size_t>(red)];
  for (int i = 0; i < 1000; ++i) model.learn(bins, counts_of(model, 0, blue, 300));
  // Half of the model remains: log 2 less. The rest is due to smoothing of the other colour.
  EXPECT_NEAR(static_cast<double>(model.table(0)[static_cast<size_t>(red)]),
              static_cast<double>(at_first) - std::log(2), 0.01);
  EXPECT_GT(model.table(0)[static_cast<size_t>(blue)],
            broad_table(bins)[static_cast<size_t>(blue)] + 2);
}

TEST(AppearanceModel, OneFrameOfAnotherColourChangesLittle) {
  const ColourBins bins;
  const ForegroundConfig config;
  AppearanceModel model(config, kAllClasses);
  const int red = bins.bin(90, 80, -20), blue = bins.bin(90, -80, -10);
  for (int i = 0; i < 50; ++i) model.learn(bins, counts_of(model, 0, red, 300));
  const double before = static_cast<double>(model.table(0)[static_cast<size_t>(red)]);
  model.learn(bins, counts_of(model, 0, blue, 300));
  // The recent half loses the share of one frame.
  const double after = std::log(1 - (1 - config.anchor_share) * config.learning_rate);
  EXPECT_NEAR(static_cast<double>(model.table(0)[static_cast<size_t>(red)]), before + after, 1e-3);
}

TEST(AppearanceModel, ClassesAreAMatterOfConfigAndBody) {
  EXPECT_EQ(AppearanceModel({}, kAllClasses).classes(), 5);
  ForegroundConfig merged;
  merged.classes = {0, 3, 3, 1, 1};
  const AppearanceModel model(merged, kAllClasses);
  EXPECT_EQ(model.classes(), 3);
  EXPECT_EQ(model.class_of()[1], model.class_of()[2]);
  EXPECT_EQ(model.class_of()[3], model.class_of()[4]);
  EXPECT_NE(model.class_of()[0], model.class_of()[1]);
  EXPECT_EQ(AppearanceModel({}, {true, true, false, false, false}).classes(), 2);
}

}  // namespace
}  // namespace walktrack
