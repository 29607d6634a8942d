#pragma once

#include <toml++/toml.h>

#include <string>

namespace verification {

/// A table as TOML text that reads back to the same values bit by bit: values first, then the sub-tables
/// under their full names. (The library's own formatter has undefined behaviour for arrays of numbers below
/// 0.1: it casts a negative logarithm to an unsigned width.)
std::string printed_toml(const toml::table& table);

}  // namespace verification
