#include "observation/background/background_sampler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/conventions.h"
#include "core/errors.h"
#include "core/rng.h"
#include "observation/background/appearance.h"
#include "observation/background/picture_change.h"

namespace walktrack {
namespace {

constexpr int kWidth = 96, kHeight = 64;

// A smooth coloured scene; `noise` is a standard deviation of every channel.
cv::Mat scene(Rng& rng, double noise, double gain = 1) {
  cv::Mat image(kHeight, kWidth, CV_8UC3);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const double base[] = {90 + 0.5 * x, 120 + 0.4 * y, 140 - 0.3 * x};
      for (int c = 0; c < 3; ++c)
        image.at<cv::Vec3b>(y, x)[c] =
            cv::saturate_cast<uint8_t>(gain * base[c] + noise * rng.normal());
    }
  }
  return image;
}

void scale(cv::Mat& image, const cv::Rect& where, double factor) {
  image(where).convertTo(image(where), -1, factor);
}

BackgroundModel model_of(const std::vector<cv::Mat>& frames, const BackgroundConfig& config = {}) {
  BackgroundSampler sampler(config);
  for (const cv::Mat& frame : frames) sampler.add(frame);
  return sampler.model();
}

// Log-ratios of "any colour" to the background over a whole frame.
std::vector<double> log_ratios(const BackgroundModel& model, const cv::Mat& frame) {
  const ColourBins bins;
  const ColourTable broad = broad_table(bins, model.change.colourless);
  const PixelRect all{0, 0, frame.cols, frame.rows};
  ColourPatch patch;
  read_colours(frame, all, patch);
  const double gain = light_gain(model, frame);
  std::vector<float> row(static_cast<size_t>(frame.cols));
  std::vector<double> out;
  for (int y = 0; y < frame.rows; ++y) {
    background_log_density(model, {}, patch, all, y, gain, row);
    for (int x = 0; x < frame.cols; ++x) {
      const size_t i = patch.index(x, y);
      const float fore = broad[bins.bin(patch.luma[i], patch.orange[i], patch.green[i])];
      out.push_back(static_cast<double>(fore - row[static_cast<size_t>(x)]));
    }
  }
  return out;
}

// Share of the pixels of a rectangle that look more like foreground than background.
double foreground_share(const std::vector<double>& ratios, const cv::Rect& where) {
  int count = 0;
  for (int y = where.y; y < where.y + where.height; ++y)
    for (int x = where.x; x < where.x + where.width; ++x)
      count += ratios[static_cast<size_t>(y * kWidth + x)] > 0;
  return count / static_cast<double>(where.area());
}

const cv::Rect kEverywhere(0, 0, kWidth, kHeight), kBox(30, 20, 20, 24);

TEST(Background, EmptySceneIsBackground) {
  Rng rng(1, Purpose::kTest);
  const BackgroundModel one = model_of({scene(rng, 2)});
  std::vector<cv::Mat> frames;
  for (int i = 0; i < 12; ++i) frames.push_back(scene(rng, 2));
  const BackgroundModel many = model_of(frames);
  for (const BackgroundModel& model : {one, many})
    EXPECT_LT(foreground_share(log_ratios(model, scene(rng, 2)), kEverywhere), 0.002);
}

TEST(Background, ThingsStandOutAndShadowsDoNot) {
  Rng rng(2, Purpose::kTest);
  const BackgroundModel model = model_of({scene(rng, 2)});
  cv::Mat frame = scene(rng, 2);
  frame(kBox) = cv::Scalar(60, 70, 150);
  EXPECT_GT(foreground_share(log_ratios(model, frame), kBox), 0.98);
  for (const double strength : {0.9, 0.75, 0.6, 0.5}) {
    frame = scene(rng, 2);
    scale(frame, kBox, strength);
    const std::vector<double> ratios = log_ratios(model, frame);
    // Without its edge, which is sharper here than a real shadow's.
    const cv::Rect inside(kBox.x + 1, kBox.y + 1, kBox.width - 2, kBox.height - 2);
    EXPECT_LT(foreground_share(ratios, inside), 0.01) << strength;
  }
  frame = scene(rng, 2);
  scale(frame, kBox, 0.2);  // far too dark for a shadow: dark clothes
  EXPECT_GT(foreground_share(log_ratios(model, frame), kBox), 0.9);
}

