// checkpoint.bin: where a track stands between two frames, so that another process goes on from
// there to the same bytes. It holds what the next frame depends on and how many frames came before
// it; their records are in a FrameFile.
//
// "walktrack checkpoint 3", the SHA-256 of what follows, and the bytes of io/archive/archive.h:
// what it was made of, then the state. The file is only fit for the program that wrote it, on a
// machine of the same kind; results of machines whose vector instructions differ may differ in the
// last digits. The digest finds damage; what made its own digest is still read field by field
// (io/archive/state_checks.h).
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
  uint64_t records = 0;                  // of finished frames
  uint64_t record_bytes = 0;             // of them in the FrameFile
  std::vector<ObserverState> observers;  // by camera
  std::vector<Region> regions;           // of the next frame, by camera
  TrackerState tracker;
};

// Appears complete or not at all.
void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint);

struct FoundCheckpoint {
  std::optional<Checkpoint> checkpoint;
  std::string unfit{};    // why the one that is there is of no use; "" = there is none, or it is
  std::string changed{};  // what it was made of otherwise; "" = nothing, or it is not sound
};

// `origin`: what the checkpoint has to be made of.
FoundCheckpoint read_checkpoint(const std::filesystem::path& path, const Origin& origin);

// What follows the digest, to and fro. `file` is what messages call it.
std::string checkpoint_bytes(const Checkpoint& checkpoint);
FoundCheckpoint parse_checkpoint(std::string_view bytes, std::string_view file,
                                 const Origin& origin);

}  // namespace io
}  // namespace walktrack
