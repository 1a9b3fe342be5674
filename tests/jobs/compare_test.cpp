#include "jobs/compare/compare.h"

#include <cmath>
#include <fstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/errors.h"
#include "io/archive/files.h"
#include "io/tables/csv.h"
#include "io/tables/motion_file.h"
#include "jobs/compare/compare_figures.h"
#include "jobs/evaluate/analyse.h"
#include "tests/data_folders.h"
#include "tests/message_of.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using Json = nlohmann::json;

class Compare : public testing::Test {
 protected:
  // The demo's walk analysed, `slower` times as slow, from row `first` on.
  fs::path result(const std::string& name, double slower = 1, size_t first = 0) const {
    Motion motion = read_motion(kDemo / "truth.csv");
    motion.time.erase(motion.time.begin(), motion.time.begin() + static_cast<long>(first));
    motion.joints.erase(motion.joints.begin(), motion.joints.begin() + static_cast<long>(first));
    for (double& time : motion.time) time *= slower;
    AnalyseJob job;
    job.motion = place_.write(name + ".csv", motion_csv(motion));
    job.output = place_.path() / name;
    analyse(job);
    return job.output;
  }
  CompareJob job(std::vector<CompareGroup> groups) const {
    CompareJob out;
    out.groups = std::move(groups);
    out.output = place_.path() / "compared";
    out.draws = 200;
    out.overwrite = true;
    return out;
  }
  Json compared(const CompareJob& job) const {
    compare(job);
    return Json::parse(read_file(job.output / "compare.json"));
  }
  const TemporaryFolder place_;
};

const Json& parameter(const Json& all, size_t comparison, size_t sample, const char* name) {
  return all.at("comparisons").at(comparison).at("samples").at(sample).at("parameters").at(name);
}

TEST_F(Compare, FindsASlowerWalkSlowerAndOfTheSameSteps) {
  const fs::path before = result("before"), after = result("after", 1.25);
  const Json all = compared(job({{"", {before}}, {"", {after}}}));
  ASSERT_EQ(all.at("comparisons").size(), 3u);
  const Json &speed = parameter(all, 0, 1, "speed_m_s"),
             &length = parameter(all, 0, 1, "step_length_m"),
             &time = parameter(all, 0, 1, "step_time_s");
  const double was = parameter(all, 0, 0, "speed_m_s").at("mean").get<double>();
  EXPECT_NEAR(speed.at("difference").get<double>(), was / 1.25 - was, 0.01);
  EXPECT_LT(speed.at("high").get<double>(), 0);
  EXPECT_TRUE(speed.at("exceeds").get<bool>());
  EXPECT_TRUE(time.at("exceeds").get<bool>());
  EXPECT_NEAR(length.at("difference").get<double>(), 0, 0.01);
  EXPECT_FALSE(length.at("exceeds").get<bool>());
  EXPECT_LE(length.at("low").get<double>(), 0);
  EXPECT_GE(length.at("high").get<double>(), 0);
  // After scaling in time, the curves over the cycle are the same.
  for (const double difference :
       all.at("comparisons")[0]["samples"][1]["angles"]["knee_flexion"]["difference"])
    EXPECT_NEAR(difference, 0, 1);
}

// The detectable change computed by hand: the demo's truth has no bands.
TEST_F(Compare, DetectableChangeIsTheScatterOfBothMeans) {
  const Json all = compared(job({{"", {result("a")}}, {"", {result("b", 1.1)}}}));
  const Json &a = parameter(all, 0, 0, "step_time_s"), &b = parameter(all, 0, 1, "step_time_s");
  const auto error_squared = [](const Json& one) {
    return std::pow(one.at("sd").get<double>(), 2) / one.at("count").get<double>();
  };
  const double of_a = error_squared(a), of_b = error_squared(b), n = a.at("count").get<double>();
  ASSERT_EQ(b.at("count"), a.at("count"));
  const double degrees = (of_a + of_b) * (of_a + of_b) * (n - 1) / (of_a * of_a + of_b * of_b);
  EXPECT_NEAR(b.at("detectable").get<double>(), students_t(0.025, degrees) * std::sqrt(of_a + of_b),
              1e-5);
  EXPECT_FALSE(b.at("with_bands").get<bool>());
}

TEST_F(Compare, OfOneGroupIsLeftAgainstRight) {
  const fs::path walk = result("walk");
  const Json all = compared(job({{"", {walk}}}));
  ASSERT_EQ(all.at("comparisons").size(), 1u);
  const Json& samples = all["comparisons"][0]["samples"];
  EXPECT_EQ(samples[0]["name"], "right");
  EXPECT_EQ(samples[1]["name"], "left");
  const Json summary = Json::parse(read_file(walk / "gait.json")).at("summary");
  for (size_t i : {0, 1}) {
    const std::string side = samples[i]["name"];
    EXPECT_NEAR(samples[i]["parameters"]["step_length_m"]["mean"].get<double>(),
                summary.at(side).at("step_length_m").at("value").get<double>(), 2e-6)
        << side;
  }
}

