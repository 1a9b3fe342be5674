// Whether a sanitizer has this program's memory: it takes several times as much, and the operators.
#pragma once

namespace walktrack {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define WALKTRACK_SANITIZED 1
#else
#define WALKTRACK_SANITIZED 0
#endif
inline constexpr bool kSanitized = WALKTRACK_SANITIZED;

}  // namespace walktrack
