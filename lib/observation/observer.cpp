#include "observation/observer.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Geometry>
#include <opencv2/imgproc.hpp>

#include "core/errors.h"
#include "core/parallel_for.h"
#include "observation/shrink.h"
#include "observation/silhouette.h"

namespace walktrack {

namespace {

// Rows of the background that follow the light in one frame: every eighth, in turn.
constexpr int kDriftRows = 8;
// Rows that are worked on together.
constexpr int kBand = 32;
// Colours are learned from the inner part of each silhouette, where the body is surely.
constexpr double kInner = 0.75;

PixelRect image_area(const Camera& camera) { return {0, 0, camera.width_px, camera.height_px}; }

// One pixel more on all sides where there is one: gradients need neighbours.
PixelRect with_border(const PixelRect& area, const Camera& camera) {
  return intersection({area.x0 - 1, area.y0 - 1, area.x1 + 1, area.y1 + 1}, image_area(camera));
}

cv::Mat occluder_mask(const Camera& camera, const std::vector<Polygon>& occluders, int shrink) {
  cv::Mat mask = cv::Mat::zeros(camera.height_px, camera.width_px, CV_8U);
  for (const Polygon& polygon : occluders) {
    std::vector<cv::Point> corners;
    for (const Eigen::Vector2d& p : polygon) {
      const Eigen::Vector2d small = (p.array() + 0.5) / shrink - 0.5;
      corners.emplace_back(static_cast<int>(std::lround(small.x())),
                           static_cast<int>(std::lround(small.y())));
    }
    if (!corners.empty())
      cv::fillPoly(mask, std::vector<std::vector<cv::Point>>{corners}, cv::Scalar(255));
  }
  return mask;
}

// The colours of a whole image, as a class of its own: what stands against the walker's colours
// where no background is modelled.
ColourTable scene_table(const ColourBins& bins, const cv::Mat& bgr) {
  ForegroundConfig config;
  config.classes.fill(0);
  AppearanceModel scene(config, {true});
  AppearanceModel::Counts counts = scene.empty_counts();
  ColourPatch patch;
  read_colours(bgr, {0, 0, bgr.cols, bgr.rows}, patch);
  for (size_t i = 0; i < patch.luma.size(); ++i)
    counts.weights[0][bins.bin(patch.luma[i], patch.orange[i], patch.green[i])] += 1;
  counts.seen[0] = static_cast<double>(patch.luma.size());
  scene.learn(bins, counts);
  return scene.table(0);
}

}  // namespace

struct PreparedFrame::Content {
  Region region;
  cv::Mat bgr;                // shrunk
  ColourPatch colours;        // of the region and a border
  double gain = 1;            // strength of the light; 1 without a background
  std::vector<float> behind;  // log densities under the background, row by row of the area
  cv::Mat grey;               // empty unless flow or the picture needs it
  FlowField flow;
};

PreparedFrame::PreparedFrame() : content_(std::make_unique<Content>()) {}
PreparedFrame::PreparedFrame(PreparedFrame&&) noexcept = default;
PreparedFrame& PreparedFrame::operator=(PreparedFrame&&) noexcept = default;
PreparedFrame::~PreparedFrame() = default;

struct Observer::State {
  using Content = PreparedFrame::Content;

  State(const ObservationConfig& settings, ObserverInput input)
      : config(settings),
        camera(scaled_down(input.camera, input.shrink)),
        full_camera(input.camera),
        shrink(input.shrink),
        background(std::move(input.background)),
        threads(input.threads),
        occluded(!input.occluders.empty()),
        mask(occluder_mask(camera, input.occluders, input.shrink)),
        appearance(settings.foreground, input.appearances),
        broad(broad_table(bins)) {}

  bool uses_colours() const { return config.background.enabled || config.foreground.enabled; }
  void read_background(int sharing, Content& frame) const;
  void fill_planes(const Content& frame, LogRatioPlanes& planes);
  int planes_wanted() const;
  void fill_rows(const Content& frame, int begin, int end, LogRatioPlanes& planes) const;
  void block_flow(FlowField& flow) const;