TEST_F(Compare, GroupsHoldTheResultsBelowTheirFolders) {
  const fs::path one = result("before/one"), two = result("before/two", 1.05);
  const fs::path after = result("after", 1.2);
  CompareJob both = job({{"", {place_.path() / "before"}}, {"later", {after}}});
  const Json strides = compared(both);
  ASSERT_EQ(strides.at("groups")[0].at("trials").size(), 2u);
  EXPECT_EQ(strides.at("groups")[0].at("name"), "before");
  EXPECT_EQ(strides.at("groups")[1].at("name"), "later");
  const size_t count = parameter(strides, 0, 0, "stride_time_s").at("count");
  EXPECT_EQ(count, 2 * parameter(strides, 0, 1, "stride_time_s").at("count").get<size_t>());
  both.unit = CompareUnit::kTrials;
  const Json trials = compared(both);
  EXPECT_EQ(parameter(trials, 0, 0, "stride_time_s").at("count"), 2);
  EXPECT_TRUE(parameter(trials, 0, 1, "stride_time_s").at("low").is_null());  // too few for a band
}

// Three trials of a group with known bands.
TEST(ParameterDifference, HasTheResultsOwnBandsInIt) {
  ComparedTrial trial;
  for (SideStrides& side : trial.sides) {
    side.band_sd.fill(0.04);
    side.values[0] = {1.0, 1.2, 1.1, 1.3};
  }
  const ComparedGroup group{"g", {trial, trial}};
  const Sample sample{"g", &group, {0}};
  CompareJob job;
  job.draws = 100;
  const ParameterDifference found = parameter_difference(sample, sample, 0, job);
  const double variance = 8.0 / 7 * 0.0125 / 8 + 0.04 * 0.04 / 2;
  EXPECT_TRUE(found.with_bands);
  const double scatter = 8.0 / 7 * 0.0125 / 8;
  const double degrees = 4 * variance * variance * 7 / (2 * scatter * scatter);
  EXPECT_NEAR(found.detectable, students_t(0.025, degrees) * std::sqrt(2 * variance), 1e-9);
  EXPECT_FALSE(found.exceeds());
}

TEST_F(Compare, TablesSayWhatTheJsonSays) {
  const CompareJob two = job({{"", {result("a")}}, {"a, b", {result("b", 1.1)}}});
  const Json all = compared(two);
  const std::string curves = read_file(two.output / "compare_curves.csv");
  EXPECT_EQ(std::count(curves.begin(), curves.end(), '\n'), 1 + 3 * 2 * 4 * 101);
  EXPECT_THAT(curves, HasSubstr("both,\"a, b\",knee_flexion,100,"));
  const std::string parameters = read_file(two.output / "compare_parameters.csv");
  EXPECT_THAT(parameters,
              HasSubstr(fmt::format("both,\"a, b\",step_time_s,{},{},",
                                    parameter(all, 0, 1, "step_time_s")["count"].get<int>(),
                                    parameter(all, 0, 1, "step_time_s")["mean"].get<double>())));
  const std::string page = read_file(two.output / "compare.html");
  EXPECT_EQ(page.find("<!--"), std::string::npos);
  const std::string first = read_file(two.output / "compare.json");
  compare(two);
  EXPECT_EQ(read_file(two.output / "compare.json"), first);
}

TEST_F(Compare, SaysWhatCannotBeCompared) {
  const fs::path walk = result("walk"), short_walk = result("short", 1, 95);
  place_.write("partial/run.partial.json", "{}");
  place_.write("other/run.json", "{}");
  place_.write("other/angles.csv", "t\n");
  place_.write("other/gait.json", R"({"format": "walktrack gait 9"})");
  const auto trouble = [&](const std::string& name) {
    return message_of([&] { compare(job({{"", {walk}}, {"", {place_.path() / name}}})); });
  };
  EXPECT_THAT(trouble("nowhere"), HasSubstr("nowhere: found no such folder, allowed: results of"));
  EXPECT_THAT(trouble("partial"), HasSubstr("partial: found an incomplete result"));
  EXPECT_THAT(trouble("walk.csv"), HasSubstr("walk.csv: found a file"));
  EXPECT_THAT(trouble("other"), HasSubstr("gait.json: found other contents"));
  EXPECT_THAT(trouble("short"), HasSubstr("short: found no whole stride"));
  EXPECT_THAT(message_of<UsageError>([&] {
                compare(job({{"", {walk}}, {"", {walk}}}));
              }),
              HasSubstr("found two groups of the name 'walk'"));
  EXPECT_FALSE(fs::exists(place_.path() / "compared"));
}

TEST(CompareGroup, IsAFolderOrANameWithFolders) {
  const CompareGroup named = compare_group("before=a/b,c");
  EXPECT_EQ(named.name, "before");
  EXPECT_EQ(named.places, (std::vector<fs::path>{"a/b", "c"}));
  const TemporaryFolder place;
  place.write("a=b/x", "");
  EXPECT_EQ(compare_group(place / "a=b").places.size(), 1u);
  EXPECT_EQ(compare_group(place / "a=b").name, "");
  EXPECT_THROW(compare_group("=x"), UsageError);
  EXPECT_THROW(compare_group("x=,"), UsageError);
}

}  // namespace
}  // namespace walktrack
