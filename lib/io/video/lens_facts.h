// What a recording's metadata state about its lens, and the lenses of known telephones.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace walktrack {
inline namespace io {

// The focal length in mm for an image of the same field of view with a diagonal of 43.27 mm (35 mm
// film). For a video it is the field that iPhones write
// (com.apple.quicktime.camera.focal_length.35mm_equivalent), for images the EXIF field
// FocalLengthIn35mmFilm of the first one. nullopt if it is missing, 0 or implausible (below 4 or
// above 2000 mm).
std::optional<double> focal_length_35mm(const std::filesystem::path& video_or_images);

// The model of the telephone or camera, e.g. "iPhone 12" or "SM-G991B": QuickTime's and Android's
// `model` of a video, EXIF's of the first image. "" if it is missing.
std::string camera_model(const std::filesystem::path& video_or_images);

// The focal length (as above) of a telephone's main camera by its model, as its maker states it;
// nullopt for a model that is not in the table of lens_facts.cpp.
std::optional<double> telephone_focal_length_35mm(std::string_view model);

// The EXIF fields in the bytes of a JPEG file.
std::optional<double> exif_focal_length_35mm(std::string_view jpeg);
std::string exif_model(std::string_view jpeg);

}  // namespace io
}  // namespace walktrack
