#pragma once

#include <filesystem>
#include <string>

namespace verification {

struct NewOptions {
  std::filesystem::path studies;  ///< beside which the templates lie
  std::string what, name, language = "python";
};
/// `new study NAME` writes NAME.toml; `new solver NAME` a directory NAME with a solver in a language and a
/// study of it. Both run as they are. Throws ConfigError where something is there already.
int new_command(const NewOptions& options);

}  // namespace verification
