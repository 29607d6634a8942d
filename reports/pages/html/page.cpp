#include "reports/pages/html/page.hpp"

#include <cctype>

#include "reports/pages/html/style.hpp"
#include "reports/pages/junit.hpp"

namespace reports {
std::string html_page(const std::string& title, const std::string& body) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         html_text(title) + "</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>" + page_style() +
         "</style>\n</head>\n<body>\n" + body + "<script>" + page_script() + "</script>\n</body>\n</html>\n";
}

std::string html_text(const std::string& text) {
  return xml_text(text);
}

std::string html_anchor(const std::string& study) {
  std::string anchor = "study-";
  for (const char c : study) anchor += std::isalnum(static_cast<unsigned char>(c)) ? c : '-';
  return anchor;
}

std::string html_token(const std::string& text) {
  std::string token = html_text(text);
  for (char& c : token)
    if (c == ' ') c = '-';
  return token;
}

std::string html_table(const std::string& head, const std::string& rows, const std::string& css_class) {
  return "<div class=\"scroll\"><table class=\"" + css_class + "\">\n<thead><tr>" + head +
         "</tr></thead>\n<tbody>\n" + rows + "</tbody>\n</table></div>\n";
}

}  // namespace reports
