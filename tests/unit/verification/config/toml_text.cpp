#include "verification/config/toml_text.hpp"

#include "tests/catch.hpp"
#include "tests/scratch_directory.hpp"
#include "verification/config/config_error.hpp"
#include "verification/config/toml_table.hpp"

using namespace verification;

namespace {

void check_refused(const std::string& text, const std::string& names) {
  INFO(text.substr(0, 60));
  CHECK_THROWS_AS(TomlTable::from_text(text, "file.toml"), ConfigError);
  CHECK_THROWS_WITH(TomlTable::from_text(text, "file.toml"), contains(names));
}

std::string repeated(const std::string& part, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += part;
  return text;
}

}  // namespace

TEST_CASE("keys and brackets nested too deeply are refused, not recursed into") {
  check_refused(repeated("a.", 40000) + "a = 1\n", "file.toml:1: not valid TOML: keys are nested");
  check_refused("[" + repeated("\"a\" . ", 40000) + "a]\n", "keys are nested");
  check_refused("x = {" + repeated("a.", 40000) + "a = 1}\n", "keys are nested");
  check_refused("x = " + repeated("[", 40000), "brackets are nested");
  check_refused("x = " + repeated("{a = ", 40000), "brackets are nested");
  CHECK_NOTHROW(TomlTable::from_text("a.b.c = [[0.1, 0.2], [0.3]]\nd = \"a.b.c.d.e.f\"\n", "file.toml"));
  std::string numbers = "x = [";
  for (int i = 0; i < 1000; ++i) numbers += "0.5, ";
  CHECK_NOTHROW(TomlTable::from_text(numbers + "1.5]\n", "file.toml"));
  CHECK_NOTHROW(TomlTable::from_text(
      "# " + repeated("a.", 1000) + "\nx = '''\n" + repeated("b.", 1000) + "'''\n", "f"));
  CHECK_NOTHROW(TomlTable::from_text("x = \"\"\"\n\\\"\"\" " + repeated("[", 100) + "\"\"\"\n", "file.toml"));
}

TEST_CASE("what is no text is refused with its line") {
  check_refused("a = 1\n[\xc3\xa9]\n",
                "file.toml:2: not valid TOML: a letter beyond ASCII outside of quotes");
  check_refused("a = \"\xff\"\n", "file.toml:1: not valid TOML: a byte that is no UTF-8");
  check_refused("a = \"\xef\xbf\xbf\"\n", "no UTF-8");  // U+FFFF
  check_refused(std::string("a = 1\nb = \"x\0y\"\n", 17), "file.toml:2: not valid TOML: a control character");
  check_refused("a = \"\x1b[31m\"\n", "control character");
  CHECK_NOTHROW(TomlTable::from_text("a = \"caf\xc3\xa9\"  # \xc3\xa9\r\n\"\xc3\xa9\" = 1\r\n", "file.toml"));
  TomlTable escaped = TomlTable::from_text("a = \"x\\u0007y\"\nb = \"tab\\t\"\n", "file.toml");
  CHECK_THROWS_WITH(escaped.text("a"), contains("key 'a': must not hold control characters"));
  CHECK(escaped.text("b") == "tab\t");
}

TEST_CASE("only files of a sensible size are read") {
  const ScratchDirectory scratch;
  CHECK_THROWS_WITH(TomlTable::from_file(scratch.path().string()), contains("is a directory"));
  CHECK_THROWS_WITH(TomlTable::from_file("/dev/zero"), contains("cannot be read"));
  CHECK_THROWS_WITH(TomlTable::from_file((scratch / "absent.toml").string()), contains("cannot be read"));
  const std::string large = scratch.write("large.toml", "# " + std::string(std::size_t{17} << 20, 'x'));
  CHECK_THROWS_WITH(TomlTable::from_file(large), contains("16 MiB"));
  CHECK(TomlTable::from_file(scratch.write("empty.toml", "")).print().empty());
}

TEST_CASE("numbers that no SI unit makes sensible are refused with key and range") {
  TomlTable table =
      TomlTable::from_text("a = 5e-324\nb = 1e300\nc = 0\nd = -1e-30\ne = [1e31]\n", "file.toml");
  CHECK_THROWS_WITH(table.number("a"),
                    contains("key 'a': is 5e-324: must be 0 or lie between 1e-30 and 1e+30"));
  CHECK_THROWS_WITH(table.number("b"), contains("'b'"));
  CHECK(table.number("c") == 0);
  CHECK(table.number("d") == -1e-30);
  CHECK_THROWS_WITH(table.numbers("e"), contains("'e'"));
}
