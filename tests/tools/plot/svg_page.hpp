#pragma once

#include <expat.h>

#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace articular {

/// What a reader sees of an SVG page: texts and strokes with their places.
struct SvgPage {
  struct Text {
    std::string text;
    double x = 0, y = 0;
  };
  struct Point {
    double x = 0, y = 0;
    bool begins = false;  // a new piece of the line
  };
  struct Shape {
    std::vector<Point> points;
    std::string dashes;
  };
  std::string width, height;  // as written, "85.00mm"
  std::vector<Text> texts;
  std::vector<Shape> shapes;  // of each panel: bands, curves, error bars

  const Text* find(const std::string& text) const {
    for (const Text& one : texts)
      if (one.text == text) return &one;
    return nullptr;
  }
};

/// @throws std::runtime_error  where it is no well-formed XML
inline SvgPage read_svg(const std::string& svg) {
  struct Reader {
    SvgPage page;
    std::string element, characters;
    double x = 0, y = 0;
    bool is_in_plot = false;

    static std::string attribute(const char** attributes, const std::string& name) {
      for (; *attributes != nullptr; attributes += 2)
        if (attributes[0] == name) return attributes[1];
      return "";
    }
    void points(const std::string& d) {
      SvgPage::Shape& shape = page.shapes.back();
      int read = 0;
      for (const char* c = d.c_str(); *c != '\0';) {
        SvgPage::Point p;
        p.begins = *c == 'M';
        const char* number = *c == 'M' || *c == 'L' ? c + 1 : c;
        if (std::sscanf(number, "%lf,%lf%n", &p.x, &p.y, &read) == 2) {
          shape.points.push_back(p);
          c = number + read;
        } else {
          ++c;
        }
      }
    }
    void start(const std::string& name, const char** attributes) {
      element = name;
      characters.clear();
      const std::string id = attribute(attributes, "id");
      if (name == "svg") {
        page.width = attribute(attributes, "width");
        page.height = attribute(attributes, "height");
      }
      if (name == "g" && id.starts_with("gnuplot_plot_")) {
        page.shapes.emplace_back();
        is_in_plot = true;
      }
      const std::string transform = attribute(attributes, "transform");
      if (!transform.empty()) {
        std::sscanf(transform.c_str(), "translate(%lf,%lf)", &x, &y);
        is_in_plot = false;  // what follows a curve has its own place
      }
      if (is_in_plot && (name == "path" || name == "polygon")) {
        points(attribute(attributes, name == "path" ? "d" : "points"));
        page.shapes.back().dashes = attribute(attributes, "stroke-dasharray");
      }
    }
    void end(const std::string& name) {
      if (name == "text") page.texts.push_back({characters, x, y});
    }
  } reader;
  const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(
      XML_ParserCreate(nullptr), &XML_ParserFree);
  XML_SetUserData(parser.get(), &reader);
  XML_SetElementHandler(
      parser.get(),
      [](void* data, const char* name, const char** attributes) {
        static_cast<Reader*>(data)->start(name, attributes);
      },
      [](void* data, const char* name) { static_cast<Reader*>(data)->end(name); });
  XML_SetCharacterDataHandler(parser.get(), [](void* data, const char* text, int length) {
    static_cast<Reader*>(data)->characters.append(text, static_cast<std::size_t>(length));
  });
  if (XML_Parse(parser.get(), svg.data(), static_cast<int>(svg.size()), 1) != XML_STATUS_OK)
    throw std::runtime_error(XML_ErrorString(XML_GetErrorCode(parser.get())));
  return reader.page;
}

}  // namespace articular