  ObservationConfig config;
  Camera camera, full_camera;
  int shrink;
  std::optional<BackgroundModel> background;
  int threads;
  bool occluded;
  cv::Mat mask;  // 255 where an occluder stands
  AppearanceModel appearance;
  ColourBins bins;
  ColourTable scene;  // only without a background model
  ColourTable broad;
  cv::Mat grey_before;
  int64_t frames = 0;
  ColourPatch patch;  // of the frame observed last
};

Region whole_image(const Camera& camera, double metres_per_px) {
  return {image_area(camera), metres_per_px};
}

Region person_region(const Camera& camera, const Eigen::Vector2d& position, double height,
                     double margin) {
  Eigen::AlignedBox2d box;
  for (const double x : {-margin, margin}) {
    for (const double y : {-margin, margin}) {
      for (const double z : {-margin / 4, height + margin / 4}) {
        const auto pixel = project(camera, {position.x() + x, position.y() + y, z});
        if (pixel) box.extend(*pixel);
      }
    }
  }
  const double depth = camera_point(camera, {position.x(), position.y(), height / 2}).z();
  if (box.isEmpty() || depth < kMinDepth) return {{}, 1};
  const auto bound = [](double value, int limit) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(limit)));
  };
  const PixelRect area{bound(std::floor(box.min().x()), camera.width_px),
                       bound(std::floor(box.min().y()), camera.height_px),
                       bound(std::ceil(box.max().x()) + 1, camera.width_px),
                       bound(std::ceil(box.max().y()) + 1, camera.height_px)};
  return {area, depth / camera.focal_px.mean()};
}

double independent_share(const ObservationConfig& config, double metres_per_px) {
  return std::min(1.0, std::pow(metres_per_px / config.independent_m, 2));
}

std::array<bool, kAppearanceCount> appearances_of(const Body& body) {
  std::array<bool, kAppearanceCount> used{};
  for (const Part& part : body.parts) used[static_cast<size_t>(part.appearance)] = true;
  return used;
}

Observer::Observer(const ObservationConfig& config, ObserverInput input)
    : state_(std::make_unique<State>(config, std::move(input))) {
  const State& s = *state_;
  if (!config.background.enabled) return;
  if (!s.background) throw InputError("background: enabled, but there is no model of it");
  if (s.background->width != s.camera.width_px || s.background->height != s.camera.height_px) {
    const auto size = [](int w, int h) { return std::to_string(w) + " x " + std::to_string(h); };
    throw InputError(describe({"", 0, "background"},
                              size(s.background->width, s.background->height) + " px",
                              size(s.camera.width_px, s.camera.height_px) +
                                  " px, the calibrated size divided by the shrink factor"));
  }
}

Observer::Observer(Observer&&) noexcept = default;
Observer& Observer::operator=(Observer&&) noexcept = default;
Observer::~Observer() = default;

const Camera& Observer::camera() const { return state_->camera; }

void Observer::hide(const std::vector<Polygon>& occluders) {
  state_->occluded = !occluders.empty();
  state_->mask = occluder_mask(state_->camera, occluders, state_->shrink);
}

void Observer::forget_previous_frame() { state_->grey_before.release(); }

bool Observer::knows_walker() const { return state_->appearance.any_learned(); }

ObserverState Observer::state() const {
  const State& s = *state_;
  ObserverState out{s.background, s.appearance.states(), s.scene, 0, 0, {}, s.frames};
  if (s.grey_before.empty()) return out;
  out.grey_width = s.grey_before.cols;
  out.grey_height = s.grey_before.rows;
  out.grey_before.assign(s.grey_before.data, s.grey_before.data + s.grey_before.total());
  return out;
}

