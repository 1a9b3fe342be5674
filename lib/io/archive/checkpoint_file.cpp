#include "io/archive/checkpoint_file.h"

#include <limits>

#include <fmt/format.h>

#include "io/archive/files.h"
#include "io/archive/sha256.h"
#include "io/archive/state_fields.h"

namespace walktrack {

namespace {

constexpr std::string_view kFormat = "walktrack checkpoint 3\n";
constexpr size_t kDigestBytes = 64;

template <typename Archive, ArchivedAs<Checkpoint> T>
void state_fields(Archive& archive, T& value) {
  auto& [origin, frames_read, records, record_bytes, observers, regions, tracker] = value;
  archive(frames_read, records, record_bytes, observers, regions, tracker);
}

// What the two differ in; "" = nothing.
std::string difference(const Origin& found, const Origin& wanted) {
  for (size_t i = 0; i < wanted.size(); ++i)
    if (i >= found.size() || found[i] != wanted[i]) return wanted[i].first;
  return {};
}

}  // namespace

void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint) {
  ArchiveWriter archive;
  archive(checkpoint.origin);
  state_fields(archive, checkpoint);
  AtomicFile file(path);
  file.write(kFormat);
  file.write(sha256(archive.bytes()));
  file.write(archive.bytes());
  file.commit();
}

FoundCheckpoint read_checkpoint(const std::filesystem::path& path, const Origin& origin) {
  if (!std::filesystem::exists(path)) return {};
  const std::string text = read_text_file(path, std::numeric_limits<size_t>::max());
  std::string_view rest = text;
  const bool headed = rest.starts_with(kFormat) && rest.size() >= kFormat.size() + kDigestBytes;
  if (headed) rest.remove_prefix(kFormat.size());
  const std::string_view digest = rest.substr(0, kDigestBytes);
  if (headed) rest.remove_prefix(kDigestBytes);
  if (!headed || sha256(rest) != digest)
    return {{}, fmt::format("{}: found no sound checkpoint of this format", path.string())};
  Checkpoint checkpoint;
  ArchiveReader archive(rest, path.native());
  archive(checkpoint.origin);
  const std::string other = difference(checkpoint.origin, origin);
  if (!other.empty())
    return {{}, fmt::format("{}: the checkpoint is of another {}", path.string(), other)};
  state_fields(archive, checkpoint);
  return {std::move(checkpoint), {}};
}

}  // namespace walktrack
