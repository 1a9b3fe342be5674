// A plan as text and as JSON.
#pragma once

#include <string>

#include "jobs/plan/plan.h"

namespace walktrack {
inline namespace jobs {

std::string plan_text(const Plan& plan);
std::string plan_json(const Plan& plan);

}  // namespace jobs
}  // namespace walktrack
