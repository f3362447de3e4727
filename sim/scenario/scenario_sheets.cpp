// Aponeuroses, fasciae, capsules.
#include "sim/scenario/scenario_keys.hpp"
#include "sim/scenario/scenario_reader.hpp"

namespace articular::sim {
namespace {

Sheet read_sheet(const TableReader& table, const Context& context, Side side) {
  Sheet sheet;
  sheet.where = table.node().where;
  sheet.name = read_name(table.at("name")) + side_suffix(table, side);
  const Body& body = read_body_reference(table.at("body"), context);
  if (body.kind != Body::Kind::Tissue)
    fail(table.at("body"),
         fmt::format("a sheet lies on the surface of a tissue, and body `{}` is none", body.name));
  sheet.at = {body.name, read_region(table.at("region"), context)};
  table.read("thickness", sheet.thickness);
  table.read("young_modulus", sheet.young_modulus);
  table.read("toe_strain", sheet.toe_strain);
  if (const Node* fibres = table.find("fibres"))
    sheet.fibres = read_fibres(*fibres, sheet_fibres_keys(), context);
  else if (!body.material->fibres)
    throw InputError(sheet.where,
                     fmt::format("{}: tissue `{}` has no fibres whose direction the sheet could "
                                 "have; expected `fibres`",
                                 table.what(), body.name));
  return sheet;
}

void append_sheets(const Node& node, const Context& context, std::vector<Sheet>& sheets) {
  const TableReader table(node, sheet_keys(), label(node, "sheet"));
  for (const Side side : read_sides(table)) {
    Context here = context;
    here.side = side;
    Sheet sheet = read_sheet(table, here, side);
    check_new_name(table.at("name"), "sheet", sheet.name, sheets);
    sheets.push_back(std::move(sheet));
  }
}

}  // namespace

const KeyTable& sheet_keys() {
  static const KeyTable kTable{
      "[[sheet]]",
      {{"name", {form::Text{"name"}}, kRequired, "unique among sheets"},
       {"body", {form::Text{"name of a tissue"}}, kRequired, "the tissue"},
       {"region",
        {form::Table{region_keys}},
        kRequired,
        "faces of its surface whose middles lie in it"},
       {"thickness", {form::Quantity{kLength, kPositive}}, kRequired, "of the sheet"},
       {"young_modulus",
        {form::Quantity{kStress, kPositive}},
        kRequired,
        "along its fibres, once they are straight; they do not push"},
       {"toe_strain",
        {form::Number{kPositive}},
        standard(0.03),
        "half the strain at which the toe ends"},
       {"fibres",
        {form::Table{sheet_fibres_keys}},
        otherwise("those of the tissue"),
        "directions at the start; the part of them within the surface counts"},
       mirror_key()}};
  return kTable;
}

std::vector<Sheet> read_sheets(const TableReader& document, const Context& context) {
  std::vector<Sheet> sheets;
  read_each(entries(document, "sheet"),
            [&](const Node& node) { append_sheets(node, context, sheets); });
  return sheets;
}

}  // namespace articular::sim
