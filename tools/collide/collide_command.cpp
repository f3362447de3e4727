#include "tools/collide/collide_command.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "tools/collide/collide.hpp"
#include "tools/process/interruption.hpp"

namespace articular::tools {
namespace {

const char* const kCollideHelp =
    R"(A and B are meshes of tetrahedra (.vtu, .vtk, .msh, .inp, ...), or series of frames of one mesh: a
pattern in quotes, taken in order of names ('disc_*.vtu'; number frames with leading zeros), or
a .pvd, of which FILE.pvd:BODY picks one of several bodies. Two series have the same number of
frames, or one is a single mesh that stands still. One mesh alone is searched against itself.

The table of --pairs has the header frame,triangle_body,triangle_tet,triangle_face,tet_body,tet.
Frames count from 0; body 0 is A, 1 is B. Tetrahedra are numbered from 0 in the order of the
file, other cells not counted; a triangle is named by its tetrahedron and the local node (0 to 3)
that it lies opposite to. In a mesh with itself pairs with a common node are left out.

Example: two frames of a run, then the whole of it
  articular run scenarios/v-shapes/two.toml --out out/two
  articular collide out/two/frames/lower_000011.vtu out/two/frames/upper_000011.vtu
  articular collide out/two/two.pvd:lower out/two/two.pvd:upper --pairs out/two/pairs.csv)";

void add_options(CLI::App& command, CollideOptions& options) {
  command
      .add_option("meshes", options.meshes,
                  "One mesh of tetrahedra (.vtu, .vtk, .msh, .inp, ...; .pvd), or two: A B")
      ->required()
      ->type_name("A [B]")
      ->expected(1, -1);  // an unquoted pattern gives many, which gets a message of its own
  command.add_flag("--self", options.self, "Of two meshes, search each against itself as well");
  command
      .add_option("--narrow", options.narrow,
                  "Test of a triangle and a tetrahedron: sat (separating axes) or gjk [sat]")
      ->type_name("sat|gjk");
  command
      .add_option("--method", options.method,
                  "blocks, or article: the BucketTree of the article, with gjk [blocks]")
      ->type_name("blocks|article");
  command.add_option("--pairs", options.pairs, "Write the pairs found as a table (.csv)")
      ->type_name("FILE");
  command
      .add_option("--repeat", options.repeat,
                  "Go through the frames N times; times are medians [1]")
      ->type_name("N");
  command.add_option("--threads", options.threads, "The answer is the same with any number [1]")
      ->type_name("N");
  command
      .add_option("--margin", options.margin,
                  "Pairs nearer than this too, in the length unit of the mesh files; near edges "
                  "and corners also some a little farther [0]")
      ->type_name("LENGTH");
  command.add_flag("--json", options.json, "Machine-readable, times in seconds");
  command.footer(kCollideHelp);
}

}  // namespace

void add_collide_command(CLI::App& app, int& exit_code) {
  const auto options = std::make_shared<CollideOptions>();
  CLI::App& command = *app.add_subcommand(
      "collide", "Find surface triangles that penetrate tetrahedra, of two meshes or of one");
  add_options(command, *options);
  command.callback([options, &exit_code] {
    listen_for_interruption();
    options->interrupted = interruption_asked;
    exit_code = collide(*options);
  });
}

}  // namespace articular::tools
