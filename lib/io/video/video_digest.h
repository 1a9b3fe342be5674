// A digest by which a video is known again, at a price that does not grow with it.
#pragma once

#include <filesystem>
#include <string>

namespace walktrack {
inline namespace io {

// Of a video file, an image, a folder or a printf pattern of images. SHA-256 over the names (of
// images in a folder) and sizes of the files and their content: all of it up to 4 MiB, of more 64
// blocks of 64 KiB, evenly spaced over all files, the first and the last among them. What has
// another length, another beginning or another encoding so has another digest; times of change have
// no say. InputError for what cannot be read.
std::string video_digest(const std::filesystem::path& video);

}  // namespace io
}  // namespace walktrack