TEST(Levels, AreRaisedWhereNineTenthsAreDark) {
  const auto of = [](double share_of_lamps, float rest) {
    std::vector<float> luma(1000, rest);
    for (size_t i = 0; static_cast<double>(i) < 1000 * share_of_lamps; ++i) luma[i] = 250;
    const Levels levels = levels_of_dark(luma);
    EXPECT_EQ(levels.black, 0);
    return levels.gain;
  };
  EXPECT_EQ(of(0, 200), 1);
  EXPECT_EQ(of(0, 85), 1);
  EXPECT_EQ(of(0, 80), 1.6F);
  EXPECT_EQ(of(0, 32), 4);
  EXPECT_EQ(of(0.05, 32), 4);  // a lamp in the picture
  EXPECT_EQ(of(0.2, 32), 1);   // a window
  EXPECT_EQ(of(0, 0), 8);      // the most
}

// The darkest and the brightest values come to be as far from the ends of the range as usual,
TEST(Levels, AreStretchedWhereTheRangeIsSmall) {
  const auto of = [](float lowest, float highest, float noise = 0) {
    LumaRange range;
    for (const float each : {lowest, highest}) range.take(each);
    return range.levels(noise);
  };
  for (const auto& [lowest, highest] : {std::pair{70.F, 182.F}, {100.F, 150.F}, {40.F, 220.F}}) {
    const Levels levels = of(lowest, highest);
    EXPECT_NEAR(levels.gain * (highest - lowest), 224, 1e-3F) << lowest;
    EXPECT_NEAR(levels.gain * (lowest - levels.black), 15.5F, 1e-3F) << lowest;
  }
  EXPECT_FALSE(of(20, 215).stretch());
  EXPECT_EQ(of(0, 158).black, 0);  // black stays black
  EXPECT_EQ(of(90, 100).gain, kMostGain);
  EXPECT_EQ(of(90, 90).gain, kMostGain);
  EXPECT_FALSE(LumaRange{}.is_small()) << "no picture";
  EXPECT_EQ(of(70, 182, 0.25F).gain, 2);
  EXPECT_EQ(of(70, 182, 0.5F).gain, 1.5F);  // the noise becomes as large as usual
  EXPECT_FALSE(of(70, 182, 0.75F).stretch());
}

// Values become brighter, and noise does not become larger.
TEST(Levels, BlurTheNoiseAway) {
  Rng rng(11, Purpose::kTest);
  cv::Mat dark(200, 300, CV_8UC3);
  for (int y = 0; y < dark.rows; ++y)
    for (int x = 0; x < dark.cols; ++x)
      for (int c = 0; c < 3; ++c)
        dark.at<cv::Vec3b>(y, x)[c] = cv::saturate_cast<uint8_t>(24 + 3 * rng.normal());
  cv::Scalar mean, deviation, before;
  cv::meanStdDev(dark, mean, before);
  for (const float gain : {1.5F, 2.5F, 5.0F}) {
    cv::meanStdDev(stretched(dark, {4, gain}), mean, deviation);
    EXPECT_NEAR(mean[1], 20 * static_cast<double>(gain), 1) << gain;
    EXPECT_LT(deviation[1], 1.05 * before[1]) << gain;
  }
}

// A seventh of the light: without more of it most of the thing looks like the background.
TEST(Background, ThingsStandOutInTheDark) {
  Rng rng(12, Purpose::kTest);
  std::vector<cv::Mat> frames;
  for (int i = 0; i < 10; ++i) frames.push_back(scene(rng, 2.5, 0.15));
  const BackgroundModel model = model_of(frames);
  EXPECT_GT(model.change.levels.gain, 5);
  cv::Mat frame = scene(rng, 2.5, 0.15);
  for (int y = kBox.y; y < kBox.y + kBox.height; ++y)
    for (int x = kBox.x; x < kBox.x + kBox.width; ++x)
      for (int c = 0; c < 3; ++c)
        frame.at<cv::Vec3b>(y, x)[c] = cv::saturate_cast<uint8_t>(
            0.15 * std::array{60, 70, 150}[static_cast<size_t>(c)] + 2.5 * rng.normal());
  const std::vector<double> ratios = log_ratios(model, stretched(frame, model.change.levels));
  EXPECT_GT(foreground_share(ratios, kBox), 0.8);
  EXPECT_LT(foreground_share(ratios, {0, 0, 24, kHeight}), 0.05);
  EXPECT_EQ(model_of({scene(rng, 2)}).change.levels.gain, 1);
}

