// Validates JSON with a JSON Schema, for the keywords that the schemas in data/schemas use; an
// unknown keyword is an error, so that none is ignored.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace walktrack {

// The place and reason of the first violation ("/contacts/0/side: ..."); "" if it is valid.
std::string schema_trouble(const nlohmann::json& schema, const nlohmann::json& value);

}  // namespace walktrack
