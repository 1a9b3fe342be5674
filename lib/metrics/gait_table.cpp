#include "metrics/gait_table.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "metrics/statistics/statistics.h"
#include "metrics/steps/foot_placement.h"

namespace walktrack {
inline namespace metrics {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
// By hand.
constexpr double kSameContact = 0.25;  // s; under half of the shortest usual stride
constexpr size_t kLeastForSpread = 3;  // steps; two depend on chance too much
constexpr size_t kLeastASide = 2;      // contacts of either side, for a symmetry
constexpr size_t kLeastMembers = 5;    // for 5 % and 95 % quantiles that are more than two members

using Values = std::array<double, kContactColumnCount>;

// The gait of one motion, without bands.
struct Contact {
  Side side;
  double time;  // for matching: the strike, otherwise the toe-off; NaN if cut at both ends
  Values at;
};

struct MotionGait {
  std::vector<Contact> contacts;
  double speed = kNone;
};

Values nothing() {
  Values out;
  out.fill(kNone);
  return out;
}

// Duration for which the other foot is on the ground as well during [from, to).
double shared_time(const Gait& gait, const Stance& stance, double from, double to) {
  double sum = 0;
  for (const Stance& each : gait.stances) {
    if (each.side == stance.side) continue;
    sum +=
        std::max(0.0, std::min({each.off, stance.off, to}) - std::max({each.on, stance.on, from}));
  }
  return sum;
}

void set_stride(const Gait& gait, size_t index, Values& at) {
  const Stance& stance = gait.stances[index];
  const Stance* next = stride_end(gait.stances, index);
  if (!next) return;
  const double time = next->on - stance.on;
  at[kStrideLength] = (next->place - stance.place).norm();
  at[kStrideTime] = time;
  at[kStrideSpeed] = at[kStrideLength] / time;
  if (!stance.ends_in_motion) return;
  at[kStanceShare] = 100 * (stance.off - stance.on) / time;
  at[kSwingShare] = 100 - at[kStanceShare];
  at[kDoubleSupportShare] = 100 * shared_time(gait, stance, stance.on, next->on) / time;
}

void set_foot(const Motion& motion, const Gait& gait, size_t index, Values& at) {
  at[kToeClearance] = toe_clearance(motion, gait, index);
  at[kFootProgression] = foot_progression_deg(motion, gait, index);
  at[kWidthAtStrike] = width_at_strike(motion, gait, index);
  at[kWalkingBase] = walking_base(gait, index);
  at[kTurn] = turn_deg(motion, gait, index);
}

MotionGait read(const Motion& motion) {
  const Gait gait = gait_from_motion(motion);
  MotionGait out;
  if (gait.speed > 0) out.speed = gait.speed;
  for (size_t i = 0; i < gait.stances.size(); ++i) {
    const Stance& stance = gait.stances[i];
    Contact contact{stance.side, kNone, nothing()};
    if (stance.starts_in_motion) contact.time = contact.at[kFootStrike] = stance.on;
    if (stance.ends_in_motion) contact.at[kToeOff] = stance.off;
    if (!stance.starts_in_motion) contact.time = contact.at[kToeOff];
    set_stride(gait, i, contact.at);
    set_foot(motion, gait, i, contact.at);
    out.contacts.push_back(contact);
  }
  for (const Step& step : gait.steps) {
    Values& at = out.contacts[step.to].at;
    at[kStepLength] = step.length;
    at[kStepWidth] = step.width;
    at[kStepTime] = step.time;
  }
  return out;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return values.empty() ? kNone : sum / static_cast<double>(values.size());
}

double deviation(const std::vector<double>& values) {
  if (values.size() < kLeastForSpread) return kNone;
  const double middle = mean(values);
  double sum = 0;
  for (const double value : values) sum += (value - middle) * (value - middle);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

std::vector<double> column(const MotionGait& gait_of_motion, std::optional<Side> side,
                           ContactColumn which) {
  std::vector<double> out;
  for (const Contact& contact : gait_of_motion.contacts) {
    if (side && contact.side != *side) continue;
    if (std::isfinite(contact.at[which])) out.push_back(contact.at[which]);
  }
  return out;
}

std::array<double, kSummaryColumnCount> summarised(const MotionGait& gait_of_motion,
                                                   std::optional<Side> side) {
  const auto values = [&](ContactColumn which) { return column(gait_of_motion, side, which); };
  std::array<double, kSummaryColumnCount> out;
  out[kSpeed] = side ? mean(values(kStrideSpeed)) : gait_of_motion.speed;
  out[kMeanStepLength] = mean(values(kStepLength));
  out[kMeanStepWidth] = mean(values(kStepWidth));
  out[kMeanStepTime] = mean(values(kStepTime));
  out[kCadence] = 60 / out[kMeanStepTime];
  out[kMeanStrideLength] = mean(values(kStrideLength));
  out[kMeanStrideTime] = mean(values(kStrideTime));
  out[kMeanStance] = mean(values(kStanceShare));
  out[kMeanSwing] = mean(values(kSwingShare));
  out[kMeanDoubleSupport] = mean(values(kDoubleSupportShare));
  out[kStepLengthSd] = deviation(values(kStepLength));
  out[kStepTimeSd] = deviation(values(kStepTime));
  out[kMeanToeClearance] = mean(values(kToeClearance));
  out[kMeanFootProgression] = mean(values(kFootProgression));
  out[kMeanWidthAtStrike] = mean(values(kWidthAtStrike));
  out[kMeanWalkingBase] = mean(values(kWalkingBase));
  return out;
}

std::array<double, kSymmetryCount> symmetries(const MotionGait& gait_of_motion) {
  const auto asymmetry = [&](ContactColumn which) {
    const auto left = column(gait_of_motion, Side::kLeft, which),
               right = column(gait_of_motion, Side::kRight, which);
    if (std::min(left.size(), right.size()) < kLeastASide) return kNone;
    return 200 * (mean(left) - mean(right)) / (mean(left) + mean(right));
  };
  return {asymmetry(kStepLength), asymmetry(kStepTime), asymmetry(kStanceShare)};
}

// `value` with the 5 and 95 % quantiles of the finite values among `others`, if they are at least
// half of them and at least kLeastMembers; the band always contains the value.
Banded banded(double value, const std::vector<double>& others) {
  std::vector<double> finite;
  std::copy_if(others.begin(), others.end(), std::back_inserter(finite),
               [](double other) { return std::isfinite(other); });
  Banded out{value, kNone, kNone};
  if (!std::isfinite(value) || finite.size() < kLeastMembers || 2 * finite.size() < others.size())
    return out;
  out.p05 = std::min(value, quantile(finite, 0.05));
  out.p95 = std::max(value, quantile(finite, 0.95));
  return out;
}

// The member's contact that corresponds to this one.
const Contact* find_contact(const MotionGait& gait_of_motion, const Contact& wanted) {
  const Contact* best = nullptr;
  for (const Contact& each : gait_of_motion.contacts) {
    const double apart = std::abs(each.time - wanted.time);
    if (each.side != wanted.side || !(apart < kSameContact)) continue;
    if (!best || apart < std::abs(best->time - wanted.time)) best = &each;
  }
  return best;
}

ContactRow contact_row(const Contact& contact, const std::vector<MotionGait>& members) {
  std::vector<const Contact*> same;
  for (const MotionGait& member : members) same.push_back(find_contact(member, contact));
  ContactRow row;
  row.side = contact.side;
  for (size_t k = 0; k < kContactColumnCount; ++k) {
    std::vector<double> others;
    for (const Contact* other : same) others.push_back(other ? other->at[k] : kNone);
    row.at[k] = banded(contact.at[k], others);
  }
  return row;
}

void set_transfer(std::span<const SupportTransfer> transfers, ContactRow& row) {
  const double strike = row.at[kFootStrike].value;
  for (const SupportTransfer& transfer : transfers) {
    const double apart = std::abs(transfer.time.value - strike);
    if (transfer.side != row.side || !(apart < kSameContact)) continue;
    if (std::abs(row.at[kSupportTransfer].value - strike) <= apart) continue;
    row.at[kSupportTransfer] = transfer.time;
  }
}

// Whether the direction of walking turns at this contact, with all of the band, if there is one.
bool turns(const ContactRow& row) {
  const Banded& turn = row.at[kTurn];
  const double least = std::isnan(turn.p05) ? turn.value : turn.p05,
               most = std::isnan(turn.p95) ? turn.value : turn.p95;
  return least > kTurningStep_deg || most < -kTurningStep_deg;
}

// The gaits of a motion and of a member, both reduced to the contacts that both have.
struct Common {
  MotionGait motion, member;
};

Common common_of(const MotionGait& motion, const MotionGait& member) {
  Common out{motion, motion};
  out.member.speed = member.speed;
  for (size_t i = 0; i < motion.contacts.size(); ++i) {
    const Contact* same = find_contact(member, motion.contacts[i]);
    Values &ours = out.motion.contacts[i].at, &theirs = out.member.contacts[i].at;
    theirs = same ? same->at : nothing();
    for (size_t k = 0; k < kContactColumnCount; ++k)
      if (std::isnan(ours[k]) || std::isnan(theirs[k])) ours[k] = theirs[k] = kNone;
  }
  return out;
}

// The numbers of the motion that f computes, with bands over the members. A member that lacks a
// contact, or has an additional one, would have other step lengths; therefore the difference
// between member and motion over the contacts that both have is used.
template <size_t N>
std::array<Banded, N> banded_all(const MotionGait& gait_of_motion,
                                 const std::vector<Common>& members,
                                 const std::function<std::array<double, N>(const MotionGait&)>& f) {
  const std::array<double, N> values = f(gait_of_motion);
  std::array<std::vector<double>, N> others;
  for (const Common& common : members) {
    const std::array<double, N> ours = f(common.motion), theirs = f(common.member);
    for (size_t k = 0; k < N; ++k) others[k].push_back(values[k] + (theirs[k] - ours[k]));
  }
  std::array<Banded, N> out;
  for (size_t k = 0; k < N; ++k) out[k] = banded(values[k], others[k]);
  return out;
}

}  // namespace

GaitTable gait_table(const Motion& motion, const Ensemble& members,
                     std::span<const SupportTransfer> transfers) {
  const MotionGait gait_of_motion = read(motion);
  std::vector<MotionGait> others;
  for (size_t m = 0; m < members.size; ++m) others.push_back(read(members.member(m)));
  GaitTable table;
  for (const Contact& contact : gait_of_motion.contacts) {
    table.contacts.push_back(contact_row(contact, others));
    set_transfer(transfers, table.contacts.back());
  }
  table.steps = column(gait_of_motion, std::nullopt, kStepLength).size();
  table.strides = column(gait_of_motion, std::nullopt, kStrideLength).size();
  table.turning_steps = static_cast<size_t>(std::ranges::count_if(table.contacts, turns));
  std::vector<Common> common;
  for (const MotionGait& member : others) common.push_back(common_of(gait_of_motion, member));
  const auto summary = [&](std::optional<Side> side) {
    return banded_all<kSummaryColumnCount>(
        gait_of_motion, common, [side](const MotionGait& each) { return summarised(each, side); });
  };
  table.both = summary(std::nullopt);
  table.left = summary(Side::kLeft);
  table.right = summary(Side::kRight);
  table.symmetry = banded_all<kSymmetryCount>(gait_of_motion, common, symmetries);
  return table;
}

}  // namespace metrics
}  // namespace walktrack
