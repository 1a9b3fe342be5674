// One scene for many videos: the same room, camera and subject, another video.
#pragma once

#include <filesystem>
#include <string>

namespace walktrack {
inline namespace io {

// The text of a scene file that is the template with another video. The template must have one
// camera; its paths become absolute, so that the text may be written anywhere; its truth, which is
// of its own video, is left out. InputError for a template that is no such scene.
std::string scene_for_video(const std::filesystem::path& scene_template,
                            const std::filesystem::path& video);

// By the name's ending alone.
bool is_video_file(const std::filesystem::path& path);

}  // namespace io
}  // namespace walktrack
