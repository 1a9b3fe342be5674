#include "observation/silhouette/silhouette_term.h"

#include <algorithm>
#include <limits>
#include <string>

#include "core/errors.h"
#include "core/parallel_for.h"
#include "observation/observed_frame.h"
#include "observation/silhouette/silhouette.h"

namespace walktrack {
inline namespace observation {

namespace {

// In each frame, every eighth row of the background is adapted to the light, in turn.
constexpr int kDriftRows = 8;
// Number of rows that are processed together.
constexpr int kBand = 32;
// Colours are learned from the inner part of each silhouette, which certainly shows the body. By
// hand.
constexpr double kInner = 0.75;

// CPU time for a frame, nanoseconds, as scripts/measure_costs.py prints it.
constexpr double kBackground = 22.2;
constexpr double kAppearance = 2.0e5;
constexpr double kRowSummed = 8.71;

bool uses_colours(const ObservationConfig& config) {
  return config.background.enabled || config.foreground.enabled;
}

// Adds one pixel on all sides inside the image: gradients need neighbours.
PixelRect with_border(const PixelRect& area, const Camera& camera) {
  return intersection({area.x0 - 1, area.y0 - 1, area.x1 + 1, area.y1 + 1},
                      {0, 0, camera.width_px, camera.height_px});
}

// The colours of a whole image, as a class of its own, to which the subject's colours are compared
// if there is no model of the background.
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

void require_background(const std::optional<BackgroundModel>& background, const Camera& camera) {
  if (!background) throw InputError("background: enabled, but there is no model of it");
  if (background->width == camera.width_px && background->height == camera.height_px) return;
  const auto size = [](int w, int h) { return std::to_string(w) + " x " + std::to_string(h); };
  throw InputError(describe({"", 0, "background"},
                            size(background->width, background->height) + " px",
                            size(camera.width_px, camera.height_px) +
                                " px, the calibrated size divided by the shrink factor"));
}

// Calls f(begin, end) for bands of rows that cover the area.
template <typename F>
void for_bands(const PixelRect& area, int threads, const F& f) {
  const size_t bands = (static_cast<size_t>(area.height()) + kBand - 1) / kBand;
  parallel_for(bands, threads, [&](size_t band) {
    const int begin = area.y0 + static_cast<int>(band) * kBand;
    f(begin, std::min(begin + kBand, area.y1));
  });
}

}  // namespace

SilhouetteTerm::Memory::Memory(const ObserverSetting& setting, ObserverInput& input)
    : background_(std::move(input.background)),
      appearance_(setting.config.foreground, input.appearances,
                  background_ && background_->change.colourless),
      broad_(broad_table(bins_, background_ && background_->change.colourless)) {
  if (setting.config.background.enabled && input.pictures)
    require_background(background_, setting.camera);
}

void SilhouetteTerm::Memory::prepare(const ObserverSetting& setting, ObservedFrame& frame,
                                     int threads, Prepared& out) const {
  if (frame.bgr.empty() || !uses_colours(setting.config)) return;
  const PixelRect& area = frame.region.area;
  read_colours(frame.bgr, with_border(area, setting.camera), out.colours);
  if (!setting.config.background.enabled) return;
  out.gain = light_gain(*background_, frame.bgr);
  frame.background = {&*background_, out.gain};
  const auto width = static_cast<size_t>(area.width());
  out.behind.resize(width * static_cast<size_t>(area.height()));
  for_bands(area, threads, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      background_log_density(*background_, setting.config.background, out.colours, area, y,
                             out.gain,
                             {out.behind.data() + width * static_cast<size_t>(y - area.y0), width});
  });
}

void SilhouetteTerm::Memory::complete(const ObserverSetting& setting, ObservedFrame& frame,
                                      Prepared& prepared, CameraEvidence& out) {
  if (frame.bgr.empty()) {
    out.planes.count = 0;
    out.planes.area = {};
    out.colours = {};
    return;
  }
  const BackgroundConfig& background = setting.config.background;
  if (uses_colours(setting.config)) fill_planes(setting, frame, prepared, out.planes);
  out.colours = seen_colours(setting, frame, prepared);
  if (background.enabled && background.drift_rate > 0)
    follow_drift(*background_, background, frame.bgr, prepared.gain,
                 static_cast<int>(frames_ % kDriftRows), kDriftRows);
  std::swap(patch_, prepared.colours);
  ++frames_;
}

// One generic plane until the subject's colours are known; without a background, no plane until
// then.
int SilhouetteTerm::Memory::planes_wanted(const ObservationConfig& config) const {
  if (knows_colours(config)) return appearance_.classes();
  return config.background.enabled ? 1 : 0;
}

bool SilhouetteTerm::Memory::knows_colours(const ObservationConfig& config) const {
  return config.foreground.enabled && appearance_.any_learned();
}

uint16_t SilhouetteTerm::Memory::bin_of(const ColourPatch& patch, size_t index) const {
  return bins_.bin(patch.luma[index], patch.orange[index], patch.green[index]);
}

void SilhouetteTerm::Memory::fill_planes(const ObserverSetting& setting, const ObservedFrame& frame,
                                         const Prepared& prepared, LogRatioPlanes& planes) {
  const PixelRect& area = frame.region.area;
  const ObservationConfig& config = setting.config;
  if (!config.background.enabled && scene_.empty()) scene_ = scene_table(bins_, frame.bgr);
  planes.plane_of =
      knows_colours(config) ? appearance_.class_of() : std::array<int, kAppearanceCount>{};
  resize(planes, area, planes_wanted(config));
  if (planes.count == 0 || area.empty()) return;
  for_bands(area, setting.threads,
            [&](int begin, int end) { fill_rows(setting, prepared, begin, end, planes); });
}

void SilhouetteTerm::Memory::fill_rows(const ObserverSetting& setting, const Prepared& prepared,
                                       int begin, int end, LogRatioPlanes& planes) const {
  const PixelRect& area = planes.area;
  const ObservationConfig& config = setting.config;
  const ColourPatch& seen = prepared.colours;
  const auto width = static_cast<size_t>(area.width());
  std::vector<uint16_t> colours(width);
  std::vector<float> of_scene(width), ratio(width);
  for (int y = begin; y < end; ++y) {
    const size_t at = seen.index(area.x0, y);
    for (size_t i = 0; i < width; ++i) colours[i] = bin_of(seen, at + i);
    const float* behind = prepared.behind.data() + width * static_cast<size_t>(y - area.y0);
    if (!config.background.enabled) {
      for (size_t i = 0; i < width; ++i) of_scene[i] = scene_[colours[i]];
      behind = of_scene.data();
    }
    const uint8_t* const blocked =
        setting.occluded ? setting.mask.ptr<uint8_t>(y) + area.x0 : nullptr;
    for (int plane = 0; plane < planes.count; ++plane) {
      const ColourTable& table = config.foreground.enabled ? appearance_.table(plane) : broad_;
      for (size_t i = 0; i < width; ++i) ratio[i] = table[colours[i]] - behind[i];
      for (size_t i = 0; blocked && i < width; ++i)
        if (blocked[i]) ratio[i] = 0;
      set_row(planes, plane, y, ratio, config.clip);
    }
  }
}

SeenColours SilhouetteTerm::Memory::seen_colours(const ObserverSetting& setting,
                                                 const ObservedFrame& frame,
                                                 const Prepared& prepared) const {
  const bool wanted = frame.region.picture && setting.config.background.enabled &&
                      setting.config.foreground.enabled && !knows_colours(setting.config);
  if (!wanted) return {};
  const PixelRect& area = frame.region.area;
  SeenColours seen;
  seen.area = area;
  seen.colourless = background_->change.colourless;
  seen.bin.reserve(prepared.behind.size());
  seen.behind.reserve(prepared.behind.size());
  constexpr auto kNat = static_cast<float>(LogRatioPlanes::kNat);
  constexpr float kMost = std::numeric_limits<int16_t>::max();
  for (int y = area.y0; y < area.y1; ++y) {
    for (int x = area.x0; x < area.x1; ++x) {
      const bool unknown = setting.occluded && setting.mask.at<uint8_t>(y, x);
      const float behind = kNat * prepared.behind[seen.bin.size()];
      seen.bin.push_back(bin_of(prepared.colours, prepared.colours.index(x, y)));
      seen.behind.push_back(unknown ? SeenColours::kUnknown
                                    : static_cast<int16_t>(std::clamp(behind, -kMost, kMost)));
    }
  }
  return seen;
}

void SilhouetteTerm::Memory::learn(const ObserverSetting& setting, const CameraEvidence& evidence,
                                   const FoundPose& found) {
  if (!setting.config.foreground.enabled) return;
  const auto bin_at = [&](int x, int y) -> std::optional<uint16_t> {
    if (setting.occluded && setting.mask.at<uint8_t>(y, x)) return std::nullopt;
    return bin_of(patch_, patch_.index(x, y));
  };
  appearance_.learn(bins_, colours_inside(scaled_radii(found.capsules, kInner), evidence.planes,
                                          appearance_, bin_at));
}

SilhouetteTerm::State SilhouetteTerm::Memory::state() const {
  return {background_, appearance_.states(), scene_, frames_};
}

bool SilhouetteTerm::Memory::fits(const ObserverSetting& setting, const State& state) const {
  const auto& background = state.background;
  return background.has_value() == background_.has_value() &&
         (!background || (background->width == setting.camera.width_px &&
                          background->height == setting.camera.height_px)) &&
         state.appearance.size() == appearance_.states().size();
}

void SilhouetteTerm::Memory::resume(const ObserverSetting&, State state) {
  background_ = std::move(state.background);
  appearance_.resume(std::move(state.appearance));
  scene_ = std::move(state.scene);
  frames_ = state.frames;
}

bool SilhouetteTerm::says(const CameraEvidence& evidence) { return evidence.planes.count > 0; }

double SilhouetteTerm::log_likelihood(const ObservationConfig& config,
                                      const CameraEvidence& evidence, const Camera& camera,
                                      const PosedBody& now, const PosedBody*) {
  return config.outline_share * evidence.pixel_weight *
         silhouette_log_ratio(evidence.planes, project_parts(camera, now.parts));
}

TermCosts SilhouetteTerm::cost(const ObservationConfig& config, const TermWork& work) {
  TermCosts out;
  if (config.background.enabled) out.push_back({"background", kBackground * work.region_px});
  if (config.foreground.enabled) out.push_back({"appearance", kAppearance * work.classes});
  if (uses_colours(config)) out.push_back({"silhouettes", kRowSummed * work.poses * work.rows});
  return out;
}

}  // namespace observation
}  // namespace walktrack
