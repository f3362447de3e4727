#pragma once

namespace articular::sim {

inline constexpr char kVersion[] = "0.1.0";

}  // namespace articular::sim
