// EasyMocap's pair of files (github.com/zju3dv/EasyMocap, doc/quickstart): intri.yml with names,
// K_<name>, dist_<name> and, from later versions, H_<name> and W_<name>; extri.yml beside it with
// R_<name> (Rodrigues), Rot_<name> and T_<name>; x_camera = Rot x + T, metres.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/calibration/calibration_checks.h"

namespace walktrack {
inline namespace io {

struct FileText {
  std::string text, file;
};

// Whether a YAML file is EasyMocap's intri.yml.
bool is_easymocap(const std::string& text, const std::string& file);

// `size`: of the images, for files that do not state it.
Camera camera_from_easymocap(const FileText& intrinsic, const FileText& extrinsic,
                             const std::string& name,
                             const std::optional<ImageSize>& size = std::nullopt);
std::vector<std::string> easymocap_names(const std::string& text, const std::string& file);

}  // namespace io
}  // namespace walktrack
