#include "metrics/gait_table.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

namespace walktrack {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kBandSd = 1.6449;     // standard deviations from the mean to the 95th percentile
constexpr double kSameContact = 0.25;  // s; under half of the shortest usual stride

using Values = std::array<double, kContactColumnCount>;

// A reading of one motion, without bands.
struct Contact {
  Side side;
  double time;  // for matching: the strike, else the toe-off; NaN if cut at both ends
  Values at;
};

struct Reading {
  std::vector<Contact> contacts;
  double speed = kNone;
};

Values nothing() {
  Values out;
  out.fill(kNone);
  return out;
}

// How long the other foot stands as well during [from, to).
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
  const auto next =
      std::find_if(gait.stances.begin() + static_cast<std::ptrdiff_t>(index) + 1,
                   gait.stances.end(), [&](const Stance& s) { return s.side == stance.side; });
  if (next == gait.stances.end() || !stance.starts_in_motion || !next->starts_in_motion) return;
  const double time = next->on - stance.on;
  at[kStrideLength] = (next->place - stance.place).norm();
  at[kStrideTime] = time;
  at[kStrideSpeed] = at[kStrideLength] / time;
  if (!stance.ends_in_motion) return;
  at[kStanceShare] = 100 * (stance.off - stance.on) / time;
  at[kSwingShare] = 100 - at[kStanceShare];
  at[kDoubleSupportShare] = 100 * shared_time(gait, stance, stance.on, next->on) / time;
}

Reading read(const Motion& motion) {
  const Gait gait = gait_from_motion(motion);
  Reading out;
  if (gait.speed > 0) out.speed = gait.speed;
  for (size_t i = 0; i < gait.stances.size(); ++i) {
    const Stance& stance = gait.stances[i];
    Contact contact{stance.side, kNone, nothing()};
    if (stance.starts_in_motion) contact.time = contact.at[kFootStrike] = stance.on;
    if (stance.ends_in_motion) contact.at[kToeOff] = stance.off;
    if (!stance.starts_in_motion) contact.time = contact.at[kToeOff];
    set_stride(gait, i, contact.at);
    out.contacts.push_back(contact);
  }
  for (const Step& step : gait.steps) {
    Values& at = out.contacts[step.to].at;
    at[kStepLength] = step.length;
    at[kStepWidth] = step.width;
    if (step.time) at[kStepTime] = *step.time;
  }
  return out;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return values.empty() ? kNone : sum / static_cast<double>(values.size());
}

double deviation(const std::vector<double>& values) {
  if (values.size() < 2) return kNone;
  const double middle = mean(values);
  double sum = 0;
  for (const double value : values) sum += (value - middle) * (value - middle);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

std::vector<double> column(const Reading& reading, std::optional<Side> side, ContactColumn which) {
  std::vector<double> out;
  for (const Contact& contact : reading.contacts) {
    if (side && contact.side != *side) continue;
    if (std::isfinite(contact.at[which])) out.push_back(contact.at[which]);
  }
  return out;
}

std::array<double, kSummaryColumnCount> summarised(const Reading& reading,
                                                   std::optional<Side> side) {
  const auto values = [&](ContactColumn which) { return column(reading, side, which); };
  std::array<double, kSummaryColumnCount> out;
  out[kSpeed] = side ? mean(values(kStrideSpeed)) : reading.speed;
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
  return out;
}

std::array<double, kSymmetryCount> symmetries(const Reading& reading) {
  const auto left = summarised(reading, Side::kLeft), right = summarised(reading, Side::kRight);
  const auto asymmetry = [&](SummaryColumn which) {
    return 200 * (left[which] - right[which]) / (left[which] + right[which]);
  };
  return {asymmetry(kMeanStepLength), asymmetry(kMeanStepTime), asymmetry(kMeanStance)};
}

// `value` with the spread of the finite ones among `others`, if they are at least half of them.
Banded banded(double value, const std::vector<double>& others) {
  std::vector<double> finite;
  std::copy_if(others.begin(), others.end(), std::back_inserter(finite),
               [](double other) { return std::isfinite(other); });
  Banded out{value, kNone, kNone};
  if (!std::isfinite(value) || finite.size() < 2 || 2 * finite.size() < others.size()) return out;
  const double half = kBandSd * deviation(finite);
  out.p05 = value - half;
  out.p95 = value + half;
  return out;
}

// The member's reading of the same contact.
const Contact* find_contact(const Reading& reading, const Contact& wanted) {
  const Contact* best = nullptr;
  for (const Contact& each : reading.contacts) {
    const double apart = std::abs(each.time - wanted.time);
    if (each.side != wanted.side || !(apart < kSameContact)) continue;
    if (!best || apart < std::abs(best->time - wanted.time)) best = &each;
  }
  return best;
}

ContactRow contact_row(const Contact& contact, const std::vector<Reading>& members) {
  std::vector<const Contact*> same;
  for (const Reading& member : members) same.push_back(find_contact(member, contact));
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

// f's numbers of the motion, with f's spread over the members.
template <size_t N>
std::array<Banded, N> banded_all(const Reading& reading, const std::vector<Reading>& members,
                                 const std::function<std::array<double, N>(const Reading&)>& f) {
  const std::array<double, N> values = f(reading);
  std::vector<std::array<double, N>> others;
  for (const Reading& member : members) others.push_back(f(member));
  std::array<Banded, N> out;
  for (size_t k = 0; k < N; ++k) {
    std::vector<double> list;
    for (const auto& other : others) list.push_back(other[k]);
    out[k] = banded(values[k], list);
  }
  return out;
}

}  // namespace

GaitTable gait_table(const Motion& motion, std::span<const Motion> members,
                     std::span<const SupportTransfer> transfers) {
  const Reading reading = read(motion);
  std::vector<Reading> others;
  for (const Motion& member : members) others.push_back(read(member));
  GaitTable table;
  for (const Contact& contact : reading.contacts) {
    table.contacts.push_back(contact_row(contact, others));
    set_transfer(transfers, table.contacts.back());
  }
  table.steps = column(reading, std::nullopt, kStepLength).size();
  table.strides = column(reading, std::nullopt, kStrideLength).size();
  const auto summary = [&](std::optional<Side> side) {
    return banded_all<kSummaryColumnCount>(
        reading, others, [side](const Reading& each) { return summarised(each, side); });
  };
  table.both = summary(std::nullopt);
  table.left = summary(Side::kLeft);
  table.right = summary(Side::kRight);
  table.symmetry = banded_all<kSymmetryCount>(reading, others, symmetries);
  return table;
}

}  // namespace walktrack
