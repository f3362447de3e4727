#pragma once

#include <array>
#include <cstddef>
#include <string_view>

/// How curves are told apart: by colour and by dashes, so that they differ in grey print too.
///
/// [Okabe 2008] Okabe, Ito. Color Universal Design: how to make figures and presentations that are
/// friendly to colorblind people. Eight colours that the colour-blind tell apart; their yellow is
/// too pale for a line on white paper.
namespace articular::tools {

struct LineStyle {
  std::string_view colour;  // "#rrggbb"
  std::string_view dashes;  // lengths of strokes and gaps; "": solid
};

inline constexpr std::array kColours{std::string_view("#000000"), std::string_view("#D55E00"),
                                     std::string_view("#0072B2"), std::string_view("#009E73"),
                                     std::string_view("#CC79A7"), std::string_view("#E69F00"),
                                     std::string_view("#56B4E9")};
inline constexpr std::array kDashes{std::string_view(""),     std::string_view("8,3"),
                                    std::string_view("2,2"),  std::string_view("8,3,2,3"),
                                    std::string_view("14,4"), std::string_view("8,3,2,3,2,3"),
                                    std::string_view("4,3")};

/// The first seven differ in both; with their number the pairs of colour and dashes come back after
/// 49.
inline LineStyle line_style(std::size_t i) {
  return {kColours[i % kColours.size()], kDashes[(i + i / kColours.size()) % kDashes.size()]};
}

/// Of a band, drawn so that another one is seen through it; all curves stand out from it.
inline std::string_view band_colour(std::size_t i) {
  constexpr std::array kShades{std::string_view("#C8C8C8"), std::string_view("#A9CDE8"),
                               std::string_view("#F2CE9B")};
  return kShades[i % kShades.size()];
}

}  // namespace articular::tools
