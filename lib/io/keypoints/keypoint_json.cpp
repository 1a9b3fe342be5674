#include "io/keypoints/keypoint_json.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/errors.h"
#include "io/archive/files.h"
#include "io/keypoints/skeleton.h"
#include "io/video/image_files.h"

namespace walktrack {
inline namespace io {

namespace fs = std::filesystem;

namespace {

constexpr size_t kMaxFrameBytes = size_t{16} << 20;

bool is_json(const fs::path& path) { return path.extension() == ".json"; }

std::vector<double> with_scores(const JsonValue& points, const std::vector<double>& scores) {
  const std::vector<JsonValue> places = points.items();
  if (places.size() != scores.size())
    points.fail(fmt::format("{} points for {} scores", places.size(), scores.size()),
                "as many of both");
  std::vector<double> out;
  for (size_t i = 0; i < places.size(); ++i) {
    const std::vector<double> place = places[i].numbers();
    if (place.size() < 2) places[i].fail(fmt::format("{} numbers", place.size()), "[x, y]");
    out.insert(out.end(), {place[0], place[1], scores[i]});
  }
  return out;
}

int frame_of_image(const JsonValue& id) {
  if (!id.is_text()) return id.integer(0, kLargestFrameNumber);
  const auto frame = last_number_in(fs::path(id.text()).stem().string());
  if (!frame)
    id.fail(fmt::format("'{}'", id.text()), "a frame's number, or a name that ends with one");
  return *frame;
}

// One person from x, y, confidence of each point of a skeleton. `points` is the number of points of
// the earlier people in the file (0 = none yet), which must be the same.
DetectedPerson person_from(const std::vector<double>& triples, int& points,
                           const JsonValue& place) {
  const size_t count = triples.size() / 3;
  const auto skeleton = skeleton_of(count);
  if (triples.size() % 3 != 0 || skeleton.empty())
    place.fail(fmt::format("{} numbers", triples.size()),
               "x, y and confidence of " + skeletons_allowed());
  if (points == 0) points = static_cast<int>(count);
  if (points != static_cast<int>(count))
    place.fail(fmt::format("{} points", count), fmt::format("{}, as before", points));
  DetectedPerson person;
  for (size_t i = 0; i < count; ++i)
    if (skeleton[i])
      person[*skeleton[i]] = keypoint_from(triples[3 * i], triples[3 * i + 1], triples[3 * i + 2]);
  return person;
}

DetectedPeople openpose_people(const fs::path& file, int& points) {
  const std::string name = file.string();
  const nlohmann::json content = json_from_text(read_text_file(file, kMaxFrameBytes), name);
  DetectedPeople people;
  for (const JsonValue& person : JsonValue(content, name).at("people").items()) {
    const JsonValue body = person.at("pose_keypoints_2d");
    if (body.is_list() && body.size() == 0) continue;  // a face or a hand without a body
    people.push_back(person_from(body.numbers(), points, body));
  }
  return people;
}

}  // namespace

std::map<int, fs::path> openpose_files(const fs::path& folder) {
  std::map<int, fs::path> out;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (!entry.is_regular_file() || !is_json(entry.path())) continue;
    const auto frame = last_number_in(entry.path().stem().string());
    if (!frame) continue;
    const auto [place, is_new] = out.emplace(*frame, entry.path());
    if (is_new) continue;
    std::string first = place->second.filename().string(),
                second = entry.path().filename().string();
    if (second < first) std::swap(first, second);
    throw InputError(describe({folder.string(), 0, ""},
                              fmt::format("frame {} twice, in {} and {}", *frame, first, second),
                              "the files of one video"));
  }
  if (out.empty())
    throw InputError(describe({folder.string(), 0, ""}, "no keypoint file with a frame's number",
                              "files such as side_000000000012_keypoints.json"));
  return out;
}

KeypointFrames openpose_folder(const fs::path& folder) {
  KeypointFrames out{.format = "OpenPose JSON"};
  for (const auto& [frame, file] : openpose_files(folder))
    out.people[frame] = openpose_people(file, out.points);
  return out;
}

KeypointFrames coco_results(const JsonValue& list) {
  KeypointFrames out{.format = "COCO results"};
  for (const JsonValue& one : list.items()) {
    const JsonValue body = one.at("keypoints");
    const DetectedPerson person = person_from(body.numbers(), out.points, body);
    out.people[frame_of_image(one.at("image_id"))].push_back(person);
  }
  return out;
}

KeypointFrames mmpose_inferences(const JsonValue& root) {
  KeypointFrames out{.format = "MMPose JSON"};
  for (const JsonValue& one : root.at("instance_info").items()) {
    DetectedPeople& people = out.people[one.at("frame_id").integer(1, kLargestFrameNumber) - 1];
    for (const JsonValue& person : one.at("instances").items()) {
      const JsonValue body = person.at("keypoints");
      people.push_back(
          person_from(with_scores(body, person.at("keypoint_scores").numbers()), out.points, body));
    }
  }
  return out;
}

}  // namespace io
}  // namespace walktrack
