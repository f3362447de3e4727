#include "tools/import/febio_material.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "sim/base/message_text.hpp"
#include "sim/mesh/mesh_readers.hpp"
#include "tools/import/toml_entry.hpp"

namespace articular::tools {
namespace {

using sim::XmlElement;

constexpr int kMostTerms = 6;  // of Ogden's law and of relaxation, as FEBio has them

/// Thrown where a constant is no number: it varies in space, or is missing.
struct NoConstant {
  int line;
  std::string what;
};

class Translator {
 public:
  Translator(const FebioMaterial& material, const UnitSystem& units, std::string fibre_array,
             bool is_dynamic, std::vector<Loss>& losses)
      : material_(material),
        units_(units),
        fibre_array_(std::move(fibre_array)),
        is_dynamic_(is_dynamic),
        losses_(losses) {}

  std::optional<MaterialText> translate() {
    const XmlElement& element = *material_.element;
    MaterialText text;
    text.density = toml_quantity(number_or(element, "density", 1), units_.density());
    if (part(element, "density") == nullptr && part(element, "elastic") != nullptr)
      text.density =
          toml_quantity(number_or(*part(element, "elastic"), "density", 1), units_.density());
    const std::optional<std::string> keys = material_.type == "uncoupled viscoelastic"
                                                ? relaxing(element)
                                                : law(material_.type, element, 1, text.activation);
    if (!keys) return std::nullopt;
    lose_unread(element);
    text.table = fmt::format("{{ {} }}", *keys);
    return text;
  }

 private:
  const XmlElement* part(const XmlElement& element, std::string_view name) const {
    const XmlElement* const found = element.child(name);
    read_.insert(found);
    return found;
  }

  /// What no law asked for, such as a prestrain. Axes of a law without fibres say nothing, nor do
  /// the tolerances of an augmentation.
  void lose_unread(const XmlElement& element) {
    constexpr std::array<std::string_view, 4> kIdle{"fiber", "mat_axis", "atol", "augtol"};
    for (const XmlElement& inner : element.children) {
      if (inner.name == "elastic")
        lose_unread(inner);
      else if (!read_.contains(&inner) && std::ranges::find(kIdle, inner.name) == kIdle.end())
        lose(inner, fmt::format("{} of the material {}", sim::in_ticks(inner.name),
                                sim::in_ticks(material_.name)));
    }
  }

  /// A number in a child. @throws NoConstant
  double number(const XmlElement& element, std::string_view name) const {
    const XmlElement* const child = part(element, name);
    if (child == nullptr)
      throw NoConstant{element.line, fmt::format("it has no constant `{}`", name)};
    const std::optional<double> value = sim::parse_number(child->text);
    if (!value || child->attribute("lc") != nullptr)
      throw NoConstant{child->line, fmt::format("its constant `{}` varies in space or time", name)};
    return *value;
  }
  double number_or(const XmlElement& element, std::string_view name, double otherwise) const {
    return part(element, name) != nullptr ? number(element, name) : otherwise;
  }

  /// "c10 = "2 kPa"". A scale belongs to the stress of the distortion.
  std::string stress(std::string_view key, double value) const {
    return fmt::format("{} = {}", key, toml_quantity(value, units_.stress));
  }
  static std::string plain(std::string_view key, double value) {
    return fmt::format("{} = {}", key, value);
  }

  std::string two_constants(std::string_view law, const XmlElement& element) const {
    return fmt::format("law = \"{}\", {}, {}", law, stress("young_modulus", number(element, "E")),
                       plain("poisson_ratio", number(element, "v")));
  }

  /// U(J) of an uncoupled law is k/2 (ln J)² unless `pressure_model` says otherwise.
  std::string bulk(const XmlElement& element) {
    const XmlElement* const model = part(element, "pressure_model");
    std::string_view word = "logarithmic";
    if (model != nullptr && (model->text == "2" || model->text == "Abaqus"))
      word = "quadratic";
    else if (model != nullptr && model->text != "0" && model->text != "default")
      lose(*model,
           fmt::format("pressure_model {}: the change of volume has the energy k/2 (ln J)^2",
                       sim::in_quotes(model->text)));
    if (const XmlElement* const augmented = part(element, "laugon");
        augmented && augmented->text != "0")
      lose(*augmented,
           "the augmented incompressibility (`laugon`): the bulk modulus k alone counts");
    return fmt::format("{}, volumetric = \"{}\"", stress("bulk_modulus", number(element, "k")),
                       word);
  }

