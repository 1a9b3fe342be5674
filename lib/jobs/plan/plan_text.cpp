#include "jobs/plan/plan_text.h"

// The plan as text and as JSON.
#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace walktrack {
inline namespace jobs {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kMiB = 1024 * 1024, kMsPerSecond = 1000, kInPercent = 100;

// The time of each stage, summed over the cameras, in the order of the work.
Costs stages(const FrameCost& cost) {
  Costs out;
  for (const Costs& camera : cost.cameras) {
    for (const auto& cost_of : camera) {
      const auto same = [&](const auto& each) { return each.first == cost_of.first; };
      const auto found = std::find_if(out.begin(), out.end(), same);
      found == out.end() ? void(out.push_back(cost_of)) : void(found->second += cost_of.second);
    }
  }
  out.emplace_back("walker", cost.walker);
  out.emplace_back("poses", cost.poses);
  return out;
}

std::string items_text(const Plan& plan) {
  std::string out = "Modelled\n";
  for (const PlanItem& item : plan.items)
    out += fmt::format(
        "  {:<3} {:<12} {} ({}){}\n", item.on ? "on" : "off", item.name, item.what, item.why,
        item.ms > 0
            ? fmt::format("; without it {:.0f} % less time", kInPercent * item.ms / plan.cost.sum())
            : "");
  return out;
}

const char* mark(const PlanLevel& level) {
  return level.on ? (level.lowest ? "  <- on, and suffices" : "  <- on")
                  : (level.lowest ? "  <- suffices" : "");
}

std::string levels_text(const Plan& plan) {
  std::string out =
      "\nLevels of the model: numbers in the state of a particle, and how many are drawn anew in a "
      "frame\n";
  for (const PlanLevel& level : plan.levels.levels)
    out += fmt::format("  {:<14} {:3} {:3}  {}{}\n", level.name, level.state.dimension(),
                       level.state.noise, fmt::join(level.settings, " "), mark(level));
  return out + fmt::format(
                   "The lowest level that suffices for this scene:\n  {}.\nA measurement shows "
                   "whether it does:\n"
                   "  walktrack sweep {} -o out/levels --over path=sagittal:spatial\n",
                   plan.levels.why, plan.scene.string());
}

std::string cost_text(const Plan& plan) {
  const double all = plan.cost.sum();
  std::string out = fmt::format(
      "\nTime of a frame, {:g} particles: {:.1f} ms of CPU, {:.3g} frames/s on one thread of the "
      "machine on which the\ncosts were measured. Shares and ratios hold for other machines, too, "
      "times only roughly;\n'walktrack sweep' measures them on yours.\n",
      plan.work.particles, all, kMsPerSecond / all);
  for (const auto& [stage, ms] : stages(plan.cost))
    if (ms > 0)
      out += fmt::format("  {:<12} {:6.2f} ms {:5.1f} %\n", stage, ms, kInPercent * ms / all);
  return out;
}

}  // namespace

std::string plan_text(const Plan& plan) {
  std::string out =
      fmt::format("{}: {} camera{} at {:g} Hz\n", plan.scene.filename().string(),
                  plan.cameras.size(), plan.cameras.size() == 1 ? "" : "s", plan.frame_rate);
  for (const PlanCamera& camera : plan.cameras)
    out += fmt::format(
        "  {}: {}x{} px, shrunk to 1/{} of it, where a person is {:.0f} px high; {:.0f} % of the "
        "time\n",
        camera.name, camera.width_px, camera.height_px, camera.shrink, camera.person_px,
        kInPercent * camera.ms / plan.cost.sum());
  out += '\n';
  out += items_text(plan);
  const PlanState& s = plan.state;
  out += fmt::format(
      "\nState: {} numbers for each particle (walker {}, stance foot and path {}, angles and their "
      "rates {}, controls {}),\n{} of them drawn anew in every frame; {:.0f} bytes with copies, "
      "most of which do not depend on the model\n",
      s.dimension(), s.walker, s.place, s.pose, s.controls, s.noise, s.bytes_per_particle);
  out += levels_text(plan);
  out += cost_text(plan);
  out += "\nMemory, in addition to that of the program itself\n";
  for (const auto& [what, bytes] : plan.memory)
    out += fmt::format("  {:<38} {:7.2f} MiB\n", what, bytes / kMiB);
  if (plan.advice.empty())
    return out + "\nNothing in this model seems to be more than the scene needs.\n";
  out += "\nWhat could be left out\n";
  for (const std::string& sentence : plan.advice) out += fmt::format("- {}\n", sentence);
  return out + "'walktrack sweep' measures on this scene what each would cost in accuracy.\n";
}

std::string plan_json(const Plan& plan) {
  Json root = {{"scene", plan.scene.filename().string()}, {"frame_rate_hz", plan.frame_rate}};
  for (size_t c = 0; c < plan.cameras.size(); ++c) {
    const PlanCamera& camera = plan.cameras[c];
    const CameraWork& work = plan.work.cameras[c];
    root["cameras"].push_back({{"name", camera.name},
                               {"size_px", {camera.width_px, camera.height_px}},
                               {"shrink", camera.shrink},
                               {"person_px", camera.person_px},
                               {"region_px", work.region_px},
                               {"rows", work.rows},
                               {"cpu_ms", camera.ms}});
  }
  for (const PlanItem& item : plan.items)
    root["items"].push_back({{"name", item.name},
                             {"on", item.on},
                             {"what", item.what},
                             {"why", item.why},
                             {"saves_cpu_ms", item.ms}});
  const PlanState& s = plan.state;
  root["state"] = {{"dimension", s.dimension()},
                   {"noise", s.noise},
                   {"bytes_per_particle", s.bytes_per_particle}};
  for (const PlanLevel& level : plan.levels.levels)
    root["levels"].push_back({{"name", level.name},
                              {"settings", level.settings},
                              {"dimension", level.state.dimension()},
                              {"noise", level.state.noise},
                              {"on", level.on},
                              {"lowest_sufficient", level.lowest}});
  root["lowest_level_why"] = plan.levels.why;
  root["work"] = {{"particles", plan.work.particles},
                  {"poses", plan.work.poses},
                  {"parts", plan.work.parts},
                  {"classes", plan.work.classes}};
  root["cpu_ms"] = plan.cost.sum();
  for (const auto& [stage, ms] : stages(plan.cost)) root["cpu_ms_by_stage"][stage] = ms;
  for (const auto& [what, bytes] : plan.memory) root["memory_bytes"][what] = bytes;
  root["advice"] = plan.advice;
  return root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace jobs
}  // namespace walktrack
