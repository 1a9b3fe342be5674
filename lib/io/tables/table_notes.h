// tables.json: a description of the tables beside it. The tables themselves begin with their header
// line, so that any program can read them.
//   format   "walktrack tables 1"
//   <table>  {units, bands, ... in words; rate_hz, subject, totals, ... as numbers}
#pragma once

#include <span>
#include <string>

#include <nlohmann/json_fwd.hpp>

namespace walktrack {
inline namespace io {

struct TableNotes {
  std::string table;  // "angles.csv"
  std::string json;   // an object
};

std::string tables_json(std::span<const TableNotes> tables);

// With six decimals, as in tables; null if not finite.
nlohmann::ordered_json json_number(double value);

}  // namespace io
}  // namespace walktrack
