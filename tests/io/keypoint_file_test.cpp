#include "io/keypoints/keypoint_file.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "io/keypoints/skeleton.h"
#include "tests/io/sample_files.h"
#include "tests/message_of.h"

namespace walktrack {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using enum KeypointName;

// Point i of a person is at (10 + i, 100 + i), confidence .5, so that the position shows for which
// point a reader took it.
std::string numbered(int points, double scale = 1) {
  std::string out;
  for (int i = 0; i < points; ++i)
    out += fmt::format("{}{}, {}, 0.5", i ? ", " : "", scale * (10 + i), scale * (100 + i));
  return out;
}

std::string openpose(const std::string& people) {
  return R"({"version": 1.3, "people": [)" + people + "]}";
}
std::string openpose_person(const std::string& numbers) {
  return R"({"person_id": [-1], "pose_keypoints_2d": [)" + numbers + "]}";
}

int index_of(const DetectedPerson& person, KeypointName name) {
  return person[name].confidence > 0 ? static_cast<int>(person[name].x_px) - 10 : -1;
}

class KeypointFile : public testing::Test {
 protected:
  KeypointFrames read(const std::string& text, const std::string& name = "points.json") {
    return read_keypoints({.path = folder_.write(name, text)});
  }
  KeypointFrames read_folder() { return read_keypoints({.path = folder_.path()}); }
  TemporaryFolder folder_;
};

// The orders of the points as documented by their programs.
TEST_F(KeypointFile, NamesThePointsByTheirNumber) {
  struct Row {
    int points, nose, left_wrist, right_hip, left_ankle, left_heel, right_big_toe, neck, mid_hip;
  };
  for (const Row& row :
       {Row{17, 0, 9, 12, 15, -1, -1, -1, -1}, Row{18, 0, 7, 8, 13, -1, -1, 1, -1},
        Row{25, 0, 7, 9, 14, 21, 22, 1, 8}, Row{26, 0, 9, 12, 15, 24, 21, 18, 19}}) {
    folder_.write("v_000000000000_keypoints.json", openpose(openpose_person(numbered(row.points))));
    const KeypointFrames frames = read_folder();
    EXPECT_EQ(frames.points, row.points);
    const DetectedPerson& person = frames.people.at(0).at(0);
    EXPECT_EQ(index_of(person, kNose), row.nose);
    EXPECT_EQ(index_of(person, kLeftWrist), row.left_wrist);
    EXPECT_EQ(index_of(person, kRightHip), row.right_hip);
    EXPECT_EQ(index_of(person, kLeftAnkle), row.left_ankle);
    EXPECT_EQ(index_of(person, kLeftHeel), row.left_heel);
    EXPECT_EQ(index_of(person, kRightBigToe), row.right_big_toe);
    EXPECT_EQ(index_of(person, kNeck), row.neck);
    EXPECT_EQ(index_of(person, kMidHip), row.mid_hip);
  }
}

// Every point of a skeleton is another one, and none is left out.
TEST(Skeleton, IsAPermutation) {
  for (const size_t points : {17u, 18u, 25u, 26u}) {
    std::vector<KeypointName> names;
    for (const auto& name : skeleton_of(points)) names.push_back(name.value());
    std::sort(names.begin(), names.end());
    EXPECT_EQ(std::unique(names.begin(), names.end()), names.end()) << points;
    EXPECT_EQ(names.size(), points);
  }
  EXPECT_TRUE(skeleton_of(19).empty());
}

TEST_F(KeypointFile, TakesAFramesNumberFromTheName) {
  folder_.write("walk2_000000000012_keypoints.json", openpose(openpose_person(numbered(17))));
  folder_.write("walk2_000014.json", openpose(""));
  folder_.write("notes.json", "no keypoints");  // no number: none of ours
  folder_.write("walk2_000000000012.png", "");
  const KeypointFrames frames = read_folder();
  EXPECT_EQ(frames.format, "OpenPose JSON");
  ASSERT_EQ(frames.people.size(), 2u);
  EXPECT_EQ(frames.people.at(12).size(), 1u);
  EXPECT_TRUE(frames.people.at(14).empty());
  EXPECT_THAT(keypoint_notes(frames, 0),
              ElementsAre("nobody in 1 of the frames 12 to 14 (the first is 13)"));
}

TEST_F(KeypointFile, KnowsWhatIsMissing) {
  const std::string others =
      numbered(17).substr(std::string("10, 100, 0.5, 11, 101, 0.5, ").size());
  const KeypointFrames frames = read("[{\"image_id\": 3, \"keypoints\": [0, 0, 0, NaN, 5, 0.9, " +
                                     others + "], \"score\": 2}]");
  const DetectedPerson& person = frames.people.at(3).at(0);
  EXPECT_EQ(person[kNose].confidence, 0);
  EXPECT_EQ(person[kLeftEye].confidence, 0);
  EXPECT_EQ(person[kRightEye].confidence, 0.5f);
}

TEST_F(KeypointFile, ReadsCocoResults) {
  const std::string points = numbered(26);
  const KeypointFrames frames =
      read("[{\"image_id\": \"00007.jpg\", \"category_id\": 1, \"keypoints\": [" + points +
           "], \"score\": 3.2, \"box\": [1, 2, 3, 4], \"idx\": 1},\n"
           "{\"image_id\": 7, \"keypoints\": [" +
           points + "]}]");
  EXPECT_EQ(frames.format, "COCO results");
  EXPECT_EQ(frames.people.at(7).size(), 2u);
  EXPECT_EQ(index_of(frames.people.at(7)[0], kRightHeel), 25);
}

TEST_F(KeypointFile, ReadsMmposeWhoseFramesCountFromOne) {
  std::string places, scores;
  for (int i = 0; i < 17; ++i) {
    places += fmt::format("{}[{}, {}]", i ? "," : "", 10 + i, 100 + i);
    scores += i ? ", 1.7" : "1.7";
  }
  const KeypointFrames frames =
      read(R"({"meta_info": {}, "instance_info": [{"frame_id": 1, "instances": [{"keypoints": [)" +
           places + "], \"keypoint_scores\": [" + scores +
           "], \"bbox\": [[1,2,3,4]]}]}, {\"frame_id\": 2, \"instances\": []}]}");
  EXPECT_EQ(frames.format, "MMPose JSON");
  EXPECT_EQ(index_of(frames.people.at(0).at(0), kRightAnkle), 16);
  EXPECT_EQ(frames.people.at(0).at(0)[kRightAnkle].confidence, 1);  // larger ones count as 1
  EXPECT_TRUE(frames.people.at(1).empty());
}

const std::string kDeepLabCut =
    "scorer,net,net,net,net,net,net\n"
    "bodyparts,kneeL,kneeL,kneeL,toe,toe,toe\n"
    "coords,x,y,likelihood,x,y,likelihood\n"
    "0,1,2,0.9,,,\n"
    "1,3,4,0.8,5,6,0.1\n";

TEST_F(KeypointFile, ReadsDeepLabCutByAMap) {
  const std::string path = folder_.write("dlc.csv", kDeepLabCut);
  const KeypointFrames frames =
      read_keypoints({path, {{"left_knee", "kneeL"}, {"left_big_toe", "toe"}}});
  EXPECT_EQ(frames.format, "DeepLabCut CSV");
  EXPECT_EQ(frames.people.at(0).at(0)[kLeftKnee].y_px, 2);
  EXPECT_EQ(frames.people.at(0).at(0)[kLeftBigToe].confidence, 0);
  EXPECT_EQ(frames.people.at(1).at(0)[kLeftBigToe].x_px, 5);
  EXPECT_THAT(message_of([&] {
                read_keypoints({path, {{"left_knee", "kneeR"}}});
              }),
              HasSubstr("dlc.csv:2: found no body part 'kneeR' for left_knee"));
  EXPECT_THAT(message_of([&] { read_keypoints({path}); }),
              HasSubstr("found body parts of other names, such as 'kneeL', allowed: a map"));
}

TEST_F(KeypointFile, ReadsSeveralAnimalsOfDeepLabCut) {
  const KeypointFrames frames = read(
      "scorer,n,n,n,n,n,n\nindividuals,a,a,a,b,b,b\n"
      "bodyparts,nose,nose,nose,nose,nose,nose\ncoords,x,y,likelihood,x,y,likelihood\n"
      "frame0004.png,1,2,0.5,3,4,0.5\nframe0005.png,,,,3,4,0.5\n",
      "dlc.csv");
  EXPECT_EQ(frames.people.at(4).size(), 2u);
  EXPECT_EQ(frames.people.at(5).size(), 1u);
}

TEST_F(KeypointFile, SaysWhatIsWrongAndWhere) {
  const std::string person = numbered(17);
  const std::vector<std::pair<std::string, std::string>> faults{
      {"", "found an empty file, allowed: a folder of OpenPose JSON files, COCO results"},
      {"hello", "found a file of another kind"},
      {"{\"a\": 1}", "found JSON of another kind"},
      {openpose(""), "found OpenPose's file of one frame, allowed: its folder"},
      {"[{\"image_id\": 1,\n \"keypoints\": [1, 2", ":2: found no JSON"},
      {"[{\"image_id\": 1}]", "[0]: found no 'keypoints'"},
      {"[{\"image_id\": 1, \"keypoints\": [1, 2, 3]}]",
       "[0].keypoints: found 3 numbers, allowed: x, y and confidence of 17 (COCO), 18, 25"},
      {"[{\"image_id\": 1, \"keypoints\": [\"a\"]}]", "[0].keypoints[0]: found \"a\""},
      {"[{\"image_id\": \"x.png\", \"keypoints\": [" + person + "]}]",
       "[0].image_id: found 'x.png', allowed: a frame's number"},
      {"[{\"image_id\": -1, \"keypoints\": [" + person + "]}]", "[0].image_id: found -1"},
      {"[{\"image_id\": 1, \"keypoints\": [" + person + "]}, {\"image_id\": 2, \"keypoints\": [" +
           numbered(26) + "]}]",
       "[1].keypoints: found 26 points, allowed: 17, as before"},
      {"[]", "found nobody in any frame"},
      {"scorer,a\nbodyparts,b\n", "found other rows above the numbers"},
      {replaced(kDeepLabCut, "3,4,0.8", "3,x,0.8"), "such as 'kneeL'"}};
  for (const auto& [text, expected] : faults)
    EXPECT_THAT(message_of([&] { read(text); }), HasSubstr(expected)) << text;
  const std::string table = folder_.write("d.csv", replaced(kDeepLabCut, "3,4,0.8", "3,x,0.8"));
  EXPECT_THAT(message_of([&] {
                read_keypoints({table, {{"left_knee", "kneeL"}}});
              }),
              HasSubstr("d.csv:5: /kneeL/y: found 'x', allowed: a number"));
}

TEST_F(KeypointFile, RefusesTwoVideosInOneFolder) {
  folder_.write("a_000001.json", openpose(""));
  folder_.write("b_000001.json", openpose(""));
  EXPECT_THAT(message_of([&] { read_folder(); }),
              HasSubstr("found frame 1 twice, in a_000001.json and b_000001.json"));
}

TEST_F(KeypointFile, RefusesAMapWhereNamesAreKnown) {
  const std::string path =
      folder_.write("p.json", "[{\"image_id\": 1, \"keypoints\": [" + numbered(17) + "]}]");
  EXPECT_THAT(message_of([&] {
                read_keypoints({path, {{"nose", "n"}}});
              }),
              HasSubstr("found a map of names for COCO results"));
}

class KeypointImageSize : public KeypointFile {
 protected:
  std::string fault(double scale, int width, int height) {
    const KeypointFrames frames =
        read("[{\"image_id\": 1, \"keypoints\": [" + numbered(17, scale) + "]}]");
    Camera camera;
    camera.width_px = width;
    camera.height_px = height;
    return message_of([&] { check_image_size(frames, {.path = "p.json"}, camera); });
  }
};

TEST_F(KeypointImageSize, IsTheCalibrations) {
  EXPECT_EQ(fault(1, 30, 120), "");
  EXPECT_EQ(fault(1, 30, 110), "");  // slightly beyond the border
  EXPECT_THAT(fault(4, 400, 300),
              HasSubstr("p.json: found points as far as (100, 460) px, allowed: "
                        "400x300 px, the calibration's image size"));
  EXPECT_THAT(fault(4, 480, 110), HasSubstr("(they fit a picture that is turned by 90 degrees)"));
  EXPECT_THAT(fault(0.001, 640, 480), HasSubstr("found coordinates between 0 and 1"));
}

TEST_F(KeypointFile, NotesAnotherNumberOfFrames) {
  const KeypointFrames frames = read("[{\"image_id\": 0, \"keypoints\": [" + numbered(17) +
                                     "]}, {\"image_id\": 1, "
                                     "\"keypoints\": [" +
                                     numbered(17) + "]}]");
  EXPECT_THAT(keypoint_notes(frames, 2), IsEmpty());
  EXPECT_THAT(keypoint_notes(frames, 0), IsEmpty());
  EXPECT_THAT(keypoint_notes(frames, 1),
              ElementsAre("keypoints up to frame 1, but the video ends with frame 0"));
  EXPECT_THAT(keypoint_notes(frames, 9),
              ElementsAre("keypoints end with frame 1, the video with frame 8"));
}

// Both formats of one detector's output on a real video hold the same.
TEST(RealKeypoints, AreTheSameInBothFormats) {
  for (const std::string name : {"sports2d_side/keypoints", "opencap_two_phones/keypoints_cam0"}) {
    if (!std::filesystem::exists(shared_data(name))) GTEST_SKIP() << "no " << name;
    const KeypointFrames folder = read_keypoints({.path = shared_data(name)});
    const KeypointFrames file = read_keypoints({.path = shared_data(name + "_coco.json")});
    EXPECT_EQ(folder.format, "OpenPose JSON");
    EXPECT_EQ(file.format, "COCO results");
    for (const auto& [frame, people] : file.people) {
      ASSERT_EQ(folder.people.at(frame).size(), people.size());
      for (size_t i = 0; i < people.size(); ++i)
        EXPECT_EQ(folder.people.at(frame)[i][kLeftKnee].x_px, people[i][kLeftKnee].x_px);
    }
  }
}

}  // namespace
}  // namespace walktrack
