// The images of `walktrack check`: what each camera would see of a standing subject.
#pragma once

#include <filesystem>

#include "io/archive/result_folder.h"
#include "io/scene/scene.h"
#include "jobs/check/check_report.h"

namespace walktrack {
inline namespace jobs {

// The folder of the images.
Outputs check_outputs(const Scene& scene, const std::filesystem::path& folder);

// Draws the ground grid, the world's axes and a standing figure into the first frame of each
// camera.
void write_check_pictures(const Scene& scene, const CheckReport& report,
                          const std::filesystem::path& folder);

}  // namespace jobs
}  // namespace walktrack
