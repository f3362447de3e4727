#include "tools/study/population_page.hpp"

#include <cmath>

#include "sim/base/version.hpp"
#include "tools/report/page_file.hpp"
#include "tools/report/run_record.hpp"
#include "tools/sampling/spread.hpp"
#include "tools/study/study_report.hpp"

namespace articular::tools {
namespace {

namespace fs = std::filesystem;

constexpr double kRoomForPictures = 1e6;  // of one case [bytes]

/// null where there is none: JSON knows no NaN.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

/// "" of a plain number, which columns mark with "-".
std::string unit_of_output(const StudyOutput& output) {
  const std::string unit = unit_of(output.column);
  return unit.empty() || unit == " -" ? "" : unit.substr(1);
}

Json parameters_of(const PopulationStudy& all) {
  Json list = Json::array();
  for (const PopulationParameter& parameter : all.study.population->parameters)
    list.push_back({{"name", parameter.name},
                    {"unit", parameter.unit},
                    {"distribution", distribution_words(parameter)},
                    {"low", quantile(parameter.distribution, kTornadoLow)},
                    {"high", quantile(parameter.distribution, kTornadoHigh)}});
  return list;
}

Json failures_of(const PopulationStudy& all) {
  Json list = Json::array();
  for (std::size_t i = 0; i < all.records.size(); ++i)
    if (!all.records[i].succeeded())
      list.push_back(
          {all.population.cases[i].name, all.records[i].outcome(), all.records[i].message});
  return list;
}

Json spread_of(const PopulationOutput& output) {
  if (output.drawn.empty()) return nullptr;
  const Histogram histogram = histogram_of(output.drawn);
  Json quantiles = Json::array();
  for (const double p : {0.0, 0.05, 0.25, 0.5, 0.75, 0.95, 1.0})
    quantiles.push_back({p, quantile_of(output.drawn, p)});
  return {
      {"count", output.drawn.size()},
      {"mean", mean_of(output.drawn)},
      {"sd", sd_of(output.drawn)},
      {"quantiles", quantiles},
      {"histogram",
       {{"lowest", histogram.lowest}, {"width", histogram.width}, {"counts", histogram.counts}}}};
}

Json estimate(const Estimate& e) { return {e.value, e.low, e.high}; }

Json extreme(const PopulationStudy& all, std::size_t o, std::size_t i,
             const std::map<std::size_t, fs::path>& pictures) {
  Json json = {{"case", all.population.cases[i].name},
               {"value", all.result.values[i][o]},
               {"parameters", Json::array()},
               {"pictures", Json::array()}};
  const auto& parameters = all.study.population->parameters;
  for (std::size_t p = 0; p < parameters.size(); ++p)
    json["parameters"].push_back(
        parameters[p].name + " " +
        with_unit(all.population.values(static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(i)),
                  parameters[p].unit));
  const auto found = pictures.find(i);
  if (found != pictures.end())
    json["pictures"] = pictures_of(found->second, kRoomForPictures)["pictures"];
  return json;
}

Json output_of(const PopulationStudy& all, std::size_t o,
               const std::map<std::size_t, fs::path>& pictures) {
  const PopulationOutput& output = all.result.outputs[o];
  Json json = {{"name", all.study.outputs[o].name},
               {"unit", unit_of_output(all.study.outputs[o])},
               {"spread", spread_of(output)},
               {"at_medians", number(output.at_medians)},
               {"bars", Json::array()},
               {"indices", Json::array()},
               {"whole_rows", output.whole_rows},
               {"ranks", Json::array()},
               {"extremes", Json::array()}};
  for (const TornadoBar& bar : output.bars)
    json["bars"].push_back({number(bar.low), number(bar.high)});
  for (const SobolIndex& index : output.indices)
    json["indices"].push_back({{"first", estimate(index.first)}, {"total", estimate(index.total)}});
  for (const double rank : output.ranks) json["ranks"].push_back(number(rank));
  for (const auto& i : {output.least, output.largest})
    if (i) json["extremes"].push_back(extreme(all, o, *i, pictures));
  return json;
}

}  // namespace

std::string population_page(const PopulationStudy& all,
                            const std::map<std::size_t, fs::path>& pictures) {
  Json outputs = Json::array();
  for (std::size_t o = 0; o < all.study.outputs.size(); ++o)
    outputs.push_back(output_of(all, o, pictures));
  const Json data = {{"kind", "population"},
                     {"title", all.study.title},
                     {"program", sim::kVersion},
                     {"remarks", Json::array()},
                     {"words", population_words(all)},
                     {"cases", all.records.size()},
                     {"succeeded", all.result.succeeded},
                     {"index_rows", all.study.population->index_rows},
                     {"failures", failures_of(all)},
                     {"parameters", parameters_of(all)},
                     {"outputs", outputs}};
  return page_with(empty_page(), all.study.title, data);
}

}  // namespace articular::tools
