// Whether this program is built with a sanitizer, which takes several times as much memory and
// replaces operator new.
#pragma once

namespace walktrack {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define WALKTRACK_SANITIZED 1
#else
#define WALKTRACK_SANITIZED 0
#endif
inline constexpr bool kSanitized = WALKTRACK_SANITIZED;

}  // namespace walktrack
