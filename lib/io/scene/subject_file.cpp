#include "io/scene/subject_file.h"

#include <array>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "io/archive/files.h"

namespace walktrack {
inline namespace io {

namespace {

using Length = std::pair<const char*, std::optional<double> SubjectLengths::*>;
constexpr std::array kLengths{
    Length{"thigh", &SubjectLengths::thigh},
    Length{"shank", &SubjectLengths::shank},
    Length{"foot", &SubjectLengths::foot},
    Length{"ankle_height", &SubjectLengths::ankle_height},
    Length{"trunk", &SubjectLengths::trunk},
    Length{"hip_width", &SubjectLengths::hip_width},
    Length{"shoulder_width", &SubjectLengths::shoulder_width},
    Length{"upper_arm", &SubjectLengths::upper_arm},
    Length{"forearm", &SubjectLengths::forearm},
};

constexpr double kLeastSd = 0.001, kMostSd = 0.5;  // m, of a height
constexpr double kLeastGirth = 0.5, kMostGirth = 2;

SubjectLengths read_lengths(const YamlValue& value) {
  std::vector<std::string> names;
  for (const auto& [name, member] : kLengths) names.emplace_back(name);
  value.only_keys(names);
  SubjectLengths out;
  for (const auto& [name, member] : kLengths)
    if (value.has(name)) out.*member = value.at(name).number(0.005, 3);
  return out;
}

StatedSubject read_map(const YamlValue& value) {
  StatedSubject out;
  out.height_stated = value.has("height");
  out.mass_stated = value.has("mass");
  if (out.height_stated)
    out.subject.height = value.at("height").number(kSmallestHeight, kGreatestHeight);
  if (value.has("height_sd")) {
    if (!out.height_stated)
      value.at("height_sd").fail("no 'height' beside it", "the height that it belongs to");
    out.height_sd = value.at("height_sd").number(kLeastSd, kMostSd);
  }
  if (out.mass_stated) out.subject.mass = value.at("mass").number(kSmallestMass, kGreatestMass);
  out.girth_stated = value.has("girth");
  if (out.girth_stated) out.subject.girth = value.at("girth").number(kLeastGirth, kMostGirth);
  if (value.has("lengths")) out.subject.lengths = read_lengths(value.at("lengths"));
  return out;
}

}  // namespace

StatedSubject read_subject(const YamlValue& value, const std::filesystem::path& folder) {
  if (!value.is_scalar()) {
    value.only_keys({"height", "height_sd", "mass", "girth", "lengths", "near"});
    return read_map(value);
  }
  const std::filesystem::path file = resolved(folder, value.text());
  if (std::error_code ignored; !std::filesystem::is_regular_file(file, ignored))
    value.fail(fmt::format("'{}'", value.text()),
               fmt::format("a map, or a file that exists ({} does not)", file.string()));
  const YamlValue map = YamlValue::from_file(file.string());
  map.only_keys({"height", "height_sd", "mass", "girth", "lengths"});
  StatedSubject out = read_map(map);
  out.file = file;
  return out;
}

std::string subject_text(const StatedSubject& stated) {
  std::string out =
      "# The subject, for other scenes of the same person: `subject: PATH OF THIS FILE`.\n";
  const Subject& subject = stated.subject;
  if (stated.height_stated) out += fmt::format("height: {:.3f}  # m\n", subject.height);
  if (stated.height_sd)
    out += fmt::format(
        "height_sd: {:.3f}  # m, its standard deviation: the height is estimated anew, "
        "with this knowledge\n",
        *stated.height_sd);
  if (stated.mass_stated) out += fmt::format("mass: {:.1f}  # kg\n", subject.mass);
  if (stated.girth_stated)
    out += fmt::format("girth: {:.2f}  # of trunk and limbs, times a usual one\n", subject.girth);
  std::string lengths;
  for (const auto& [name, member] : kLengths)
    if (const auto& length = subject.lengths.*member)
      lengths += fmt::format("  {}: {:.4f}\n", name, *length);
  if (!lengths.empty()) out += "lengths:  # m\n" + lengths;
  return out;
}

}  // namespace io
}  // namespace walktrack
