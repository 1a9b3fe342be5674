// walktrack config: the configuration with comments, after a file and --set.
#include <fmt/format.h>

#include "commands.h"
#include "io/archive/files.h"

namespace walktrack {

int run_config(const Arguments& arguments) {
  bool changed = false, keys = false;
  CommandLine line({.name = "config",
                    .operands = "",
                    .about = "Prints every parameter with its value, meaning, allowed values and, "
                             "if the value is not the default,\nthe file or option that set it. "
                             "The output is itself a configuration file.",
                    .example = "walktrack config --set seed=7"});
  line.options().add_options()("changed", boost::program_options::bool_switch(&changed),
                               "print only values that differ from the defaults")(
      "keys", boost::program_options::bool_switch(&keys), "print only the names, one in each line");
  if (!line.parse(arguments)) return kDone;
  if (keys) {
    for (const auto& [key, value] : config_values(line.config().values)) fmt::print("{}\n", key);
    return kDone;
  }
  const std::string text = config_as_yaml(
      line.config(), changed ? ConfigScope::kChanged : ConfigScope::kEverything, true);
  line.write_or_print(text);
  return kDone;
}

}  // namespace walktrack