// Law: what stands out does not depend on the contrast of the camera. Grey clothes before a grey
// wall in a haze look like the wall unless its levels are stretched.
TEST(Background, ThingsStandOutInAHaze) {
  const auto seen = [](double contrast, bool stretch) {
    Rng rng(13, Purpose::kTest);
    const auto hazy = [&](cv::Mat picture) {
      picture.convertTo(picture, -1, contrast, 125 * (1 - contrast));
      return picture;
    };
    const auto with_thing = [&] {
      cv::Mat picture = scene(rng, 1);
      picture(kBox).setTo(cv::Scalar::all(95));
      picture({0, 0, 8, 4}).setTo(cv::Scalar::all(8));
      picture({8, 0, 8, 4}).setTo(cv::Scalar::all(247));
      return hazy(picture);
    };
    BackgroundSampler sampler({});
    for (int i = 0; i < 10; ++i) sampler.add(hazy(scene(rng, 1)));
    EXPECT_FALSE(sampler.has_little_contrast()) << "before the video is known";
    const cv::Mat frame = with_thing();
    if (stretch) sampler.show(frame);
    EXPECT_EQ(sampler.has_little_contrast(), stretch && contrast < 0.7);
    const BackgroundModel model = sampler.model();
    return foreground_share(log_ratios(model, changed(frame, model.change)), kBox);
  };
  const double clear = seen(1, true);
  EXPECT_GT(clear, 0.5);
  EXPECT_GT(seen(0.4, true), 0.8 * clear);
  EXPECT_LT(seen(0.4, false), 0.2 * clear);
}

TEST(Colourless, IsWhatHasNoColourInNinetyNineOfAHundredPixels) {
  const auto of = [](double share_of_red, float rest, float brightness = 1) {
    std::vector<float> chroma(1000, rest);
    for (size_t i = 0; static_cast<double>(i) < 1000 * share_of_red; ++i) chroma[i] = 120;
    return is_colourless(chroma, brightness);
  };
  EXPECT_TRUE(of(0, 0));
  EXPECT_TRUE(of(0, 14));
  EXPECT_FALSE(of(0, 15));
  EXPECT_TRUE(of(.005, 3));   // a red lamp
  EXPECT_FALSE(of(.02, 3));   // a red door
  EXPECT_FALSE(of(0, 4, 5));  // colours in the dark
  EXPECT_TRUE(of(0, 3, 8));   // rounding in the dark
}

// Somebody in grey before a monochrome camera, a little lighter than the wall or darker than a
// shadow can be. What is as dark as a shadow may be one: it gives little evidence.
TEST(Background, ThingsStandOutWithoutColours) {
  Rng rng(13, Purpose::kTest);
  const auto grey = [&rng] { return without_colours(scene(rng, 2)); };
  std::vector<cv::Mat> frames;
  for (int i = 0; i < 10; ++i) frames.push_back(grey());
  const BackgroundModel model = model_of(frames);
  EXPECT_TRUE(model.change.colourless);
  const auto median_ratio = [&](double factor) {
    cv::Mat frame = grey();
    scale(frame, kBox, factor);
    const std::vector<double> all = log_ratios(model, frame);
    std::vector<double> inside;
    for (int y = kBox.y + 1; y < kBox.y + kBox.height - 1; ++y)
      for (int x = kBox.x + 1; x < kBox.x + kBox.width - 1; ++x)
        inside.push_back(all[static_cast<size_t>(y * kWidth + x)]);
    std::nth_element(inside.begin(), inside.begin() + std::ssize(inside) / 2, inside.end());
    return inside[inside.size() / 2];
  };
  EXPECT_LT(median_ratio(1), -3);
  EXPECT_GT(median_ratio(1.15), 4);
  EXPECT_GT(median_ratio(0.3), 4);
  for (const double shadow : {0.85, 0.7, 0.55}) {
    EXPECT_GT(median_ratio(shadow), -1) << shadow;
    EXPECT_LT(median_ratio(shadow), 3) << shadow;
  }
  EXPECT_FALSE(model_of({scene(rng, 2)}).change.colourless);
}

