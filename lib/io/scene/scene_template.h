// Scenes for many videos with the same room, camera and subject.
#pragma once

#include <filesystem>
#include <string>

namespace walktrack {
inline namespace io {

// The text of the template's scene file with another video. The template must have one camera. Its
// paths become absolute, so that the text may be stored anywhere; its truth, which belongs to its
// own video, is left out. InputError if the template is not such a scene.
std::string scene_for_video(const std::filesystem::path& scene_template,
                            const std::filesystem::path& video);

// Decided by the name's ending alone.
bool is_video_file(const std::filesystem::path& path);

}  // namespace io
}  // namespace walktrack
