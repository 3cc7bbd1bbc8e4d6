// JSON that keeps its keys in the order of insertion, and the statistics of a run as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <utility>

#include "lib/ode/statistics.h"

namespace orthodyn {

using Json = nlohmann::ordered_json;

// The members of Statistics, by their names in files.
inline constexpr std::pair<const char*, long Statistics::*> kStatisticsCounts[] = {
    {"steps", &Statistics::steps},
    {"rejected_steps", &Statistics::rejected_steps},
    {"error_test_failures", &Statistics::error_test_failures},
    {"convergence_failures", &Statistics::convergence_failures},
    {"newton_iterations", &Statistics::newton_iterations},
    {"gauss_newton_fallbacks", &Statistics::gauss_newton_fallbacks}};
inline constexpr std::pair<const char*, Cost Statistics::*> kStatisticsCosts[] = {
    {"force", &Statistics::force},
    {"tangent", &Statistics::tangent},
    {"factorization", &Statistics::factorization},
    {"solve", &Statistics::solve},
    {"sensitivity", &Statistics::sensitivity},
    {"modes", &Statistics::modes},
    {"observation", &Statistics::observation}};

Json to_json(const Statistics& statistics);
Statistics statistics_from(const Json& json);

}  // namespace orthodyn
