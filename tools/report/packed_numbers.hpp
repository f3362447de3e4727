#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

/// Numbers in few characters, for page/unpack.js to read: whole numbers as differences to an
/// earlier one, all low bytes before all higher ones, zlib, base64.
namespace articular::tools {

using Json = nlohmann::ordered_json;

/// Of those that are finite; 0 where there is none.
double largest_size(const std::vector<double>& numbers);

std::string base64(std::string_view bytes);

/// Each number as its difference to the one `back` before; back = 0: as it is.
/// @param bytes  of each number: 2 or 4
std::string packed_integers(const std::vector<std::uint32_t>& numbers, int bytes, std::size_t back);

/// With all their bits.
std::string packed_doubles(const std::vector<double>& numbers);

/// Numbers rounded to one of 65535 steps between the least and the largest: off by at most a
/// 131068th of that range. NaN stays NaN.
/// @param frame_size  how many make one moment in time: each is packed as its difference to the
///                    moment before; 0: there is one moment only
/// @return {"low", "high", "packed"}
Json quantised(const std::vector<double>& numbers, std::size_t frame_size);

}  // namespace articular::tools
