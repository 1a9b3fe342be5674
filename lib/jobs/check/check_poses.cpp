#include "jobs/check/check_poses.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "core/conventions.h"

namespace walktrack {
inline namespace jobs {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Usual heights in a room, a street or on a roof, m; a camera outside of them may be calibrated
// wrongly.
constexpr double kLowest = 0.05, kHighest = 50;  // m above the ground
constexpr double kMostRoll = 1.05;               // rad
constexpr double kSmallestPerson = 12;           // px
constexpr double kWidestView = 2.8;              // rad, of a lens that is not a fisheye
constexpr double kMillimetres = 1e-3;

bool plausible(const Camera& camera, double person_height) {
  const CameraInspection view = inspect_camera(camera, person_height);
  return view.centre.z() > kLowest && view.centre.z() < kHighest &&
         std::abs(view.roll) < kMostRoll && view.standing_place &&
         view.person_px >= kSmallestPerson;
}

std::string complaint(const Camera& camera, double person_height) {
  const CameraInspection view = inspect_camera(camera, person_height);
  if (view.centre.z() <= 0) return fmt::format("stands {:.2f} m underground", -view.centre.z());
  if (view.centre.z() <= kLowest) return "lies on the ground";
  if (view.centre.z() >= kHighest) return fmt::format("stands {:.0f} m high", view.centre.z());
  if (std::abs(view.roll) >= kMostRoll) {
    return fmt::format("is rolled by {:.0f} degrees, so people stand askew in its image",
                       deg_from_rad(view.roll));
  }
  if (!view.standing_place) return "sees no place on the ground where a person would be seen whole";
  return fmt::format("sees people {:.0f} px high at most", view.person_px);
}

struct Cure {
  std::string text;
  std::function<Camera(Camera, WorldFrame)> apply;  // from calibration axes to the world
};

Camera with_pose(Camera camera, const Matrix3d& rotation, const Vector3d& translation) {
  camera.rotation = rotation;
  camera.translation = translation;
  return camera;
}

Camera on_ground(const Camera& camera, const Vector3d& normal) {
  return camera_in_world(world_frame_on_ground(normal, 0), camera);
}

// Single mistakes come first.
std::vector<Cure> common_cures() {
  const auto millimetres = [](Camera c) {
    return with_pose(c, c.rotation, kMillimetres * c.translation);
  };
  const auto transposed = [](Camera c) {
    return with_pose(c, c.rotation.transpose(), c.translation);
  };
  const auto inverted = [](Camera c) {
    return with_pose(c, c.rotation.transpose(), -c.rotation.transpose() * c.translation);
  };
  const auto centred = [](Camera c) {
    return with_pose(c, c.rotation, -c.rotation * c.translation);
  };
  return {
      {"the translation is in millimetres; divide it by 1000",
       [=](Camera c, WorldFrame w) { return camera_in_world(w, millimetres(c)); }},
      {"the rotation is transposed; swap its rows and columns",
       [=](Camera c, WorldFrame w) { return camera_in_world(w, transposed(c)); }},
      {"rotation and translation are world_from_camera; store their inverse (R', -R't)",
       [=](Camera c, WorldFrame w) { return camera_in_world(w, inverted(c)); }},
      {"the translation is the camera's place C; store -R C",
       [=](Camera c, WorldFrame w) { return camera_in_world(w, centred(c)); }},
      {"the ground is not z = 0 of the calibration; say in the scene: ground: {normal: [0, 1, 0]}",
       [](Camera c, WorldFrame) {
         return on_ground(c, {0, 1, 0});
       }},
      {"the calibration's z points down; say in the scene: ground: {normal: [0, 0, -1]}",
       [](Camera c, WorldFrame) {
         return on_ground(c, {0, 0, -1});
       }},
      {"the calibration's y points down; say in the scene: ground: {normal: [0, -1, 0]}",
       [](Camera c, WorldFrame) {
         return on_ground(c, {0, -1, 0});
       }},
      {"the ground's normal points up without the scene's ground: remove it or turn its sign",
       [](Camera c, WorldFrame) {
         return on_ground(c, {0, 0, 1});
       }},
      {"world_from_camera in millimetres; store the inverse in metres",
       [=](Camera c, WorldFrame w) { return camera_in_world(w, inverted(millimetres(c))); }},
      {"the translation is the camera's place in millimetres; store -R C in metres",
       [=](Camera c, WorldFrame w) { return camera_in_world(w, centred(millimetres(c))); }},
  };
}

std::vector<Camera> cameras_of(const Scene& scene) {
  std::vector<Camera> cameras;
  for (const SceneCamera& camera : scene.cameras) cameras.push_back(camera.camera);
  return cameras;
}

// Number of other cameras that see a person where `camera` sees one best.
int companions(const std::vector<Camera>& others, const Camera& camera, size_t self,
               double person_height) {
  const CameraInspection view = inspect_camera(camera, person_height);
  if (!view.standing_place) return 0;
  int count = 0;
  for (size_t i = 0; i < others.size(); ++i)
    if (i != self && sees_person(others[i], *view.standing_place, person_height)) ++count;
  return count;
}

// Upright cameras below the ground stand on a floor that is lower than z = 0 if for some lower
// floor all of them are plausible.
constexpr const char* kLowerFloor =
    "the floor lies below z = 0 of the calibration; say where: ground: {offset: -1.2} if it is "
    "1.2 m below";

bool stand_on_a_lower_floor(const Scene& scene) {
  const double height = scene.subject.height;
  double lowest = 0;
  for (const SceneCamera& camera : scene.cameras)
    lowest = std::min(lowest, camera_centre(camera.camera).z());
  for (const double above : {0.5, 1.0, 1.5, 2.0, 3.0, 5.0}) {  // height of the lowest camera, m
    const WorldFrame floor = world_frame_on_ground({0, 0, 1}, lowest - above);
    const auto stands = [&](const SceneCamera& camera) {
      return plausible(camera_in_world(floor, camera.camera), height);
    };
    if (std::all_of(scene.cameras.begin(), scene.cameras.end(), stands)) return true;
  }
  return false;
}

std::string find_cure(const Scene& scene, size_t self) {
  const double height = scene.subject.height;
  const std::vector<Camera> others = cameras_of(scene);
  const bool lower_floor = camera_centre(others[self]).z() <= 0 && stand_on_a_lower_floor(scene);
  if (lower_floor && others.size() > 1) return kLowerFloor;
  const Camera file_camera = camera_in_calibration(scene.world, scene.cameras[self].camera);
  std::string best = "compare the file's units, axes and direction (x_camera = R x_world + t)";
  int most = -1;
  for (const Cure& cure : common_cures()) {
    const Camera cured = cure.apply(file_camera, scene.world);
    if (!plausible(cured, height)) continue;
    const int count = companions(others, cured, self, height);
    if (count > most) {
      most = count;
      best = cure.text;
    }
  }
  if (!lower_floor) return best;
  return most < 0 ? kLowerFloor : fmt::format("{}; or {}", best, kLowerFloor);
}

// The field of view from the focal length alone; distortion means nothing if the focal length is
// wrong.
double undistorted_view(const Camera& camera) {
  return 2 * std::atan(0.5 * camera.width_px / camera.focal_px.x());
}

void check_lens(const SceneCamera& camera, CheckReport& report) {
  const double view = undistorted_view(camera.camera);
  if (camera.camera.lens != Lens::kFisheye && view > kWidestView) {
    report.findings.push_back(
        {camera.name, true,
         fmt::format("has a field of view of {:.0f} degrees", deg_from_rad(view)),
         "the focal length must be in pixels, not in millimetres"});
    return;
  }
  if (!lens_covers_image(camera.camera)) {
    report.findings.push_back({camera.name, true,
                               "the distortion folds the image over inside its corners",
                               "the order is k1 k2 p1 p2 k3, for normalised coordinates; fit again "
                               "with points near the corners or with fewer coefficients"});
  }
}

// Reports cameras that are plausible by themselves but look at different places.
void check_common_ground(const Scene& scene, CheckReport& report) {
  if (scene.cameras.size() < 2) return;
  const std::vector<Camera> cameras = cameras_of(scene);
  for (size_t i = 0; i < scene.cameras.size(); ++i) {
    const auto shares = [&](const Camera& other) {
      const double height = scene.subject.height;
      return &other != &cameras[i] &&
             (share_a_view(cameras[i], other, height) || share_a_view(other, cameras[i], height));
    };
    if (std::ranges::any_of(cameras, shares)) continue;
    report.findings.push_back({scene.cameras[i].name, true,
                               "sees no place where another camera sees a person",
                               find_cure(scene, i)});
  }
}

}  // namespace

void check_poses(const Scene& scene, CheckReport& report) {
  const size_t before = report.findings.size();
  for (size_t i = 0; i < scene.cameras.size(); ++i) {
    check_lens(scene.cameras[i], report);
    const Camera& camera = scene.cameras[i].camera;
    if (plausible(camera, scene.subject.height)) continue;
    report.findings.push_back({scene.cameras[i].name, true, complaint(camera, scene.subject.height),
                               find_cure(scene, i)});
  }
  if (report.findings.size() == before) check_common_ground(scene, report);
}

}  // namespace jobs
}  // namespace walktrack
