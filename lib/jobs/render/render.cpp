#include "jobs/render/render.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/conventions.h"
#include "core/errors.h"
#include "core/parallel_for.h"
#include "io/archive/files.h"
#include "io/archive/result_folder.h"
#include "io/calibration/calibration.h"
#include "io/calibration/formats/opencv.h"
#include "io/drawing/picture.h"
#include "io/tables/angles_file.h"
#include "io/tables/kinetics_file.h"
#include "io/tables/motion_file.h"
#include "jobs/render/frame_writer.h"
#include "jobs/render/gait_motion.h"
#include "jobs/render/render_keypoints.h"
#include "jobs/render/render_truth.h"
#include "observation/image.h"
#include "synth/recording/sensor.h"
#include "synth/recording/stage.h"

namespace walktrack {
inline namespace jobs {

namespace {

namespace fs = std::filesystem;

constexpr const char* kSceneFile = "scene.yaml";
constexpr size_t kFramesPerThread = 2;   // number of frames in memory at a time
constexpr double kRoundingShare = 1e-6;  // share of a frame: a duration of whole frames includes
                                         // the last one

// One camera of the recording.
struct RenderedCamera {
  RenderCamera camera;
  View view;
  double rate;                       // Hz
  uint32_t stream;                   // of its random numbers
  size_t frames;                     // with start_frame
  double time(size_t frame) const {  // the time of an exposure
    return (static_cast<double>(frame) - camera.start_frame) / rate + camera.delay;
  }
};

Subject subject_of(const FilmedWalker& walker) {
  Subject subject;
  subject.height = height_of(walker);
  subject.mass = walker.mass;
  return subject;
}

size_t frames_in(double duration, double rate) {
  return static_cast<size_t>(std::floor(duration * rate + kRoundingShare)) + 1;
}

// The cameras whose pose is calibrated, read from their files.
std::vector<std::optional<Camera>> calibrations(const RenderOptions& options) {
  std::vector<std::optional<Camera>> out;
  for (const RenderCamera& camera : options.cameras) {
    if (camera.calibration.empty()) {
      out.emplace_back();
    } else {
      out.emplace_back(read_calibration(camera.calibration, camera.name));
    }
  }
  return out;
}

Image picture(const RenderJob& job, const Plane<Colour>& light, uint32_t stream, uint32_t frame) {
  const Image image =
      bgr_image(developed(light, job.options.sensor, job.options.seed, stream, frame), light.width,
                light.height);
  return job.options.jpeg_quality == 0 ? image : after_jpeg(image, job.options.jpeg_quality);
}

void write_truth_pictures(const RenderJob& job, const Stage& stage, const RenderedCamera& rendered,
                          const ResultFolder& folder, size_t frame) {
  const RenderOptions& options = job.options;
  if (!options.labels && !options.flow && !options.depth) return;
  const auto now = actors_at(stage, rendered.time(frame));
  const Plane<Sight> sights = render(rendered.view, stage.world, now).sights;
  const auto file = [&](const char* kind, const char* suffix) {
    return folder.file(fmt::format("{}/{}/{:06}.{}", kind, rendered.camera.name, frame, suffix));
  };
  if (options.labels) write_labels(file("labels", "png"), labels_of(sights));
  if (options.depth) write_depth(file("depth", "pfm"), depth_of(rendered.view, sights));
  if (!options.flow) return;
  const auto next = actors_at(stage, rendered.time(frame + 1));
  write_flow(file("flow", "flo"), flow_of(rendered.view, sights, now, next));
}

void make_truth_folders(const RenderJob& job, const std::string& camera) {
  const RenderOptions& options = job.options;
  for (const auto& [wanted, kind] :
       {std::pair{options.labels, "labels"}, std::pair{options.flow, "flow"},
        std::pair{options.depth, "depth"}}) {
    if (wanted) fs::create_directories(job.output / kind / camera);
  }
}

// Renders `count` frames, several at a time in parallel, and writes them in order.
template <typename MakeFrame>
void write_video(const RenderJob& job, const std::string& name, const RenderedCamera& rendered,
                 const ResultFolder& folder, size_t count, int threads, const JobControl& control,
                 const MakeFrame& make_frame) {
  FrameWriter writer(folder, name, job.options.images,
                     {rendered.view.camera.width_px, rendered.view.camera.height_px},
                     rendered.rate);
  const size_t batch = kFramesPerThread * static_cast<size_t>(threads);
  std::vector<Image> images(batch);
  for (size_t start = 0; start < count && !control.stopping(); start += batch) {
    const size_t n = std::min(batch, count - start);
    parallel_for(n, threads, [&](size_t i) { images[i] = make_frame(start + i); });
    for (size_t i = 0; i < n; ++i) writer.write(images[i]);
    control.progress("rendering " + rendered.camera.name, start + n, count);
  }
  if (!control.stopping()) writer.close();
}

void write_keypoints(const RenderJob& job, const Stage& stage, const RenderedCamera& rendered,
                     const ResultFolder& folder) {
  if (!job.options.keypoints) return;
  const std::string& name = rendered.camera.name;
  fs::create_directories(job.output / keypoint_folder(name));
  for (size_t frame = 0; frame < rendered.frames; ++frame) {
    const DetectedPeople people =
        rendered_keypoints(stage, rendered.view.camera, *job.options.keypoints, job.options.seed,
                           rendered.stream, static_cast<uint32_t>(frame), rendered.time(frame));
    folder.write(keypoint_folder(name) + "/" + openpose_file_name(name, frame),
                 openpose_json(people));
  }
}

void record(const RenderJob& job, const Stage& stage, const RenderedCamera& rendered,
            const ResultFolder& folder, int threads, const JobControl& control) {
  const std::string& name = rendered.camera.name;
  make_truth_folders(job, name);
  folder.write(name + ".yaml", opencv_from_camera(rendered.view.camera));
  write_video(job, name, rendered, folder, rendered.frames, threads, control, [&](size_t frame) {
    write_truth_pictures(job, stage, rendered, folder, frame);
    const Plane<Colour> light =
        exposed(stage, rendered.view, job.options.shutter, rendered.time(frame), rendered.rate);
    return picture(job, light, 2 * rendered.stream, static_cast<uint32_t>(frame));
  });
  write_keypoints(job, stage, rendered, folder);
  if (job.options.background_frames == 0 || control.stopping()) return;
  write_video(job, name + "_background", rendered, folder,
              static_cast<size_t>(job.options.background_frames), threads, control,
              [&](size_t frame) {
                return picture(job, rendered.view.empty, 2 * rendered.stream + 1,
                               static_cast<uint32_t>(frame));
              });
}

std::vector<double> scene_times(const Stage& stage, double rate) {
  std::vector<double> times(frames_in(stage.duration, rate));
  for (size_t i = 0; i < times.size(); ++i) times[i] = static_cast<double>(i) / rate;
  return times;
}

// The line `initial` of a scene: position, heading and speed at time 0, from the first half second.
std::string initial_line(const Motion& truth) {
  size_t last = 0;
  while (last + 1 < truth.time.size() && truth.time[last] < 0.5) ++last;
  const Eigen::Vector3d from = truth.joints.front()[Joint::kPelvis];
  const Eigen::Vector3d way = truth.joints[last][Joint::kPelvis] - from;
  if (!known(way) || last == 0)
    throw InputError("'initial: true' needs a walker who is there from the start");
  return fmt::format(
      "initial: {{time: 0, position: [{:.2f}, {:.2f}], heading: {:.2f}, speed: {:.2f}}}\n",
      from.x(), from.y(), std::atan2(way.y(), way.x()), way.head<2>().norm() / truth.time[last]);
}

std::string gravity_line(const Motion& truth, double slope) {
  const Eigen::Vector3d way =
      truth.joints.back()[Joint::kPelvis] - truth.joints.front()[Joint::kPelvis];
  const double heading = known(way) ? std::atan2(way.y(), way.x()) : 0;
  const double along = kStandardGravity * std::sin(slope);
  return fmt::format("gravity: [{:.6f}, {:.6f}, {:.6f}]\n", along * std::cos(heading),
                     along * std::sin(heading), -kStandardGravity * std::cos(slope));
}

std::string scene_yaml(const RenderJob& job, const std::vector<RenderedCamera>& cameras,
                       const Motion& truth) {
  std::string out = "# Synthetic: rendered by walktrack, truth in truth.csv.\ncameras:\n";
  for (const RenderedCamera& rendered : cameras) {
    const std::string& name = rendered.camera.name;
    const bool images = job.options.images;
    out += fmt::format("  - {{name: {0}, video: {1}, calibration: {0}.yaml", name,
                       video_name(name, images));
    if (job.options.background_frames > 0)
      out += fmt::format(", background: {}", video_name(name + "_background", images));
    if (job.options.keypoints) out += ", keypoints: " + keypoint_folder(name);
    if (rendered.camera.start_frame > 0)
      out += fmt::format(", start_frame: {}", rendered.camera.start_frame);
    if (rendered.camera.frame_rate)
      out += fmt::format(", frame_rate: {}", shortest_number(rendered.rate));
    out += "}\n";
  }
  out += fmt::format("frame_rate: {}\n", shortest_number(job.options.frame_rate));
  out += fmt::format("subject: {{height: {}, mass: {}}}\n", shortest_number(height_of(job.walker)),
                     shortest_number(job.walker.mass));
  if (job.options.slope != 0) out += gravity_line(truth, job.options.slope);
  if (job.options.state_initial) out += initial_line(truth);
  return out + "truth: truth.csv\n";
}

std::vector<RenderedCamera> rendered_cameras(const RenderOptions& options, const Stage& stage,
                                             int threads) {
  std::vector<RenderedCamera> out;
  for (size_t i = 0; i < stage.cameras.size(); ++i) {
    RenderCamera camera = options.cameras.empty() ? RenderCamera{} : options.cameras[i];
    if (camera.name.empty()) camera.name = fmt::format("cam{}", i);
    const double rate = camera.frame_rate.value_or(options.frame_rate);
    const size_t frames = frames_in(stage.duration, rate) + static_cast<size_t>(camera.start_frame);
    out.push_back({std::move(camera), make_view(stage.world, stage.cameras[i], threads), rate,
                   static_cast<uint32_t>(i), frames});
  }
  return out;
}

// Forces at the times of the scene, with the walker at its place in the scene.
TableNotes write_kinetics(const RenderJob& job, WalkedGait walked, std::vector<double> times,
                          const ResultFolder& folder) {
  const FilmedWalker& walker = job.walker;
  walked.world_from_plane = Eigen::Translation3d(walker.shift.x(), walker.shift.y(), 0) *
                            Eigen::AngleAxisd(walker.turn, Eigen::Vector3d::UnitZ()) *
                            walked.world_from_plane;
  const std::vector<double> of_scene = times;
  for (double& time : times) time += job.options.start - walker.delay;
  Kinetics truth = ground_kinetics(walked, times, 1 / job.options.frame_rate);
  truth.time = of_scene;
  folder.write("kinetics.csv", simulated_kinetics_csv(truth));
  return simulated_kinetics_notes(truth, subject_of(walker));
}

Outputs outputs_of(const RenderJob& job, const std::vector<RenderedCamera>& cameras) {
  const RenderOptions& options = job.options;
  Outputs out{job.output,
              "render",
              {kSceneFile, "truth.csv", "angles.csv", "events.csv", "kinetics.csv", "tables.json"},
              job.inputs,
              kSceneFile};
  for (const RenderedCamera& rendered : cameras) {
    const std::string& name = rendered.camera.name;
    out.files.push_back(name + ".yaml");
    out.files.push_back(video_files(name, options.images));
    if (options.background_frames > 0)
      out.files.push_back(video_files(name + "_background", options.images));
    if (options.keypoints)
      out.files.push_back(numbered_files(keypoint_folder(name), kOpenPoseEnding, name + "_"));
    if (options.labels) out.files.push_back(numbered_files("labels/" + name, ".png"));
    if (options.flow) out.files.push_back(numbered_files("flow/" + name, ".flo"));
    if (options.depth) out.files.push_back(numbered_files("depth/" + name, ".pfm"));
    if (!rendered.camera.calibration.empty()) out.inputs.push_back(rendered.camera.calibration);
  }
  return out;
}

}  // namespace

size_t render_scene(const RenderJob& given, const JobControl& control) {
  RenderJob job = given;
  const int threads = thread_count(job.threads);
  std::optional<WalkedGait> walked;
  if (job.gait) {
    const double end = job.options.duration.value_or(kDefaultWalkDuration) + job.options.start;
    walked = walked_gait(*job.gait, subject_of(job.walker), job.options.slope,
                         std::max(0.0, end - job.walker.delay));
    job.walker.motion = walked->motion;
  }
  const Stage stage = make_stage(job.walker, job.options, calibrations(job.options));
  const std::vector<RenderedCamera> cameras = rendered_cameras(job.options, stage, threads);
  const ResultFolder folder(outputs_of(job, cameras), job.overwrite);
  const Actor& actor = stage.actors.front();
  const std::vector<double> times = scene_times(stage, job.options.frame_rate);
  const Motion truth = truth_at(stage, times);
  folder.write("truth.csv", motion_csv(truth));
  const std::vector<AngleRow> angles = angle_rows(truth, actor.body.lengths);
  folder.write("angles.csv", joint_angles_csv(angles));
  folder.write("events.csv", events_csv(actor.motion, stage.duration));
  std::vector<TableNotes> notes{joint_angles_notes(job.options.frame_rate)};
  if (walked) notes.push_back(write_kinetics(job, *walked, times, folder));
  folder.write("tables.json", tables_json(notes));
  size_t frames = 0;
  for (const RenderedCamera& rendered : cameras) {
    record(job, stage, rendered, folder, threads, control);
    if (control.stopping()) return frames;
    frames += rendered.frames;
  }
  folder.write(kSceneFile, scene_yaml(job, cameras, truth));
  return frames;
}

}  // namespace jobs
}  // namespace walktrack
