#include "jobs/init/init_files.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "io/tables/table_notes.h"

namespace walktrack {
inline namespace jobs {

namespace fs = std::filesystem;

std::string band(const Measured& of, double factor, int digits) {
  return fmt::format("{:.{}f} (± {:.{}f})", factor * of.value, digits, 2 * factor * of.sd, digits);
}

std::string path_beside(const fs::path& file, const fs::path& folder) {
  return nlohmann::json(fs::absolute(file)
                            .lexically_normal()
                            .lexically_relative(fs::absolute(folder).lexically_normal())
                            .generic_string())
      .dump();
}

std::string subject_line(double height, const std::optional<double>& mass) {
  std::string text = fmt::format("subject: {{height: {:g}", height);
  if (mass) text += fmt::format(", mass: {:g}", *mass);
  return text + "}\n";
}

nlohmann::ordered_json measured_json(const Measured& of, double factor) {
  return {{"value", json_number(factor * of.value)}, {"sd", json_number(factor * of.sd)}};
}

}  // namespace jobs
}  // namespace walktrack
