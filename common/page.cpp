#include "common/page.hpp"

#include <cmath>
#include <cstdint>
#include <cstdio>

#include "common/markup.hpp"
#include "common/page_text.hpp"

namespace navjit::common {

Cell measured(double value, const char* format) {
  if (!(value > 0) || !std::isfinite(value)) return {"-"};
  char text[40];
  std::snprintf(text, sizeof text, format, value);
  return {text, value};
}

Cell counted(std::uint64_t value) {
  std::string text = std::to_string(value);
  for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, ",");
  return {text, static_cast<double>(value)};
}

std::string table_html(const std::vector<std::string>& headings,
                       const std::vector<std::vector<Cell>>& rows) {
  std::string html = "<div class=\"wide\"><table class=\"sorts\"><thead><tr>";
  for (const std::string& heading : headings) {
    html += "<th scope=\"col\"><button type=\"button\">" + markup(heading) + "</button></th>";
  }
  html += "</tr></thead><tbody>\n";
  for (const std::vector<Cell>& row : rows) {
    html += "<tr>";
    for (const Cell& cell : row) {
      if (cell.value) {
        char value[40];
        std::snprintf(value, sizeof value, "%.9g", *cell.value);
        html += std::string("<td class=\"n\" data-v=\"") + value + "\">";
      } else {
        html += cell.text == "-" ? "<td class=\"n\">" : "<td>";
      }
      html += markup(cell.text) + "</td>";
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string facts_html(const std::vector<std::pair<std::string, std::string>>& facts) {
  std::string html = "<table class=\"facts\"><tbody>\n";
  for (const auto& [what, value] : facts) {
    html += "<tr><th scope=\"row\">" + markup(what) + "</th><td>" + markup(value) + "</td></tr>\n";
  }
  return html + "</tbody></table>\n";
}

std::string shares_html(const std::vector<std::pair<std::string, double>>& shares) {
  std::string bar = "<div class=\"bar\">", legend = "<p class=\"legend\">";
  int number = 0;
  for (const auto& [name, share] : shares) {
    number = number % 6 + 1;
    if (!(share > 0)) continue;
    char text[64];
    std::snprintf(text, sizeof text, "%.3f%%", 100 * share);
    bar += "<span class=\"k" + std::to_string(number) + "\" style=\"width:" + text + "\"></span>";
    std::snprintf(text, sizeof text, " %.1f%%", 100 * share);
    legend += "<span class=\"key\"><i class=\"k" + std::to_string(number) + "\"></i>" +
              markup(name) + text + "</span> ";
  }
  return bar + "</div>" + legend + "</p>\n";
}

std::string picture_html(const std::string& png, const std::string& caption) {
  return "<figure><img alt=\"" + markup(caption) + "\" src=\"data:image/png;base64," + base64(png) +
         "\"><figcaption>" + markup(caption) + "</figcaption></figure>\n";
}

std::string heading_html(const std::string& text) { return "<h2>" + markup(text) + "</h2>\n"; }
std::string paragraph_html(const std::string& text) { return "<p>" + markup(text) + "</p>\n"; }

std::string page_html(const std::string& title, const std::string& body) {
  // Nothing is fetched from anywhere, whatever might be in the page.
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
         "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src "
         "data:; "
         "style-src 'unsafe-inline'; script-src 'unsafe-inline'\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         markup(title) + "</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>" + page_style +
         "</style></head>\n<body>\n<h1>" + markup(title) + "</h1>\n" + body + "<script>" +
         page_script + "</script>\n</body></html>\n";
}

}  // namespace navjit::common
