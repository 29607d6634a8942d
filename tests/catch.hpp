#pragma once

// One include for Catch2 v2 (Debian 12) and v3 (Ubuntu 24.04).
#include <string>

#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
using Catch::Approx;
/// Matcher: the text holds `part`.
inline auto contains(const std::string& part) {
  return Catch::Matchers::ContainsSubstring(part);
}
#else
#include <catch2/catch.hpp>
/// Matcher: the text holds `part`.
inline auto contains(const std::string& part) {
  return Catch::Matchers::Contains(part);
}
#endif
