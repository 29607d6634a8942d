#include "verification/scene/matrix.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace verification {

std::vector<std::string> part_names(TomlTable& table, const std::string& key,
                                    const std::vector<mpm::SchemePart>& parts) {
  std::vector<std::string> known;
  std::string list;
  for (const mpm::SchemePart& part : parts) {
    known.push_back(part.name);
    list += (list.empty() ? "" : ", ") + part.name;
  }
  const std::vector<std::string> names = table.has(key) ? table.texts(key) : known;
  for (const std::string& name : names)
    if (std::ranges::count(known, name) == 0)
      table.fail(key, "'" + name + "' is not known; choose from: " + list);
  return names;
}

std::vector<MatrixEntry> read_matrix(TomlTable table) {
  std::vector<MatrixEntry> entries;
  const auto bases = part_names(table, "basis", mpm::basis_parts());
  const auto transfers = part_names(table, "transfer", mpm::transfer_parts());
  const auto steppings = part_names(table, "stepping", mpm::stepping_parts());
  const double flip_fraction = table.number("flip_fraction", mpm::Scheme{}.flip_fraction);
  table.refuse_unknown_keys();
  for (const std::string& basis : bases)
    for (const std::string& transfer : transfers)
      for (const std::string& stepping : steppings)
        entries.push_back(
            {basis + "_" + transfer + "_" + stepping, basis, transfer, stepping, flip_fraction});
  return entries;
}

std::string MatrixEntry::toml() const {
  std::string text = fmt::format("[scheme]\nbasis = \"{}\"\ntransfer = \"{}\"\nstepping = \"{}\"\n", basis,
                                 transfer, stepping);
  if (transfer == mpm::name(mpm::Scheme::Transfer::FlipBlend))
    text += fmt::format("flip_fraction = {}\n", flip_fraction);
  return text;
}

}  // namespace verification
