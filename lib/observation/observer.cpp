#include "observation/observer.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include <Eigen/Geometry>
#include <opencv2/imgproc.hpp>

#include "core/errors.h"
#include "observation/background/picture_change.h"
#include "observation/observed_frame.h"

namespace walktrack {
inline namespace observation {

namespace {

PixelRect image_area(const Camera& camera) { return {0, 0, camera.width_px, camera.height_px}; }

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

// Mask of the pixels at which the background behind people is unknown.
cv::Mat unseen_mask(const std::optional<BackgroundModel>& background) {
  if (!background) return {};
  const auto& precision = background->luma_precision;
  if (std::none_of(precision.begin(), precision.end(), never_seen)) return {};
  cv::Mat mask(background->height, background->width, CV_8U);
  std::transform(precision.begin(), precision.end(), mask.begin<uint8_t>(),
                 [](float each) { return never_seen(each) ? uint8_t{255} : uint8_t{0}; });
  return mask;
}

void set_mask(const std::vector<Polygon>& occluders, const cv::Mat& unseen,
              ObserverSetting& setting) {
  setting.occluded = !occluders.empty() || !unseen.empty();
  setting.mask = occluder_mask(setting.camera, occluders, setting.shrink);
  if (!unseen.empty() && unseen.size() == setting.mask.size()) setting.mask |= unseen;
}

void require_size(const cv::Mat& frame_bgr, const Camera& camera) {
  if (frame_bgr.type() == CV_8UC3 && frame_bgr.cols == camera.width_px &&
      frame_bgr.rows == camera.height_px)
    return;
  const auto size = [](int w, int h) { return std::to_string(w) + " x " + std::to_string(h); };
  throw InputError(describe(
      {}, "a frame of " + size(frame_bgr.cols, frame_bgr.rows),
      "8-bit BGR of " + size(camera.width_px, camera.height_px) + " px, as calibrated and shrunk"));
}

template <typename Term>
using PreparedOf = typename Term::Prepared;
template <typename Term>
using MemoryOf = typename Term::Memory;

}  // namespace

struct PreparedFrame::Content {
  ObservedFrame frame;
  Terms::map<std::tuple, PreparedOf> prepared;
};

PreparedFrame::PreparedFrame() : content_(std::make_unique<Content>()) {}
PreparedFrame::PreparedFrame(PreparedFrame&&) noexcept = default;
PreparedFrame& PreparedFrame::operator=(PreparedFrame&&) noexcept = default;
PreparedFrame::~PreparedFrame() = default;

const GreyImage& grey_of(ObservedFrame& frame) {
  GreyImage& grey = frame.grey;
  if (!grey.pixels.empty()) return grey;
  grey = {frame.bgr.cols, frame.bgr.rows, std::vector<uint8_t>(frame.bgr.total())};
  cv::cvtColor(frame.bgr, cv::Mat(grey.height, grey.width, CV_8U, grey.pixels.data()),
               cv::COLOR_BGR2GRAY);
  return grey;
}

struct Observer::State {
  State(const ObservationConfig& config, ObserverInput input)
      : setting{config, scaled_down(input.camera, input.shrink), input.shrink, input.threads, false,
                {}},
        unseen(unseen_mask(input.background)),
        change(input.background ? input.background->change : PictureChange{}),
        background_from_video(input.background ? input.background->from_video : 0),
        memories(Terms::make<std::tuple, MemoryOf>(setting, input)) {
    set_mask(input.occluders, unseen, setting);
  }

  template <typename Term>
  auto& memory() {
    return std::get<MemoryOf<Term>>(memories);
  }

  ObserverSetting setting;
  cv::Mat unseen;
  PictureChange change;          // of the background's model
  double background_from_video;  // of the same
  Terms::map<std::tuple, MemoryOf> memories;
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
    : state_(std::make_unique<State>(config, std::move(input))) {}

Observer::Observer(Observer&&) noexcept = default;
Observer& Observer::operator=(Observer&&) noexcept = default;
Observer::~Observer() = default;

const Camera& Observer::camera() const { return state_->setting.camera; }
int Observer::shrink() const { return state_->setting.shrink; }
const PictureChange& Observer::change() const { return state_->change; }
double Observer::background_from_video() const { return state_->background_from_video; }

void Observer::hide(const std::vector<Polygon>& occluders) {
  set_mask(occluders, state_->unseen, state_->setting);
}

void Observer::forget_previous_frame() {
  Terms::each([&]<typename Term>() { state_->memory<Term>().forget(); });
}

ObserverState Observer::state() const {
  ObserverState out;
  Terms::each([&]<typename Term>() {
    static_cast<typename Term::State&>(out) = state_->memory<Term>().state();
  });
  return out;
}

void Observer::resume(ObserverState state) {
  const ObserverSetting& setting = state_->setting;
  Terms::each([&]<typename Term>() {
    if (!state_->memory<Term>().fits(setting, state))
      throw InputError("an observer's state is of other images or classes than its camera");
  });
  Terms::each([&]<typename Term>() {
    state_->memory<Term>().resume(setting, static_cast<typename Term::State&&>(state));
  });
}

void Observer::observe(const cv::Mat& frame_bgr, const Region& region, CameraEvidence& out,
                       const DetectedPeople& people) {
  PreparedFrame frame;
  prepare(frame_bgr, region, state_->setting.threads, frame, people);
  complete(frame, out);
}

void Observer::prepare(const cv::Mat& frame_bgr, const Region& region, int threads,
                       PreparedFrame& prepared, const DetectedPeople& people) const {
  const ObserverSetting& setting = state_->setting;
  if (!frame_bgr.empty()) require_size(frame_bgr, setting.camera);
  PreparedFrame::Content& content = *prepared.content_;
  ObservedFrame& frame = content.frame;
  frame.bgr = changed(frame_bgr, state_->change);
  frame.region = region;
  frame.region.area = intersection(region.area, image_area(setting.camera));
  frame.grey = {};
  frame.background = {};
  frame.people = &people;
  Terms::each([&]<typename Term>() {
    state_->memory<Term>().prepare(setting, frame, threads,
                                   std::get<PreparedOf<Term>>(content.prepared));
  });
  frame.people = nullptr;
  frame.background = {};
}

void Observer::complete(PreparedFrame& prepared, CameraEvidence& out) {
  const ObserverSetting& setting = state_->setting;
  PreparedFrame::Content& content = *prepared.content_;
  Terms::each([&]<typename Term>() {
    state_->memory<Term>().complete(setting, content.frame,
                                    std::get<PreparedOf<Term>>(content.prepared), out);
  });
  out.pixel_weight = independent_share(setting.config, content.frame.region.metres_per_px);
}

bool Observer::learns() const {
  bool any = false;
  Terms::each([&]<typename Term>() { any = any || Term::Memory::learns(state_->setting.config); });
  return any;
}

void Observer::learn(const CameraEvidence& evidence, const CapsuleList& capsules,
                     const PosedBody* body) {
  Terms::each([&]<typename Term>() {
    state_->memory<Term>().learn(state_->setting, evidence, {capsules, body});
  });
}

}  // namespace observation
}  // namespace walktrack
