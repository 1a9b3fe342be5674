// Reads numbers from a Python pickle without executing any of it.
//
// A pickle is a program for a stack machine that may call any function of Python. This reader knows
// the opcodes for plain values and containers, records calls instead of making them, and refuses
// everything except the construction of numpy arrays (protocols 2 to 5, numpy 1 and 2). Sources:
// Python's Lib/pickletools.py; numpy's ndarray.__reduce__.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace walktrack {
inline namespace io {

struct PickledArray {
  std::vector<size_t> shape;
  std::vector<double> numbers;  // row by row, whatever the order in the file
};

inline constexpr size_t kMostPickleBytes = size_t{1} << 18;

// The arrays of a pickled dictionary by their keys; other values are ignored. Throws an InputError
// that names the file, the byte, what was found and what is allowed; also for files larger than
// kMostPickleBytes.
std::map<std::string, PickledArray> read_pickled_arrays(const std::string& bytes,
                                                        const std::string& file);

}  // namespace io
}  // namespace walktrack