// Chroma that gives no evidence: it has the same density under both.
TEST(Background, GreyIsAsProbableUnderPeopleAsUnderTheBackgroundWithoutColours) {
  const ColourBins bins;
  const double sd = BackgroundConfig{}.noise;
  const double background = -std::log(2 * kPi * sd * sd);
  const auto person = [&](bool colourless) {
    return static_cast<double>(broad_table(bins, colourless)[bins.bin(100, 0, 0)]) + std::log(256);
  };
  EXPECT_NEAR(person(true), background, 0.1);
  EXPECT_LT(person(false), background - 4);
}

// Something that changes its colour in every frame: the medians of luma and of chroma are those of
// different frames, and no frame has a colour near both.
TEST(Background, IsFiniteWhereNoFrameShowsTheMedianColour) {
  std::vector<cv::Mat> frames;
  for (const cv::Scalar& colour :
       {cv::Scalar(120, 120, 120), cv::Scalar(0, 160, 0), cv::Scalar(160, 240, 160),
        cv::Scalar(255, 0, 0), cv::Scalar(0, 0, 255), cv::Scalar(0, 60, 255)}) {
    frames.emplace_back(kHeight, kWidth, CV_8UC3, cv::Scalar(90, 120, 140));
    frames.back()(kBox) = colour;
  }
  const BackgroundModel model = model_of(frames);
  for (const auto* plane :
       {&model.luma, &model.orange, &model.green, &model.luma_precision, &model.chroma_precision})
    EXPECT_TRUE(std::ranges::all_of(*plane, [](float v) { return std::isfinite(v); }));
}

TEST(Background, FlickerIsCompensated) {
  Rng rng(3, Purpose::kTest);
  const BackgroundModel model = model_of({scene(rng, 1)});
  for (const double gain : {0.8, 0.93, 1.07, 1.2}) {
    cv::Mat frame = scene(rng, 1, gain);
    frame(kBox) = cv::Scalar(60, 70, 150);
    EXPECT_NEAR(light_gain(model, frame), gain, 0.01);
    const std::vector<double> ratios = log_ratios(model, frame);
    EXPECT_GT(foreground_share(ratios, kBox), 0.98) << gain;
    EXPECT_LT(foreground_share(ratios, {0, 0, 28, kHeight}), 0.01) << gain;
  }
}

TEST(Background, IsFoundBehindAWalkerWhoCoversItHalfTheTime) {
  Rng rng(4, Purpose::kTest);
  std::vector<cv::Mat> frames;
  for (int i = 0; i < 24; ++i) {
    frames.push_back(scene(rng, 2, 1 + 0.04 * std::sin(i)));
    // In five frames of ten the box is covered by clothes with changing folds.
    if (i % 2 == 0) frames.back()(kBox) = cv::Scalar(60, 70, 150) + cv::Scalar::all(3 * (i % 8));
  }
  const BackgroundModel model = model_of(frames);
  const cv::Mat truth = scene(rng, 0);
  double worst = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const cv::Vec3b& c = truth.at<cv::Vec3b>(y, x);
      const double luma = 0.25 * (c[0] + 2 * c[1] + c[2]);
      worst = std::max(
          worst,
          std::abs(static_cast<double>(model.luma[static_cast<size_t>(y * kWidth + x)]) - luma));
    }
  }
  // Twelve samples with a standard deviation of 2, and the frames' brightness within 1 %: five
  // sigma.
  EXPECT_LT(worst, 5 * 2 / std::sqrt(12.0) + 0.01 * 140);
  EXPECT_LT(foreground_share(log_ratios(model, scene(rng, 2)), kEverywhere), 0.01);
}

// A person who stands in most frames is not part of the background if their pixels are known; what
// they always hide is marked as unknown.
TEST(Background, LeavesOutWhatIsHidden) {
  Rng rng(9, Purpose::kTest);
  const cv::Rect always(70, 10, 8, 8);
  BackgroundSampler sampler({});
  for (int i = 0; i < 20; ++i) {
    cv::Mat frame = scene(rng, 2);
    if (i < 15) frame(kBox) = cv::Scalar(60, 70, 150);
    frame(always) = cv::Scalar(20, 30, 220);
    sampler.add(frame);
  }
  EXPECT_GT(foreground_share(log_ratios(sampler.model(), scene(rng, 2)), kBox), 0.95);
  cv::Mat mask = cv::Mat::zeros(kHeight, kWidth, CV_8U);
  mask(always) = 255;
  for (int i = 0; i < sampler.frames(); ++i) {
    mask(kBox) = i < 15 ? 255 : 0;
    sampler.hide(i, mask);
  }
  const BackgroundModel model = sampler.model();
  const std::vector<double> ratios = log_ratios(model, scene(rng, 2));
  EXPECT_LT(foreground_share(ratios, kBox), 0.05);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      EXPECT_EQ(never_seen(model.luma_precision[static_cast<size_t>(y * kWidth + x)]),
                always.contains({x, y}));
}

