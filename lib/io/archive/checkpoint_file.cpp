#include "io/archive/checkpoint_file.h"

#include <limits>

#include <fmt/format.h>

#include "core/errors.h"
#include "io/archive/files.h"
#include "io/archive/sha256.h"
#include "io/archive/state_checks.h"
#include "io/archive/state_fields.h"

namespace walktrack {
inline namespace io {

namespace {

constexpr std::string_view kFormat = "walktrack checkpoint 11\n";
constexpr size_t kDigestBytes = 64;

template <typename Archive, ArchivedAs<Checkpoint> T>
void state_fields(Archive& archive, T& value) {
  auto& [origin, frames_read, records, record_bytes, observers, regions, tracker] = value;
  archive(frames_read, records, record_bytes, observers, regions, tracker);
}

}  // namespace

std::string checkpoint_bytes(const Checkpoint& checkpoint) {
  ArchiveWriter archive;
  archive(checkpoint.origin);
  state_fields(archive, checkpoint);
  return archive.bytes();
}

void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint) {
  const std::string bytes = checkpoint_bytes(checkpoint);
  AtomicFile file(path);
  file.write(kFormat);
  file.write(sha256(bytes));
  file.write(bytes);
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
    return {{}, fmt::format("{}: found no valid checkpoint of this format", path.string())};
  return parse_checkpoint(rest, path.native(), origin);
}

FoundCheckpoint parse_checkpoint(std::string_view bytes, std::string_view file,
                                 const Origin& origin) try {
  Checkpoint checkpoint;
  ArchiveReader archive(bytes, file);
  archive(checkpoint.origin);
  const std::string changed = differences(checkpoint.origin, origin);
  if (!changed.empty())
    return {{},
            fmt::format("{}: the checkpoint was made with other settings or inputs ({})", file,
                        changed),
            changed};
  state_fields(archive, checkpoint);
  if (!archive.at_end()) archive.fail("more than it announces");
  if (const std::string_view trouble = trouble_of(checkpoint); !trouble.empty())
    archive.fail(trouble);
  return {std::move(checkpoint)};
} catch (const InputError& error) {
  return {{}, error.what()};
}

}  // namespace io
}  // namespace walktrack
