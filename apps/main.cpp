// walktrack: the table of commands. Options are parsed here, work is done in lib/jobs.
#include <exception>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "core/errors.h"

namespace {

constexpr int kDone = 0, kFailed = 1, kUsage = 2, kInput = 3;

int run(int argc, char** argv) {
  const std::string_view word = argc > 1 ? argv[1] : "--help";
  if (word == "--version") {
    fmt::print("walktrack {}\n", WALKTRACK_VERSION);
    return kDone;
  }
  throw walktrack::UsageError(fmt::format("unknown command '{}'", word));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const walktrack::UsageError& error) {
    fmt::print(stderr, "walktrack: {}\n", error.what());
    return kUsage;
  } catch (const walktrack::InputError& error) {
    fmt::print(stderr, "walktrack: {}\n", error.what());
    return kInput;
  } catch (const std::exception& error) {
    fmt::print(stderr, "walktrack: {}\n", error.what());
    return kFailed;
  }
}
