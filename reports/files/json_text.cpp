#include "reports/files/json_text.hpp"

namespace reports {

Json parse_json(const std::string& text) {
  return Json::parse(text);
}

std::string json_text(const Json& json, int indent, InvalidText invalid) {
  return json.dump(indent, ' ', false,
                   invalid == InvalidText::Replaced ? Json::error_handler_t::replace
                                                    : Json::error_handler_t::strict) +
         "\n";
}

}  // namespace reports
