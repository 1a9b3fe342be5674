#include "counted_heap.h"

#include <atomic>
#include <cstdlib>
#include <new>

#include "tests/sanitized.h"

namespace walktrack {

namespace {

std::atomic<long> allocation_count{0};

}  // namespace

long allocations() { return allocation_count; }

}  // namespace walktrack

#if !WALKTRACK_SANITIZED
void* operator new(size_t size) {
  ++walktrack::allocation_count;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void* operator new(size_t size, std::align_val_t alignment) {
  ++walktrack::allocation_count;
  const auto unit = static_cast<size_t>(alignment);
  if (void* memory = std::aligned_alloc(unit, (size + unit - 1) / unit * unit)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, size_t, std::align_val_t) noexcept { std::free(memory); }
#endif
