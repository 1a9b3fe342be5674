// This program's calls of operator new, counted; none where a sanitizer has the operator.
#pragma once

namespace walktrack {

// So far, of all threads.
long allocations();

}  // namespace walktrack
