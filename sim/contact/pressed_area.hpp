#pragma once

#include <vector>

#include "sim/contact/contact_response.hpp"

/// The area on which at least a given pressure acts, as a pressure film shows it.
///
/// It ends where the linear field of contact_area.hpp has that value: as the threshold falls to
/// zero, it becomes the area that carries. There pressure ends at zero, and on a thin layer even
/// its slope does, so the whole area hangs on pressures that no film shows and no mesh resolves.
/// The line where the pressure has a given value does not.
namespace articular::sim {

/// Of a contact, at rest [m²].
/// @param selected   by face of the body's collider, one of the contact's two; empty: all
/// @param threshold  [Pa], > 0
double area_above(const Model& model, const ContactResponse& response, ContactId contact, int body,
                  const std::vector<char>& selected, double threshold);

}  // namespace articular::sim
