#include "jobs/check/check_pictures.h"

#include <fmt/format.h>

#include "body/kinematics.h"
#include "core/errors.h"
#include "io/drawing/overlay.h"
#include "io/drawing/picture.h"
#include "io/video/scene_video.h"
#include "observation/image.h"

namespace walktrack {
inline namespace jobs {

namespace {

constexpr double kGridHalfSide = 6;  // m

// The joints of the subject, standing at a place on the ground.
JointPositions standing_figure(const Subject& subject, const Eigen::Vector2d& place) {
  const Body body = make_body(subject, {});
  Pose pose;
  const double half_width = 0.5 * body.lengths.hip_width;
  const double ahead = body.lengths.ball_forward;
  stand_on(body, Side::kLeft, {place.x() + ahead, place.y() + half_width, 0},
           ankle_from_ball(body.lengths, 0), pose);
  pose.legs[1].ankle_dorsiflexion = pose.legs[0].ankle_dorsiflexion;
  return forward_kinematics(body, pose).joints;
}

std::string picture_name(const SceneCamera& camera) { return "check_" + camera.name + ".png"; }

}  // namespace

Outputs check_outputs(const Scene& scene, const std::filesystem::path& folder) {
  Outputs out{folder, "check", {}, files_of(scene), ""};
  for (const SceneCamera& camera : scene.cameras) out.files.push_back(picture_name(camera));
  return out;
}

void write_check_pictures(const Scene& scene, const CheckReport& report,
                          const std::filesystem::path& folder) {
  const ResultFolder out(check_outputs(scene, folder), true);
  for (size_t i = 0; i < scene.cameras.size(); ++i) {
    const SceneCamera& camera = scene.cameras[i];
    const CameraInspection& view = report.cameras[i].view;
    Image frame;
    FrameSource source = camera.video.empty() ? plain_frames(camera) : FrameSource(camera.video);
    if (!source.skip(camera.start_frame) || !source.read(frame)) continue;
    const Eigen::Vector2d place = view.standing_place.value_or(Eigen::Vector2d::Zero());
    draw_ground_grid(frame, camera.camera, place, kGridHalfSide);
    draw_axes(frame, camera.camera, Eigen::Vector3d::Zero(), 1);
    draw_skeleton(frame, camera.camera, standing_figure(scene.subject, place), false,
                  2 * line_thickness(frame));
    draw_caption(frame, fmt::format("{}: {:.2f} m figure at ({:.1f}, {:.1f}), 1 m grid",
                                    camera.name, scene.subject.height, place.x(), place.y()));
    out.write(picture_name(camera), png_bytes(frame));
  }
}

}  // namespace jobs
}  // namespace walktrack
