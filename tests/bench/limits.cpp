#include "tests/bench/limits.h"

#include <algorithm>
#include <cmath>

namespace walktrack::limits {
namespace {

constexpr size_t kLanes = 8;
using Lanes = double __attribute__((vector_size(kLanes * sizeof(double))));

// Taylor series, exact to rounding below pi/2.
void sine_and_cosine(Lanes a, Lanes& sine, Lanes& cosine) {
  constexpr int kTerms = 10;
  const Lanes square = a * a;
  Lanes s = square * 0 + 1, c = s;
  for (int n = kTerms; n > 0; --n) {
    c = 1 - c * square * (1.0 / ((2 * n - 1) * (2 * n)));
    s = 1 - s * square * (1.0 / ((2 * n) * (2 * n + 1)));
  }
  sine = a * s;
  cosine = c;
}

struct Lines {
  Lanes v[5];
};

// M = L D L', in place; b becomes the solution.
void solve(Lanes (&m)[5][5], Lanes (&b)[5]) {
  Lanes inverse[5];
  for (int j = 0; j < 5; ++j) {
    inverse[j] = 1 / m[j][j];
    for (int i = j + 1; i < 5; ++i) {
      const Lanes factor = m[i][j] * inverse[j];
      for (int k = j + 1; k <= i; ++k) m[i][k] -= factor * m[k][j];
      b[i] -= factor * b[j];
    }
  }
  for (int i = 4; i >= 0; --i) {
    for (int k = i + 1; k < 5; ++k) b[i] -= m[k][i] * b[k];
    b[i] *= inverse[i];
  }
}

void accelerations_of_eight(const Linkage& p, const Lines& q, const Lines& qd, Lines& qdd) {
  Lanes s[5], c[5], x[5], square[5], m[5][5], b[5];
  Lanes sway = q.v[0] * 0;
  for (int k = 0; k < 5; ++k) {
    sine_and_cosine(q.v[k], s[k], c[k]);
    x[k] = p.along[k] * c[k] - p.across[k] * s[k];
    const Lanes z = p.along[k] * s[k] + p.across[k] * c[k];
    square[k] = qd.v[k] * qd.v[k];
    b[k] = p.gravity_x * x[k] - p.gravity_z * z;
    sway += z * square[k];
  }
  for (int j = 0; j < 5; ++j) {
    m[j][j] = x[j] * 0 + p.couple[j][j];
    for (int k = j + 1; k < 5; ++k) {
      const Lanes cosine = c[j] * c[k] + s[j] * s[k], sine = s[k] * c[j] - c[k] * s[j];
      m[k][j] = p.couple[j][k] * cosine - p.skew[j][k] * sine;
      const Lanes pull = p.couple[j][k] * sine + p.skew[j][k] * cosine;
      b[j] += pull * square[k];
      b[k] -= pull * square[j];
    }
  }
  for (int k = 0; k < 3; ++k) m[3][k] += p.radius * x[k];
  m[4][3] += p.radius * x[4];
  m[3][3] += p.radius * (p.radius * p.total_mass + 2 * x[3]);
  b[3] += p.radius * (p.gravity_x * p.total_mass + sway);
  solve(m, b);
  for (int k = 0; k < 5; ++k) qdd.v[k] = b[k];
}

void accelerations_of_eight(const Legs& p, const Lanes (&q)[2], const Lanes (&qd)[2],
                            Lanes (&qdd)[2]) {
  Lanes s0, c0, s1, c1;
  sine_and_cosine(q[0], s0, c0);
  sine_and_cosine(q[1], s1, c1);
  const Lanes square0 = qd[0] * qd[0], square1 = qd[1] * qd[1];
  const Lanes m00 = p.stance_couple + p.radius * (p.radius * p.mass + 2 * p.stance_moment * c0);
  const Lanes m01 = p.cross_couple * (c0 * c1 + s0 * s1) + p.radius * p.swing_moment * c1;
  const Lanes pull = p.cross_couple * (c0 * s1 - s0 * c1);
  const Lanes sway =
      p.gravity_x * p.mass + p.stance_moment * s0 * square0 + p.swing_moment * s1 * square1;
  const Lanes f0 =
      p.stance_moment * (p.gravity_x * c0 - p.gravity_z * s0) + pull * square1 + p.radius * sway;
  const Lanes f1 = p.swing_moment * (p.gravity_x * c1 - p.gravity_z * s1) - pull * square0;
  const Lanes inverse = 1 / (m00 * p.swing_couple - m01 * m01);
  qdd[0] = inverse * (p.swing_couple * f0 - m01 * f1);
  qdd[1] = inverse * (m00 * f1 - m01 * f0);
}

struct Interval {
  int begin, end;
};

constexpr int kMaxRows = 2160, kMaxParts = 24;

struct Edge {
  float top, bottom, x_at_0, slope;
};

Edge edge_of(const TaperedPart& p, float side) {
  const float dx = p.x[1] - p.x[0], dy = p.y[1] - p.y[0], length = std::sqrt(dx * dx + dy * dy);
  const float s = (p.radius[0] - p.radius[1]) / length;
  const float t = side * std::sqrt(std::max(0.0F, 1 - s * s));
  const float nx = (s * dx - t * dy) / length, ny = (s * dy + t * dx) / length;
  const float y0 = p.y[0] + p.radius[0] * ny, y1 = p.y[1] + p.radius[1] * ny;
  const float x0 = p.x[0] + p.radius[0] * nx, x1 = p.x[1] + p.radius[1] * nx;
  const float slope = (x1 - x0) / (y1 - y0);
  return {std::min(y0, y1), std::max(y0, y1), x0 - slope * y0, slope};
}

// The columns of rows first..end-1 inside the hull of two discs: a loop without branches.
void find_columns(const TaperedPart& p, int first, int end, int width, int* from, int* to) {
  const Edge edges[2] = {edge_of(p, 1), edge_of(p, -1)};
  for (int y = first; y < end; ++y) {
    float left = 1e6F, right = -1e6F;
    for (int i = 0; i < 2; ++i) {
      const float v = static_cast<float>(y) - p.y[i], h = p.radius[i] * p.radius[i] - v * v;
      const float half = std::sqrt(std::max(0.0F, h)), off = h < 0 ? 1e6F : 0.0F;
      left = std::min(left, p.x[i] - half + off);
      right = std::max(right, p.x[i] + half - off);
      const float row = static_cast<float>(y), x = edges[i].x_at_0 + edges[i].slope * row;
      const float away = row < edges[i].top || row > edges[i].bottom ? 1e6F : 0.0F;
      left = std::min(left, x + away);
      right = std::max(right, x - away);
    }
    from[y] = static_cast<int>(std::ceil(std::max(0.0F, left)));
    to[y] = static_cast<int>(std::min(static_cast<float>(width), right + 1));
  }
}

}  // namespace

void accelerations(const Linkage& linkage, size_t count, const double* q, const double* qd,
                   double* qdd) {
  Lines a, b, out;
  for (size_t first = 0; first < count; first += kLanes) {
    for (size_t k = 0; k < 5; ++k)
      for (size_t lane = 0; lane < kLanes; ++lane) {
        a.v[k][lane] = q[k * count + first + lane];
        b.v[k][lane] = qd[k * count + first + lane];
      }
    accelerations_of_eight(linkage, a, b, out);
    for (size_t k = 0; k < 5; ++k)
      for (size_t lane = 0; lane < kLanes; ++lane) qdd[k * count + first + lane] = out.v[k][lane];
  }
}

void accelerations(const Legs& legs, size_t count, const double* q, const double* qd, double* qdd) {
  Lanes a[2], b[2], out[2];
  for (size_t first = 0; first < count; first += kLanes) {
    for (size_t k = 0; k < 2; ++k)
      for (size_t lane = 0; lane < kLanes; ++lane) {
        a[k][lane] = q[k * count + first + lane];
        b[k][lane] = qd[k * count + first + lane];
      }
    accelerations_of_eight(legs, a, b, out);
    for (size_t k = 0; k < 2; ++k)
      for (size_t lane = 0; lane < kLanes; ++lane) qdd[k * count + first + lane] = out[k][lane];
  }
}

int64_t silhouette(const PrefixPlane& plane, std::span<const TaperedPart> parts) {
  static thread_local Interval rows[kMaxRows][kMaxParts];
  static thread_local int used[kMaxRows], from[kMaxRows], to[kMaxRows];
  int first = plane.height, last = -1;
  for (const TaperedPart& p : parts) {
    const float top = std::min(p.y[0] - p.radius[0], p.y[1] - p.radius[1]);
    const float bottom = std::max(p.y[0] + p.radius[0], p.y[1] + p.radius[1]);
    const int begin = std::max(0, static_cast<int>(std::ceil(top)));
    const int end = std::min(plane.height, static_cast<int>(std::floor(bottom)) + 1);
    first = std::min(first, begin);
    last = std::max(last, end - 1);
    find_columns(p, begin, end, plane.width, from, to);
    for (int y = begin; y < end; ++y) {
      int at = used[y]++;
      for (; at > 0 && rows[y][at - 1].begin > from[y]; --at) rows[y][at] = rows[y][at - 1];
      rows[y][at] = {from[y], to[y]};
    }
  }
  int64_t sum = 0;
  for (int y = first; y <= last; ++y) {
    const int32_t* prefix = plane.prefix + static_cast<size_t>(y) * plane.pitch;
    int covered = 0;
    for (int i = 0; i < used[y]; ++i) {
      const int begin = std::max(rows[y][i].begin, covered), end = rows[y][i].end;
      if (begin < end) sum += prefix[end] - prefix[begin];
      covered = std::max(covered, end);
    }
    used[y] = 0;
  }
  return sum;
}

}  // namespace walktrack::limits