  void lose(const XmlElement& element, std::string what) {
    losses_.push_back({element.line, std::move(what)});
  }

  /// Law and constants. @param scale  of the energy of the distortion
  std::optional<std::string> law(const std::string& type, const XmlElement& element, double scale,
                                 std::optional<FebioValue>& activation) {
    if (type == "neo-Hookean") return two_constants("coupled-neo-hookean", element);
    if (type == "isotropic elastic") return two_constants("st-venant-kirchhoff", element);
    if (type == "linear elastic") return two_constants("linear", element);
    if (type == "Holmes-Mow")
      return two_constants("holmes-mow", element) + ", " + plain("beta", number(element, "beta"));
    if (type == "incomp neo-Hookean")
      return fmt::format("law = \"mooney-rivlin\", {}, {}",
                         stress("c10", scale * number(element, "G") / 2), bulk(element));
    if (type == "Mooney-Rivlin")
      return fmt::format("law = \"mooney-rivlin\", {}, {}, {}",
                         stress("c10", scale * number(element, "c1")),
                         stress("c01", scale * number_or(element, "c2", 0)), bulk(element));
    if (type == "Veronda-Westmann")
      return fmt::format("law = \"veronda-westmann\", {}, {}, {}",
                         stress("c1", scale * number(element, "c1")),
                         plain("c2", number(element, "c2")), bulk(element));
    if (type == "Yeoh" && yeoh_ends_at_two(element))
      return fmt::format("law = \"yeoh\", {}, {}, {}", stress("c10", scale * number(element, "c1")),
                         stress("c20", scale * number_or(element, "c2", 0)), bulk(element));
    if (type == "Ogden") return ogden(element, scale);
    if (type == "trans iso Mooney-Rivlin") return transversely_isotropic(element, scale);
    if (type == "muscle material" && scale == 1) return muscle(element, activation);
    return std::nullopt;
  }

  bool yeoh_ends_at_two(const XmlElement& element) const {
    for (const char* const name : {"c3", "c4", "c5", "c6"})
      if (number_or(element, name, 0) != 0) return false;
    return true;
  }

  std::string ogden(const XmlElement& element, double scale) {
    std::string terms;
    for (int i = 1; i <= kMostTerms; ++i) {
      const double c = number_or(element, fmt::format("c{}", i), 0);
      if (c == 0) continue;
      terms += fmt::format("{}{{ {}, {} }}", terms.empty() ? "" : ", ", stress("c", scale * c),
                           plain("m", number(element, fmt::format("m{}", i))));
    }
    return fmt::format("law = \"ogden\", terms = [{}], {}", terms, bulk(element));
  }

  std::string transversely_isotropic(const XmlElement& element, double scale) {
    if (const XmlElement* const active = part(element, "active_contraction"))
      lose(*active, "the active contraction of the fibres");
    return fmt::format(
        "law = \"transversely-isotropic\", {}, {}, {}, {}, {}, {}, {}, {}",
        stress("c10", scale * number(element, "c1")),
        stress("c01", scale * number_or(element, "c2", 0)),
        stress("c3", scale * number(element, "c3")), plain("c4", number(element, "c4")),
        stress("c5", scale * number(element, "c5")), plain("toe_end", number(element, "lam_max")),
        bulk(element), fibres(element));
  }

  std::string muscle(const XmlElement& element, std::optional<FebioValue>& activation) {
    for (const char* const name : {"activation", "alpha"})
      if (const XmlElement* const child = part(element, name)) {
        const std::optional<double> value = sim::parse_number(child->text);
        if (!value) throw NoConstant{child->line, "its activation is no number"};
        activation = FebioValue{*value, child->attribute("lc") ? *child->attribute("lc") : ""};
        if (is_dynamic_)
          lose(*child,
               "the activation at once: it follows its curve with the muscle's time constants");
      }
    if (number_or(element, "g3", 0) != 0)
      lose(*part(element, "g3"), "the constant g3 of the muscle");
    const double optimal = number(element, "Lofl");
    return fmt::format(
        "law = \"muscle\", {}, {}, {}, {}, {}, {}, {}, {}, {}",
        stress("max_stress", number(element, "smax")), plain("p1", number(element, "p1")),
        plain("p2", number(element, "p2")), plain("toe_end", number(element, "lam_max") / optimal),
        plain("optimal_stretch", optimal), stress("shear_along", number(element, "g1")),
        stress("shear_across", number(element, "g2")), bulk(element), fibres(element));
  }

