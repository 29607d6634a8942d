#include "verification/scene/matrix.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "solver/sph/sph_scheme.hpp"

namespace verification {
namespace {

/// Names listed under a key, all of `known` where it is absent.
std::vector<std::string> listed(TomlTable& table, const std::string& key,
                                const std::vector<std::string>& known) {
  const std::vector<std::string> names = table.has(key) ? table.texts(key) : known;
  if (names.empty()) table.fail(key, "must name one at least");
  for (const std::string& name : names)
    if (std::ranges::count(known, name) == 0)
      table.fail(key, fmt::format("'{}' is not known; choose from: {}", name, fmt::join(known, ", ")));
  return names;
}

std::vector<MatrixEntry> read_sph_matrix(TomlTable& table) {
  using mpm::SphScheme;
  std::vector<MatrixEntry> entries;
  const auto kernels =
      listed(table, "kernel", {mpm::name(SphScheme::Kernel::Quintic), mpm::name(SphScheme::Kernel::Cubic)});
  const auto walls =
      listed(table, "wall", {mpm::name(SphScheme::Wall::Mirror), mpm::name(SphScheme::Wall::Morris)});
  const auto densities =
      listed(table, "density",
             {mpm::name(SphScheme::Density::Continuity), mpm::name(SphScheme::Density::Summation)});
  table.refuse_unknown_keys();
  for (const std::string& kernel : kernels)
    for (const std::string& wall : walls)
      for (const std::string& density : densities) {
        MatrixEntry entry;
        entry.variant = "sph_" + kernel + "_" + wall + "_" + density;
        entry.kernel = kernel;
        entry.wall = wall;
        entry.density = density;
        entries.push_back(entry);
      }
  return entries;
}

}  // namespace

std::vector<std::string> part_names(TomlTable& table, const std::string& key,
                                    const std::vector<mpm::SchemePart>& parts) {
  std::vector<std::string> known;
  for (const mpm::SchemePart& part : parts) known.push_back(part.name);
  return listed(table, key, known);
}

std::vector<MatrixEntry> read_matrix(TomlTable table) {
  const std::string method = table.text("method", "mpm");
  if (method != "mpm" && method != "sph") table.fail("method", "must be \"mpm\" or \"sph\"");
  if (method == "sph") return read_sph_matrix(table);
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
            {basis + "_" + transfer + "_" + stepping, basis, transfer, stepping, flip_fraction, "", "", ""});
  return entries;
}

std::string MatrixEntry::toml() const {
  if (is_sph())
    return fmt::format("[scheme]\nmethod = \"sph\"\nkernel = \"{}\"\nwall = \"{}\"\ndensity = \"{}\"\n",
                       kernel, wall, density);
  std::string text = fmt::format("[scheme]\nbasis = \"{}\"\ntransfer = \"{}\"\nstepping = \"{}\"\n", basis,
                                 transfer, stepping);
  if (transfer == mpm::name(mpm::Scheme::Transfer::FlipBlend))
    text += fmt::format("flip_fraction = {}\n", flip_fraction);
  return text;
}

}  // namespace verification
