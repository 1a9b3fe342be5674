// A digest that identifies a video, at a cost that does not grow with its length.
#pragma once

#include <filesystem>
#include <string>

namespace walktrack {
inline namespace io {

// For a video file, an image, a folder or a printf pattern of images: SHA-256 of the names (of
// images in a folder), the sizes of the files and their content, which is read completely up to 4
// MiB; of more, 64 blocks of 64 KiB are read, evenly spaced over all files and including the first
// and the last. Another length, another beginning or another encoding therefore changes the digest;
// times of change do not. InputError for what cannot be read.
std::string video_digest(const std::filesystem::path& video);

}  // namespace io
}  // namespace walktrack
