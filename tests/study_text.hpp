#pragma once

#include <cstddef>
#include <string>

#include "tests/catch.hpp"

// Texts of small scenes and studies. Tests write them with ScratchDirectory::write and vary them with
// replaced().

/// The text with its first `from` replaced; the test fails where there is none.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  INFO("looking for " << from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

/// How often a part occurs in a text.
inline std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

/// A Couette start-up of water-like fluid in a gap of 1 mm without pressure (settled after 1 s): a scene that
/// runs in milliseconds. The arguments are the lines of [discretisation] and of [time].
inline std::string couette_scene(const std::string& discretisation = "cells = 8",
                                 const std::string& time = "dt = 2e-3\noutputs = [0.1, 0.2]") {
  return R"([scene]
flow = "couette"
height = 1e-3
plate_velocity = 1e-4
[fluid]
kinematic_viscosity = 1e-6
pressure = false
[discretisation]
)" + discretisation +
         "\n[time]\n" + time + "\n";
}

/// A study: title, claim, further lines of its head (e.g. `suite = "deep"`), and the tables that follow.
inline std::string study_text(const std::string& title, const std::string& claim, const std::string& body,
                              const std::string& head = "") {
  return "title = \"" + title + "\"\nclaim = \"" + claim + "\"\n" + head + body;
}
