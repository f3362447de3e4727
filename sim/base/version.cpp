#include "sim/base/version.hpp"

namespace articular::sim {

const char* const kVersion = ARTICULAR_VERSION;

}  // namespace articular::sim
