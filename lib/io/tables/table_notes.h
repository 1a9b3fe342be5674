// tables.json: what stands in the tables beside it. The tables themselves begin with their header
// line, so that any program reads them as they are.
//   format   "walktrack tables 1"
//   <table>  {units, bands, ... in words; rate_hz, subject, totals, ... as numbers}
#pragma once

#include <span>
#include <string>
#include <utility>

#include <nlohmann/json_fwd.hpp>

namespace walktrack {

// Of one table, e.g. "angles.csv".
using TableNotes = std::pair<std::string, nlohmann::ordered_json>;

std::string tables_json(std::span<const TableNotes> tables);

// With six decimals, as tables have them; null for what is not finite.
nlohmann::ordered_json json_number(double value);

}  // namespace walktrack
