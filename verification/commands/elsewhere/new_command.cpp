#include "verification/commands/elsewhere/new_command.hpp"

#include <map>

#include "reports/files/atomic_file.hpp"
#include "reports/records/directory/result_files.hpp"
#include "verification/commands/output.hpp"
#include "verification/config/config_error.hpp"

namespace verification {
namespace {

namespace fs = std::filesystem;

struct Language {
  const char *source, *command, *build;
};

const std::map<std::string, Language>& languages() {
  static const std::map<std::string, Language> known = {
      {"sh", {"solver.sh", R"(["sh", "solver.sh", "{scene}", "{out}"])", ""}},
      {"python", {"solver.py", R"(["python3", "solver.py", "{scene}", "{out}"])", ""}},
      {"cpp",
       {"solver.cpp", R"(["./solver", "{scene}", "{out}"])", "g++ -std=c++17 -O2 -o solver solver.cpp"}}};
  return known;
}

std::string filled(std::string text, const std::map<std::string, std::string>& values) {
  for (const auto& [mark, value] : values)
    for (std::size_t at = text.find(mark); at != text.npos; at = text.find(mark, at + value.size()))
      text.replace(at, mark.size(), value);
  return text;
}

void write_new(const fs::path& file, const std::string& text) {
  if (fs::exists(fs::symlink_status(file)))
    throw ConfigError(file.string() + " is there already: choose another name, or remove it");
  reports::write_file(file, text);
  say("{}\n", file.string());
}

}  // namespace

int new_command(const NewOptions& options) {
  if (!reports::is_plain_name(options.name))
    throw ConfigError("'" + options.name + "' becomes the name of a study: letters, digits and . _ = - only");
  const fs::path templates = options.studies.parent_path() / "templates";
  std::map<std::string, std::string> values = {{"@NAME@", options.name}};
  const auto text_of = [&](const std::string& name) {
    return filled(reports::read_file(templates / name), values);
  };
  if (options.what == "study") {
    write_new(options.name + ".toml", text_of("study.toml"));
    say("run it:   mpm-verify run {}.toml --out results\n", options.name);
    return 0;
  }
  const Language& language = languages().at(options.language);
  values["@COMMAND@"] = language.command;
  values["@SOURCE@"] = language.source;
  const fs::path folder = options.name;
  write_new(folder / language.source, (reports::ensure_directory(folder), text_of(language.source)));
  write_new(folder / (options.name + ".toml"), text_of("solver-study.toml"));
  say("run it:   cd {}{}{} && mpm-verify run {}.toml --out results\n", options.name,
      *language.build ? " && " : "", language.build, options.name);
  return 0;
}

}  // namespace verification
