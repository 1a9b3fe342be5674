// This program's calls of operator new, counted.
#pragma once

namespace walktrack {

// False where a sanitizer has the operators.
bool allocations_counted();

// So far, of all threads.
long allocations();

}  // namespace walktrack
