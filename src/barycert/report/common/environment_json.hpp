/// The environment as every JSON report has it.
#pragma once

#include <nlohmann/json.hpp>

#include "barycert/environment.hpp"

namespace barycert::report {

inline nlohmann::ordered_json environment_json(const Environment& e) {
    nlohmann::ordered_json j;
    j["version"] = e.version;
    j["rounding"] = e.rounding;
    j["flush_to_zero"] = e.flush_to_zero;
    j["contraction"] = e.contraction;
    j["excess_precision"] = e.excess_precision;
    j["simd"] = e.simd;
    j["fma"] = e.fma;
    j["compiler"] = e.compiler;
    j["hardware_threads"] = e.hardware_threads;
    return j;
}

}  // namespace barycert::report
