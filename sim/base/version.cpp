#include "sim/base/version.hpp"

namespace articular::sim {

const char* const kVersion = ARTICULAR_VERSION;
const char* const kReleaseDate = ARTICULAR_RELEASE_DATE;

}  // namespace articular::sim
