#include "jobs/batch/bids/bids_tables.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "body/joint_angles.h"
#include "core/version.h"
#include "io/archive/files.h"

namespace walktrack {
inline namespace jobs {

namespace fs = std::filesystem;

namespace {

using BidsJson = nlohmann::ordered_json;

constexpr size_t kMostJsonBytes = size_t{1} << 30;
constexpr const char* kUnknown = "n/a";

struct Channel {
  std::string name, component, type, point, units, frame;
  const CsvTable* table;
  size_t column;
};

std::string point_of_angle(std::string_view name) {
  std::string joint(name.substr(0, name.find('_')));
  if (name.ends_with("_r")) return "r" + joint;
  return name.ends_with("_l") ? "l" + joint : joint;
}

// Angles between two parts of the body, for which Motion-BIDS has a type of its own.
bool is_of_joint(std::string_view name) {
  return !name.starts_with("pelvis") && name != "trunk_tilt";
}

std::vector<Channel> channels_of(const CsvTable& joints, const CsvTable& angles) {
  std::vector<Channel> out;
  for (size_t i = 1; i < joints.columns.size(); ++i) {
    const std::string& name = joints.columns[i];
    const size_t cut = name.rfind('_');
    out.push_back(
        {name, name.substr(cut + 1), "POS", name.substr(0, cut), "m", "global", &joints, i});
  }
  for (const std::string_view name : kJointAngleNames) {
    const auto column = angles.find_column(std::string(name) + "_deg");
    if (!column) continue;
    const bool joint = is_of_joint(name);
    out.push_back({std::string(name), kUnknown, joint ? "JNTANG" : "MISC", point_of_angle(name),
                   "deg", joint ? "joint" : "global", &angles, *column});
  }
  return out;
}

std::string motion_tsv(const std::vector<Channel>& channels, size_t rows) {
  std::string text;
  for (size_t row = 0; row < rows; ++row) {
    for (const Channel& channel : channels) {
      const auto& cells = channel.table->rows;
      const std::string& cell = row < cells.size() ? cells[row].cells[channel.column] : "";
      if (&channel != channels.data()) text += '\t';
      text += cell.empty() ? kUnknown : cell;
    }
    text += '\n';
  }
  return text;
}

std::string channels_tsv(const std::vector<Channel>& channels) {
  std::string text = "name\tcomponent\ttype\ttracked_point\tunits\treference_frame\n";
  for (const Channel& c : channels)
    text += fmt::format("{}\t{}\t{}\t{}\t{}\t{}\n", c.name, c.component, c.type, c.point, c.units,
                        c.frame);
  return text;
}

std::string text_of(const BidsJson& json) {
  return json.dump(2, ' ', false, BidsJson::error_handler_t::replace) + "\n";
}

std::string channels_json() {
  BidsJson out;
  BidsJson& frame = out["reference_frame"];
  frame["Description"] = "what positions and angles refer to";
  BidsJson& levels = frame["Levels"];
  levels["global"]["RotationRule"] = "right-hand";
  levels["global"]["Description"] =
      "the world axes of the camera's calibration; pelvis and trunk angles against the ground and "
      "the world's x axis";
  levels["joint"]["RotationRule"] = "right-hand";
  levels["joint"]["Description"] =
      "the child segment against its parent, joint coordinate systems of the ISB: flexion, "
      "adduction, inward rotation and dorsiflexion positive; lumbar: the trunk against the pelvis, "
      "backwards, to the right and to the left positive";
  return text_of(out);
}

BidsJson number_in(const BidsJson& run, const char* block, const char* key) {
  const auto found = run.find(block);
  return found != run.end() && found->is_object() && found->contains(key) ? found->at(key)
                                                                          : BidsJson();
}

double rate_of(const BidsJson& run, const CsvTable& joints) {
  const BidsJson said = number_in(run, "numbers", "frame_rate");
  if (said.is_number()) return said.get<double>();
  const size_t rows = joints.rows.size();
  if (rows < 2) return 0;
  const double span = joints.number(joints.rows.back(), 0) - joints.number(joints.rows.front(), 0);
  return static_cast<double>(rows - 1) / span;
}

std::string motion_json(const std::vector<Channel>& channels, const CsvTable& joints,
                        const BidsJson& run, const BidsOrigin& origin) {
  const auto count = [&](std::string_view type) {
    return std::ranges::count_if(channels, [&](const Channel& c) { return c.type == type; });
  };
  std::set<std::string> points;
  for (const Channel& channel : channels)
    if (channel.type == "POS") points.insert(channel.point);
  const double rate = rate_of(run, joints);
  BidsJson out = {{"TaskName", origin.task},
                  {"SamplingFrequency", rate},
                  {"SamplingFrequencyEffective", rate},
                  {"TrackingSystemName", origin.system},
                  {"RecordingDuration", static_cast<double>(joints.rows.size()) / rate},
                  {"MotionChannelCount", channels.size()},
                  {"POSChannelCount", count("POS")},
                  {"JNTANGChannelCount", count("JNTANG")},
                  {"MISCChannelCount", count("MISC")},
                  {"TrackedPointsCount", points.size()},
                  {"MissingValues", kUnknown},
                  {"RotationRule", "right-hand"},
                  {"SoftwareVersions", fmt::format("walktrack {}", build_facts().version)},
                  {"Sources", BidsJson::array({origin.source})},
                  {"Status", run.value("status", std::string(kUnknown))},
                  {"Digest", run.value("digest", std::string(kUnknown))}};
  for (const char* type : {"ACCEL", "ANGACC", "GYRO", "LATENCY", "MAGN", "ORNT", "VEL"})
    out[fmt::format("{}ChannelCount", type)] = 0;
  return text_of(out);
}

std::string cell_of(const BidsJson& band, const char* key) {
  return band.is_object() && band.contains(key) && band[key].is_number() ? band[key].dump()
                                                                         : kUnknown;
}

std::string events_tsv(const BidsJson& gait) {
  std::string text = "onset\tduration\ttrial_type\tside\tonset_p05\tonset_p95\n";
  const auto events = gait.find("events");
  if (events == gait.end() || !events->is_array()) return text;
  for (const BidsJson& event : *events) {
    const BidsJson time = event.value("time_s", BidsJson());
    if (cell_of(time, "value") == kUnknown) continue;
    text += fmt::format("{}\t0\t{}\t{}\t{}\t{}\n", cell_of(time, "value"),
                        event.value("event", std::string(kUnknown)),
                        event.value("side", std::string(kUnknown)), cell_of(time, "p05"),
                        cell_of(time, "p95"));
  }
  return text;
}

std::string events_json() {
  BidsJson out;
  const auto describe_column = [&](const char* name, const char* what, const char* units) {
    out[name]["Description"] = what;
    if (units) out[name]["Units"] = units;
  };
  describe_column("onset", "time of the event from the first frame", "s");
  describe_column("duration", "0: events are moments", "s");
  describe_column("trial_type", "what a foot does", nullptr);
  out["trial_type"]["Levels"]["foot_strike"] = "the foot meets the ground";
  out["trial_type"]["Levels"]["toe_off"] = "the foot leaves the ground";
  describe_column("side", "which foot", nullptr);
  out["side"]["Levels"]["left"] = "the left foot";
  out["side"]["Levels"]["right"] = "the right foot";
  describe_column("onset_p05", "5 % limit of the onset", "s");
  describe_column("onset_p95", "95 % limit of the onset", "s");
  return text_of(out);
}

BidsJson json_in(const fs::path& file) {
  const BidsJson json = BidsJson::parse(read_text_file(file, kMostJsonBytes), nullptr, false);
  return json.is_object() ? json : BidsJson::object();
}

std::string name_of_data_set(const fs::path& folder) {
  const fs::path file = folder / "dataset_description.json";
  const std::string name = fs::weakly_canonical(folder).filename().string();
  return fs::is_regular_file(file) ? json_in(file).value("Name", name) : name;
}

}  // namespace

std::vector<std::string> bids_file_names() {
  return {"motion.tsv",    "motion.json", "channels.tsv",
          "channels.json", "events.tsv",  "events.json"};
}

std::vector<BidsFile> bids_files(const fs::path& result, const BidsOrigin& origin) {
  const CsvTable joints = read_csv(result / "joints.csv"), angles = read_csv(result / "angles.csv");
  const std::vector<Channel> channels = channels_of(joints, angles);
  const BidsJson run = json_in(result / "run.json"), gait = json_in(result / "gait.json");
  return {{"motion.tsv", motion_tsv(channels, joints.rows.size())},
          {"motion.json", motion_json(channels, joints, run, origin)},
          {"channels.tsv", channels_tsv(channels)},
          {"channels.json", channels_json()},
          {"events.tsv", events_tsv(gait)},
          {"events.json", events_json()}};
}

std::string bids_description(const fs::path& folder, const fs::path& output) {
  const fs::path way =
      fs::weakly_canonical(folder).lexically_relative(fs::weakly_canonical(output));
  BidsJson program;
  program["Name"] = "walktrack";
  program["Version"] = std::string(build_facts().version);
  BidsJson out;
  out["Name"] = name_of_data_set(folder) + ": walks, tracked";
  out["BIDSVersion"] = "1.9.0";
  out["DatasetType"] = "derivative";
  out["DatasetLinks"]["raw"] = way.generic_string();
  out["GeneratedBy"] = BidsJson::array({program});
  return text_of(out);
}

}  // namespace jobs
}  // namespace walktrack
