#include <fmt/format.h>

#include "tools/manual/completed_value.hpp"
#include "tools/manual/shell_completion.hpp"

namespace articular::tools {
namespace {

constexpr const char* kHelpers = R"bash(
# _articular_words WORD...: those that go on from what is typed. Bash takes "=" for a word of its own, so
# that of accuracy=fast only what stands behind it is to be completed.
_articular_words() {
  mapfile -t COMPREPLY < <(compgen -W "$*" -- "$key$word")
  COMPREPLY=("${COMPREPLY[@]#"$key"}")
}

# _articular_files [ENDING]...: folders, and files with these endings; '' is that of all.
_articular_files() {
  local ending
  compopt -o filenames 2> /dev/null
  mapfile -t COMPREPLY < <({
    compgen -d -- "$word"
    for ending; do compgen -f -X "!*$ending" -- "$word"; done
  } | sort -u)
}

# _articular_names NAMES: adds those that go on from what is typed.
_articular_names() {
  mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -W "$1" -- "$word")
}
)bash";

/// Sets `word`, the one to be completed; `option`, that before it; `key`, as far as it stands
/// before a "=". Then `path`, the subcommand with those above it.
constexpr const char* kWhereTheCursorIs = R"bash(
_articular() {
  local word=${COMP_WORDS[COMP_CWORD]} option=${COMP_WORDS[COMP_CWORD - 1]} key= path=articular i
  COMPREPLY=()
  i=$COMP_CWORD
  if [ "$word" = = ]; then
    word=
  elif [ "$option" = = ]; then
    i=$((i - 1))
  fi
  if [ "${COMP_WORDS[i]}" = = ]; then
    option=${COMP_WORDS[i - 1]}
    if [[ $option != --* ]]; then
      key=$option=
      option=${COMP_WORDS[i - 2]}
    fi
  fi
)bash";

std::string quoted(const std::string& text) { return "'" + text + "'"; }

std::string offer(const CompletedValue& value) {
  std::string call = value.words.empty() ? "_articular_files" : "_articular_words";
  for (const std::string& word : value.words) call += " " + word;
  for (const std::string& ending : value.endings) call += " " + ending;
  if (value.files) call += " ''";
  if (!value.listing.empty()) call += "; _articular_names \"$(" + value.listing + ")\"";
  return value.empty() ? ":" : call;
}

struct Cases {
  std::string paths;        // "'articular run' | 'articular check'"
  std::string values;       // of options, by path and name
  std::string options;      // by path
  std::string positionals;  // by path; of a group its subcommands
};

void add_cases(const Command& command, const std::string& path, Cases& cases) {
  std::string names, subcommands;
  for (const Argument& option : command.options) {
    const std::string offered = offer(completed_value(option));
    for (const std::string& name : option.names) {
      names += " " + name;
      if (!option.value.empty())
        cases.values += fmt::format("    '{} {}') {}; return ;;\n", path, name, offered);
    }
  }
  for (const Command& below : command.commands) {
    const std::string path_below = path + " " + below.name;
    subcommands += " " + below.name;
    cases.paths += (cases.paths.empty() ? "" : " | ") + quoted(path_below);
    add_cases(below, path_below, cases);
  }
  cases.options += fmt::format("        {}) _articular_words{} ;;\n", quoted(path), names);
  cases.positionals += fmt::format("        {}) {} ;;\n", quoted(path),
                                   subcommands.empty() ? offer(completed_positional(command))
                                                       : "_articular_words" + subcommands);
}

}  // namespace

std::string bash_completion(const Command& program) {
  Cases cases;
  add_cases(program, program.name, cases);
  return std::string(
             "# Completion of articular for bash, as `articular manual bash` prints it.\n") +
         kHelpers + kWhereTheCursorIs + "  for ((i = 1; i < COMP_CWORD; ++i)); do\n" +
         "    case \"$path ${COMP_WORDS[i]}\" in\n      " + cases.paths +
         ") path+=\" ${COMP_WORDS[i]}\" ;;\n    esac\n  done\n" + "  case \"$path $option\" in\n" +
         cases.values + "  esac\n" + "  case \"$word\" in\n    -*)\n      case \"$path\" in\n" +
         cases.options + "      esac\n      ;;\n    *)\n      case \"$path\" in\n" +
         cases.positionals +
         "      esac\n      ;;\n  esac\n}\n\ncomplete -F _articular articular\n";
}

}  // namespace articular::tools
