// checkpoint.bin: where a track stands between two frames, so that another process goes on from
// there to the same bytes. It holds what the next frame depends on and how many frames came before
// it; their records are in a FrameFile.
//
// "walktrack checkpoint 3", the SHA-256 of what follows, and the bytes of io/archive/archive.h:
// what it was made of, then the state. The file is only fit for the program that wrote it, on a
// machine of the same kind; results of machines whose vector instructions differ may differ in the
// last digits.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "observation/observer.h"
#include "tracker/tracker.h"

namespace walktrack {

// What a track depends on, in words and with a digest: "configuration", "9f86d0...".
using Origin = std::vector<std::pair<std::string, std::string>>;

struct Checkpoint {
  Origin origin;
  uint64_t frames_read = 0;              // of the film
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
  std::string unfit;  // why the one that is there is of no use; "" = there is none, or it is
};

// `origin`: what the checkpoint has to be made of.
FoundCheckpoint read_checkpoint(const std::filesystem::path& path, const Origin& origin);

}  // namespace walktrack
