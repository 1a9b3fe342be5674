// Counts this program's calls of operator new; 0 if a sanitizer replaces the operator.
#pragma once

namespace walktrack {

// Number so far, of all threads.
long allocations();

}  // namespace walktrack
