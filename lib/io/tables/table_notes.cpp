#include "io/tables/table_notes.h"

#include <cmath>

#include <nlohmann/json.hpp>

namespace walktrack {
inline namespace io {

std::string tables_json(std::span<const TableNotes> tables) {
  nlohmann::ordered_json root;
  root["format"] = "walktrack tables 1";
  for (const TableNotes& notes : tables)
    root[notes.table] = nlohmann::ordered_json::parse(notes.json);
  return root.dump(2) + "\n";
}

nlohmann::ordered_json json_number(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::round(value * 1e6) / 1e6 + 0.0;
}

}  // namespace io
}  // namespace walktrack
