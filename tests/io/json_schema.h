// Whether JSON is as a JSON Schema says, for the keywords that the schemas in data/schemas use; a
// keyword that is not known here is an error, so that none is passed over.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace walktrack {

// Where and why it is not ("/contacts/0/side: ..."); "" where it is.
std::string schema_trouble(const nlohmann::json& schema, const nlohmann::json& value);

}  // namespace walktrack
