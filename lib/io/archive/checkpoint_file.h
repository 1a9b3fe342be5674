// checkpoint.bin: the state of a track between two frames, from which another process continues to
// the same bytes. It contains everything on which the next frame depends and the number of frames
// before it; their records are in a FrameFile.
//
// The file consists of a line with the number of the format, the SHA-256 of the rest, and the bytes
// of io/archive/archive.h: first the origin (what the state was computed from), then the state. It
// is only valid for the program that wrote it, on a machine of the same kind; results of machines
// with different vector instructions may differ in the last digits. The digest detects damage. A
// forged file with a correct digest is still checked field by field (io/archive/state_checks.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/archive/origin.h"
#include "observation/observer.h"
#include "tracker/tracker.h"

namespace walktrack {
inline namespace io {

struct Checkpoint {
  Origin origin;
  uint64_t frames_read = 0;              // of the video
  uint64_t records = 0;                  // number of finished frames
  uint64_t record_bytes = 0;             // their size in the FrameFile
  std::vector<ObserverState> observers;  // by camera
  std::vector<Region> regions;           // of the next frame, by camera
  TrackerState tracker;
};

// The file appears complete or not at all.
void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint);

struct FoundCheckpoint {
  std::optional<Checkpoint> checkpoint;
  std::string unfit{};    // why the present checkpoint cannot be used; "" = there is none, or it
                          // can
  std::string changed{};  // what differs in its origin; "" = nothing, or it is damaged
};

// `origin`: what the checkpoint must have been computed from.
FoundCheckpoint read_checkpoint(const std::filesystem::path& path, const Origin& origin);

// The part after the digest, written and read. `file` is its name in messages.
std::string checkpoint_bytes(const Checkpoint& checkpoint);
FoundCheckpoint parse_checkpoint(std::string_view bytes, std::string_view file,
                                 const Origin& origin);

}  // namespace io
}  // namespace walktrack
