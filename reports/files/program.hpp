#pragma once

#include <string>
#include <string_view>

namespace reports {

/// The path of an executable file: `name` itself if it has a slash, else the first of that name on $PATH; ""
/// if there is none.
std::string find_program(const std::string& name);

/// What a program said, on one line, at most 400 characters of it.
std::string one_line(std::string_view text);

}  // namespace reports