void Observer::resume(ObserverState state) {
  State& s = *state_;
  const auto of_the_camera = [&](int width, int height) {
    return width == s.camera.width_px && height == s.camera.height_px;
  };
  const bool fits =
      state.background.has_value() == s.background.has_value() &&
      (!state.background || of_the_camera(state.background->width, state.background->height)) &&
      (state.grey_before.empty() || of_the_camera(state.grey_width, state.grey_height)) &&
      state.appearance.size() == s.appearance.states().size();
  if (!fits) throw InputError("an observer's state is of other images or classes than its camera");
  s.background = std::move(state.background);
  s.appearance.resume(std::move(state.appearance));
  s.scene = std::move(state.scene);
  s.frames = state.frames;
  s.grey_before.release();
  if (!state.grey_before.empty())
    s.grey_before =
        cv::Mat(state.grey_height, state.grey_width, CV_8U, state.grey_before.data()).clone();
}

void Observer::observe(const cv::Mat& frame_bgr, const Region& region, CameraEvidence& out) {
  PreparedFrame frame;
  prepare(frame_bgr, region, state_->threads, frame);
  complete(frame, out);
}

void Observer::prepare(const cv::Mat& frame_bgr, const Region& region, int threads,
                       PreparedFrame& prepared) const {
  const State& s = *state_;
  PreparedFrame::Content& out = *prepared.content_;
  if (frame_bgr.type() != CV_8UC3 || frame_bgr.cols != s.full_camera.width_px ||
      frame_bgr.rows != s.full_camera.height_px) {
    throw InputError(describe(
        {}, "a frame of " + std::to_string(frame_bgr.cols) + " x " + std::to_string(frame_bgr.rows),
        "8-bit BGR of " + std::to_string(s.full_camera.width_px) + " x " +
            std::to_string(s.full_camera.height_px) + " px, as calibrated"));
  }
  out.bgr = shrunk(frame_bgr, s.shrink);
  out.region = region;
  out.region.area = intersection(region.area, image_area(s.camera));
  if (s.uses_colours()) read_colours(out.bgr, with_border(out.region.area, s.camera), out.colours);
  if (s.config.background.enabled) s.read_background(threads, out);
  out.grey.release();
  if (s.config.flow.enabled || region.picture) cv::cvtColor(out.bgr, out.grey, cv::COLOR_BGR2GRAY);
  out.flow.area = {};  // none, but for its memory, where there is no frame before
  out.flow.pixels.clear();
  if (s.config.flow.enabled && !s.grey_before.empty())
    pair_frames(s.config.flow, s.grey_before, out.grey, out.region.area, out.flow);
}

void Observer::complete(PreparedFrame& prepared, CameraEvidence& out) {
  State& s = *state_;
  PreparedFrame::Content& frame = *prepared.content_;
  if (s.uses_colours()) s.fill_planes(frame, out.planes);
  if (s.config.background.enabled && s.config.background.drift_rate > 0)
    follow_drift(*s.background, s.config.background, frame.bgr, frame.gain,
                 static_cast<int>(s.frames % kDriftRows), kDriftRows);
  std::swap(s.patch, frame.colours);
  std::swap(out.flow, frame.flow);
  if (s.occluded) s.block_flow(out.flow);
  if (s.config.flow.enabled) s.grey_before = frame.grey;
  out.picture = {};
  if (frame.region.picture)
    out.picture = {frame.grey.cols, frame.grey.rows, {frame.grey.datastart, frame.grey.dataend}};
  out.pixel_weight = independent_share(s.config, frame.region.metres_per_px);
  ++s.frames;
}

// One generic plane until the walker's colours are known; without a background, nothing until then.
int Observer::State::planes_wanted() const {
  if (config.foreground.enabled && appearance.any_learned()) return appearance.classes();
  return config.background.enabled ? 1 : 0;
}

// f(begin, end) for bands of rows that make up the area.
template <typename F>
void for_bands(const PixelRect& area, int threads, const F& f) {
  const size_t bands = (static_cast<size_t>(area.height()) + kBand - 1) / kBand;
  parallel_for(bands, threads, [&](size_t band) {
    const int begin = area.y0 + static_cast<int>(band) * kBand;
    f(begin, std::min(begin + kBand, area.y1));
  });
}

void Observer::State::read_background(int sharing, Content& frame) const {
  const PixelRect& area = frame.region.area;
  frame.gain = light_gain(*background, frame.bgr);
  const auto width = static_cast<size_t>(area.width());
  frame.behind.resize(width * static_cast<size_t>(area.height()));
  for_bands(area, sharing, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      background_log_density(
          *background, config.background, frame.colours, area, y, frame.gain,
          {frame.behind.data() + width * static_cast<size_t>(y - area.y0), width});
  });
}

