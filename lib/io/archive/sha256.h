// SHA-256 (FIPS 180-4): the digest that shows whether two results are the same.
#pragma once

#include <string>
#include <string_view>

namespace walktrack {
inline namespace io {

// 64 hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace io
}  // namespace walktrack
