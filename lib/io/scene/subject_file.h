// The subject of a scene: a map in the scene, or a file of its own with the same keys, which
// another scene of the same person can name. `track` writes one with the height that it has
// estimated and its standard deviation, `optimise` one with the lengths of the motion's bones.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "body/subject.h"
#include "io/config/yaml.h"

namespace walktrack {
inline namespace io {

inline constexpr const char* kSubjectFile = "subject.yaml";

// Limits of what may be stated, m and kg.
inline constexpr double kSmallestHeight = 0.2, kGreatestHeight = 4;
inline constexpr double kSmallestMass = 0.5, kGreatestMass = 1000;

struct StatedSubject {
  Subject subject;                  // usual values for what is not stated
  std::optional<double> height_sd;  // m; then the height is only known so well
  bool height_stated = false, mass_stated = false, girth_stated = false;
  std::filesystem::path file;  // which states it; empty = the scene itself
};

// The value of `subject`: a map, or the path of a file, relative to `folder`. A map may have the
// key `near`, which is the scene's. InputErrors name the file that has the mistake.
StatedSubject read_subject(const YamlValue& value, const std::filesystem::path& folder);

// The text of such a file. Usual values that nobody stated are left out.
std::string subject_text(const StatedSubject& stated);

}  // namespace io
}  // namespace walktrack
