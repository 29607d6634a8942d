#include "verification/commands/commands.hpp"
#include "verification/commands/output.hpp"
#include "verification/schema/study_schema.hpp"

namespace verification {

int schema_command(const SchemaOptions& options) {
  say("{}", options.markdown ? keys_page() : options.scene ? scene_schema() : study_schema());
  return 0;
}

}  // namespace verification
