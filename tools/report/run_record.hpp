#pragma once

#include <filesystem>

#include "tools/report/packed_numbers.hpp"

namespace articular::tools {

/// summary.json as it is, or null where there is none.
Json summary_of(const std::filesystem::path& folder);

/// error_bars.csv: {"columns": [...], "rows": [[...]]}, or null where there is none.
/// @throws InputError  where it is damaged
Json error_bars_of(const std::filesystem::path& folder);

/// All columns of history.csv: {"axes": [times], "columns": [{"name", "unit", "axis", "values"}],
/// "panels": [{"title", "is_zero", "unit", "factor", "columns"}], "time": {"label", "factor"},
/// "rows"}. Long histories are thinned, but no extreme is lost (see ThinnedCurve).
/// @throws InputError  where there is none, or no row in it yet, or it is damaged
Json history_of(const std::filesystem::path& folder);

/// Pictures and plots that lie in the folder: {"pictures": [{"name", "source"}], "remarks"}.
/// @param room  [bytes] for all of them; those that do not fit are named in a remark
Json pictures_of(const std::filesystem::path& folder, double room);

}  // namespace articular::tools
