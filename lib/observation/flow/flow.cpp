#include "observation/flow/flow.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "observation/silhouette/visible_rows.h"

namespace walktrack {
inline namespace observation {

namespace {

using Eigen::Vector2d;
using Eigen::Vector2f;

const double kLogAnything = -std::log(256.0);

// The capsules in columns and rows of the lattice.
CapsuleList on_lattice(const FlowField& flow, const CapsuleList& capsules) {
  const Vector2d corner(flow.area.x0, flow.area.y0);
  const double share = 1.0 / flow.step;
  CapsuleList out;
  for (Capsule capsule : capsules) {
    for (Disc* disc : {&capsule.lower, &capsule.upper}) {
      disc->centre = share * (disc->centre - corner);
      disc->radius *= share;
    }
    out.insert(capsule);
  }
  return out;
}

// The part of the body in the previous frame in each cell, counted from 1; 0 = none.
struct PartMap {
  std::array<uint8_t, kMaxFlowCells> part;
  int columns, rows;

  uint8_t at(int column, int row) const {
    return part[static_cast<size_t>(row) * static_cast<size_t>(columns) +
                static_cast<size_t>(column)];
  }
};

// Draws the body of the previous frame and returns the sum over what would be uncovered if it were
// absent now.
double draw_before(const FlowField& flow, const CapsuleList& before, PartMap& map) {
  map.columns = flow.columns;
  map.rows = flow.rows;
  std::fill_n(map.part.begin(), flow.cells.size(), uint8_t{0});
  int64_t sum = 0;
  visit_visible(flow.uncovered.area, before, [&](int row, int begin, int end, size_t i) {
    if (begin >= end) return;
    const int32_t* const prefix = flow.uncovered.row(0, row).data();
    sum += prefix[end] - prefix[begin];
    const auto at = static_cast<size_t>(row) * static_cast<size_t>(flow.columns);
    std::fill(map.part.begin() + static_cast<std::ptrdiff_t>(at) + begin,
              map.part.begin() + static_cast<std::ptrdiff_t>(at) + end,
              static_cast<uint8_t>(before[i].part + 1));
  });
  return static_cast<double>(sum) / LogRatioPlanes::kNat;
}

// The points of a part in the previous frame: cell (column, row) shows the point that was at corner
// + column right + row down, in pixels from the corner of FlowField::known.
struct Origin {
  Vector2f corner, right, down;
  float error2;  // squared error of that position, px^2
  bool known;    // whether the part was in the image
};

struct Limb {
  Vector2d middle, axis, aside;  // px; unit vectors
  double length, width;          // px; half the axis with the ends, the radius in the middle
};

Limb limb_of(const Capsule& capsule) {
  const Vector2d along = capsule.upper.centre - capsule.lower.centre;
  const double length = along.norm();
  const Vector2d axis = length > 1e-6 ? Vector2d(along / length) : Vector2d(0, -1);
  const double width = 0.5 * (capsule.lower.radius + capsule.upper.radius);
  return {0.5 * (capsule.lower.centre + capsule.upper.centre),
          axis,
          {-axis.y(), axis.x()},
          0.5 * length + width,
          width};
}

// A point moves with its part: its coordinates along the axis and across are constant shares of
// length and width.
Origin origin_of(const FlowConfig& config, const FlowField& flow, const Capsule& now,
                 const Capsule& before) {
  const Limb is = limb_of(now), was = limb_of(before);
  const double along = was.length / is.length, aside = was.width / is.width;
  const auto carried = [&](const Vector2d& offset) {
    return Vector2d(along * offset.dot(is.axis) * was.axis +
                    aside * offset.dot(is.aside) * was.aside);
  };
  const Vector2d start(flow.area.x0, flow.area.y0), from(flow.known.x0, flow.known.y0);
  const double motion = config.error_share * (was.middle - is.middle).norm();
  return {(was.middle + carried(start - is.middle) - from).cast<float>(),
          carried({static_cast<double>(flow.step), 0}).cast<float>(),
          carried({0, static_cast<double>(flow.step)}).cast<float>(),
          static_cast<float>(config.error_px * config.error_px + motion * motion), true};
}

// A product of Student-t densities; logarithms are taken of several factors at a time, few enough
// not to overflow.
class Likelihood {
 public:
  Likelihood(const FlowConfig& config)
      : noise2_(static_cast<float>(config.noise * config.noise)),
        dof_(static_cast<float>(config.dof)) {}

  void multiply(float difference, float error2_slope2) {
    const float scale2 = noise2_ + error2_slope2;
    scales_ *= static_cast<double>(scale2);
    misses_ *=
        static_cast<double>(dof_ * scale2 + std::min(difference * difference, kStrangest * scale2));
    if (++factors_ % kMostFactors == 0) take_logs();
  }
  void multiply_by_anything() { ++anything_; }

  double log() {
    take_logs();
    const double dof = static_cast<double>(dof_);
    return log_t_peak(dof) * factors_ + 0.5 * dof * log_scales_ - 0.5 * (dof + 1) * log_misses_ +
           kLogAnything * anything_;
  }

 private:
  // Factors are at most 1e17, with the largest errors that a configuration may state.
  static constexpr int kMostFactors = 16;

  void take_logs() {
    log_scales_ += std::log(scales_);
    log_misses_ += std::log(misses_);
    scales_ = misses_ = 1;
  }

  float noise2_, dof_;
  double scales_ = 1, misses_ = 1;
  double log_scales_ = 0, log_misses_ = 0;
  int factors_ = 0, anything_ = 0;
};

// A run of cells in a row that shows one part.
struct Run {
  int row, begin, end;
  int part;  // counted from 1
};

class BodyPixels {
 public:
  BodyPixels(const FlowConfig& config, const FlowField& flow, const PartMap& before)
      : flow_(flow),
        before_(before),
        likelihood_(config),
        to_cells_(1.0F / static_cast<float>(flow.step)),
        shift_(static_cast<float>(flow.known.x0 - flow.area.x0) * to_cells_ + 0.5F,
               static_cast<float>(flow.known.y0 - flow.area.y0) * to_cells_ + 0.5F),
        width_(flow.known.width()),
        limit_(static_cast<float>(width_ - 1), static_cast<float>(flow.known.height() - 1)) {}

  void add(const Run& run, const Origin& origin) {
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(run.row) * flow_.columns + run.begin;
    const FlowCell* cell = flow_.cells.data() + first;
    const uint8_t* shown = before_.part.data() + first;
    Vector2f was = origin.corner + static_cast<float>(run.begin) * origin.right +
                   static_cast<float>(run.row) * origin.down;
    float given_up = 0;
    for (int column = run.begin; column < run.end; ++column, ++cell, ++shown, was += origin.right) {
      if (cell->now < 0) continue;
      given_up += cell->at_rest + (*shown != 0 ? cell->uncovered : 0);
      multiply(*cell, was, run.part, origin);
    }
    sum_ -= static_cast<double>(given_up);
  }

  double log_ratio() { return sum_ + likelihood_.log(); }

 private:
  void multiply(const FlowCell& cell, const Vector2f& was, int part, const Origin& origin) {
    const float x = was.x(), y = was.y();
    if (!origin.known || !(x >= 0 && y >= 0 && x < limit_.x() && y < limit_.y()) ||
        hidden(was, part))
      return likelihood_.multiply_by_anything();
    const auto i = static_cast<int>(x), j = static_cast<int>(y);
    const float right = x - static_cast<float>(i), down = y - static_cast<float>(j);
    const EarlierPixel* const top =
        flow_.before.data() + static_cast<std::ptrdiff_t>(j) * width_ + i;
    const EarlierPixel* const bottom = top + width_;
    const float slope2 = (down < 0.5F ? top : bottom)[right < 0.5F ? 0 : 1].slope2;
    if (slope2 < 0) return likelihood_.multiply_by_anything();
    const float above = top[0].grey + right * (top[1].grey - top[0].grey);
    const float below = bottom[0].grey + right * (bottom[1].grey - bottom[0].grey);
    likelihood_.multiply(cell.now - (above + down * (below - above)), origin.error2 * slope2);
  }

  // Hidden by another part in the previous frame.
  bool hidden(const Vector2f& was, int part) const {
    const float x = was.x() * to_cells_ + shift_.x(), y = was.y() * to_cells_ + shift_.y();
    if (!(x >= 0 && y >= 0)) return false;
    const auto column = static_cast<int>(x), row = static_cast<int>(y);
    if (column >= before_.columns || row >= before_.rows) return false;
    const uint8_t shown = before_.at(column, row);
    return shown != 0 && shown != part;
  }

  const FlowField& flow_;
  const PartMap& before_;
  Likelihood likelihood_;
  float to_cells_;
  Vector2f shift_;
  int width_;
  Vector2f limit_;
  double sum_ = 0;
};

}  // namespace

double flow_log_ratio(const FlowConfig& config, const FlowField& flow, const CapsuleList& now,
                      const CapsuleList& before) {
  if (flow.cells.empty()) return 0;
  std::array<Origin, kMaxCapsules> origins;
  std::array<const Capsule*, kMaxCapsules> earlier{};
  for (const Capsule& capsule : before) earlier[static_cast<size_t>(capsule.part)] = &capsule;
  for (size_t i = 0; i < now.size(); ++i) {
    const Capsule* const was = earlier[static_cast<size_t>(now[i].part)];
    origins[i] = was ? origin_of(config, flow, now[i], *was) : Origin{};
  }
  PartMap map;
  const double uncovered = draw_before(flow, on_lattice(flow, before), map);
  BodyPixels body(config, flow, map);
  visit_visible(flow.uncovered.area, on_lattice(flow, now),
                [&](int row, int begin, int end, size_t i) {
                  if (begin < end) body.add({row, begin, end, now[i].part + 1}, origins[i]);
                });
  return flow.step * flow.step * (uncovered + body.log_ratio());
}

}  // namespace observation
}  // namespace walktrack
