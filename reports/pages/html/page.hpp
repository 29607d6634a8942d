#pragma once

#include <string>
#include <string_view>

namespace reports {

/// A whole HTML page without external resources; `body` goes in as it is, the script after it.
std::string html_page(const std::string& title, const std::string& body);

/// Text made literal for HTML, bad bytes replaced.
std::string html_text(const std::string& text);

/// A fragment identifier made from a study's name: letters, digits and dashes after "study-".
std::string html_anchor(const std::string& study);

/// A word for an attribute that holds a list of words: blanks become dashes.
std::string html_token(const std::string& text);

/// A table that scrolls sideways by itself on a narrow screen, or, with the class "cards", shows each row as
/// a block there. `head` and `rows` are markup.
std::string html_table(const std::string& head, const std::string& rows, const std::string& css_class = "");

}  // namespace reports
