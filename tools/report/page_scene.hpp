#pragma once

#include <map>
#include <string>
#include <vector>

#include "tools/render/render_series.hpp"
#include "tools/report/packed_numbers.hpp"
#include "tools/report/page_skin.hpp"

namespace articular::tools {

/// What the 3D view shows, gathered from frames one after another: surfaces of tissues with the
/// fields at their nodes, bones by their poses, lines.
class PageScene {
 public:
  /// @throws InputError  where a part has other points than in the first frame
  void add(const Frame& frame);

  /// What one more frame like the first takes of the page, about [bytes].
  double bytes_a_frame() const;

  /// {"bodies", "lines", "fields", "colour_maps", "directions", "views"}, for page/frames.js.
  Json json(const Directions& directions) const;

  /// What is drawn otherwise than it was computed, in words.
  const std::vector<std::string>& remarks() const { return remarks_; }

 private:
  using Fields = std::map<std::string, std::vector<double>>;  // of all frames, one after another
  struct BodyRecord {
    std::string name;
    bool is_tissue = false;
    PageSkin skin;
    vtkIdType num_points = 0;       // of the part
    Positions start, shape;         // a bone: its points, and those that are drawn
    std::vector<double> positions;  // tissue: x of all nodes, then y, then z; of each frame
    std::vector<double> poses;      // a bone, see rigid_pose()
    Fields fields;
  };
  struct LinesRecord {
    std::vector<std::string> names;
    std::vector<bool> is_muscle;
    std::vector<std::uint32_t> counts;  // points of each line in each frame
    std::vector<double> points;         // x y z x y z
    Fields fields;
  };
  struct FieldInfo {
    std::string unit;
    bool is_of_lines = false;
  };

  BodyRecord& record_of(const Part& part);
  void add_tissue(const Part& part, BodyRecord& record);
  void add_bone(const Part& part, BodyRecord& record);
  void add_lines(const Part& part);
  void add_field(const Part& part, const std::string& field, Fields& fields,
                 const std::vector<vtkIdType>* nodes);
  Json body_json(const BodyRecord& record) const;
  Json lines_json() const;
  Json fields_json() const;

  std::vector<BodyRecord> bodies_;
  LinesRecord lines_;
  std::map<std::string, FieldInfo> fields_;
  std::vector<std::string> remarks_;
};

}  // namespace articular::tools
