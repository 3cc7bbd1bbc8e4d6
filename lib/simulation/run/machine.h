// Machine, versions, memory and date that a result records.
#pragma once

#include <string>

#include "lib/simulation/output/json.h"

namespace orthodyn {

Json machine_json();    // processor, cores, memory, vector instructions in use
Json versions_json();   // orthodyn and every library
double peak_memory();   // of this process so far, bytes; NaN if unknown
std::string utc_now();  // 2026-01-31T12:00:00Z

}  // namespace orthodyn