  /// A direction, else the mesh's, else x: that is FEBio's default.
  std::string fibres(const XmlElement& element) {
    const XmlElement* fibre = part(element, "fiber");
    if (fibre == nullptr && part(element, "mat_axis") != nullptr)
      fibre = part(element, "mat_axis")->child("a");
    if (fibre != nullptr) {
      std::string numbers;
      int count = 0;
      std::string text = fibre->text;
      for (char& c : text)
        if (c == ',' || c == '\n' || c == '\t') c = ' ';
      for (std::size_t at = 0; (at = text.find_first_not_of(' ', at)) != std::string::npos;) {
        const std::size_t end = std::min(text.find(' ', at), text.size());
        const std::optional<double> value = sim::parse_number(text.substr(at, end - at));
        if (!value) break;
        numbers += fmt::format("{}{}", count++ == 0 ? "" : ", ", *value);
        at = end;
      }
      if (count == 3) return fmt::format("fibres = {{ direction = [{}] }}", numbers);
    }
    if (!fibre_array_.empty())
      return fmt::format("fibres = {{ array = {} }}", toml_text(fibre_array_));
    if (fibre != nullptr)
      throw NoConstant{fibre->line, "its fibres are not one direction, nor data of the elements"};
    return "fibres = { direction = [1, 0, 0] }";
  }

  /// FEBio's law holds for what does not relax: at once it is (g0 + Σ g) times as stiff. Only the
  /// distortion relaxes, in both programs.
  std::optional<std::string> relaxing(const XmlElement& element) {
    const XmlElement* const elastic = part(element, "elastic");
    if (elastic == nullptr) throw NoConstant{element.line, "it has no <elastic>"};
    double sum = number_or(element, "g0", 1);
    for (int i = 1; i <= kMostTerms; ++i) sum += number_or(element, fmt::format("g{}", i), 0);
    std::string terms;
    for (int i = 1; i <= kMostTerms; ++i)
      if (const double g = number_or(element, fmt::format("g{}", i), 0); g != 0)
        terms += fmt::format("{}{{ weight = {}, time = \"{} s\" }}", terms.empty() ? "" : ", ",
                             g / sum, number_or(element, fmt::format("t{}", i), 1));
    std::optional<FebioValue> activation;
    const std::string* const type = elastic->attribute("type");
    std::optional<std::string> keys = law(type != nullptr ? *type : "", *elastic, sum, activation);
    if (!keys || terms.empty()) return keys;
    if (!is_dynamic_) lose(element, "relaxation in time: a static analysis has it all gone");
    return fmt::format("{}, relaxation = [{}]", *keys, terms);
  }

  const FebioMaterial& material_;
  const UnitSystem& units_;
  std::string fibre_array_;
  bool is_dynamic_;
  std::vector<Loss>& losses_;
  mutable std::set<const XmlElement*> read_;  // children that were asked for
};

}  // namespace

std::optional<MaterialText> material_text(const FebioMaterial& material, const UnitSystem& units,
                                          const std::string& fibre_array, bool is_dynamic,
                                          std::vector<Loss>& losses) {
  try {
    std::optional<MaterialText> text =
        Translator(material, units, fibre_array, is_dynamic, losses).translate();
    if (!text)
      losses.push_back({material.element->line,
                        fmt::format("the material {} of type {}: no law here is the same",
                                    sim::in_ticks(material.name), sim::in_quotes(material.type))});
    return text;
  } catch (const NoConstant& missing) {
    losses.push_back({missing.line, fmt::format("the material {}: {}", sim::in_ticks(material.name),
                                                missing.what)});
    return std::nullopt;
  }
}

}  // namespace articular::tools
