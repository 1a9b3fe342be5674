#include "gait/prior/prior_file.h"

#include <fmt/format.h>

#include <iterator>

#include "gait/prior/table_text.h"

namespace walktrack {
inline namespace gait {
namespace {

constexpr std::string_view kVersionLine = "walktrack gait prior, version 1";
constexpr std::string_view kStraightVersionLine =
    "walktrack gait prior of the anthropomorphic walker, version 1";

GaitNode parse_node(TableReader& reader) {
  GaitNode node;
  node.cyclic = reader.number() != 0;
  node.valid = reader.number() != 0;
  for (double* value : {&node.cost_of_transport, &node.clearance, &node.swing_flexion,
                        &node.stance_flexion, &node.multiplier})
    *value = reader.number();
  reader.numbers({node.gait.data(), kGaitSize});
  reader.numbers({node.gain.data(), kControlSize * kSectionSize});
  return node;
}

StraightNode parse_straight_node(TableReader& reader) {
  StraightNode node;
  node.cyclic = reader.number() != 0;
  node.valid = reader.number() != 0;
  for (double* value : {&node.cost_of_transport, &node.least_normal, &node.multiplier})
    *value = reader.number();
  reader.numbers({node.gait.data(), kStraightGaitSize});
  reader.numbers({node.gain.data(), kStraightControlSize * kStraightSectionSize});
  return node;
}

template <typename Table, typename ParseNode>
Table parse_table(std::string_view text, const std::string& name, std::string_view version_line,
                  const ParseNode& parse) {
  TableReader reader(text, name);
  reader.head(version_line);
  Table table;
  reader.axes(table);
  table.nodes.reserve(table.size());
  for (size_t i = 0; i < table.size(); ++i) {
    reader.begin_line();
    table.nodes.push_back(parse(reader));
  }
  reader.checksum();
  return table;
}

// The gait and its feedback at the end of a node's line.
template <typename Node>
void write_gait(std::string& text, const Node& node) {
  auto out = std::back_inserter(text);
  for (const double value : node.gait.reshaped()) fmt::format_to(out, " {:.11g}", value);
  for (const double value : node.gain.reshaped()) fmt::format_to(out, " {:.4g}", value);
  text += '\n';
}

}  // namespace

std::string gait_prior_text(const GaitPrior& prior, std::string_view tool_version) {
  std::string text = table_head(kVersionLine, tool_version, prior);
  for (const GaitNode& n : prior.nodes) {
    fmt::format_to(std::back_inserter(text), "{:d} {:d} {:.6g} {:.5g} {:.5g} {:.5g} {:.5g}",
                   n.cyclic, n.valid, n.cost_of_transport, n.clearance, n.swing_flexion,
                   n.stance_flexion, n.multiplier);
    write_gait(text, n);
  }
  return with_checksum(std::move(text));
}

GaitPrior parse_gait_prior(std::string_view text, const std::string& name) {
  return parse_table<GaitPrior>(text, name, kVersionLine, parse_node);
}

GaitPrior load_gait_prior() {
  return parse_gait_prior(shipped_gait_prior_text(), "gait prior of this program");
}

std::string straight_prior_text(const StraightPrior& prior, std::string_view tool_version) {
  std::string text = table_head(kStraightVersionLine, tool_version, prior);
  for (const StraightNode& n : prior.nodes) {
    fmt::format_to(std::back_inserter(text), "{:d} {:d} {:.6g} {:.5g} {:.5g}", n.cyclic, n.valid,
                   n.cost_of_transport, n.least_normal, n.multiplier);
    write_gait(text, n);
  }
  return with_checksum(std::move(text));
}

StraightPrior parse_straight_prior(std::string_view text, const std::string& name) {
  return parse_table<StraightPrior>(text, name, kStraightVersionLine, parse_straight_node);
}

StraightPrior load_straight_prior() {
  return parse_straight_prior(shipped_straight_prior_text(),
                              "gait prior of the anthropomorphic walker of this program");
}

}  // namespace gait
}  // namespace walktrack
