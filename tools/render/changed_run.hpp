#pragma once

#include "tools/render/survey.hpp"

/// Runs that are not drawn as they were written.
namespace articular::tools {

/// Every point as far from its place in the first frame as it is, times the factor.
/// @throws InputError while a frame is read in which a part has other points than in the first
DrawnRun exaggerated(DrawnRun run, double factor);

/// The second run's fields minus the first one's (of vectors by components), on the first one's
/// shape. @throws InputError while a frame is read, where times, parts or meshes differ
DrawnRun difference(DrawnRun first, DrawnRun second);

/// The frame nearest in time.
const FrameEntry& frame_at(const Series& series, double time);

}  // namespace articular::tools