TEST(Background, MemoryIsBounded) {
  BackgroundConfig config;
  config.samples = 8;
  BackgroundSampler sampler(config);
  Rng rng(5, Purpose::kTest);
  const cv::Mat frame = scene(rng, 2);
  for (int i = 0; i < 100; ++i) {
    sampler.add(frame);
    EXPECT_LE(sampler.frames(), 8);
    EXPECT_GE(sampler.frames(), std::min(i + 1, 4));
  }
  EXPECT_EQ(sampler.model().width, kWidth);
  EXPECT_THROW(BackgroundSampler(config).model(), InputError);
}

// Pixels that do not change are summed in rows, others are sorted one by one: both give the plain
// mean if every sample counts.
TEST(Background, StillPixelsHaveTheMeanAndVarianceOfTheirSamples) {
  constexpr int kFrames = 30;
  BackgroundConfig config;
  config.noise = 0.1;
  config.jitter_px = 0;
  for (const double noise : {2.0, 4.0}) {  // few pixels are sorted; nearly all are
    Rng rng(1, Purpose::kTest);
    std::vector<cv::Mat> frames;
    for (int i = 0; i < kFrames; ++i) frames.push_back(scene(rng, noise));
    const BackgroundModel model = model_of(frames, config);
    double squares = 0, variance = 0, stated = 0;
    for (size_t i = 0; i < model.luma.size(); ++i) {
      double sum = 0, square = 0;
      for (const cv::Mat& frame : frames) {
        const uint8_t* p = frame.data + 3 * i;
        const double luma = 0.25 * (p[0] + 2 * p[1] + p[2]);
        sum += luma;
        square += luma * luma;
      }
      squares += std::pow(static_cast<double>(model.luma[i]) - sum / kFrames, 2);
      variance += (square - sum * sum / kFrames) / (kFrames - 1);
      stated += 1 / static_cast<double>(model.luma_precision[i]);
    }
    const auto n = static_cast<double>(model.luma.size());
    EXPECT_LT(std::sqrt(squares / n), 0.05 * noise) << noise;  // the brightness is estimated, too
    EXPECT_NEAR(stated / variance, 1, 0.05) << noise;
  }
}

TEST(Background, IsFoundBehindAWalkerWhoDiffersInColourAlone) {
  Rng rng(1, Purpose::kTest);
  const BackgroundModel empty = model_of({scene(rng, 0)});
  std::vector<cv::Mat> frames;
  for (int i = 0; i < 12; ++i) {
    frames.push_back(scene(rng, 1));
    if (i % 3 == 0) frames.back()(kBox) += cv::Scalar(-30, 0, 30);
  }
  const BackgroundModel model = model_of(frames);
  for (size_t i = 0; i < model.orange.size(); ++i)
    ASSERT_NEAR(model.orange[i], empty.orange[i], 3) << i;
}

TEST(Background, ThreadsDoNotMatter) {
  Rng rng(7, Purpose::kTest);
  BackgroundSampler sampler({});
  for (int i = 0; i < 12; ++i) sampler.add(scene(rng, 3, 0.8 + 0.03 * i));
  const BackgroundModel one = sampler.model(1), many = sampler.model(8);
  EXPECT_EQ(one.luma, many.luma);
  EXPECT_EQ(one.chroma_precision, many.chroma_precision);
}

TEST(Background, DriftIsFollowedAndBodiesAreNot) {
  Rng rng(6, Purpose::kTest);
  BackgroundModel model = model_of({scene(rng, 0)});
  const BackgroundModel before = model;
  cv::Mat frame = scene(rng, 0) + cv::Scalar(4, 0, 0);  // bluer, within three deviations
  frame(kBox) = cv::Scalar(60, 70, 150);
  for (int i = 0; i < 400; ++i) follow_drift(model, {}, frame, 1, i % 8, 8);
  const auto at = [](int x, int y) { return static_cast<size_t>(y * kWidth + x); };
  EXPECT_NEAR(static_cast<double>(model.orange[at(5, 5)]),
              static_cast<double>(before.orange[at(5, 5)]) - 4, 0.1);
  EXPECT_EQ(model.orange[at(40, 30)], before.orange[at(40, 30)]);
}

