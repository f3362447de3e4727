#include "tools/manual/man_page.hpp"

#include <fmt/format.h>

#include <sstream>

namespace articular::tools {
namespace {

/// A text as it is: no character of it is taken for a request or for a typographic one.
std::string plain(const std::string& text) {
  std::string escaped;
  for (const char c : text) switch (c) {
      case '\\':
        escaped += "\\e";
        break;
      case '-':
        escaped += "\\-";
        break;
      case '`':
        escaped += "\\(ga";
        break;
      case '\'':
        escaped += "\\(aq";
        break;
      case '"':
        escaped += "\\(dq";
        break;
      case '^':
        escaped += "\\(ha";
        break;
      case '~':
        escaped += "\\(ti";
        break;
      default:
        escaped += c;
    }
  return escaped.starts_with('.') ? "\\&" + escaped : escaped;
}

std::string bold(const std::string& text) { return "\\fB" + plain(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + plain(text) + "\\fR"; }

/// A footer has sentences and, on lines of their own, commands to try: "Try: articular run ..." and
/// lines that are indented. Sentences are filled, commands are not.
std::string prose_and_examples(const std::string& text) {
  std::string page;
  bool in_example = false, is_gap = false;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const bool is_example = line.starts_with(' ') || line.starts_with("Try: ");
    is_gap = is_gap || line.empty() || is_example != in_example;
    if (line.empty()) continue;
    if (in_example && !is_example) page += ".fi\n";
    if (is_gap && !page.empty()) page += ".PP\n";
    if (!in_example && is_example) page += ".nf\n";
    page += plain(line) + '\n';
    in_example = is_example;
    is_gap = false;
  }
  return page + (in_example ? ".fi\n" : "");
}

std::string positional_usage(const Argument& positional) {
  const std::string name = italic(positional.names.front()) + (positional.repeatable ? "..." : "");
  return positional.required ? name : "[" + name + "]";
}

std::string usage(const std::string& path, const Command& command) {
  std::string line = bold(path);
  if (!command.options.empty()) line += " [" + italic("OPTIONS") + "]";
  for (const Argument& positional : command.positionals) line += " " + positional_usage(positional);
  if (!command.commands.empty()) line += " " + italic("SUBCOMMAND");
  return line;
}

std::string entry(const std::string& title, const Argument& argument) {
  return fmt::format(".TP\n{}\n{}{}\n", title, plain(argument.description),
                     argument.required ? " (required)" : "");
}

std::string option_entry(const Argument& option) {
  std::string title;
  for (const std::string& name : option.names) title += (title.empty() ? "" : ", ") + bold(name);
  if (!option.value.empty()) title += " " + italic(option.value);
  return entry(title, option);
}

/// Of a positional, the kind of value is told where it is more than "TEXT".
std::string positional_entry(const Argument& positional) {
  const std::string kind = positional.value == "TEXT" ? "" : " (" + plain(positional.value) + ")";
  return entry(italic(positional.names.front()) + kind, positional);
}

bool is_help(const Argument& option) { return option.names.back() == "--help"; }

std::string arguments(const Command& command) {
  std::string entries;
  for (const Argument& positional : command.positionals) entries += positional_entry(positional);
  for (const Argument& option : command.options)
    if (!is_help(option)) entries += option_entry(option);
  return entries;
}

/// A command that only has others below it is told of by these.
std::string subsections(const std::string& path, const Command& command) {
  std::string text;
  if (command.commands.empty())
    text = fmt::format(".SS {}\n{}\n.PP\n{}\n{}", plain(path), plain(command.description) + ".",
                       usage(path, command), arguments(command)) +
           (command.footer.empty() ? "" : ".PP\n" + prose_and_examples(command.footer));
  for (const Command& below : command.commands) text += subsections(path + " " + below.name, below);
  return text;
}

constexpr const char* kEnd = R"(.SH ENVIRONMENT
.TP
.B ARTICULAR_DATA
A folder of recorded anatomy, which mesh files of a scenario may name as ${ARTICULAR_DATA}.
.TP
.B ARTICULAR_SCENARIOS
A folder of scenarios that names such as mandible/opening are looked for in, in place of the shipped one.
.TP
.B OPENBLAS_CORETYPE
The kernels of OpenBLAS. Without it articular takes those of the newest instructions that processor and library both know.
.TP
.B TMPDIR
The folder for temporary files, /tmp without it.
.SH FILES
.TP
.I PREFIX/share/articular/scenarios
The scenarios that are shipped, with their meshes. PREFIX is /usr where a package installed them.
.TP
.I PREFIX/share/doc/articular
The format of scenario files, all result files, theory, and measured figures.
.SH SEE ALSO
.BR paraview (1),
.BR gnuplot (1)
)";

}  // namespace

std::string man_page(const Command& program, const std::string& version, const std::string& date) {
  std::string page = fmt::format(
      ".TH {0} 1 {1} \"{2} {3}\" \"User Commands\"\n"
      ".SH NAME\n{2} \\- finite\\-element simulator of jaw and knee tissue\n"
      ".SH SYNOPSIS\n{4}\n.SH DESCRIPTION\n{5}",
      "ARTICULAR", date, program.name, version, usage(program.name, program),
      prose_and_examples(program.description));
  page += ".SH OPTIONS\n";
  for (const Argument& option : program.options) page += option_entry(option);
  page += ".SH SUBCOMMANDS\n";
  for (const Command& command : program.commands)
    page += subsections(program.name + " " + command.name, command);
  return page + ".SH EXAMPLES AND EXIT CODES\n" + prose_and_examples(program.footer) + kEnd;
}

}  // namespace articular::tools
