// The schemas in data/schemas compared with what the program reads and writes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "io/scene/scene.h"
#include "jobs/evaluate/analyse.h"
#include "jobs/optimise/optimise.h"
#include "tests/io/json_schema.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using testing::HasSubstr;

const fs::path kSource = WALKTRACK_SOURCE_DIR;

Json schema(const std::string& name) {
  return Json::parse(read_file(kSource / "data/schemas" / (name + ".schema.json")));
}

// JSON is YAML: a scene may be written in either.
std::string reader_says(const TemporaryFolder& place, const Json& scene) {
  try {
    read_scene(place.write("scene.yaml", scene.dump()));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// Everything that a scene may hold.
Json full_scene() {
  const std::string demo = (kSource / "data/demo").string();
  const Json polygon = {{1, 2}, {3, 4}, {5, 6}};
  return {{"cameras",
           {{{"name", "side"},
             {"video", demo + "/side.mp4"},
             {"calibration", demo + "/side.yaml"},
             {"background", demo + "/side_background.mp4"},
             {"start_frame", 2},
             {"frame_rate", 30}}}},
          {"frame_rate", 30},
          {"ground", {{"normal", {0, 0, 1}}, {"offset", 0}}},
          {"gravity", {0, 0, -9.81}},
          {"subject",
           {{"height", 1.7},
            {"height_sd", 0.02},
            {"mass", 60},
            {"girth", 1.2},
            {"lengths", {{"thigh", 0.4}, {"foot", 0.2}}}}},
          {"initial",
           {{"time", 0.5}, {"position", {0, 0}}, {"heading", 0}, {"speed", 1}, {"phase", 0.1}}},
          {"occluders", {{"side", {polygon, {{"polygon", polygon}, {"from", 1}, {"to", 2}}}}}},
          {"truth", demo + "/truth.csv"},
          {"first_frame", 1},
          {"last_frame", 40}};
}

TEST(SceneSchema, TakesWhatTheReaderTakes) {
  const TemporaryFolder place;
  EXPECT_EQ(reader_says(place, full_scene()), "");
  EXPECT_EQ(schema_trouble(schema("scene"), full_scene()), "");
  Json apart = full_scene();
  place.write("anna.yaml", "height: 1.7");
  apart["subject"] = "anna.yaml";
  EXPECT_EQ(reader_says(place, apart), "");
  EXPECT_EQ(schema_trouble(schema("scene"), apart), "");
  Json near = full_scene();
  near.erase("initial");
  near["subject"]["near"] = {{"time", 1}, {"camera", "side"}, {"feet_px", {200, 400}}};
  EXPECT_EQ(reader_says(place, near), "");
  EXPECT_EQ(schema_trouble(schema("scene"), near), "");
  // Every key of the schema is tested here.
  const Json scene = full_scene(), known = schema("scene");
  for (const auto& [key, unused] : known.at("properties").items())
    EXPECT_TRUE(scene.contains(key)) << key;
}

TEST(SceneSchema, RefusesWhatTheReaderRefuses) {
  const Json known = schema("scene");
  const auto refused = [&](const char* pointer, const Json& value, const char* where) {
    const TemporaryFolder place;
    Json scene = full_scene();
    scene[Json::json_pointer(pointer)] = value;
    EXPECT_NE(reader_says(place, scene), "") << pointer;
    EXPECT_THAT(schema_trouble(known, scene), HasSubstr(where)) << pointer;
  };
  refused("/camera", 1, "/camera: an unknown key");
  refused("/subject/height", 175, "/subject/height: too large");
  refused("/subject/height_sd", 3, "/subject/height_sd: too large");
  refused("/subject/girth", 3, "/subject/girth: too large");
  refused("/subject/weight", 60, "/subject/weight: an unknown key");
  refused("/subject/near", Json::object(), "/subject/near: lacks \"time\"");
  refused("/subject/lengths/toe", 0.1, "/subject/lengths/toe: an unknown key");
  refused("/cameras/0/fps", 30, "/cameras/0/fps: an unknown key");
  refused("/cameras/0/start_frame", -1, "/cameras/0/start_frame: too small");
  refused("/cameras", Json::array(), "/cameras: too short");
  refused("/frame_rate", "fast", "/frame_rate: is no");
  refused("/initial/phase", 2, "/initial/phase: too large");
  refused("/occluders/side/0", Json::array({{1, 2}}), "/occluders/side/0: none of");
  Json scene = full_scene();
  scene.erase("cameras");
  EXPECT_THAT(schema_trouble(known, scene), HasSubstr("lacks \"cameras\""));
}

void expect_valid_result(const fs::path& folder) {
  for (const char* name : {"run", "gait"})
    EXPECT_EQ(schema_trouble(schema(name),
                             Json::parse(read_file(folder / (std::string(name) + ".json")))),
              "")
        << folder;
}

TEST(ResultSchemas, HoldForAnAnalysis) {
  const TemporaryFolder place;
  AnalyseJob job;
  job.motion = kSource / "data/demo/truth.csv";
  job.output = place.path() / "out";
  analyse(job);
  expect_valid_result(job.output);
  // The schema check can fail.
  Json gait = Json::parse(read_file(job.output / "gait.json"));
  gait["contacts"][0]["side"] = "middle";
  EXPECT_THAT(schema_trouble(schema("gait"), gait), HasSubstr("/contacts/0/side: is none of"));
  gait["contacts"][0].erase("side");
  EXPECT_THAT(schema_trouble(schema("gait"), gait), HasSubstr("/contacts/0: lacks"));
}

TEST(ResultSchemas, HoldForAnOptimisedMotion) {
  const TemporaryFolder place;
  OptimiseJob job;
  job.motion = kSource / "data/demo/truth.csv";
  job.output = place.path() / "out";
  job.overlay = false;
  optimise(job, {});
  expect_valid_result(job.output);
}

TEST(ResultSchemas, HoldForATrack) {
  const TemporaryFolder place;
  Json scene = full_scene();
  scene.erase("ground");
  scene.erase("gravity");
  scene.erase("occluders");
  scene["last_frame"] = 20;
  const auto ran =
      run_walktrack({"track", place.write("scene.yaml", scene.dump()), "-o", place / "out",
                     "--no-overlay", "--threads", "1", "--set", "filter.particles=30", "--set",
                     "start.particles=10", "--ignore-checks"});
  ASSERT_TRUE(ran.exit_code == 0 || ran.exit_code == 4) << ran.err;
  expect_valid_result(place / "out");
}

}  // namespace
}  // namespace walktrack