// The density of the header, in doubles and with library logarithms.
double reference(const BackgroundModel& m, const BackgroundConfig& c, const ColourPatch& p, int x,
                 int y) {
  const auto at = [&](const std::vector<float>& channel, int i, int j) {
    const int column = std::clamp(i, 0, kWidth - 1), row = std::clamp(j, 0, kHeight - 1);
    return static_cast<double>(channel[static_cast<size_t>(row * kWidth + column)]);
  };
  const auto slope = [&](const std::vector<float>& channel) -> Eigen::Vector2d {
    return Eigen::Vector2d(at(channel, x + 1, y) - at(channel, x - 1, y),
                           at(channel, x, y + 1) - at(channel, x, y - 1)) /
           2;
  };
  const auto normal = [](double squared, double variance) {
    return std::exp(-0.5 * squared / variance) / std::sqrt(2 * kPi * variance);
  };
  const double vl = 1 / at(m.luma_precision, x, y), vc = 1 / at(m.chroma_precision, x, y);
  const double mu = at(m.luma, x, y), luma = at(p.luma, x, y);
  const auto gradient = [&](double a) {
    const double miss = (slope(p.luma) - a * slope(m.luma)).squaredNorm();
    const double fore = 4 / (2 * kPi * std::pow(16 + slope(p.luma).squaredNorm(), 1.5));
    const double back = std::exp(-0.5 * miss / (vl / 2)) / (2 * kPi * vl / 2);
    return std::pow(std::max(back / fore, std::exp(-3.0)), c.gradient_weight);
  };
  const auto chroma = [&](double a, double variance) {
    return normal(std::pow(at(p.orange, x, y) - a * at(m.orange, x, y), 2), variance) *
           normal(std::pow(at(p.green, x, y) - a * at(m.green, x, y), 2), variance);
  };
  const double plain = (1 - c.shadow_share - c.unknown_share) * normal(std::pow(luma - mu, 2), vl) *
                       chroma(1, vc) * gradient(1);
  const double a = std::clamp(luma / mu, c.shadow_darkest, 1.0);
  const double tint = vc + std::pow(c.shadow_tint, 2) + std::pow(c.shadow_sky * (1 - a) * mu, 2);
  const double shadow = c.shadow_share / (1 - c.shadow_darkest) / mu *
                        std::exp(-0.5 * std::pow(luma - a * mu, 2) / vl) * chroma(a, tint) *
                        gradient(a);
  return std::log(std::max({plain, shadow, c.unknown_share / std::pow(256, 3)}));
}

TEST(Background, DensityIsThatOfTheHeader) {
  Rng rng(7, Purpose::kTest);
  const BackgroundConfig config;
  const BackgroundModel model = model_of({scene(rng, 6)});
  cv::Mat frame = scene(rng, 4);
  scale(frame, kBox, 0.6);
  ColourPatch patch;
  const PixelRect all{0, 0, kWidth, kHeight};
  read_colours(frame, all, patch);
  std::vector<float> row(kWidth);
  for (int y = 0; y < kHeight; ++y) {
    background_log_density(model, config, patch, all, y, 1, row);
    for (int x = 1; x < kWidth - 1; ++x) {
      // Single precision at log-densities of -20 and sums of squares of up to 50.
      EXPECT_NEAR(static_cast<double>(row[static_cast<size_t>(x)]),
                  reference(model, config, patch, x, y), 2e-3)
          << x << ", " << y;
    }
  }
}

// A person who has left the image leaves an area without columns at its border.
TEST(Background, AnAreaWithoutColumnsWritesNothing) {
  Rng rng(11, Purpose::kTest);
  const cv::Mat frame = scene(rng, 4);
  const BackgroundModel model = model_of({frame});
  for (const int edge : {0, kWidth}) {
    const PixelRect none{edge, 0, edge, kHeight};
    ColourPatch patch;
    read_colours(frame, {std::max(0, edge - 1), 0, std::min(edge + 1, kWidth), kHeight}, patch);
    std::array<float, 3> memory{7, 7, 7};
    background_log_density(model, {}, patch, none, 1, 1, std::span(memory).subspan(1, 0));
    EXPECT_EQ(memory, (std::array<float, 3>{7, 7, 7})) << "edge " << edge;
  }
}

}  // namespace
}  // namespace walktrack
