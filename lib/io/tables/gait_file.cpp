#include "io/tables/gait_file.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "io/tables/csv.h"

namespace walktrack {
inline namespace io {

namespace {

using Json = nlohmann::ordered_json;

const char* name_of(Side side) { return side == Side::kLeft ? "left" : "right"; }

Json band(const Banded& banded) {
  return {{"value", json_number(banded.value)},
          {"p05", json_number(banded.p05)},
          {"p95", json_number(banded.p95)}};
}

template <size_t N>
void add_bands(const std::array<std::string_view, N>& names, const std::array<Banded, N>& values,
               Json& out) {
  for (size_t k = 0; k < N; ++k) out[std::string(names[k])] = band(values[k]);
}

template <size_t N>
Json bands(const std::array<std::string_view, N>& names, const std::array<Banded, N>& values) {
  Json out = Json::object();
  add_bands(names, values, out);
  return out;
}

Json events_of(const GaitTable& table) {
  struct Event {
    double time;
    Json json;
  };
  std::vector<Event> events;
  const auto add = [&](const ContactRow& row, ContactColumn column, const char* name) {
    const Banded& time = row.at[column];
    if (!std::isfinite(time.value)) return;
    events.push_back(
        {time.value, {{"event", name}, {"side", name_of(row.side)}, {"time_s", band(time)}}});
  };
  for (const ContactRow& row : table.contacts) {
    add(row, kFootStrike, "foot_strike");
    add(row, kToeOff, "toe_off");
  }
  std::stable_sort(events.begin(), events.end(),
                   [](const Event& a, const Event& b) { return a.time < b.time; });
  Json out = Json::array();
  for (Event& event : events) out.push_back(std::move(event.json));
  return out;
}

Json contacts_of(const GaitTable& table) {
  Json out = Json::array();
  for (const ContactRow& row : table.contacts) {
    Json one = {{"side", name_of(row.side)}};
    add_bands(kContactColumns, row.at, one);
    out.push_back(std::move(one));
  }
  return out;
}

constexpr std::array kNotes{
    "foot_strike: 3.8 % of a stride after the ankle was furthest ahead of the pelvis; toe_off: the "
    "toe is furthest behind the pelvis (after Zeni et al. 2008), read from its speed.",
    "support_transfer: when the walker model's weight changed onto this foot. The model has no "
    "double support, so it comes between the strike and the other foot's toe-off.",
    "p05, p95: the interval that should contain the truth in 90 % of the cases, from sample "
    "motions "
    "of the tracker and errors that all samples share. Empty: too few samples or steps have the "
    "number.",
    "step: from the other foot's contact to this one, along and across the direction of walking, "
    "where both heel strikes were seen; stride: to the next contact of the same foot. symmetry: "
    "100 (left - right) / mean of both.",
    "toe_clearance: the lowest height of the toe, above its height in the stance before, while it "
    "swings at 80 % of its highest speed or more. foot_progression: from the direction of walking, "
    "toes outwards positive. width_at_strike: of the ankles, across. walking_base: from the line "
    "between the other foot's places before and after. turn: of the direction of walking, to the "
    "left positive; turning_steps: those whose band is beyond 10 degrees.",
    "Whether these numbers can be trusted is said by the quality checks in run.json and in the "
    "report."};

}  // namespace

std::string gait_json(const GaitTable& table) {
  Json root;
  root["format"] = "walktrack gait 1";
  root["time_zero"] = "first frame of the scene";
  root["events"] = events_of(table);
  root["contacts"] = contacts_of(table);
  Json& summary = root["summary"];
  summary["steps"] = table.steps;
  summary["strides"] = table.strides;
  summary["turning_steps"] = table.turning_steps;
  summary["both"] = bands(kSummaryColumns, table.both);
  summary["left"] = bands(kSummaryColumns, table.left);
  summary["right"] = bands(kSummaryColumns, table.right);
  summary["symmetry"] = bands(kSymmetryColumns, table.symmetry);
  root["notes"] = kNotes;
  return root.dump(2) + "\n";
}

TableNotes gait_notes() {
  const nlohmann::ordered_json notes = {
      {"rows", "one for each contact of a foot with the ground"},
      {"units",
       "times in s from the scene's first frame, lengths in m, angles in degrees, shares in % of "
       "the stride"},
      {"bands", "_p05, _p95: 5-95 % band of the tracker; empty where nothing is known"},
      {"definitions", "gait.json"}};
  return {"gait.csv", notes.dump()};
}

std::string gait_csv(const GaitTable& table) {
  std::string text = "side";
  for (const std::string_view name : kContactColumns)
    text += fmt::format(",{0},{0}_p05,{0}_p95", name);
  text += "\n";
  for (const ContactRow& row : table.contacts) {
    text += name_of(row.side);
    for (const Banded& each : row.at)
      for (const double value : {each.value, each.p05, each.p95}) append_number(text, ',', value);
    text += "\n";
  }
  return text;
}

}  // namespace io
}  // namespace walktrack