void Observer::State::fill_planes(const Content& frame, LogRatioPlanes& planes) {
  const PixelRect& area = frame.region.area;
  if (!config.background.enabled && scene.empty()) scene = scene_table(bins, frame.bgr);
  const bool learned = config.foreground.enabled && appearance.any_learned();
  planes.plane_of = learned ? appearance.class_of() : std::array<int, kAppearanceCount>{};
  resize(planes, area, planes_wanted());
  if (planes.count == 0 || area.empty()) return;
  for_bands(area, threads, [&](int begin, int end) { fill_rows(frame, begin, end, planes); });
}

void Observer::State::fill_rows(const Content& frame, int begin, int end,
                                LogRatioPlanes& planes) const {
  const PixelRect& area = planes.area;
  const ColourPatch& seen = frame.colours;
  const auto width = static_cast<size_t>(area.width());
  std::vector<uint16_t> colours(width);
  std::vector<float> of_scene(width), ratio(width);
  for (int y = begin; y < end; ++y) {
    const size_t at = seen.index(area.x0, y);
    for (size_t i = 0; i < width; ++i)
      colours[i] = bins.bin(seen.luma[at + i], seen.orange[at + i], seen.green[at + i]);
    const float* behind = frame.behind.data() + width * static_cast<size_t>(y - area.y0);
    if (!config.background.enabled) {
      for (size_t i = 0; i < width; ++i) of_scene[i] = scene[colours[i]];
      behind = of_scene.data();
    }
    const uint8_t* const blocked = occluded ? mask.ptr<uint8_t>(y) + area.x0 : nullptr;
    for (int plane = 0; plane < planes.count; ++plane) {
      const ColourTable& table = config.foreground.enabled ? appearance.table(plane) : broad;
      for (size_t i = 0; i < width; ++i) ratio[i] = table[colours[i]] - behind[i];
      for (size_t i = 0; blocked && i < width; ++i)
        if (blocked[i]) ratio[i] = 0;
      set_row(planes, plane, y, ratio, config.clip);
    }
  }
}

// Pixels that smoothing mixes with an occluder's say nothing.
void Observer::State::block_flow(FlowField& flow) const {
  constexpr int kReach = 2;
  cv::Mat near;
  cv::dilate(mask, near, cv::Mat::ones(2 * kReach + 1, 2 * kReach + 1, CV_8U));
  auto pixel = flow.pixels.begin();
  for (int y = flow.area.y0; y < flow.area.y1; ++y)
    for (int x = flow.area.x0; x < flow.area.x1; ++x, ++pixel)
      if (near.at<uint8_t>(y, x)) pixel->precision = 0;
}

void Observer::learn(const CameraEvidence& evidence, const CapsuleList& capsules) {
  State& s = *state_;
  if (!s.config.foreground.enabled) return;
  AppearanceModel::Counts counts = s.appearance.empty_counts();
  const CapsuleList inner = scaled_radii(capsules, kInner);
  for (const VisibleRun& run : visible_runs(evidence.planes.area, inner)) {
    const Appearance appearance = inner[static_cast<size_t>(run.capsule)].appearance;
    const auto cls = static_cast<size_t>(s.appearance.class_of()[static_cast<size_t>(appearance)]);
    for (int x = run.x0; x < run.x1; ++x) {
      const size_t i = s.patch.index(x, run.y);
      if (s.occluded && s.mask.at<uint8_t>(run.y, x)) continue;
      const double ratio = log_ratio_at(evidence.planes, appearance, x, run.y);
      const double foreground = 1 / (1 + std::exp(-ratio));
      counts.weights[cls][s.bins.bin(s.patch.luma[i], s.patch.orange[i], s.patch.green[i])] +=
          static_cast<float>(foreground);
      counts.seen[cls] += 1;
    }
  }
  s.appearance.learn(s.bins, counts);
}

}  // namespace walktrack
