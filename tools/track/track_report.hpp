#pragma once

#include <filesystem>
#include <string>

#include "tools/track/track.hpp"

/// What a track found, as text and tables.
namespace articular::tools {

/// excitations.csv: what [excitations] of a scenario reads.
std::string excitations_csv(const TrackResult& result);

/// excitations.txt: PATH=VALUE lines, those of the track too, with which `run` takes the table.
/// @param table  where excitations.csv lies
std::string excitation_overrides(const Track& track, const std::filesystem::path& table);

/// targets.csv: what was wanted and what it came to, at each time.
std::string targets_csv(const Track& track, const TrackResult& result);

/// Targets that are missed at some time, with the time where most, in words; also EMG. "" where
/// none is.
std::string missed_targets(const Track& track, const TrackResult& result);

/// muscles.csv: each excitation at each time, how well it is known, and what other costs would have
/// given.
std::string muscles_csv(const TrackResult& result);

/// track.md.  @param overrides  where excitations.txt lies
std::string track_text(const Track& track, const TrackResult& result,
                       const std::filesystem::path& overrides);

}  // namespace articular::tools
