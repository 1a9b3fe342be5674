// Memory for short-lived arrays of one call (std::pmr::vector): on the stack while they are small,
// otherwise on the heap. It is freed when this object goes out of scope.
#pragma once

#include <array>
#include <cstddef>
#include <memory_resource>

namespace walktrack {
inline namespace core {

template <size_t kBytes>
class Scratch {
 public:
  Scratch() = default;
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  std::pmr::memory_resource* memory() { return &resource_; }

 private:
  alignas(std::max_align_t) std::array<std::byte, kBytes> bytes_;
  std::pmr::monotonic_buffer_resource resource_{bytes_.data(), kBytes};
};

}  // namespace core
}  // namespace walktrack
