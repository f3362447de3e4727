#include "tools/anatomy/anatomy_muscles.hpp"

#include <cmath>
#include <stdexcept>

#include "tools/anatomy/anatomy_bones.hpp"

namespace articular::anatomy {

std::vector<FibreBody> muscle_shapes() {
  // The superficial masseter: from the front two thirds of the lower border of the zygomatic arch
  // to the outside of the angle of the jaw. It lies on the deep one.
  return {{"superficial_masseter",
           {{{49.3, -18, 71.2}, {55.9, -7, 73.8}, {60.6, 3.2, 76.5}, 3.2},
            {{48.5, -16, 58.5}, {59.6, 0.5, 60}, {67, 15, 62.5}, 4.1},
            {{44.5, -8.5, 46}, {55.9, 8.5, 47.8}, {62.1, 24.5, 50}, 4.2},
            {{42.5, 0, 34.5}, {52.4, 14.5, 36}, {57.2, 28.5, 37.5}, 4.1},
            {{46.6, 7.5, 22}, {51.8, 19, 22}, {54, 27, 23.5}, 2.7}},
           {"skull"},
           {"mandible", 0.27}},
          // The deep masseter: from the back third of the arch to the outside of the ramus below
          // its notch, steeper and more inwards.
          {"deep_masseter",
           {{{64, 7, 78}, {65.3, 13, 80}, {66.2, 19, 82.2}, 1.7},
            {{56.6, 8, 69.5}, {58, 17, 70.3}, {59, 26.8, 71.3}, 4.3},
            {{52.3, 6.5, 60}, {54.8, 16.5, 61}, {55.9, 28, 62}, 4.6},
            {{49.5, 7, 53}, {52.3, 17.5, 54}, {54, 28.8, 55}, 3.2},
            {{47.5, 8.5, 47.5}, {50.2, 18.5, 48.5}, {52.2, 28.3, 49.5}, 1.6}},
           {"skull"},
           {"mandible", 0.4}},
          // A fan from the side of the skull through the room within the zygomatic arch. It ends
          // like a hood over the tip of the coronoid, so that its fibres meet the bone from in
          // front, from above and from behind, and none of them lies along it.
          {"temporalis",
           {{{55.6, 1, 141.5}, {66.8, 29, 142}, {67.3, 51, 124}, 2.9},
            {{54.6, -3, 126}, {63.6, 21.5, 125}, {64, 40, 112}, 3.8},
            {{54.3, -5, 110}, {59.8, 8, 111}, {62, 18.5, 107.5}, 6.5},
            {{51, -9, 95}, {54.3, -1, 98}, {57.5, 6.5, 100}, 8},
            {{45.5, -7, 76}, {47.8, -0.8, 86}, {49.3, 5.4, 83}, 5.2},
            {{45.5, -2.6, 73.5}, {47, 0.2, 80.6}, {47.3, 5, 75.8}, 3.1}},
           {"skull", 0.25},
           {"mandible"},
           0.5,
           1.3},
          // From the inner side of the pterygoid plate, behind its lower end, to the inner side of
          // the angle of the jaw.
          {"medial_pterygoid",
           {{{18.5, 12, 85}, {18, 8.5, 85}, {17.5, 4.5, 85}, 5},
            {{17.8, 11.5, 72}, {17, 8, 72}, {16, 4, 72}, 6.2},
            {{24, 19, 59}, {20.7, 14, 60}, {16.5, 9, 61}, 6.5},
            {{33, 25, 46.5}, {29.6, 19.5, 47}, {24.5, 15, 47.5}, 5.8},
            {{39, 29, 35}, {36.5, 22.5, 35}, {31, 17.5, 35}, 4.8},
            {{41, 30, 23.5}, {39, 24, 23.5}, {34.5, 18.5, 23.5}, 3.6}},
           {"skull", 0.28},
           {"mandible", 0.3}},
          // The inferior head, from the outer side of the pterygoid plate to the front of the neck,
          // by its face. Its rows run from below upwards, as outwards is to the side. Between the
          // bones there is less room than round the other muscles.
          {"lateral_pterygoid",
           {{{33.4, -2.2, 62.5}, {32.1, 0.8, 74.2}, {31.3, 1.1, 80.7}, 6.1},
            {{32.8, 4.3, 62.4}, {35.4, 8.2, 71.1}, {34.1, 6.3, 78.4}, 5.7},
            {{36, 14.7, 58.6}, {38.3, 13.1, 70.2}, {40.1, 13.5, 78.7}, 4.7},
            {{44.2, 19.6, 71.1}, {44.8, 18.5, 75.9}, {44.4, 18.2, 80}, 3.45},
            {{47.3, 27.1, 73.2}, {47.1, 27.4, 77}, {46.9, 27.3, 79.7}, 3.6}},
           {"skull", 0.22},
           {"mandible"},
           0.5,
           1.1}};
}

Mesh muscle_mesh(const FibreBody& muscle, double h) {
  if (!(h >= 3 && h <= 6))
    throw std::invalid_argument("element size of muscles must lie between 3 and 6 mm");
  static const Bones kBones = {{"skull", skull_distance()}, {"mandible", mandible_distance()}};
  return fibre_body_mesh(muscle, kBones, h);
}

Mesh ramus_sheet(double h) {
  return part_of(mandible_surface(h), [](const Vec3& p, const Vec3& /*normal*/) {
    const bool condyle = p.y() > 19 && p.z() > 66, coronoid = p.y() > -6 && p.z() > 52;
    return p.x() > 30 && (p.y() > 3 || coronoid) && !condyle;
  });
}

Mesh temporal_sheet(double h) {
  return part_of(skull_without_styloid(h), [](const Vec3& p, const Vec3& normal) {
    const Vec3 d = p - kCondyle;  // the joint has its own surface
    const bool joint =
        d.x() > -14 && d.x() < 13 && d.y() < 11 && d.y() > -26 && d.z() < 14 && normal.z() < -0.3;
    return p.x() > 36 && p.y() > -22 && p.y() < 58 && p.z() > 68 && !joint;
  });
}

Mesh pterygoid_sheet(double h) {
  return part_of(skull_without_styloid(h), [](const Vec3& p, const Vec3& /*normal*/) {
    return p.x() > 18 && p.x() < 33 && p.y() > 0 && p.z() > 55 && p.z() < 93;
  });
}

}  // namespace articular::anatomy
