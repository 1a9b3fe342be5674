// The message of an error.
#pragma once

#include <functional>
#include <string>

#include "core/errors.h"

namespace walktrack {

// The message of the Error that the call throws; empty, which no test expects, if it throws none.
template <typename Error = InputError>
std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace walktrack
