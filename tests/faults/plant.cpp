// Makes a copy of the source in which every fault of a list can be switched on: plant-faults LIST SOURCE
// DESTINATION. The tree itself stays free of switches; the copy is compiled once and asks MPM_FAULT, the
// fault's name, when it starts.

#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace {

struct Fault {
  std::string name, file, right, wrong;
};

std::string content_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error("cannot read " + file.string());
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// Leaves a file that holds the text already as it is, so that nothing is compiled again for it.
void keep(const fs::path& file, const std::string& text) {
  if (fs::exists(file) && content_of(file) == text) return;
  fs::create_directories(file.parent_path());
  std::ofstream out(file, std::ios::binary);
  if (!(out << text)) throw std::runtime_error("cannot write " + file.string());
}

std::vector<Fault> read_list(const fs::path& list) {
  std::istringstream lines(content_of(list));
  std::vector<Fault> faults;
  std::set<std::string> names;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line.starts_with("#")) continue;
    if (line.starts_with("- ") || line.starts_with("+ ")) {
      if (faults.empty()) throw std::runtime_error("a text before the first fault: " + line);
      std::string& text = line[0] == '-' ? faults.back().right : faults.back().wrong;
      text += (text.empty() ? "" : "\n") + line.substr(2);
      continue;
    }
    Fault fault;
    std::istringstream(line) >> fault.name >> fault.file;
    if (fault.file.empty() || !names.insert(fault.name).second)
      throw std::runtime_error("no fault, or one named twice: " + line);
    faults.push_back(fault);
  }
  return faults;
}

/// The right text with the wrong one beside it, chosen at run time.
std::string switched(const Fault& fault) {
  const std::string on = "MPM_FAULT_ON(\"" + fault.name + "\")";
  if (fault.right.ends_with("{")) {  // a condition: "if (right) {"
    const auto condition = [](const std::string& text) {
      return text.substr(text.find('('), text.rfind(')') + 1 - text.find('('));
    };
    return "if (" + on + " ? " + condition(fault.wrong) + " : " + condition(fault.right) + ") {";
  }
  if (fault.right.ends_with(";")) {
    const std::size_t equals = fault.right.find(" = ");
    // The declaration of a variable: its value is an expression.
    if (equals != std::string::npos && equals == fault.wrong.find(" = ") &&
        fault.right.substr(0, equals).find(' ') != std::string::npos)
      return fault.right.substr(0, equals) + " = (" + on + " ? (" +
             fault.wrong.substr(equals + 3, fault.wrong.size() - equals - 4) + ") : (" +
             fault.right.substr(equals + 3, fault.right.size() - equals - 4) + "));";
    return "{\nif (" + on + ") {\n" + fault.wrong + "\n} else {\n" + fault.right +
           "\n}\n}";  // braces: it may stand after an if
  }
  return "(" + on + " ? (" + fault.wrong + ") : (" + fault.right + "))";
}

std::string planted(std::string text, const Fault& fault) {
  const std::size_t at = text.find(fault.right);
  if (at == std::string::npos || text.find(fault.right, at + 1) != std::string::npos)
    throw std::runtime_error("fault '" + fault.name + "' no longer fits: its right text must stand once in " +
                             fault.file + ":\n" + fault.right);
  return text.replace(at, fault.right.size(), switched(fault));
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 4) throw std::runtime_error("usage: plant-faults LIST SOURCE DESTINATION");
  const std::vector<Fault> faults = read_list(argv[1]);
  const fs::path source = argv[2], destination = argv[3];
  std::map<std::string, std::string> texts;
  std::string complaints;
  for (const Fault& fault : faults) try {
      if (!texts.contains(fault.file)) texts[fault.file] = content_of(source / fault.file);
      texts[fault.file] = planted(texts[fault.file], fault);
    } catch (const std::exception& error) {
      complaints += std::string(error.what()) + "\n";
    }
  if (!complaints.empty()) throw std::runtime_error(complaints);
  for (auto& [file, text] : texts) text = "#include \"tests/faults/fault.hpp\"\n" + text;
  for (const char* part : {"CMakeLists.txt", "LICENSE", "README.md", "CHANGELOG.md", "CITATION.cff",
                           "packaging", "docs", "solver", "reference", "reports", "verification", "tests"}) {
    const auto copy = [&](const fs::path& file) {
      const std::string name = fs::relative(file, source).string();
      const auto text = texts.find(name);
      keep(destination / name, text == texts.end() ? content_of(file) : text->second);
    };
    if (fs::is_regular_file(source / part)) copy(source / part);
    if (fs::is_directory(source / part))
      for (const auto& entry : fs::recursive_directory_iterator(source / part))
        if (entry.is_regular_file()) copy(entry.path());
  }
  std::string names;
  for (const Fault& fault : faults) names += fault.name + " " + fault.file + "\n";
  keep(destination / "faults.names", names);
  std::cout << faults.size() << " faults planted in " << texts.size() << " files\n";
  return 0;
} catch (const std::exception& error) {
  std::cerr << "plant-faults: " << error.what() << "\n";
  return 2;
}
