#include "io/keypoints/keypoint_file.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/errors.h"
#include "io/archive/files.h"
#include "io/keypoints/keypoint_csv.h"
#include "io/keypoints/keypoint_json.h"

namespace walktrack {
inline namespace io {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kFormats =
    "a folder of OpenPose JSON files, COCO results, MMPose JSON or a DeepLabCut CSV";

[[noreturn]] void fail(const KeypointSource& source, std::string_view found,
                       std::string_view allowed) {
  throw InputError(describe({source.path.string(), 0, ""}, found, allowed));
}

KeypointFrames from_json(std::string text, const KeypointSource& source) {
  const std::string name = source.path.string();
  const nlohmann::json content = json_from_text(std::move(text), name);
  const JsonValue root(content, name);
  if (root.is_list()) return coco_results(root);
  if (root.has("instance_info")) return mmpose_inferences(root);
  if (root.has("people")) fail(source, "OpenPose's file of one frame", "its folder");
  fail(source, "JSON of another kind", kFormats);
}

KeypointFrames from_text(std::string text, const KeypointSource& source) {
  const size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) fail(source, "an empty file", kFormats);
  if (text[first] == '{' || text[first] == '[') return from_json(std::move(text), source);
  if (text.starts_with("scorer,")) return deeplabcut_table(text, source);
  fail(source, "a file of another kind", kFormats);
}

// The extent of most points. A detector may place some points outside the image.
struct Reach {
  size_t points = 0;
  float x_px = 0, y_px = 0;  // 98 % of the points are below
  float largest = 0;
};

float share_point(std::vector<float>& values) {
  constexpr double kShare = 0.98;  // by hand: a few points may be wrong
  const auto at =
      values.begin() + static_cast<long>(kShare * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

Reach reach_of(const KeypointFrames& frames) {
  std::vector<float> x, y;
  for (const auto& [frame, people] : frames.people)
    for (const DetectedPerson& person : people)
      for (const Keypoint& point : person.points)
        if (point.confidence > 0) {
          x.push_back(point.x_px);
          y.push_back(point.y_px);
        }
  if (x.empty()) return {};
  const float largest =
      std::max(*std::max_element(x.begin(), x.end()), *std::max_element(y.begin(), y.end()));
  return {x.size(), share_point(x), share_point(y), largest};
}

bool fits(const Reach& reach, int width_px, int height_px) {
  constexpr double kBeyond = 1.1;  // detectors extrapolate slightly beyond the border
  return reach.x_px <= kBeyond * width_px && reach.y_px <= kBeyond * height_px;
}

std::string frames_left_out(const KeypointFrames& frames) {
  const int first = frames.people.begin()->first, last = frames.people.rbegin()->first;
  const int missing = last - first + 1 - static_cast<int>(frames.people.size());
  if (missing == 0) return "";
  int gap = first;
  while (frames.people.contains(gap)) ++gap;
  return fmt::format("nobody in {} of the frames {} to {} (the first is {})", missing, first, last,
                     gap);
}

}  // namespace

KeypointFrames read_keypoints(const KeypointSource& source) {
  KeypointFrames out;
  if (fs::is_directory(source.path)) {
    out = openpose_folder(source.path);
  } else {
    out = from_text(read_text_file(source.path, kMaxKeypointBytes), source);
  }
  if (!source.names.empty() && out.format != "DeepLabCut CSV")
    fail(source, "a map of names for " + out.format, "it for DeepLabCut's tables alone");
  const bool anybody = std::any_of(out.people.begin(), out.people.end(),
                                   [](const auto& frame) { return !frame.second.empty(); });
  if (!anybody) fail(source, "nobody in any frame", "at least one person");
  return out;
}

void check_image_size(const KeypointFrames& frames, const KeypointSource& source,
                      const Camera& camera) {
  const Reach reach = reach_of(frames);
  if (reach.points == 0) return;
  if (reach.largest <= 1.5f)
    fail(source, "coordinates between 0 and 1", "pixels of the picture as it was recorded");
  if (fits(reach, camera.width_px, camera.height_px)) return;
  const bool turned = fits(reach, camera.height_px, camera.width_px);
  fail(source, fmt::format("points as far as ({:.0f}, {:.0f}) px", reach.x_px, reach.y_px),
       fmt::format("{}x{} px, the calibration's image size{}", camera.width_px, camera.height_px,
                   turned ? " (they fit a picture that is turned by 90 degrees)" : ""));
}

std::vector<std::string> keypoint_notes(const KeypointFrames& frames, int video_frames) {
  std::vector<std::string> out;
  if (const std::string gaps = frames_left_out(frames); !gaps.empty()) out.push_back(gaps);
  const int last = frames.people.rbegin()->first;
  if (video_frames > 0 && last >= video_frames)
    out.push_back(fmt::format("keypoints up to frame {}, but the video ends with frame {}", last,
                              video_frames - 1));
  if (video_frames > 0 && last + 1 < video_frames)
    out.push_back(fmt::format("keypoints end with frame {}, the video with frame {}", last,
                              video_frames - 1));
  return out;
}

std::vector<fs::path> keypoint_files(const KeypointSource& source) {
  if (!fs::is_directory(source.path)) return {source.path};
  std::vector<fs::path> out;
  for (const auto& [frame, file] : openpose_files(source.path)) out.push_back(file);
  return out;
}

}  // namespace io
}  // namespace walktrack
