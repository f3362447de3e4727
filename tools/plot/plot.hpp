#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/plot/page_layout.hpp"

namespace articular::tools {

struct PlotOptions {
  std::vector<std::string> arguments;      // folders of runs, then words for probes
  std::filesystem::path out;               // .svg or .pdf; "": see default_plot_file()
  std::string x;                           // column of the x axis; "": time or load
  std::vector<std::string> ranges, bands;  // see parse_interval(), read_band()
  std::string x_range;                     // "": all there is
  std::vector<std::string> labels;         // of the runs; none: names of their folders
  PageSize size;
};

/// Which arguments are folders of runs: the first in any case, and those that follow it as long as
/// they are folders, or paths.
std::size_t count_folders(const std::vector<std::string>& arguments);

/// Names that tell folders apart: the last parts of their paths, as many as it takes.
std::vector<std::string> folder_labels(const std::vector<std::filesystem::path>& folders);

/// DIR/plot/PROBES.svg of one run, plot/DIRS-PROBES.svg in the working folder of several, with
/// -over-X where X is on the x axis. Other runs, probes or x axes give another name.
std::filesystem::path default_plot_file(const std::vector<std::filesystem::path>& folders,
                                        const std::vector<std::string>& probes,
                                        const std::string& x);

/// Draws curves of runs, and says on stdout what was written and on stderr what was left out.
/// @return 0, or kInterruptedExitCode
/// @throws InputError, SystemError
int plot(const PlotOptions& options);

}  // namespace articular::tools
