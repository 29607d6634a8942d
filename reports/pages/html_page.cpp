#include "reports/pages/html_page.hpp"

#include <cctype>

#include "reports/pages/junit.hpp"

namespace reports {
namespace {

// Fates of the scoreboard: light blue, amber and dark vermilion differ in lightness, so that they are told
// apart in any vision and in print; each cell has its mark too.
constexpr const char* style = R"(
:root { color-scheme: light dark; --text: #1b1f24; --faint: #57606a; --page: #ffffff; --panel: #f4f6f8;
  --rule: #d5dae0; --link: #0b5cad; --good: #14703a; --good-panel: #e2f4e8; --bad: #b3201c; --bad-panel: #fde8e6;
  --warn-panel: #fdf3d8; }
@media (prefers-color-scheme: dark) { :root { --text: #e3e8ee; --faint: #9aa5b1; --page: #14181d; --panel: #1d232a;
  --rule: #37414c; --link: #79b8ff; --good: #6fd693; --good-panel: #16301f; --bad: #ff9b94; --bad-panel: #3c1a1a;
  --warn-panel: #352c12; } }
* { box-sizing: border-box; }
body { margin: 0; font: 16px/1.5 system-ui, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif;
  color: var(--text); background: var(--page); }
main { max-width: 72rem; margin: 0 auto; padding: 1rem 1.25rem 3rem; }
h1 { font-size: 1.6rem; margin: 0; } h2 { font-size: 1.35rem; margin: 2.5rem 0 .5rem; padding-top: .75rem;
  border-top: 1px solid var(--rule); } h3 { font-size: 1.05rem; margin: 1.5rem 0 .4rem; }
p { margin: .4rem 0; max-width: 60rem; } a { color: var(--link); } .faint { color: var(--faint); }
.banner { padding: 1rem 1.25rem; border-radius: .5rem; border-left: .5rem solid; margin-bottom: 1rem; }
.banner.pass { background: var(--good-panel); border-color: var(--good); }
.banner.fail { background: var(--bad-panel); border-color: var(--bad); }
.warnings { background: var(--warn-panel); padding: .5rem 1.25rem; border-radius: .5rem; }
.pass > b, td.pass { color: var(--good); font-weight: 700; } .fail > b, td.fail { color: var(--bad); font-weight: 700; }
nav { background: var(--panel); padding: .75rem 1.25rem; border-radius: .5rem; }
nav ul { margin: .25rem 0; padding-left: 1.2rem; columns: 22rem; } nav li { break-inside: avoid; }
.scroll { overflow-x: auto; margin: .5rem 0 1rem; }
table { border-collapse: collapse; font-size: .9rem; font-variant-numeric: tabular-nums; }
th, td { padding: .3rem .65rem; border-bottom: 1px solid var(--rule); text-align: left; vertical-align: top; }
th { background: var(--panel); white-space: nowrap; } td.n, th.n { text-align: right; white-space: nowrap; }
td.reason { min-width: 14rem; color: var(--faint); } td.w { min-width: 11rem; } td.out { color: var(--faint); font-style: italic; }
figure { margin: 1rem 0 1.5rem; } figcaption { font-size: .9rem; margin-top: .35rem; max-width: 60rem; }
figure img { display: block; width: 100%; max-width: 60rem; height: auto; background: #ffffff;
  border: 1px solid var(--rule); border-radius: .35rem; }
code { font-size: .9em; overflow-wrap: anywhere; } td { overflow-wrap: break-word; }
.board { width: min(96vw, 120rem); margin-left: calc(50% - min(48vw, 60rem)); overflow: auto; max-height: 92vh; }
.board table { font-size: .66rem; line-height: 1.3; border-collapse: separate; border-spacing: 1px; }
.board th, .board td { padding: .1rem .1rem; border: 0; white-space: nowrap; }
.board thead th { position: sticky; top: 0; z-index: 2; padding-top: .4rem; vertical-align: bottom; font-weight: 600; }
.board thead th span { writing-mode: vertical-rl; transform: rotate(180deg); }
.board tbody th { position: sticky; left: 0; z-index: 1; font-weight: 400; }
.board thead th:first-child { left: 0; z-index: 3; } .board tr.group th { font-weight: 700; padding-top: .5rem; }
.board td { text-align: center; min-width: 1.9rem; } .board td.none { color: var(--faint); }
.fate { padding: 0 .25rem; } .survived { background: #cfe4f7; color: #0b2a45; } .degraded { background: #f5b942; color: #2b1c00; }
.diverged, .failed { background: #8f2a16; color: #ffffff; } .unexpected { outline: 3px solid #ff0033; outline-offset: -1px; font-weight: 700; }
@media print { .board { overflow: visible; max-height: none; width: auto; margin: 0; } .board table { font-size: 5pt; }
  .fate, .board td { print-color-adjust: exact; -webkit-print-color-adjust: exact; } }
@media (max-width: 40rem) { main { padding: .75rem .75rem 2rem; } th, td { padding: .3rem .4rem; } h1 { font-size: 1.3rem; }
  table.cards thead { display: none; } table.cards, table.cards tbody, table.cards tr { display: block; }
  table.cards tr { border-bottom: 1px solid var(--rule); padding: .35rem 0; }
  table.cards td { display: block; border: 0; padding: 0 .2rem; text-align: left; white-space: normal; min-width: 0; }
  td[data-label]::before { content: attr(data-label) ": "; color: var(--faint); } }
@media print { :root { --text: #000; --faint: #333; --page: #fff; --panel: #eee; --rule: #999; --link: #000;
  --good: #14703a; --good-panel: #fff; --bad: #b3201c; --bad-panel: #fff; --warn-panel: #fff; }
  body { font-size: 10pt; } main { max-width: none; padding: 0; } figure, tr { break-inside: avoid; }
  h2, h3 { break-after: avoid; } nav { display: none; } .scroll { overflow: visible; } details > * { display: block; } }
)";

}  // namespace

std::string html_page(const std::string& title, const std::string& body) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         html_text(title) + "</title>\n<style>" + style + "</style>\n</head>\n<body>\n<main>\n" + body +
         "</main>\n</body>\n</html>\n";
}

std::string html_text(const std::string& text) {
  return xml_text(text);
}

std::string html_anchor(const std::string& study) {
  std::string anchor = "study-";
  for (const char c : study) anchor += std::isalnum(static_cast<unsigned char>(c)) ? c : '-';
  return anchor;
}

std::string base64(std::string_view bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return k < bytes.size() ? static_cast<unsigned>(static_cast<unsigned char>(bytes[k])) : 0u;
    };
    const unsigned group = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    text += digits[group >> 18];
    text += digits[group >> 12 & 63];
    text += i + 1 < bytes.size() ? digits[group >> 6 & 63] : '=';
    text += i + 2 < bytes.size() ? digits[group & 63] : '=';
  }
  return text;
}

std::string html_table(const std::string& head, const std::string& rows, const std::string& css_class) {
  return "<div class=\"scroll\"><table class=\"" + css_class + "\">\n<thead><tr>" + head +
         "</tr></thead>\n<tbody>\n" + rows + "</tbody>\n</table></div>\n";
}

}  // namespace reports
