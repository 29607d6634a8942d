#include "reports/files/content_hash.hpp"

#include <fmt/format.h>

#include <cstring>

namespace reports {
namespace {

std::uint64_t mix(std::uint64_t hash, std::uint64_t word) {
  hash = (hash ^ word) * 1099511628211u;
  return hash ^ (hash >> 32);  // a plain product never carries a high bit down
}

}  // namespace

std::uint64_t content_hash(std::string_view bytes, std::uint64_t seed) {
  std::uint64_t hash = mix(seed, bytes.size());
  while (!bytes.empty()) {
    const std::size_t count = bytes.size() < 8 ? bytes.size() : 8;
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data(), count);
    hash = mix(hash, word);
    bytes.remove_prefix(count);
  }
  return hash;
}

std::string content_name(std::string_view bytes) {
  return fmt::format("{:016x}", content_hash(bytes));
}

}  // namespace reports
